// What the tests of transfer share: a body is a model, its flat mesh and its core; posed positions of its inner
// vertices; pairs from a file.
#ifndef HF_TESTS_TRANSFER_SUPPORT_H
#define HF_TESTS_TRANSFER_SUPPORT_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "assets/creature_gltf.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"
#include "gltf/pairs_file.h"
#include "support/creature.h"
#include "transfer/transfer.h"

namespace transfer_test {

inline std::filesystem::path data_folder() {
  if (const char* given = std::getenv("HF_SHARED_DATA")) return given;
  return std::filesystem::path(HF_SOURCE_DIR) / "../shared/data";
}

inline std::filesystem::path pairs_path(const std::string& name) {
  return std::filesystem::path(HF_SOURCE_DIR) / "samples/transfer/pairs" / name;
}

struct World {
  explicit World(uint32_t threads = 1, const hf_allocator& hooks = {})
      : memory(std::make_shared<hf_inner::Memory>(hooks)), jobs(std::make_shared<hf_inner::JobRunner>(threads)) {}
  std::shared_ptr<hf_inner::Memory> memory;
  std::shared_ptr<hf_inner::JobRunner> jobs;
};

inline std::shared_ptr<const hf_inner::surface::Core> make_core(const std::vector<glm::dvec3>& positions,
                                                                const std::vector<uint32_t>& triangles,
                                                                const World& world) {
  hf_inner::mesh::MeshInput input;
  input.vertex_count = static_cast<uint32_t>(positions.size());
  input.triangle_count = static_cast<uint32_t>(triangles.size() / 3);
  input.positions = hf_inner::ConstRows(&positions[0].x, sizeof(glm::dvec3));
  input.triangles = hf_inner::IndexRows(triangles.data(), 3);
  return hf_inner::surface::Core::make(input, {}, world.memory, world.jobs);
}

struct Body {
  hf_gltf::Model model;
  hf_gltf::FlatMesh mesh;
  std::shared_ptr<const hf_inner::surface::Core> core;

  Body(hf_gltf::Model from, const World& world) : model(std::move(from)), mesh(hf_gltf::flatten(model)) {
    build(world);
  }
  // Moves the rest shape (and nothing else), p -> f(p), and makes the core anew.
  template <class Function>
  void move(const World& world, Function f) {
    for (glm::dvec3& p : mesh.positions) p = f(p);
    build(world);
  }
  void build(const World& world) { core = make_core(mesh.positions, mesh.triangles, world); }

  // Given positions of flat vertices as inner vertices.
  std::vector<hf_inner::Vec3> inner(const std::vector<glm::dvec3>& flat) const {
    std::vector<hf_inner::Vec3> out(static_cast<size_t>(core->size()));
    for (size_t v = 0; v < out.size(); ++v) {
      const glm::dvec3& p = flat[static_cast<size_t>(core->mesh.given_of_inner[v])];
      out[v] = {p.x, p.y, p.z};
    }
    return out;
  }
  std::vector<hf_inner::Vec3> rest() const { return inner(mesh.positions); }
  std::vector<hf_inner::Vec3> posed(const hf_gltf::Animation& clip, double time) const {
    return inner(hf_gltf::posed_positions(model, mesh, clip, time));
  }
  std::vector<int32_t> inner_of(const std::vector<uint32_t>& flat) const {
    std::vector<int32_t> out;
    for (const uint32_t v : flat) {
      if (core->mesh.inner_of_given[v] >= 0) out.push_back(core->mesh.inner_of_given[v]);
    }
    return out;
  }
};

inline Body creature(const std::string& name, uint32_t vertices, const World& world) {
  return Body(samples::to_model(hf_test::creature(name, vertices)), world);
}

// The regions of a pairs file as inner vertices of two bodies.
struct Pairs {
  std::vector<std::string> names;
  std::vector<std::vector<int32_t>> source, target;
  std::vector<uint32_t> flags;
  std::vector<hf_inner::transfer::PairInput> inputs() const {
    std::vector<hf_inner::transfer::PairInput> out(names.size());
    for (size_t i = 0; i < out.size(); ++i) {
      out[i].source = {source[i].data(), source[i].size()};
      out[i].target = {target[i].data(), target[i].size()};
      out[i].flags = flags[i];
    }
    return out;
  }
};

// as_source: both sides take the source's selectors (self-transfer).
inline Pairs find_pairs(const std::string& file, const Body& source, const Body& target, bool as_source = false) {
  const hf_gltf::PairsFile pairs = hf_gltf::read_pairs(pairs_path(file));
  const hf_gltf::RegionFinder on_source(source.model, source.mesh, pairs.source_axes),
      on_target(target.model, target.mesh, pairs.target_axes);
  std::vector<hf_gltf::Region> a, b;
  for (const hf_gltf::PairEntry& entry : pairs.pairs) {
    a.push_back(on_source.find(entry.source));
    b.push_back(on_target.find(as_source ? entry.source : entry.target));
  }
  if (on_source.separate(a) >= 0 || on_target.separate(b) >= 0)
    throw std::runtime_error("a region is covered by others");
  Pairs out;
  for (size_t i = 0; i < a.size(); ++i) {
    out.names.push_back(pairs.pairs[i].name);
    out.flags.push_back(pairs.pairs[i].flags());
    out.source.push_back(source.inner_of(a[i].vertices));
    out.target.push_back(target.inner_of(b[i].vertices));
  }
  return out;
}

// The horse and the bull of most tests, and their pairs. Made once: the creatures take a moment.
struct Animals {
  World world;
  Body horse = creature("horse", 2500, world), bull = creature("bull", 1600, world);
  Pairs pairs = find_pairs("horse_to_bull.json", horse, bull);
  const hf_gltf::Animation& walk =
      horse.model.animations[static_cast<size_t>(hf_gltf::find_animation(horse.model, "walk"))];
  double box = bull.core->mesh.scale;
  size_t pair(const std::string& name) const {
    return static_cast<size_t>(std::find(pairs.names.begin(), pairs.names.end(), name) - pairs.names.begin());
  }
};

inline const Animals& animals() {
  static const Animals made;
  return made;
}

// Mean over the vertices of a region, each once.
inline hf_inner::Vec3 centre_of(std::vector<int32_t> region, const std::vector<hf_inner::Vec3>& points) {
  std::sort(region.begin(), region.end());
  region.erase(std::unique(region.begin(), region.end()), region.end());
  hf_inner::Vec3 sum;
  for (const int32_t v : region)
    sum = sum + (1.0 / static_cast<double>(region.size())) * points[static_cast<size_t>(v)];
  return sum;
}

inline double lowest_of(const std::vector<int32_t>& region, const std::vector<hf_inner::Vec3>& points) {
  double low = 1e300;
  for (const int32_t v : region) low = std::min(low, points[static_cast<size_t>(v)].y);
  return low;
}

inline double lowest_of(const std::vector<hf_inner::Vec3>& points) {
  double low = 1e300;
  for (const hf_inner::Vec3& p : points) low = std::min(low, p.y);
  return low;
}

inline void add(hf_inner::transfer::Transfer& transfer, const std::vector<hf_inner::transfer::PairInput>& inputs,
                uint32_t* numbers = nullptr) {
  transfer.add_pairs({inputs.data(), inputs.size()}, numbers);
}

inline std::vector<hf_inner::Vec3> frame_of(hf_inner::transfer::Transfer& transfer,
                                            const std::vector<hf_inner::Vec3>& posed) {
  std::vector<hf_inner::Vec3> out(static_cast<size_t>(transfer.target().size()));
  transfer.apply(posed.data(), out.data());
  return out;
}

inline double largest_distance(const std::vector<hf_inner::Vec3>& a, const std::vector<hf_inner::Vec3>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, hf_inner::norm(a[i] - b[i]));
  return largest;
}

// Area-weighted root mean square over the box diagonal; centred: the mean difference is taken out.
inline double rms(const hf_inner::surface::Core& core, const std::vector<hf_inner::Vec3>& a,
                  const std::vector<hf_inner::Vec3>& b, bool centred = false) {
  hf_inner::Memory memory;
  const auto area = hf_inner::transfer::area_shares(core.mesh, memory);
  hf_inner::Vec3 mean;
  for (size_t v = 0; centred && v < a.size(); ++v) mean = mean + area[v] * (a[v] - b[v]);
  double sum = 0;
  for (size_t v = 0; v < a.size(); ++v) {
    const hf_inner::Vec3 d = a[v] - b[v] - mean;
    sum += area[v] * hf_inner::dot(d, d);
  }
  return std::sqrt(sum) / core.mesh.scale;
}

}  // namespace transfer_test

#endif
