// From a design to a creature: base mesh, skin weights, charts, refinement, spatial order, stored arrays.
//
// Skin weights start as "all to the joint of the nearest flesh" and diffuse over the base mesh, w <- (1 - r) w + r mean
// of the ring; on a mesh that is finer on thin limbs the blend at a joint is about as wide as the limb is thick. They
// never cross from one leg to the other except through the body. The four largest are kept, less the fifth.
#include "creature.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <stdexcept>

#include "creature_charts.h"
#include "creature_design.h"
#include "even_mesh.h"

namespace samples {
namespace {

// Weights of all joints per vertex, row by row.
struct WeightTable {
  size_t joints = 0;
  std::vector<float> values;
  float* row(size_t v) { return &values[v * joints]; }
  const float* row(size_t v) const { return &values[v * joints]; }
};

// One diffusion step with rate r towards the mean of the ring (each neighbour is met in two triangles).
void diffuse(const TriangleMesh& mesh, WeightTable& table, int rounds, float rate) {
  std::vector<uint32_t> start(mesh.points.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    for (uint32_t v : t) ++start[v + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<uint32_t> ring(start.back()), fill(start.begin(), start.end() - 1);
  for (const Triangle& t : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) ring[fill[t[k]]++] = t[(k + 1) % 3];
  }
  std::vector<float> next(table.values.size());
  const size_t n = table.joints;
  for (int round = 0; round < rounds; ++round) {
    for (size_t v = 0; v < mesh.points.size(); ++v) {
      float* out = &next[v * n];
      std::fill(out, out + n, 0.0f);
      for (uint32_t i = start[v]; i < start[v + 1]; ++i) {
        const float* in = table.row(ring[i]);
        for (size_t j = 0; j < n; ++j) out[j] += in[j];
      }
      const float share = rate / float(start[v + 1] - start[v]);
      const float* own = table.row(v);
      for (size_t j = 0; j < n; ++j) out[j] = (1 - rate) * own[j] + share * out[j];
    }
    table.values.swap(next);
  }
}

WeightTable base_weights(const Design& design, const TriangleMesh& mesh) {
  WeightTable table;
  table.joints = design.joints.size();
  table.values.assign(mesh.points.size() * table.joints, 0.0f);
  for (size_t v = 0; v < mesh.points.size(); ++v) table.row(v)[design.body.nearest_joint(mesh.points[v])] = 1;
  // blend width in metres on the trunk, in edges there
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    area += 0.5 * length(cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]));
  }
  const double edge = 1.25 * std::sqrt(area / double(mesh.points.size()));
  const double height = design.body.upper.y, width = 0.055 * height;
  const float rate = 0.6f;
  const int rounds = std::clamp(int(std::lround(2 * width * width / (double(rate) * edge * edge))), 1, 400);
  diffuse(mesh, table, rounds, rate);
  return table;
}

void store_weights(const WeightTable& table, const std::vector<uint32_t>& old_vertex, Creature& creature) {
  std::vector<uint32_t> order(table.joints);
  for (size_t s = 0; s < creature.surface_vertex.size(); ++s) {
    const float* row = table.row(old_vertex[creature.surface_vertex[s]]);
    std::iota(order.begin(), order.end(), 0u);
    std::partial_sort(order.begin(), order.begin() + 5, order.end(),
                      [&](uint32_t a, uint32_t b) { return row[a] != row[b] ? row[a] > row[b] : a < b; });
    // what the fifth has is taken from the four, so that no joint leaves with a jump
    const float fifth = row[order[0]] - row[order[4]] > 0.02f ? row[order[4]] : 0.0f;
    std::array<uint16_t, 4> joints{};
    std::array<float, 4> weights{};
    float sum = 0;
    for (size_t k = 0; k < 4; ++k) {
      if (row[order[k]] - fifth < 1e-4f) break;
      joints[k] = static_cast<uint16_t>(order[k]);
      weights[k] = row[order[k]] - fifth;
      sum += weights[k];
    }
    for (float& w : weights) w /= sum;
    creature.joints.push_back(joints);
    creature.weights.push_back(weights);
  }
}

Design design_of(const std::string& name) {
  if (name == "horse") return design_horse();
  if (name == "bull") return design_bull();
  if (name == "biped") return design_biped();
  std::string known;
  for (const std::string& each : creature_names()) known += (known.empty() ? "" : ", ") + each;
  throw std::runtime_error("there is no creature named " + name + "; known are " + known);
}

// Stored vertices in the order of their surface vertices, copies side by side.
void store_arrays(const Design& design, const TriangleMesh& surface, const ChartMesh& charts,
                  const std::vector<uint32_t>& order, Creature& creature) {
  std::vector<uint32_t> new_name(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) new_name[order[i]] = i;
  std::vector<uint32_t> stored(charts.surface.size());
  std::iota(stored.begin(), stored.end(), 0u);
  std::stable_sort(stored.begin(), stored.end(),
                   [&](uint32_t a, uint32_t b) { return new_name[charts.surface[a]] < new_name[charts.surface[b]]; });
  std::vector<uint32_t> stored_name(stored.size());
  const auto push = [](std::vector<float>& array, const dvec3& p) {
    for (int k = 0; k < 3; ++k) array.push_back(static_cast<float>(p[k]));
  };
  dvec3 normal(0), color(0);
  uint32_t last = 0xFFFFFFFFu;
  for (uint32_t s = 0; s < stored.size(); ++s) {
    const uint32_t flat = stored[s], v = charts.surface[flat];
    stored_name[flat] = s;
    if (v != last) {
      last = v;
      normal = normalize(design.body.gradient(surface.points[v]));
      color = design.color(surface.points[v], normal);
    }
    push(creature.positions, surface.points[v]);
    push(creature.normals, normal);
    push(creature.colors, color);
    creature.texcoords.push_back(static_cast<float>(charts.flat.points[flat].x));
    creature.texcoords.push_back(static_cast<float>(1 - charts.flat.points[flat].y));
    creature.surface_vertex.push_back(new_name[v]);
  }
  std::vector<uint32_t> triangle_order;
  reorder(surface, order, triangle_order);
  for (uint32_t t : triangle_order) {
    for (uint32_t corner : charts.flat.triangles[t]) creature.triangles.push_back(stored_name[corner]);
  }
}

glm::dmat4 to_matrix(const glm::dquat& q, const dvec3& p) {
  glm::dmat4 m = glm::mat4_cast(q);
  m[3] = glm::dvec4(p, 1);
  return m;
}

std::vector<double> world_matrices(const Creature& creature, const std::vector<glm::dmat4>& local) {
  std::vector<glm::dmat4> world(local.size());
  std::vector<double> numbers;
  for (size_t j = 0; j < local.size(); ++j) {
    const int32_t parent = creature.skeleton[j].parent;
    world[j] = parent < 0 ? local[j] : world[size_t(parent)] * local[j];
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r) numbers.push_back(world[j][c][r]);
    }
  }
  return numbers;
}

}  // namespace

std::vector<std::string> creature_names() { return {"horse", "bull", "biped"}; }

Creature make_creature(const std::string& name, uint32_t vertices) {
  const MeshPlan plan = plan_mesh(vertices);
  const Design design = design_of(name);
  TriangleMesh surface = base_mesh(design.body, plan.base);
  WeightTable weights = base_weights(design, surface);
  ChartMesh charts = make_charts(design, surface);
  std::vector<std::array<uint32_t, 2>> parents;
  for (int level = 0; level < plan.levels; ++level) {
    surface = refine(design.body, surface, parents);
    const size_t old_count = surface.points.size() - parents.size(), n = weights.joints;
    weights.values.resize(surface.points.size() * n);
    for (size_t i = 0; i < parents.size(); ++i) {
      const float *a = weights.row(parents[i][0]), *b = weights.row(parents[i][1]);
      float* row = weights.row(old_count + i);
      for (size_t j = 0; j < n; ++j) row[j] = 0.5f * (a[j] + b[j]);
    }
    diffuse(surface, weights, 2, 0.5f);
    // the flat mesh is cut in the same order, so its triangles stay parallel to the surface's
    charts.flat = subdivide(charts.flat, parents);
    charts.surface.resize(charts.flat.points.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) charts.surface[charts.flat.triangles[t][k]] = surface.triangles[t][k];
    }
  }
  Creature creature;
  creature.name = name;
  creature.surface_vertex_count = static_cast<uint32_t>(surface.points.size());
  creature.chart_count = charts.chart_count;
  const std::vector<uint32_t> order = spatial_order(surface.points);
  store_arrays(design, surface, charts, order, creature);
  store_weights(weights, order, creature);
  creature.skeleton = design.joints;
  creature.clips = design.clips;
  return creature;
}

ShapeMesh welded_surface(const Creature& creature) {
  ShapeMesh mesh;
  mesh.positions.resize(3 * size_t(creature.surface_vertex_count));
  for (size_t s = 0; s < creature.surface_vertex.size(); ++s) {
    for (size_t k = 0; k < 3; ++k) {
      mesh.positions[3 * size_t(creature.surface_vertex[s]) + k] = double(creature.positions[3 * s + k]);
    }
  }
  for (uint32_t v : creature.triangles) mesh.triangles.push_back(creature.surface_vertex[v]);
  return mesh;
}

uint32_t find_clip(const Creature& creature, const std::string& name) {
  for (uint32_t i = 0; i < creature.clips.size(); ++i) {
    if (creature.clips[i].name == name) return i;
  }
  throw std::runtime_error("creature " + creature.name + " has no clip named " + name);
}

uint32_t find_joint(const Creature& creature, const std::string& name) {
  for (uint32_t i = 0; i < creature.skeleton.size(); ++i) {
    if (creature.skeleton[i].name == name) return i;
  }
  throw std::runtime_error("creature " + creature.name + " has no joint named " + name);
}

std::vector<double> rest_pose(const Creature& creature) {
  std::vector<glm::dmat4> local;
  for (const Joint& joint : creature.skeleton) {
    local.push_back(to_matrix({1, 0, 0, 0}, {joint.translation[0], joint.translation[1], joint.translation[2]}));
  }
  return world_matrices(creature, local);
}

std::vector<double> clip_pose(const Creature& creature, const Clip& clip, double time) {
  if (clip.times.empty() || clip.joints.size() != creature.skeleton.size()) return rest_pose(creature);
  const double duration = clip.duration();
  if (duration > 0) time -= duration * std::floor(time / duration);
  const size_t count = clip.times.size();
  const size_t after = std::upper_bound(clip.times.begin(), clip.times.end(), time,
                                        [](double t, float key) { return t < double(key); }) -
                       clip.times.begin();
  const size_t i = std::min(after > 0 ? after - 1 : 0, count - 1), k = std::min(i + 1, count - 1);
  const double width = double(clip.times[k]) - double(clip.times[i]);
  const double t = width > 0 ? (time - double(clip.times[i])) / width : 0;
  std::vector<glm::dmat4> local;
  for (size_t j = 0; j < creature.skeleton.size(); ++j) {
    const JointKeys& keys = clip.joints[j];
    const Joint& joint = creature.skeleton[j];
    dvec3 p(joint.translation[0], joint.translation[1], joint.translation[2]);
    glm::dquat q(1, 0, 0, 0);
    if (!keys.translations.empty()) {
      const float *a = &keys.translations[3 * i], *b = &keys.translations[3 * k];
      p = mix(dvec3(a[0], a[1], a[2]), dvec3(b[0], b[1], b[2]), t);
    }
    if (!keys.rotations.empty()) {
      const float *a = &keys.rotations[4 * i], *b = &keys.rotations[4 * k];
      q = normalize(glm::slerp(glm::dquat(double(a[3]), double(a[0]), double(a[1]), double(a[2])),
                               glm::dquat(double(b[3]), double(b[0]), double(b[1]), double(b[2])), t));
    }
    local.push_back(to_matrix(q, p));
  }
  return world_matrices(creature, local);
}

std::vector<double> skin_positions(const Creature& creature, const std::vector<double>& world) {
  if (world.size() != 16 * creature.skeleton.size()) {
    throw std::runtime_error("skin_positions: needs one 4 x 4 matrix per joint of creature " + creature.name);
  }
  // rest rotations are identity: the inverse bind matrix is a translation
  std::vector<dvec3> rest(creature.skeleton.size());
  for (size_t j = 0; j < rest.size(); ++j) {
    const Joint& joint = creature.skeleton[j];
    rest[j] = dvec3(joint.translation[0], joint.translation[1], joint.translation[2]);
    if (joint.parent >= 0) rest[j] += rest[size_t(joint.parent)];
  }
  std::vector<double> result(creature.positions.size());
  for (size_t v = 0; v < creature.joints.size(); ++v) {
    const dvec3 p(creature.positions[3 * v], creature.positions[3 * v + 1], creature.positions[3 * v + 2]);
    dvec3 sum(0);
    for (size_t k = 0; k < 4; ++k) {
      const double w = double(creature.weights[v][k]);
      if (w == 0) continue;
      const size_t j = creature.joints[v][k];
      const double* m = &world[16 * j];
      const dvec3 q = p - rest[j];
      sum += w * dvec3(m[0] * q.x + m[4] * q.y + m[8] * q.z + m[12], m[1] * q.x + m[5] * q.y + m[9] * q.z + m[13],
                       m[2] * q.x + m[6] * q.y + m[10] * q.z + m[14]);
    }
    for (int k = 0; k < 3; ++k) result[3 * v + size_t(k)] = sum[k];
  }
  return result;
}

uint64_t creature_hash(const Creature& creature) {
  uint64_t hash = 0xCBF29CE484222325ull;
  const auto add = [&](const auto& array) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(array.data());
    for (size_t i = 0; i < array.size() * sizeof(array[0]); ++i) hash = (hash ^ bytes[i]) * 0x100000001B3ull;
  };
  add(creature.positions);
  add(creature.normals);
  add(creature.texcoords);
  add(creature.colors);
  add(creature.joints);
  add(creature.weights);
  add(creature.triangles);
  add(creature.surface_vertex);
  for (const Joint& joint : creature.skeleton) {
    add(joint.name);
    add(joint.translation);
  }
  for (const Clip& clip : creature.clips) {
    add(clip.times);
    for (const JointKeys& keys : clip.joints) {
      add(keys.rotations);
      add(keys.translations);
    }
  }
  return hash;
}

}  // namespace samples
