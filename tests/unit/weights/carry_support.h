// Generated creatures with weights, garments over them, and carried weights for both.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <string>

#include "assets/creature.h"
#include "support/creature.h"
#include "weights/carry.h"
#include "weights_support.h"

namespace hf_test {

using Point = std::array<double, 3>;

// A creature welded, with the weights of its generator.
struct Body {
  PlainMesh mesh;
  std::vector<std::uint32_t> joints;  // four for each vertex
  std::vector<float> weights;
  std::vector<Point> heads;
  std::vector<int> parents;
  samples::Creature creature;
  hf_inner::weights::GivenWeights given() const { return {4, joints.data(), weights.data()}; }
};

inline Body make_body(const std::string& name, std::uint32_t vertices) {
  Body out;
  out.creature = hf_test::creature(name, vertices);
  const samples::Creature& c = out.creature;
  out.mesh.positions.resize(3 * std::size_t{c.surface_vertex_count});
  out.joints.resize(4 * std::size_t{c.surface_vertex_count});
  out.weights.resize(out.joints.size());
  for (std::size_t v = 0; v < c.vertex_count(); ++v) {
    const std::size_t to = c.surface_vertex[v];
    for (std::size_t k = 0; k < 3; ++k) out.mesh.positions[3 * to + k] = static_cast<double>(c.positions[3 * v + k]);
    for (std::size_t k = 0; k < 4; ++k) {
      out.joints[4 * to + k] = c.joints[v][k];
      out.weights[4 * to + k] = c.weights[v][k];
    }
  }
  for (const std::uint32_t v : c.triangles) out.mesh.triangles.push_back(c.surface_vertex[v]);
  for (const samples::Joint& joint : c.skeleton) {
    Point p{joint.translation[0], joint.translation[1], joint.translation[2]};
    if (joint.parent >= 0) {
      for (std::size_t k = 0; k < 3; ++k) p[k] += out.heads[static_cast<std::size_t>(joint.parent)][k];
    }
    out.heads.push_back(p);
    out.parents.push_back(joint.parent);
  }
  return out;
}

inline hf_inner::weights::MatchOptions carry_options(std::int32_t influences = 4) {
  hf_inner::weights::MatchOptions options;
  options.distance = 0.05;
  options.cosine = std::cos(0.5235987755982988) - 1e-12;
  options.influences = influences;
  return options;
}

inline hf_inner::weights::FilledWeights carry(const std::shared_ptr<const hf_inner::surface::Core>& source,
                                              const hf_inner::weights::GivenWeights& given,
                                              const std::shared_ptr<const hf_inner::surface::Core>& target,
                                              const hf_inner::weights::MatchOptions& options = carry_options()) {
  const hf_inner::mesh::SkinShape skin(source->mesh, *source->memory);
  const hf_inner::surface::Surface surface(target->geometry, {});
  return hf_inner::weights::transfer_weights(source->mesh, skin, given, target, options, &surface);
}

inline double share_of(const hf_inner::weights::FilledWeights& filled, std::size_t v, std::uint32_t joint) {
  double sum = 0;
  const std::size_t k = at(filled.influences);
  for (std::size_t i = v * k; i < (v + 1) * k; ++i)
    sum += filled.joints[i] == joint ? static_cast<double>(filled.weights[i]) : 0;
  return sum;
}

// Vertices whose weights are negative, do not descend, do not sum to exactly 1, or name a joint that is not there.
inline std::size_t faults_of(const hf_inner::weights::FilledWeights& filled, std::size_t vertices, std::size_t joints) {
  const std::size_t k = at(filled.influences);
  if (filled.weights.size() != vertices * k || filled.origin.size() != vertices) return vertices + 1;
  std::size_t faults = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    float sum = 0;
    bool good = true;
    for (std::size_t i = v * k; i < (v + 1) * k; ++i) {
      good &= filled.weights[i] >= 0 && filled.joints[i] < joints &&
              (i == v * k || filled.weights[i] <= filled.weights[i - 1]);
      sum += filled.weights[i];
    }
    faults += !(good && sum == 1.0f);
  }
  return faults;
}

// A tube around a line, open at both ends: radius from `first` to `last`.
inline PlainMesh around_line(const Point& from, const Point& to, double first, double last, std::uint32_t around,
                             std::uint32_t rings) {
  hf_inner::Vec3 along{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  along = (1 / norm(along)) * along;
  const hf_inner::Vec3 any = std::fabs(along.x) < 0.6 ? hf_inner::Vec3{1, 0, 0} : hf_inner::Vec3{0, 1, 0};
  hf_inner::Vec3 u = cross(along, any);
  u = (1 / norm(u)) * u;
  const hf_inner::Vec3 w = cross(along, u);
  PlainMesh mesh;
  for (std::uint32_t i = 0; i < rings; ++i) {
    const double t = static_cast<double>(i) / (rings - 1), radius = first + t * (last - first);
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = 8 * std::atan(1.0) * k / around;
      const hf_inner::Vec3 out = (radius * std::cos(a)) * u + (radius * std::sin(a)) * w;
      mesh.positions.insert(mesh.positions.end(),
                            {from[0] + t * (to[0] - from[0]) + out.x, from[1] + t * (to[1] - from[1]) + out.y,
                             from[2] + t * (to[2] - from[2]) + out.z});
    }
  }
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around, c = a + around, d = b + around;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

// The distance of the farthest body vertex that belongs to a joint, from the joint.
inline double girth(const Body& body, std::uint32_t joint) {
  double most = 0;
  for (std::size_t v = 0; v < body.mesh.vertex_count(); ++v) {
    double weight = 0, squared = 0;
    for (std::size_t k = 0; k < 4; ++k)
      weight += body.joints[4 * v + k] == joint ? static_cast<double>(body.weights[4 * v + k]) : 0;
    for (std::size_t k = 0; k < 3; ++k) squared += std::pow(body.mesh.positions[3 * v + k] - body.heads[joint][k], 2);
    if (weight > 0.5) most = std::max(most, squared);
  }
  return std::sqrt(most);
}

// The triangles around a vertex, moved out along the normals, with an inner sheet and a rim between.
inline PlainMesh plate(const Body& body, std::size_t middle, double radius, double gap, double thickness) {
  const PlainMesh& from = body.mesh;
  std::vector<hf_inner::Vec3> normal(from.vertex_count());
  const auto at_vertex = [&](std::uint32_t v) {
    return hf_inner::Vec3{from.positions[3 * v], from.positions[3 * v + 1], from.positions[3 * v + 2]};
  };
  for (std::size_t t = 0; t < from.triangles.size(); t += 3) {
    const hf_inner::Vec3 a = at_vertex(from.triangles[t]);
    const hf_inner::Vec3 n = cross(at_vertex(from.triangles[t + 1]) - a, at_vertex(from.triangles[t + 2]) - a);
    for (std::size_t k = 0; k < 3; ++k) normal[from.triangles[t + k]] = normal[from.triangles[t + k]] + n;
  }
  PlainMesh mesh;
  std::vector<std::uint32_t> number(from.vertex_count(), UINT32_MAX);
  const hf_inner::Vec3 centre = at_vertex(static_cast<std::uint32_t>(middle));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t t = 0; t < from.triangles.size(); t += 3) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside &= norm(at_vertex(from.triangles[t + k]) - centre) < radius;
    if (!inside) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = from.triangles[t + k];
      if (number[v] == UINT32_MAX) {
        number[v] = mesh.vertex_count() / 2;
        const double length = std::max(norm(normal[v]), 1e-30);
        for (const double away : {gap, gap + thickness}) {
          const hf_inner::Vec3 p = at_vertex(v) + (away / length) * normal[v];
          mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
        }
      }
    }
    const std::uint32_t a = 2 * number[from.triangles[t]], b = 2 * number[from.triangles[t + 1]],
                        c = 2 * number[from.triangles[t + 2]];
    mesh.triangles.insert(mesh.triangles.end(), {a + 1, b + 1, c + 1, a, c, b});
    ++edges[{a, b}];
    ++edges[{b, c}];
    ++edges[{c, a}];
  }
  for (const auto& [edge, count] : edges) {
    const auto [a, b] = edge;
    if (!edges.count({b, a})) mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
  }
  return mesh;
}

// A sleeve, a skirt, a hood or an armour plate over a creature, with what garments come with: other tessellation,
// noise, faces that look inwards, specks far away, loose vertices.
inline PlainMesh garment(const Body& body, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  const auto joint = [&](bool with_parent) {
    for (;;) {
      const std::size_t j = random() % body.heads.size();
      if (!with_parent || body.parents[j] >= 0) return static_cast<std::uint32_t>(j);
    }
  };
  double size = 0;
  for (const double x : body.mesh.positions) size = std::max(size, std::fabs(x));
  PlainMesh mesh;
  const auto around = static_cast<std::uint32_t>(7 + random() % 14),
             rings = static_cast<std::uint32_t>(5 + random() % 9);
  switch (seed % 4) {
    case 0: {  // a sleeve over a bone, longer than it
      const std::uint32_t j = joint(true);
      const Point &a = body.heads[static_cast<std::size_t>(body.parents[j])], &b = body.heads[j];
      Point from, to;
      double length = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        from[k] = a[k] - 0.1 * (b[k] - a[k]);
        to[k] = b[k] + 0.1 * (b[k] - a[k]);
        length += std::pow(b[k] - a[k], 2);
      }
      if (!(length > 0)) to[1] += 0.1 * size;
      const double radius = std::max(0.3 * girth(body, static_cast<std::uint32_t>(body.parents[j])), 0.02 * size);
      mesh = around_line(from, to, radius * (1 + any(random)), radius * (1 + any(random)), around, rings);
      break;
    }
    case 1: {  // a skirt, hanging from a joint
      const Point from = body.heads[joint(false)];
      const Point to{from[0], from[1] - (0.2 + 0.4 * any(random)) * size, from[2]};
      mesh = around_line(from, to, 0.15 * size, (0.2 + 0.3 * any(random)) * size, around, rings);
      break;
    }
    case 2: {  // a hood: half a sphere around a joint
      const Point centre = body.heads[joint(false)];
      const double radius = std::max(girth(body, joint(false)), 0.05 * size) * (1 + 0.3 * any(random));
      mesh = tube(around, rings, 1);
      for (std::size_t p = 0; p < mesh.positions.size(); p += 3) {
        const double t = 0.05 + 0.9 * mesh.positions[p], y = mesh.positions[p + 1], z = mesh.positions[p + 2];
        const double angle = 1.7 * (1 - t), ring = radius * std::sin(angle);
        mesh.positions[p] = centre[0] + ring * z;
        mesh.positions[p + 1] = centre[1] + radius * std::cos(angle);
        mesh.positions[p + 2] = centre[2] + ring * y;
      }
      break;
    }
    default:  // an armour plate
      do {
        mesh = plate(body, random() % body.mesh.vertex_count(), (0.1 + 0.3 * any(random)) * size,
                     0.02 * size * any(random), 0.02 * size);
      } while (mesh.triangles.empty());
  }
  if (random() % 3 == 0) {
    for (double& x : mesh.positions) x += 0.01 * size * (any(random) - 0.5);
  }
  if (random() % 5 == 0) {
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t], mesh.triangles[t + 1]);
  }
  if (random() % 4 == 0) {
    PlainMesh speck = tube(5, 3, 1);
    for (double& x : speck.positions) x *= 0.01 * size;
    append(mesh, speck, 3 * size * any(random));
  }
  if (random() % 4 == 0) mesh.positions.insert(mesh.positions.end(), {0.1 * size, 2 * size * any(random), 0});
  return mesh;
}

}  // namespace hf_test
