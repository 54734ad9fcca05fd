// Vectors that share their elements and grow behind one another.
#include "base/shared_vector.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace {

using hf_inner::Memory;
using hf_inner::SharedVector;

SharedVector<int> counted(int count, Memory& memory) {
  SharedVector<int> out(memory);
  for (int i = 0; i < count; ++i) out.push_back(i);
  out.leave_room();
  return out;
}
SharedVector<int> grown(const SharedVector<int>& from, std::size_t count, int value, Memory& memory) {
  SharedVector<int> out = from.grown(count, memory);
  std::fill(out.begin() + from.size(), out.end(), value);
  return out;
}

TEST(SharedVector, ALongerOneSharesTheRoomOfOneAlone) {
  Memory memory;
  const SharedVector<int> base = counted(160, memory);
  const SharedVector<int> longer = grown(base, 163, 1000, memory), sibling = grown(base, 165, 2000, memory);
  EXPECT_EQ(longer.data(), base.data());
  EXPECT_NE(sibling.data(), base.data());  // the room belongs to `longer`
  EXPECT_EQ(base.size(), 160u);
  for (int i = 0; i < 160; ++i) {
    EXPECT_EQ(longer[i], i);
    EXPECT_EQ(sibling[i], i);
  }
  EXPECT_EQ(longer.back(), 1000);
  EXPECT_EQ(sibling.back(), 2000);
  const SharedVector<int> longest = grown(longer, 170, 3000, memory);
  EXPECT_EQ(longest.data(), base.data());
  EXPECT_EQ(longest[162], 1000);
  EXPECT_EQ(longest[163], 3000);
  EXPECT_NE(grown(longest, 171, 4000, memory).data(), base.data());  // no room is left
}

TEST(SharedVector, TheRoomIsFreeWhenThoseThatHaveItAreGone) {
  Memory memory;
  const SharedVector<int> base = counted(320, memory);
  for (int round = 0; round < 1000; ++round) {
    const SharedVector<int> longer = grown(base, 330, round, memory);
    const SharedVector<int> copy = longer;
    SharedVector<int> longest = grown(copy, 340, -round, memory);
    EXPECT_EQ(longest.data(), base.data());
    EXPECT_EQ(longest[329], round);
  }
  SharedVector<int> last = grown(base, 321, 7, memory);
  {
    const SharedVector<int> kept = grown(last, 322, 8, memory);
    last = base;  // `kept` still reads its place
    EXPECT_NE(grown(base, 321, 9, memory).data(), base.data());
    EXPECT_EQ(kept[320], 7);
  }
  EXPECT_EQ(grown(base, 321, 9, memory).data(), base.data());
}

TEST(SharedVector, ManySmallStepsKeepAllElements) {
  Memory memory;
  SharedVector<int> all = counted(64000, memory);
  for (int i = 0; i < 5000; ++i) all = grown(all, 64001 + i, 64000 + i, memory);
  for (int i = 0; i < 69000; ++i) ASSERT_EQ(all[i], i);
}

TEST(SharedVector, AVectorThatChangesHasNoRoom) {
  Memory memory;
  SharedVector<int> one = counted(160, memory);
  one.push_back(160);
  EXPECT_EQ(one.size(), 161u);
  EXPECT_EQ(one.back(), 160);
  EXPECT_NE(grown(one, 162, 5, memory).data(), one.data());
}

TEST(SharedVector, ThreadsThatGrowOneVectorGetRoomsOfTheirOwn) {
  Memory memory;
  const SharedVector<int> base = counted(1600, memory);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int round = 0; round < 2000; ++round) {
        const SharedVector<int> own = grown(base, 1650, t, memory);
        for (std::size_t i = 1600; i < own.size(); ++i) wrong[t] += own[i] != t;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

}  // namespace
