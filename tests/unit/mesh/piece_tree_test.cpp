// The trees of boxes of pieces against all pairs.
#include "mesh/piece_tree.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::Vec3;
using hf_inner::mesh::ItemBox;
using hf_inner::mesh::PieceTree;

constexpr Index pieces = 5;

struct Boxes {
  hf_inner::Memory memory;
  hf_inner::Vector<ItemBox> items{&memory};
  hf_inner::Vector<Index> piece{&memory};
  std::mt19937 random{5};
  std::uniform_real_distribution<double> any{-0.5, 0.5};
  Vec3 point() { return {any(random), any(random), any(random)}; }

  // Pieces of 1, 4, 5, 64 and 300 boxes: a part of a block, a block, two levels, full and partial ones.
  Boxes() {
    for (Index p = 0; p < pieces; ++p) {
      const int counts[pieces] = {1, 4, 5, 64, 300};
      for (int i = 0; i < counts[p]; ++i) {
        items.push_back(ItemBox::of(point()));
        items.back().take(items.back().low + Vec3{0.03, 0.01, 0.02});
        piece.push_back(p);
      }
    }
  }
};

TEST(PieceTree, VisitsEveryBoxThatIsNear) {
  Boxes boxes;
  const PieceTree tree(boxes.items, boxes.piece, pieces, boxes.memory);
  for (Index p = 0; p < pieces; ++p) {
    for (const Index i : tree.items(p)) EXPECT_EQ(boxes.piece[at(i)], p);
    for (int k = 0; k < 200; ++k) {
      const Vec3 point = boxes.point();
      const double reach = k % 10 == 0 ? 0 : 0.01 * (k % 7);
      std::vector<int> seen(boxes.items.size(), 0);
      tree.near(
          p, point, [&] { return reach * reach; }, [&](Index i) { ++seen[at(i)]; });
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const bool own = boxes.piece[i] == p;
        const double distance = std::sqrt(squared_distance(point, boxes.items[i]));
        EXPECT_GE(seen[i], own && distance <= reach ? 1 : 0);
        EXPECT_LE(seen[i], own && distance <= reach + 1e-5 ? 1 : 0);
      }
    }
  }
}

TEST(PieceTree, FindsTheNearestBoxOfAll) {
  Boxes boxes;
  const PieceTree tree(boxes.items, boxes.piece, pieces, boxes.memory);
  for (Index p = 0; p < pieces; ++p) {
    for (int k = 0; k < 200; ++k) {
      const Vec3 point = boxes.point();
      double best = HUGE_VAL, all = HUGE_VAL;  // no bound at first
      const auto distance = [&](Index i) { return squared_distance(point, boxes.items[at(i)]); };
      tree.near(
          p, point, [&] { return best; }, [&](Index i) { best = std::min(best, distance(i)); });
      for (const Index i : tree.items(p)) all = std::min(all, distance(i));
      EXPECT_EQ(best, all);
    }
  }
}

TEST(PieceTree, ABoxIsNearOrNot) {
  Boxes boxes;
  const PieceTree tree(boxes.items, boxes.piece, pieces, boxes.memory);
  int near = 0, far = 0;
  for (Index p = 0; p < pieces; ++p) {
    for (int k = 0; k < 100; ++k) {
      ItemBox box = ItemBox::of(boxes.point());
      box.take(box.low + Vec3{0.05, 0.05, 0.05});
      double least = HUGE_VAL;
      for (const Index i : tree.items(p)) least = std::min(least, squared_distance(boxes.items[at(i)], box));
      const double reach = 0.1;
      if (std::abs(std::sqrt(least) - reach) < 1e-5) continue;
      EXPECT_EQ(tree.is_near(p, box, reach * reach), least < reach * reach);
      EXPECT_TRUE(tree.is_near(p, box, HUGE_VAL));
      least < reach* reach ? ++near : ++far;
    }
  }
  EXPECT_GT(near, 50);
  EXPECT_GT(far, 50);
}

// Triangles at one place have one cell of the curve.
TEST(PieceTree, TakesEqualBoxes) {
  hf_inner::Memory memory;
  hf_inner::Vector<ItemBox> items(9, ItemBox::of({0.1, 0.2, 0.3}), &memory);
  const hf_inner::Vector<Index> piece(9, 0, &memory);
  const PieceTree tree(items, piece, 1, memory);
  for (Index i = 0; i < 9; ++i) EXPECT_EQ(tree.items(0)[at(i)], i);
  int seen = 0;
  tree.near(
      0, {0.1, 0.2, 0.3}, [] { return 0.0; }, [&](Index) { ++seen; });
  EXPECT_EQ(seen, 9);
}

}  // namespace
