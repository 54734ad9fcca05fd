// The tree of boxes against all pairs.
#include "mesh/box_tree.h"

#include <gtest/gtest.h>

#include <random>

#include "base/index.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::Vec3;
using hf_inner::mesh::BoxTree;
using hf_inner::mesh::ItemBox;

TEST(BoxTree, FindsTheNearestPoint) {
  hf_inner::Memory memory;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const std::size_t count : {1u, 5u, 400u}) {
    hf_inner::Vector<ItemBox> items(&memory);
    for (std::size_t i = 0; i < count; ++i) items.push_back(ItemBox::of({any(random), any(random), 0.0}));
    const BoxTree tree(items, memory);
    for (int k = 0; k < 200; ++k) {
      const Vec3 p{any(random), any(random), any(random)};
      double best = HUGE_VAL, all = HUGE_VAL;
      tree.near(
          p, [&] { return best; },
          [&](Index i) { best = std::min(best, dot(items[at(i)].low - p, items[at(i)].low - p)); });
      for (const ItemBox& item : items) all = std::min(all, dot(item.low - p, item.low - p));
      EXPECT_EQ(best, all);
    }
  }
}

TEST(BoxTree, KeepsGroupsApart) {
  hf_inner::Memory memory;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr Index groups = 4;  // the third has no item
  hf_inner::Vector<ItemBox> items(&memory);
  std::vector<Index> group;
  for (int i = 0; i < 300; ++i) {
    items.push_back(ItemBox::of({any(random), any(random), any(random)}));
    items.back().take(items.back().low + hf_inner::Vec3{0.05, 0.02, 0.03});
    group.push_back(i % 3 == 2 ? 3 : i % 3);
  }
  const BoxTree tree(items, group, groups, memory);
  tree.near(
      2, {0, 0, 0}, [] { return 10.0; }, [](Index) { ADD_FAILURE(); });
  for (const Index g : {0, 1, 3}) {
    std::vector<int> seen(items.size(), 0);
    tree.near(
        g, {0, 0, 0}, [] { return 100.0; }, [&](Index i) { ++seen[at(i)]; });
    for (std::size_t i = 0; i < items.size(); ++i) EXPECT_EQ(seen[i], group[i] == g ? 1 : 0);
    for (int k = 0; k < 50; ++k) {
      const Vec3 p{any(random), any(random), any(random)};
      double best = HUGE_VAL, all = HUGE_VAL;
      tree.near(
          g, p, [&] { return best; }, [&](Index i) { best = std::min(best, squared_distance(p, items[at(i)])); });
      for (std::size_t i = 0; i < items.size(); ++i) {
        if (group[i] == g) all = std::min(all, squared_distance(p, items[i]));
      }
      EXPECT_EQ(best, all);
    }
  }
}

TEST(BoxTree, VisitsEveryTriangleThatASegmentCrosses) {
  hf_inner::Memory memory;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<std::array<Vec3, 3>> triangles;
  hf_inner::Vector<ItemBox> items(&memory);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p{any(random), any(random), any(random)};
    std::array<Vec3, 3> t;
    for (Vec3& corner : t) corner = p + 0.3 * Vec3{any(random), any(random), any(random)};
    ItemBox box = ItemBox::of(t[0]);
    box.take(t[1]);
    box.take(t[2]);
    triangles.push_back(t);
    items.push_back(box);
  }
  const BoxTree tree(items, memory);
  int hits = 0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 from{any(random), any(random), any(random)}, to{any(random), any(random), any(random)};
    const auto crossed = [&](std::size_t i) {
      bool entering = false;
      return hf_inner::mesh::crossing(from, to - from, triangles[i][0], triangles[i][1], triangles[i][2], entering) >=
             0;
    };
    int found = 0, all = 0;
    tree.along(from, to, [&](Index i) { return found += crossed(at(i)), false; });
    for (std::size_t i = 0; i < triangles.size(); ++i) all += crossed(i);
    EXPECT_EQ(found, all);
    hits += all;
  }
  EXPECT_GT(hits, 100);
}

TEST(BoxTree, ACrossingHasASideAndAPlace) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  bool entering = false;
  EXPECT_DOUBLE_EQ(hf_inner::mesh::crossing({0.2, 0.2, 1}, {0, 0, -4}, a, b, c, entering), 0.25);
  EXPECT_TRUE(entering);
  EXPECT_DOUBLE_EQ(hf_inner::mesh::crossing({0.2, 0.2, -1}, {0, 0, 4}, a, b, c, entering), 0.25);
  EXPECT_FALSE(entering);
  EXPECT_LT(hf_inner::mesh::crossing({0.8, 0.8, 1}, {0, 0, -4}, a, b, c, entering), 0);
  EXPECT_LT(hf_inner::mesh::crossing({0.2, 0.2, 1}, {0, 0, -0.5}, a, b, c, entering), 0);
  EXPECT_LT(hf_inner::mesh::crossing({0.2, 0.2, 0}, {1, 0, 0}, a, b, c, entering), 0);
}

}  // namespace
