// Transfers whose right answer is known: the same body remeshed and scaled, a copy with another rest pose, loose parts,
// planted feet.
#include <gtest/gtest.h>

#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

TEST(TransferShapes, TheSameSurfaceRemeshedAndScaledFollowsWithinTwoPercentOfTheBox) {
  const Animals& a = animals();
  const double scale = 1.7;
  const Body plain = creature("horse", 3600, a.world);
  Body other = plain;
  const hf_gltf::FlatMesh unscaled = other.mesh;
  other.move(a.world, [&](const glm::dvec3& p) { return scale * p; });
  Pairs pairs = find_pairs("horse_to_bull.json", a.horse, a.horse);
  pairs.target = find_pairs("horse_to_bull.json", plain, plain).target;
  for (uint32_t& flags : pairs.flags) flags |= HF_PAIR_ANCHOR;
  hf_inner::transfer::Transfer transfer(a.horse.core, other.core, {});
  add(transfer, pairs.inputs());
  EXPECT_NEAR(transfer.scale(), scale, 0.01 * scale);
  double sum = 0, worst = 0, largest = 0;
  int frames = 0;
  for (const hf_gltf::Animation& clip : a.horse.model.animations) {
    for (int k = 0; k < 8; ++k, ++frames) {
      const double time = hf_gltf::clip_duration(clip) * k / 8;
      std::vector<glm::dvec3> truth = hf_gltf::posed_positions(other.model, unscaled, clip, time);
      for (glm::dvec3& p : truth) p *= scale;
      const std::vector<Vec3> expected = other.inner(truth), out = frame_of(transfer, a.horse.posed(clip, time));
      const double error = rms(*other.core, out, expected);
      sum += error;
      worst = std::max(worst, error);
      largest = std::max(largest, largest_distance(out, expected) / other.core->mesh.scale);
    }
  }
  // the largest single vertex is at the knees, where the source's skin itself stretches
  std::printf(
      "remeshed and scaled: root mean square of a frame %.4f of the box, worst frame %.4f, largest vertex %.4f\n",
      sum / frames, worst, largest);
  EXPECT_LT(sum / frames, 0.008);
  EXPECT_LT(worst, 0.02);
  EXPECT_LT(largest, 0.06);
}

// The horse with its tail lifted at rest: joints below tail_1 turned by an angle about x.
std::vector<glm::dvec3> with_lifted_tail(const Body& horse, hf_gltf::Pose pose, double angle) {
  const int tail = hf_gltf::find_node(horse.model, "tail_1");
  hf_gltf::NodePose& node = pose[static_cast<size_t>(tail)];
  node.rotation = node.rotation * glm::angleAxis(angle, glm::dvec3(1, 0, 0));
  return hf_gltf::posed_positions(horse.model, horse.mesh, pose);
}

TEST(TransferShapes, ACopyWithAnotherRestPoseOfTheTailMovesLikeTheSource) {
  const Animals& a = animals();
  Body lifted = a.horse;
  lifted.mesh.positions = with_lifted_tail(a.horse, hf_gltf::rest_pose(a.horse.model), 1.2);
  lifted.build(a.world);
  ASSERT_EQ(lifted.core->size(), a.horse.core->size());
  Pairs pairs = find_pairs("horse_to_bull.json", a.horse, a.horse);
  const auto error = [&](double alignment) {
    hf_inner::transfer::TransferOptions options;
    options.alignment_angle = alignment;
    options.scale = 1;
    hf_inner::transfer::Transfer transfer(a.horse.core, lifted.core, options);
    std::vector<uint32_t> numbers(pairs.names.size());
    add(transfer, pairs.inputs(), numbers.data());
    const hf_inner::transfer::PairInfo tail = transfer.pair_info(numbers[1]);
    EXPECT_GT(tail.alignment_angle, 0.7);
    EXPECT_EQ(tail.alignment_share > 0, alignment >= 0);
    double largest = 0;
    for (const double time : {0.1, 0.5, 0.8}) {
      const std::vector<Vec3> posed = a.horse.posed(a.walk, time);
      largest = std::max(largest, rms(*lifted.core, frame_of(transfer, posed), posed));
    }
    return largest;
  };
  const double aligned = error(0), plain = error(-1);
  std::printf("lifted tail: aligned %.4f, not aligned %.4f\n", aligned, plain);
  EXPECT_LT(aligned, 0.02);
  EXPECT_GT(plain, 2 * aligned);
}

TEST(TransferShapes, AnAlignmentSwitchedOffForAPairIsNotApplied) {
  const Animals& a = animals();
  Body lifted = a.horse;
  lifted.mesh.positions = with_lifted_tail(a.horse, hf_gltf::rest_pose(a.horse.model), 1.2);
  lifted.build(a.world);
  Pairs pairs = find_pairs("horse_to_bull.json", a.horse, a.horse);
  pairs.flags[1] |= HF_PAIR_NO_ALIGNMENT;
  hf_inner::transfer::Transfer transfer(a.horse.core, lifted.core, {});
  add(transfer, pairs.inputs());
  EXPECT_EQ(transfer.pair_info(1).alignment_share, 0);
  EXPECT_LT(largest_distance(frame_of(transfer, a.horse.rest()), lifted.rest()), 1e-6 * lifted.core->mesh.scale);
}

// Appends a small octahedron and a larger strip, both loose, near a place.
void add_loose_parts(Body& body, const glm::dvec3& eye, const glm::dvec3& strap, const World& world) {
  auto& mesh = body.mesh;
  const auto base = static_cast<uint32_t>(mesh.positions.size());
  const double r = 0.02;
  for (const glm::dvec3& d : {glm::dvec3(r, 0, 0), glm::dvec3(-r, 0, 0), glm::dvec3(0, r, 0), glm::dvec3(0, -r, 0),
                              glm::dvec3(0, 0, r), glm::dvec3(0, 0, -r)})
    mesh.positions.push_back(eye + d);
  for (const uint32_t t :
       {0u, 2u, 4u, 2u, 1u, 4u, 1u, 3u, 4u, 3u, 0u, 4u, 2u, 0u, 5u, 1u, 2u, 5u, 3u, 1u, 5u, 0u, 3u, 5u})
    mesh.triangles.push_back(base + t);
  const uint32_t start = base + 6;
  for (uint32_t i = 0; i <= 12; ++i) {
    mesh.positions.push_back(strap + glm::dvec3(-0.03, 0, 0.1 * i));
    mesh.positions.push_back(strap + glm::dvec3(0.03, 0, 0.1 * i));
  }
  for (uint32_t i = 0; i < 12; ++i) {
    for (const uint32_t t : {0u, 2u, 1u, 1u, 2u, 3u}) mesh.triangles.push_back(start + 2 * i + t);
  }
  body.build(world);
}

TEST(TransferShapes, LoosePartsFollowWhatTheyLieNextTo) {
  const Animals& a = animals();
  Body bull = a.bull;
  const glm::dvec3 head = glm::dvec3(hf_gltf::global_matrices(
      bull.model, hf_gltf::rest_pose(bull.model))[static_cast<size_t>(hf_gltf::find_node(bull.model, "head"))][3]);
  const size_t first = bull.mesh.positions.size();
  add_loose_parts(bull, head + glm::dvec3(0.1, 0.1, 0.15), {0, 1.45, -0.6}, a.world);
  ASSERT_EQ(bull.core->mesh.component_count(), 3);
  hf_inner::transfer::Transfer transfer(a.horse.core, bull.core, {});
  add(transfer, a.pairs.inputs());
  EXPECT_LT(largest_distance(frame_of(transfer, a.horse.rest()), bull.rest()), 1e-6);
  const auto inner = [&](size_t given) { return static_cast<size_t>(bull.core->mesh.inner_of_given[given]); };
  // neighbours at rest: the nearest body vertex of each loose vertex
  const std::vector<Vec3> rest = bull.rest();
  for (const double time : {0.1, 0.4, 0.9}) {
    const std::vector<Vec3> out = frame_of(transfer, a.horse.posed(a.walk, time));
    for (size_t v = first; v < bull.mesh.positions.size(); ++v) {
      size_t host = 0;
      double best = 1e300;
      for (size_t w = 0; w < first; ++w) {
        const double distance = hf_inner::norm(rest[inner(w)] - rest[inner(v)]);
        if (distance < best) {
          best = distance;
          host = w;
        }
      }
      EXPECT_NEAR(hf_inner::norm(out[inner(v)] - out[inner(host)]), best, 0.02 * bull.core->mesh.scale) << v;
    }
    // the eye stays rigid
    for (size_t v = first; v < first + 6; ++v) {
      for (size_t w = first; w < v; ++w)
        EXPECT_NEAR(hf_inner::norm(out[inner(v)] - out[inner(w)]), hf_inner::norm(rest[inner(v)] - rest[inner(w)]),
                    1e-3);
    }
  }
}

TEST(TransferShapes, AnIslandTakesTheRowsOfTheNearestVerticesAndIsRelaxedBetweenThem) {
  // rows that are the places themselves say which host was taken
  const Animals& a = animals();
  Body bull = a.bull;
  const size_t first = bull.mesh.positions.size();
  add_loose_parts(bull, {0.3, 1.6, 0.9}, {0.4, 1.0, -0.7}, a.world);
  const hf_inner::surface::Core& core = *bull.core;
  std::vector<uint8_t> reached(static_cast<size_t>(core.mesh.component_count()), 0);
  const auto inner = [&](size_t given) { return core.mesh.inner_of_given[given]; };
  const auto place = [&](int32_t v) { return core.mesh.positions[static_cast<size_t>(v)]; };
  const int32_t body = core.mesh.component[static_cast<size_t>(inner(0))];
  reached[static_cast<size_t>(body)] = 1;
  std::vector<double> field(3 * static_cast<size_t>(core.size()), 0.0);
  const auto row = [&](int32_t v) {
    const double* f = field.data() + 3 * static_cast<size_t>(v);
    return Vec3{f[0], f[1], f[2]};
  };
  for (int32_t v = 0; v < core.size(); ++v) {
    if (core.mesh.component[static_cast<size_t>(v)] != body) continue;
    const Vec3 p = place(v);
    field[3 * static_cast<size_t>(v)] = p.x;
    field[3 * static_cast<size_t>(v) + 1] = p.y;
    field[3 * static_cast<size_t>(v) + 2] = p.z;
  }
  hf_inner::transfer::attach_islands(core, {reached.data(), reached.size()}, 3, field.data());
  const auto nearest = [&](int32_t island_vertex) {
    double best = 1e300;
    int32_t host = -1;
    for (int32_t v = 0; v < core.size(); ++v) {
      const double d = hf_inner::norm(place(v) - place(island_vertex));
      if (core.mesh.component[static_cast<size_t>(v)] == body && d < best) {
        best = d;
        host = v;
      }
    }
    return host;
  };
  // the strap: each row is that of the nearest host, or the weighted mean of its neighbours' rows
  size_t hosted = 0, relaxed = 0;
  for (size_t given = first + 6; given < bull.mesh.positions.size(); ++given) {
    const int32_t v = inner(given);
    if (hf_inner::norm(row(v) - place(nearest(v))) < 1e-12) {
      ++hosted;
      continue;
    }
    Vec3 mean;
    double sum = 0;
    for (int32_t e = core.topology().neighbour_start[static_cast<size_t>(v)];
         e < core.topology().neighbour_start[static_cast<size_t>(v) + 1]; ++e) {
      const double w = core.weights()[static_cast<size_t>(core.topology().neighbour_edge[static_cast<size_t>(e)])];
      mean = mean + w * row(core.topology().neighbour[static_cast<size_t>(e)]);
      sum += w;
    }
    EXPECT_LT(hf_inner::norm(row(v) - (1 / sum) * mean), 1e-3 * core.mesh.scale) << given;
    ++relaxed;
  }
  EXPECT_EQ(hosted, 8u);  // a third of 26
  EXPECT_EQ(relaxed, 18u);
  // the eye: one row, the mean of its three nearest
  for (size_t given = first; given < first + 6; ++given)
    EXPECT_EQ(hf_inner::norm(row(inner(given)) - row(inner(first))), 0.0);
  EXPECT_LT(hf_inner::norm(row(inner(first)) - place(nearest(inner(first)))), 0.1 * core.mesh.scale);
}

// Bottom of a foot region: its lowest point, and its centre.
struct Foot {
  double low = 1e300;
  Vec3 centre;
};
Foot foot_of(const std::vector<int32_t>& region, const std::vector<Vec3>& points) {
  Foot out;
  for (const int32_t v : region) {
    out.low = std::min(out.low, points[static_cast<size_t>(v)].y);
    out.centre = out.centre + (1.0 / static_cast<double>(region.size())) * points[static_cast<size_t>(v)];
  }
  return out;
}

TEST(TransferShapes, FeetFollowTheScaledPathsOfTheSourcesFeetWithoutSinkingOrJitter) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const double box = a.bull.core->mesh.scale, scale = transfer.scale(), duration = hf_gltf::clip_duration(a.walk);
  const std::vector<Vec3> source_rest = a.horse.rest(), target_rest = a.bull.rest();
  constexpr int frames = 60;
  double sum = 0, largest = 0, sunk = 0, source_jerk = 0, target_jerk = 0;
  int count = 0;
  std::vector<std::vector<Vec3>> paths(8);
  for (int f = 0; f < frames; ++f) {
    const std::vector<Vec3> posed = a.horse.posed(a.walk, duration * f / frames), out = frame_of(transfer, posed);
    for (size_t foot = 2; foot < 6; ++foot) {
      const Foot from = foot_of(a.pairs.source[foot], posed), to = foot_of(a.pairs.target[foot], out);
      const Foot from_rest = foot_of(a.pairs.source[foot], source_rest),
                 to_rest = foot_of(a.pairs.target[foot], target_rest);
      const Vec3 goal = to_rest.centre + scale * (from.centre - from_rest.centre);
      const double miss = hf_inner::norm(to.centre - goal) / box;
      sum += miss;
      largest = std::max(largest, miss);
      ++count;
      sunk = std::max(sunk, (scale * std::min(0.0, from.low - from_rest.low) - (to.low - to_rest.low)) / box);
      paths[foot - 2].push_back(scale * from.centre);
      paths[foot + 2].push_back(to.centre);
    }
  }
  for (size_t foot = 0; foot < 4; ++foot) {
    for (size_t f = 0; f + 3 < frames; ++f) {
      const auto jerk = [&](const std::vector<Vec3>& p) {
        return hf_inner::norm(p[f + 3] - 3.0 * p[f + 2] + 3.0 * p[f + 1] - p[f]);
      };
      source_jerk += jerk(paths[foot]);
      target_jerk += jerk(paths[foot + 4]);
    }
  }
  std::printf("feet: path deviation mean %.4f max %.4f, sunk %.4f of the box, jerk %.3f of the source's\n", sum / count,
              largest, sunk, target_jerk / source_jerk);
  EXPECT_LT(sum / count, 0.005);
  EXPECT_LT(largest, 0.012);
  EXPECT_LT(sunk, 0.01);
  EXPECT_LT(target_jerk, 1.15 * source_jerk);
}

TEST(TransferShapes, ALimbIsTurnedTheShortestWayAlsoWhenItPointsTheOtherWay) {
  const Vec3 a{0.3, -2, 0.5}, b{-0.1, 0.4, 3};
  const Vec3 turned =
      hf_inner::deform::rotate(hf_inner::transfer::minimal_rotation(a, b, {1, 0, 0}), (1 / hf_inner::norm(a)) * a);
  EXPECT_LT(hf_inner::norm(turned - (1 / hf_inner::norm(b)) * b), 1e-12);
  const Vec3 opposite =
      hf_inner::deform::rotate(hf_inner::transfer::minimal_rotation({0, 1, 0}, {0, -1, 0}, {1, 0, 0}), {0, 1, 0});
  EXPECT_LT(hf_inner::norm(opposite - Vec3{0, -1, 0}), 1e-12);
  const Vec3 along_axis =
      hf_inner::deform::rotate(hf_inner::transfer::minimal_rotation({1, 0, 0}, {-1, 0, 0}, {1, 0, 0}), {1, 0, 0});
  EXPECT_LT(hf_inner::norm(along_axis - Vec3{-1, 0, 0}), 1e-12);
  EXPECT_NEAR(hf_inner::transfer::power(hf_inner::deform::exponential({0, 1.2, 0}), 0.25)
                  .angularDistance(hf_inner::deform::Quaternion()),
              0.3, 1e-12);
}

}  // namespace
