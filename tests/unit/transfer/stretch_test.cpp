// HF_TRANSFER_STRETCH: faces whose shapes go to another head, bodies that breathe, and a surface on itself.
#include <gtest/gtest.h>

#include <ctime>

#include "assets/face.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

// A generated face, its surface, and its poses by inner vertex.
struct Head {
  samples::Face face;
  std::shared_ptr<const hf_inner::surface::Core> core;

  Head(uint32_t columns, uint32_t rows, bool second, const World& world)
      : face(samples::make_face(columns, rows, second)) {
    core = make_core(hf_gltf::to_points(face.mesh.positions), face.mesh.triangles, world);
  }
  std::vector<Vec3> inner(const std::vector<double>& xyz) const {
    std::vector<Vec3> out(static_cast<size_t>(core->size()));
    for (size_t v = 0; v < out.size(); ++v) {
      const double* p = xyz.data() + 3 * static_cast<size_t>(core->mesh.given_of_inner[v]);
      out[v] = {p[0], p[1], p[2]};
    }
    return out;
  }
  std::vector<Vec3> rest() const { return inner(face.mesh.positions); }
  std::vector<Vec3> posed(int shape) const { return inner(face.shapes[static_cast<size_t>(shape)]); }
  size_t inner_of(uint32_t vertex) const { return static_cast<size_t>(core->mesh.inner_of_given[vertex]); }
};

// The marks of two heads as pairs.
struct HeadPairs {
  std::vector<std::vector<int32_t>> source, target;
  HeadPairs(const Head& a, const Head& b) {
    for (size_t i = 0; i < a.face.marks.size(); ++i) {
      source.emplace_back();
      target.emplace_back();
      for (const uint32_t v : a.face.marks[i].vertices) source.back().push_back(a.core->mesh.inner_of_given[v]);
      for (const uint32_t v : b.face.marks[i].vertices) target.back().push_back(b.core->mesh.inner_of_given[v]);
    }
  }
  std::vector<hf_inner::transfer::PairInput> inputs() const {
    std::vector<hf_inner::transfer::PairInput> out(source.size());
    for (size_t i = 0; i < out.size(); ++i) {
      out[i].source = {source[i].data(), source[i].size()};
      out[i].target = {target[i].data(), target[i].size()};
    }
    return out;
  }
};

hf_inner::transfer::TransferOptions stretch() {
  hf_inner::transfer::TransferOptions out;
  out.mode = HF_TRANSFER_STRETCH;
  return out;
}

TEST(TransferStretch, ASurfaceOnItselfGetsItsOwnPose) {
  const World world;
  const Head head(90, 70, false, world);
  const HeadPairs pairs(head, head);
  hf_inner::transfer::Transfer transfer(head.core, head.core, stretch());
  add(transfer, pairs.inputs());
  for (const int shape : {0, 1, 5, 12, 24, 51}) {
    const std::vector<Vec3> posed = head.posed(shape);
    EXPECT_LT(largest_distance(frame_of(transfer, posed), posed) / head.core->mesh.scale, 1e-9) << shape;
  }
  // a walking horse, all of whose limbs turn
  const Animals& a = animals();
  Pairs self = find_pairs("horse_to_bull.json", a.horse, a.horse, true);
  for (uint32_t& flags : self.flags) flags = 0;
  hf_inner::transfer::Transfer horse(a.horse.core, a.horse.core, stretch());
  add(horse, self.inputs());
  for (const double time : {0.1, 0.6}) {
    const std::vector<Vec3> posed = a.horse.posed(a.walk, time);
    EXPECT_LT(largest_distance(frame_of(horse, posed), posed) / a.horse.core->mesh.scale, 1e-9) << time;
  }
}

TEST(TransferStretch, RestGivesRestAndRigidMotionsGoOver) {
  const World world;
  const Head head(60, 50, false, world), other(70, 60, true, world);
  const HeadPairs pairs(head, other);
  hf_inner::transfer::Transfer transfer(head.core, other.core, stretch());
  add(transfer, pairs.inputs());
  const std::vector<Vec3> rest = head.rest(), expected = other.rest();
  EXPECT_LT(largest_distance(frame_of(transfer, rest), expected) / other.core->mesh.scale, 1e-9);
  const hf_inner::deform::Quaternion turn = hf_inner::deform::exponential({0.4, -1.1, 0.3});
  std::vector<Vec3> posed;
  for (const Vec3& p : rest) posed.push_back(hf_inner::deform::rotate(turn, p) + Vec3{1, 2, 3});
  const std::vector<Vec3> out = frame_of(transfer, posed);
  const Vec3 shift = out[0] - hf_inner::deform::rotate(turn, expected[0]);
  for (size_t v = 0; v < out.size(); ++v)
    ASSERT_LT(hf_inner::norm(out[v] - hf_inner::deform::rotate(turn, expected[v]) - shift) / other.core->mesh.scale,
              1e-9)
        << v;
}

TEST(TransferStretch, ASourceOfTwiceTheSizeMakesATargetOfTwiceTheSize) {
  const World world;
  const Head head(60, 50, false, world), other(70, 60, true, world);
  const HeadPairs pairs(head, other);
  hf_inner::transfer::Transfer transfer(head.core, other.core, stretch());
  add(transfer, pairs.inputs());
  std::vector<Vec3> posed = head.rest();
  for (Vec3& p : posed) p = 2 * p;
  const std::vector<Vec3> rest = other.rest(), out = frame_of(transfer, posed);
  for (size_t v = 0; v < out.size(); ++v)
    ASSERT_LT(hf_inner::norm((out[v] - out[0]) - 2 * (rest[v] - rest[0])) / other.core->mesh.scale, 1e-9) << v;
}

TEST(TransferStretch, ABodyThatBreathesAsAWholeMakesTheOtherBreathe) {
  const World world;
  const Head head(60, 50, false, world), other(70, 60, true, world);
  const HeadPairs pairs(head, other);
  hf_inner::transfer::Transfer transfer(head.core, other.core, stretch());
  add(transfer, pairs.inputs());
  std::vector<Vec3> posed = head.rest();
  for (Vec3& p : posed) p = {1.15 * p.x, 0.8 * p.y, 1.3 * p.z};
  const std::vector<Vec3> rest = other.rest(), out = frame_of(transfer, posed);
  // Normals of a stretched surface turn, so that the gradient of a vertex is not the stretch alone.
  double worst = 0;
  for (size_t v = 1; v < out.size(); ++v) {
    const Vec3 d = rest[v] - rest[0], now = out[v] - out[0];
    worst = std::max(worst, hf_inner::norm(now - Vec3{1.15 * d.x, 0.8 * d.y, 1.3 * d.z}));
  }
  std::printf("breath: %.5f of the box\n", worst / other.core->mesh.scale);
  EXPECT_LT(worst / other.core->mesh.scale, 0.03);
}

struct LidFigures {
  double gap = 0, open = 0, apart = 0, error = 0, seconds = 0;
};

// Plays all shapes. gap: largest distance of lid vertices above one another in the shape that closes their eye. apart:
// the same to the nearest place of the lower lid. open: largest at rest. error: of all vertices and shapes, as a share
// of the motion.
LidFigures play(const Head& head, const Head& other) {
  const HeadPairs pairs(head, other);
  hf_inner::transfer::Transfer transfer(head.core, other.core, stretch());
  add(transfer, pairs.inputs());
  const std::vector<Vec3> rest = other.rest();
  frame_of(transfer, head.rest());  // prepares
  std::vector<std::vector<Vec3>> shapes, made;
  for (int shape = 0; shape < 52; ++shape) shapes.push_back(head.posed(shape));
  const std::clock_t start = std::clock();
  for (const std::vector<Vec3>& shape : shapes) made.push_back(frame_of(transfer, shape));
  LidFigures out;
  out.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  double error = 0, moved = 0;
  for (int shape = 0; shape < 52; ++shape) {
    const std::vector<Vec3> expected = other.posed(shape);
    const std::vector<Vec3>& got = made[static_cast<size_t>(shape)];
    for (size_t v = 0; v < got.size(); ++v) {
      const Vec3 e = got[v] - expected[v], d = expected[v] - rest[v];
      error += hf_inner::dot(e, e);
      moved += hf_inner::dot(d, d);
    }
    for (size_t i = 0; i < other.face.lids.size() && shape < 2; ++i) {
      if ((other.face.lid_azimuth[i] > 0) != (shape == 0)) continue;
      const Vec3 upper = got[other.inner_of(other.face.lids[i].first)];
      out.gap = std::max(out.gap, hf_inner::norm(upper - got[other.inner_of(other.face.lids[i].second)]));
      double nearest = 1e300;
      for (size_t k = 0; k + 1 < other.face.lids.size(); ++k) {
        if (other.face.lid_azimuth[k] * other.face.lid_azimuth[i] < 0 ||
            other.face.lid_azimuth[k + 1] * other.face.lid_azimuth[i] < 0)
          continue;
        const Vec3 a = got[other.inner_of(other.face.lids[k].second)],
                   b = got[other.inner_of(other.face.lids[k + 1].second)] - a;
        const double t = std::clamp(hf_inner::dot(upper - a, b) / hf_inner::dot(b, b), 0.0, 1.0);
        nearest = std::min(nearest, hf_inner::norm(upper - a - t * b));
      }
      out.apart = std::max(out.apart, nearest);
      out.open = std::max(out.open, hf_inner::norm(rest[other.inner_of(other.face.lids[i].first)] -
                                                   rest[other.inner_of(other.face.lids[i].second)]));
    }
  }
  out.error = std::sqrt(error / moved);
  std::printf(
      "52 shapes on %d vertices: %.3f s of processor time; error %.3f of the motion; closed lids %.4f of the opening "
      "apart, %.4f from vertex to vertex\n",
      other.core->size(), out.seconds, out.error, out.apart / out.open, out.gap / out.open);
  return out;
}

TEST(TransferStretch, FiftyTwoShapesGoToAnotherHeadAndClosedLidsAreClosed) {
  const World world;
  const Head head(110, 90, false, world), other(128, 93, true, world);
  ASSERT_GT(other.core->size(), 11900);
  const LidFigures found = play(head, other);
  EXPECT_GT(found.open / other.core->mesh.scale, 0.01) << "the eyes are shut at rest: no test";
  EXPECT_LT(found.apart / found.open, 0.01);
  EXPECT_LT(found.gap / found.open, 0.06);
  EXPECT_LT(found.error, 0.2);
}

// Lids of few vertices close less well: the two polylines that meet on the source do not meet on another mesh.
TEST(TransferStretch, LidsOfOtherMeshesClose) {
  const World world;
  struct Case {
    uint32_t columns, rows, other_columns, other_rows;
    double there, back;  // largest gap, as a share of the opening
  };
  for (const Case& c :
       {Case{128, 93, 90, 71, 0.02, 0.25}, {70, 61, 128, 93, 0.05, 0.1}, {97, 83, 149, 101, 0.02, 0.05}}) {
    const Head head(c.columns, c.rows, false, world), other(c.other_columns, c.other_rows, true, world);
    const LidFigures there = play(head, other), back = play(other, head);
    EXPECT_LT(there.apart / there.open, c.there) << c.columns;
    EXPECT_LT(back.apart / back.open, c.back) << c.columns;
  }
}

TEST(TransferStretch, ItTakesNoHoldsAndGivesNoSkin) {
  const World world;
  const Head head(40, 30, false, world);
  const HeadPairs pairs(head, head);
  hf_inner::transfer::Transfer transfer(head.core, head.core, stretch());
  add(transfer, pairs.inputs());
  const std::vector<Vec3> rest = head.rest();
  std::vector<Vec3> out(rest.size());
  const hf_inner::transfer::PairHold hold{0, {0, 0, 0}};
  EXPECT_ANY_THROW(transfer.apply(rest.data(), out.data(), {&hold, 1}));
  EXPECT_ANY_THROW(transfer.skin_motion(nullptr, nullptr, nullptr));
}

}  // namespace
