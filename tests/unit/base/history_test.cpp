// Undo stacks and numbers.
#include "base/history.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "base/number_pool.h"

namespace {

struct Counter {
  explicit Counter(hf_inner::Memory& memory) : history(memory) {}
  void record() { history.record(int(now)); }
  void undo() {
    history.undo(
        "no record", [&] { return now; }, [&](int& state) { restore(state); });
  }
  void redo() {
    history.redo(
        "nothing undone", [&] { return now; }, [&](int& state) { restore(state); });
  }
  void restore(int state) {
    if (refuse) throw std::bad_alloc();
    now = state;
  }
  int now = 0;
  bool refuse = false;
  hf_inner::History<int> history;
};

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_NO_RECORD);
    return error.what();
  }
  return "";
}

TEST(History, goes_back_and_forth_between_recorded_states) {
  hf_inner::Memory memory;
  Counter c(memory);
  EXPECT_EQ(message_of([&] { c.undo(); }), "no record");
  EXPECT_EQ(message_of([&] { c.redo(); }), "nothing undone");
  c.now = 1;
  c.record();
  c.now = 2;
  c.record();
  c.now = 3;
  c.undo();
  EXPECT_EQ(c.now, 2);
  c.undo();
  EXPECT_EQ(c.now, 1);
  EXPECT_EQ(message_of([&] { c.undo(); }), "no record");
  c.redo();
  c.redo();
  EXPECT_EQ(c.now, 3);
  c.undo();
  c.history.clear_redo();  // as an edit does
  EXPECT_EQ(message_of([&] { c.redo(); }), "nothing undone");
  c.undo();
  c.record();  // a record is the end of what was undone too
  EXPECT_EQ(message_of([&] { c.redo(); }), "nothing undone");
}

TEST(History, drops_the_oldest_state_beyond_its_limit) {
  hf_inner::Memory memory;
  Counter c(memory);
  const int most = static_cast<int>(hf_inner::History<int>::most_states);
  for (c.now = 0; c.now < most + 5; ++c.now) c.record();
  for (int k = 0; k < most; ++k) c.undo();
  EXPECT_EQ(c.now, 5);
  EXPECT_EQ(message_of([&] { c.undo(); }), "no record");
}

TEST(History, stays_as_it_was_when_a_state_cannot_be_restored) {
  hf_inner::Memory memory;
  Counter c(memory);
  c.now = 1;
  c.record();
  c.now = 2;
  c.refuse = true;
  EXPECT_THROW(c.undo(), std::bad_alloc);
  c.refuse = false;
  EXPECT_EQ(message_of([&] { c.redo(); }), "nothing undone");
  c.undo();
  EXPECT_EQ(c.now, 1);
}

TEST(NumberPool, gives_the_smallest_numbers_that_are_free) {
  std::set<std::uint32_t> used{0, 1, 3};
  hf_inner::NumberPool pool;
  const auto take = [&] {
    const std::uint32_t number = pool.take([&](std::uint32_t n) { return used.count(n) > 0; });
    used.insert(number);
    return number;
  };
  EXPECT_EQ(take(), 2u);
  EXPECT_EQ(take(), 4u);
  EXPECT_EQ(take(), 5u);
  used.erase(4);
  pool.give_back(4);
  used.erase(1);
  pool.give_back(1);
  EXPECT_EQ(take(), 1u);
  EXPECT_EQ(take(), 4u);
  EXPECT_EQ(take(), 6u);
  // taken at once, even before the owner says that it is in use
  hf_inner::NumberPool batch;
  const auto none = [](std::uint32_t) { return false; };
  EXPECT_EQ(batch.take(none), 0u);
  EXPECT_EQ(batch.take(none), 1u);
}

}  // namespace
