// Undo and redo of an object whose states are values.
#pragma once
#include <utility>

#include "base/error.h"
#include "base/memory.h"

namespace hf_inner {

template <class State>
class History {
 public:
  // States kept for undo; a further one drops the oldest. More costs memory: a state shares paths and dense blocks with
  // its neighbours, but not its list of sites. The headers promise this number.
  static constexpr std::size_t most_states = 256;
  explicit History(Memory& memory) : undo_(&memory), redo_(&memory) {}

  void record(State&& present) {
    if (undo_.size() == most_states) undo_.erase(undo_.begin());
    undo_.push_back(std::move(present));
    redo_.clear();
  }
  // After an edit there is nothing to redo.
  void clear_redo() noexcept { redo_.clear(); }

  // Go back to the last recorded state, or forward to the last one undone. present() makes the present state, which the
  // other stack takes. restore(state) installs the old one and may move from it. All or nothing when restore is. Throw
  // HF_ERROR_NO_RECORD with the message `nothing`.
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
