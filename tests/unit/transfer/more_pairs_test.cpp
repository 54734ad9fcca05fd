// More pairs of true correspondences make a transfer better: clusters follow from the pairs.
#include <gtest/gtest.h>


#include "support/full.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

// How much longer the bones of the other body are: longer neck, tail and back, shorter legs.
double longer(const std::string& joint) {
  const auto has = [&](const char* word) { return joint.find(word) != std::string::npos; };
  if (has("neck")) return 1.3;
  if (has("tail")) return 1.2;
  if (has("spine") || has("chest")) return 1.1;
  return has("hips") || has("leg") || has("cannon") || has("pastern") || has("hoof") ? 0.8 : 1.0;
}

// A generated creature and another body whose places and motion are known: the same skin with other vertices on other
// bones, which turn as the source's bones do.
struct Twins {
  Twins(const std::string& name, uint32_t vertices, uint32_t others, bool same_bones)
      : source(creature(name, vertices, world)),
        target(creature(name, others, world)),
        same(same_bones),
        skin(target.mesh) {
    pairs = find_pairs("horse_to_bull.json", source, target);
    for (std::vector<int32_t>& region : pairs.target)
      for (int32_t& v : region) v = target.core->mesh.given_of_inner[static_cast<size_t>(v)];
    target.mesh.positions = other(hf_gltf::rest_pose(target.model));
    target.build(world);
    for (std::vector<int32_t>& region : pairs.target)
      for (int32_t& v : region) v = target.core->mesh.inner_of_given[static_cast<size_t>(v)];
  }
  World world;
  Body source, target;
  bool same;
  hf_gltf::FlatMesh skin;
  Pairs pairs;

  std::vector<glm::dvec3> other(hf_gltf::Pose pose) const {
    for (size_t n = 0; n < pose.size(); ++n) pose[n].translation *= same ? 1.0 : longer(target.model.nodes[n].name);
    return hf_gltf::posed_positions(target.model, skin, pose);
  }

  // The vertices within a distance of a place that no region has yet; at least the nearest of them.
  static std::vector<int32_t> ball(const std::vector<Vec3>& points, const std::vector<std::vector<int32_t>>& regions,
                                   Vec3 place, double radius) {
    std::vector<char> taken(points.size(), 0);
    for (const std::vector<int32_t>& region : regions)
      for (const int32_t v : region) taken[static_cast<size_t>(v)] = 1;
    std::vector<int32_t> out;
    int32_t nearest = -1;
    double least = 1e300;
    for (size_t v = 0; v < points.size(); ++v) {
      const double d = hf_inner::norm(points[v] - place);
      if (taken[v]) continue;
      if (d < radius) out.push_back(static_cast<int32_t>(v));
      if (d < least) {
        least = d;
        nearest = static_cast<int32_t>(v);
      }
    }
    if (out.empty()) out.push_back(nearest);
    return out;
  }

  // The eight pairs of the file and more of them, each at the place that is farthest from the others.
  Pairs with(size_t count) const {
    Pairs out = pairs;
    const std::vector<Vec3> from = source.rest(), to = target.inner(skin.positions);
    const double radius = 0.015 * source.core->mesh.scale;
    std::vector<Vec3> places;
    for (const std::vector<int32_t>& region : out.source) places.push_back(centre_of(region, from));
    while (out.names.size() < count) {
      size_t next = 0;
      double most = -1;
      for (size_t v = 0; v < from.size(); ++v) {
        double least = 1e300;
        for (const Vec3& place : places) least = std::min(least, hf_inner::norm(from[v] - place));
        if (least > most) {
          most = least;
          next = v;
        }
      }
      places.push_back(from[next]);
      out.names.push_back("place " + std::to_string(out.names.size()));
      out.flags.push_back(0);
      out.source.push_back(ball(from, out.source, from[next], radius));
      out.target.push_back(ball(to, out.target, from[next], radius));
    }
    return out;
  }

  // Mean over all frames of the root mean square error, in boxes.
  double error(size_t count) const {
    hf_inner::transfer::Transfer transfer(source.core, target.core, {});
    add(transfer, with(count).inputs());
    double sum = 0;
    int frames = 0;
    for (const hf_gltf::Animation& clip : source.model.animations) {
      for (int k = 0; k < 8; ++k, ++frames) {
        const double time = hf_gltf::clip_duration(clip) * k / 8;
        const std::vector<glm::dvec3> truth = other(hf_gltf::sample(
            target.model,
            target.model.animations[static_cast<size_t>(hf_gltf::find_animation(target.model, clip.name))], time));
        sum += rms(*target.core, frame_of(transfer, source.posed(clip, time)), target.inner(truth));
      }
    }
    return sum / frames;
  }
};

// With eight pairs a body on itself is as near as turning clusters come; on another body more pairs tell more.
TEST(TransferMorePairs, TheErrorFallsWithTruePairs) {
  std::vector<std::pair<uint32_t, uint32_t>> sizes = {{2500, 3600}};
  std::vector<const char*> names = {"horse"};
  if (hf_test::is_full()) {
    sizes.push_back({1500, 6000});
    names.push_back("bull");
  }
  double sum[3] = {0, 0, 0};
  for (const char* name : names) {
    for (const bool same : {true, false}) {
      for (const auto& [vertices, others] : sizes) {
        const Twins twins(name, vertices, others, same);
        const double errors[] = {twins.error(8), twins.error(20), twins.error(60)};
        std::printf("%s of %u vertices on %s of %u: %.4f of the box with 8 pairs, %.4f with 20, %.4f with 60\n", name,
                    vertices, same ? "itself" : "another body", others, errors[0], errors[1], errors[2]);
        for (int k = 0; k < 3; ++k) EXPECT_LT(errors[k], 0.006) << name;
        for (int k = 0; !same && k < 3; ++k) sum[k] += errors[k];
      }
    }
  }
  EXPECT_LT(sum[1], sum[0]);
  EXPECT_LT(sum[2], sum[1]);
}

}  // namespace
