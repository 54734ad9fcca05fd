// Undo and redo for an object whose states can be copied or moved.
#pragma once
#include <utility>

#include "base/error.h"
#include "base/memory.h"

namespace hf_inner {

template <class State>
class History {
 public:
  // Number of states kept for undo; recording one more drops the oldest. A larger number costs memory, because every
  // state has its own list of sites. The public headers promise this number.
  static constexpr std::size_t most_states = 256;
  explicit History(Memory& memory) : undo_(&memory), redo_(&memory) {}

  void record(State&& present) {
    if (undo_.size() == most_states) undo_.erase(undo_.begin());
    undo_.push_back(std::move(present));
    redo_.clear();
  }
  // Call this after an edit: the undone states no longer apply.
  void clear_redo() noexcept { redo_.clear(); }

  // undo restores the last recorded state; redo restores the last undone state. present() returns the present state,
  // which goes on the other stack. restore(state) installs the old state and may move from it. If restore throws,
  // nothing changes. If there is no state to restore, both throw HF_ERROR_NO_RECORD with the message `nothing`.
  template <class Present, class Restore>
  void undo(const char* nothing, Present&& present, Restore&& restore) {
    step(undo_, redo_, nothing, present, restore);
  }
  template <class Present, class Restore>
  void redo(const char* nothing, Present&& present, Restore&& restore) {
    step(redo_, undo_, nothing, present, restore);
  }

 private:
  template <class Present, class Restore>
  void step(Vector<State>& from, Vector<State>& to, const char* nothing, Present&& present, Restore&& restore) {
    if (from.empty()) fail(HF_ERROR_NO_RECORD, HF_NO_INDEX, "%s", nothing);
    State now = present();
    // room for it is taken first and kept only when all is done
    Vector<State> grown(to.get_allocator());
    if (to.size() == to.capacity()) grown.reserve(2 * to.size() + 1);
    restore(from.back());
    if (grown.capacity() > 0) {
      for (State& state : to) grown.push_back(std::move(state));
      to.swap(grown);
    }
    to.push_back(std::move(now));
    from.pop_back();
  }
  Vector<State> undo_, redo_;
};

}  // namespace hf_inner
