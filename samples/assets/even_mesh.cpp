// Isotropic remeshing to an exact vertex count, refinement and spatial order; see even_mesh.h for the sources.
#include "even_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "edit_mesh.h"

namespace samples {
namespace {

// Remeshing keeps the wanted relative edge length of every vertex beside the mesh.
class Remesher {
 public:
  Remesher(const ImplicitBody& body, const TriangleMesh& start) : body_(body), mesh_(start) {
    for (const dvec3& p : mesh_.points) detail_.push_back(body_.detail(p));
  }

  TriangleMesh run(uint32_t count) {
    largest_ = std::max(count, mesh_.live_vertices);
    // coarse meshes are reached in steps, so that the surface can follow
    for (uint32_t step = 6000; step > 2 * count; step /= 2) settle(step, 2);
    settle(count, 5);
    for (int round = 0; round < 4; ++round) {
      reach(count);
      flip_for_angles();
      relax_tangentially(3);
    }
    // the few needles left sit in tight creases: take them out, put the vertices elsewhere
    for (int round = 0; round < 6 && collapse_needles() > 0; ++round) {
      reach(count);
      flip_for_angles();
      relax_tangentially(2);
    }
    reach(count);
    flip_for_angles();
    return mesh_.compact();
  }

 private:
  // Edge lengths near those of a mesh of `count` vertices.
  void settle(uint32_t count, int rounds) {
    set_length(count);
    for (int round = 0; round < rounds; ++round) {
      split_long();
      collapse_short();
      flip_for_valence();
      relax_tangentially(2);
      set_length(count);
    }
  }

  double length_of(uint32_t h) const { return glm::length(mesh_.points[mesh_.to(h)] - mesh_.points[mesh_.from(h)]); }
  // Length relative to the wanted one.
  double relative(uint32_t h) const {
    return length_of(h) / (0.5 * edge_ * (detail_[mesh_.to(h)] + detail_[mesh_.from(h)]));
  }

  // V vertices share the area: one vertex of an equilateral mesh takes sqrt(3)/2 edge^2.
  void set_length(uint32_t count) {
    double area = 0;
    for (uint32_t t = 0; 3 * t < mesh_.corner.size(); ++t) {
      if (!mesh_.alive(3 * t)) continue;
      double detail = 0;
      for (uint32_t k = 0; k < 3; ++k) detail += detail_[mesh_.corner[3 * t + k]] / 3;
      area += glm::length(mesh_.face_area(t)) / (detail * detail);
    }
    edge_ = std::sqrt(area / count * 2 / std::sqrt(3.0));
  }

  void split(uint32_t h) {
    const dvec3 middle = 0.5 * (mesh_.points[mesh_.from(h)] + mesh_.points[mesh_.to(h)]);
    const uint32_t m = mesh_.split(h, middle);
    const dvec3 p = body_.project(middle, 2);
    if (mesh_.stays_upright(m, p, no_index)) mesh_.points[m] = p;
    detail_.push_back(body_.detail(mesh_.points[m]));
  }

  bool collapse(uint32_t h) {
    const uint32_t b = mesh_.to(h);
    const dvec3 p = body_.project(0.5 * (mesh_.points[mesh_.from(h)] + mesh_.points[b]), 2);
    if (!mesh_.collapse(h, p)) return false;
    detail_[b] = body_.detail(p);
    return true;
  }

  void split_long() {
    // edges made in this pass wait for the next one
    const uint32_t count = static_cast<uint32_t>(mesh_.corner.size());
    for (uint32_t h = 0; h < count; ++h) {
      if (mesh_.alive(h) && h < mesh_.twin[h] && relative(h) > 1.4) split(h);
    }
    if (mesh_.live_vertices > 4 * largest_) throw std::runtime_error("remesh: the rounds do not converge");
  }

  void collapse_short() {
    for (uint32_t h = 0; h < mesh_.corner.size(); ++h) {
      if (!mesh_.alive(h) || h > mesh_.twin[h] || relative(h) > 0.72) continue;
      // do not make edges that would be split again
      const uint32_t a = mesh_.from(h), b = mesh_.to(h);
      const dvec3 middle = 0.5 * (mesh_.points[a] + mesh_.points[b]);
      bool too_long = false;
      for (uint32_t v : {a, b}) {
        uint32_t e = mesh_.outgoing[v];
        do {
          const uint32_t w = mesh_.to(e);
          const double wanted = edge_ * 0.5 * (detail_[w] + detail_[v]);
          too_long = too_long || (w != a && w != b && glm::length(mesh_.points[w] - middle) > 1.4 * wanted);
          e = mesh_.rotate(e);
        } while (e != mesh_.outgoing[v]);
      }
      if (!too_long) collapse(h);
    }
  }

  uint32_t collapse_needles() {
    uint32_t found = 0;
    for (uint32_t t = 0; 3 * t < mesh_.corner.size(); ++t) {
      if (!mesh_.alive(3 * t)) continue;
      std::array<uint32_t, 3> edge{3 * t, 3 * t + 1, 3 * t + 2};
      std::sort(edge.begin(), edge.end(), [&](uint32_t a, uint32_t b) { return length_of(a) < length_of(b); });
      // height over the longest edge below a fifth of it: an angle below about 13 degrees
      const double longest = length_of(edge[2]);
      if (2 * glm::length(mesh_.face_area(t)) > 0.20 * longest * longest) continue;
      ++found;
      if (mesh_.flip(edge[2]) || collapse(edge[0]) || collapse(edge[1])) continue;
      // stuck in a crease: thin out the neighbourhood
      const uint32_t around[3] = {mesh_.twin[edge[0]], mesh_.twin[edge[1]], mesh_.twin[edge[2]]};
      for (uint32_t h : around) {
        if (collapse(EditMesh::next(h)) || collapse(EditMesh::previous(h))) break;
      }
    }
    return found;
  }

  void flip_for_valence() {
    for (uint32_t h = 0; h < mesh_.corner.size(); ++h) {
      if (!mesh_.alive(h) || h > mesh_.twin[h]) continue;
      const auto excess = [&](uint32_t v, int change) {
        const int off = int(mesh_.valence(v)) + change - 6;
        return off * off;
      };
      const uint32_t a = mesh_.from(h), b = mesh_.to(h), c = mesh_.from(EditMesh::previous(h)),
                     d = mesh_.from(EditMesh::previous(mesh_.twin[h]));
      const int before = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
      const int after = excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1);
      if (after < before) mesh_.flip(h);
    }
  }

  double angle_at(uint32_t v, uint32_t a, uint32_t b) const {
    const dvec3 x = mesh_.points[a] - mesh_.points[v], y = mesh_.points[b] - mesh_.points[v];
    return std::atan2(glm::length(cross(x, y)), dot(x, y));
  }

  // Delaunay: the angles opposite an edge sum to at most pi.
  void flip_for_angles() {
    for (int round = 0; round < 4; ++round) {
      uint32_t flips = 0;
      for (uint32_t h = 0; h < mesh_.corner.size(); ++h) {
        if (!mesh_.alive(h) || h > mesh_.twin[h]) continue;
        const uint32_t a = mesh_.from(h), b = mesh_.to(h), c = mesh_.from(EditMesh::previous(h)),
                       d = mesh_.from(EditMesh::previous(mesh_.twin[h]));
        if (angle_at(c, a, b) + angle_at(d, a, b) > 3.1415927 + 1e-3) flips += mesh_.flip(h);
      }
      if (flips == 0) return;
    }
  }

  void relax_tangentially(int rounds) {
    std::vector<dvec3> sum(mesh_.points.size()), normals(mesh_.points.size(), dvec3(0)), before;
    std::vector<double> weight(mesh_.points.size());
    std::vector<Triangle> triangles;
    for (uint32_t h = 0; h < mesh_.corner.size(); h += 3) {
      if (mesh_.alive(h)) triangles.push_back({mesh_.corner[h], mesh_.corner[h + 1], mesh_.corner[h + 2]});
    }
    for (int round = 0; round < rounds; ++round) {
      before = mesh_.points;
      std::fill(sum.begin(), sum.end(), dvec3(0));
      std::fill(weight.begin(), weight.end(), 0.0);
      for (uint32_t t = 0; 3 * t < mesh_.corner.size(); ++t) {
        if (!mesh_.alive(3 * t)) continue;
        const uint32_t* v = &mesh_.corner[3 * t];
        const dvec3 centre = (mesh_.points[v[0]] + mesh_.points[v[1]] + mesh_.points[v[2]]) / 3.0;
        const double detail = (detail_[v[0]] + detail_[v[1]] + detail_[v[2]]) / 3;
        const double w = glm::length(mesh_.face_area(t)) / (detail * detail);
        for (int k = 0; k < 3; ++k) {
          sum[v[k]] += w * centre;
          weight[v[k]] += w;
        }
      }
      for (size_t v = 0; v < mesh_.points.size(); ++v) {
        if (mesh_.outgoing[v] == no_index || !(weight[v] > 0)) continue;
        const dvec3 n = normals[v] = body_.gradient(mesh_.points[v]);
        dvec3 move = sum[v] / weight[v] - mesh_.points[v];
        move -= dot(move, n) / std::max(dot(n, n), 1e-12) * n;
        mesh_.points[v] = body_.project(mesh_.points[v] + 0.6 * move, 1);
      }
      keep_upright(before, mesh_.points, normals, triangles);
    }
    for (size_t v = 0; v < mesh_.points.size(); ++v) {
      if (mesh_.outgoing[v] != no_index) detail_[v] = body_.detail(mesh_.points[v]);
    }
  }

  // Splits the longest or collapses the shortest edges until the count is met.
  void reach(uint32_t count) {
    using Entry = std::pair<double, uint32_t>;
    if (mesh_.live_vertices < count) {
      std::priority_queue<Entry> longest;
      const auto offer = [&](uint32_t h) { longest.push({relative(h), std::min(h, mesh_.twin[h])}); };
      for (uint32_t h = 0; h < mesh_.corner.size(); ++h) {
        if (mesh_.alive(h) && h < mesh_.twin[h]) offer(h);
      }
      while (mesh_.live_vertices < count) {
        const auto [size, h] = longest.top();
        longest.pop();
        if (h > mesh_.twin[h] || std::abs(relative(h) - size) > 1e-12) continue;
        split(h);
        uint32_t e = mesh_.outgoing.back();
        do {
          offer(e);
          e = mesh_.rotate(e);
        } while (e != mesh_.outgoing.back());
      }
      return;
    }
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> shortest;
    int stalled = 0;
    while (mesh_.live_vertices > count) {
      const uint32_t before = mesh_.live_vertices;
      for (uint32_t h = 0; h < mesh_.corner.size(); ++h) {
        if (mesh_.alive(h) && h < mesh_.twin[h]) shortest.push({relative(h), h});
      }
      while (mesh_.live_vertices > count && !shortest.empty()) {
        const auto [size, h] = shortest.top();
        shortest.pop();
        if (!mesh_.alive(h) || std::abs(relative(h) - size) > 1e-12) continue;
        const uint32_t b = mesh_.to(h);
        if (!collapse(h)) continue;
        uint32_t e = mesh_.outgoing[b];
        do {
          const uint32_t least = std::min(e, mesh_.twin[e]);
          shortest.push({relative(least), least});
          e = mesh_.rotate(e);
        } while (e != mesh_.outgoing[b]);
      }
      if (mesh_.live_vertices == before && ++stalled > 3) {
        throw std::runtime_error("remesh: cannot go down to " + std::to_string(count) +
                                 " vertices without changing the topology; raise the count");
      }
      if (mesh_.live_vertices > count) {
        flip_for_angles();
        relax_tangentially(1);
      }
    }
  }

  const ImplicitBody& body_;
  EditMesh mesh_;
  std::vector<double> detail_;
  double edge_ = 1;
  uint32_t largest_ = 0;
};

// Number of connected pieces over edges.
uint32_t count_pieces(const TriangleMesh& mesh) {
  std::vector<uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles) {
    parent[root(t[0])] = root(t[1]);
    parent[root(t[1])] = root(t[2]);
  }
  uint32_t pieces = 0;
  for (uint32_t v = 0; v < parent.size(); ++v) pieces += root(v) == v;
  return pieces;
}

uint64_t spread_bits(uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x1F00000000FFFFull;
  x = (x | x << 16) & 0x1F0000FF0000FFull;
  x = (x | x << 8) & 0x100F00F00F00F00Full;
  x = (x | x << 4) & 0x10C30C30C30C30C3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

}  // namespace

TriangleMesh remesh(const ImplicitBody& body, const TriangleMesh& start, uint32_t count) {
  return Remesher(body, start).run(count);
}

void keep_upright(const std::vector<dvec3>& before, std::vector<dvec3>& after, const std::vector<dvec3>& normals,
                  const std::vector<Triangle>& triangles) {
  // cosine between the face and the mean normal of its corners
  const auto agreement = [&](const std::vector<dvec3>& points, const Triangle& t) {
    const dvec3 face = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    const dvec3 mean = normals[t[0]] + normals[t[1]] + normals[t[2]];
    const double scale = glm::length(face) * glm::length(mean);
    return scale > 0 ? dot(face, mean) / scale : 0.0;
  };
  bool changed = true;
  for (int round = 0; round < 8 && changed; ++round) {
    changed = false;
    for (const Triangle& t : triangles) {
      const double now = agreement(after, t);
      if (now > 0.3 || now >= agreement(before, t)) continue;
      for (uint32_t v : t) {
        changed = changed || after[v] != before[v];
        after[v] = before[v];
      }
    }
  }
}

void relax(const ImplicitBody& body, TriangleMesh& mesh, int rounds, double step, int newton_steps) {
  std::vector<dvec3> sum(mesh.points.size()), normals(mesh.points.size(), dvec3(0)), before;
  std::vector<double> weight(mesh.points.size());
  for (int round = 0; round < rounds; ++round) {
    before = mesh.points;
    std::fill(sum.begin(), sum.end(), dvec3(0));
    std::fill(weight.begin(), weight.end(), 0.0);
    for (const Triangle& t : mesh.triangles) {
      const dvec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      // the root of the area keeps the grading of the base mesh
      const double w = std::sqrt(glm::length(cross(b - a, c - a)));
      const dvec3 centre = w / 3 * (a + b + c);
      for (uint32_t v : t) {
        sum[v] += centre;
        weight[v] += w;
      }
    }
    for (size_t v = 0; v < mesh.points.size(); ++v) {
      if (!(weight[v] > 0)) continue;
      const dvec3 n = normals[v] = body.gradient(mesh.points[v]);
      dvec3 move = sum[v] / weight[v] - mesh.points[v];
      move -= dot(move, n) / std::max(dot(n, n), 1e-12) * n;
      mesh.points[v] = body.project(mesh.points[v] + step * move, newton_steps);
    }
    keep_upright(before, mesh.points, normals, mesh.triangles);
  }
}

TriangleMesh subdivide(const TriangleMesh& mesh, std::vector<std::array<uint32_t, 2>>& parents) {
  TriangleMesh fine;
  fine.points = mesh.points;
  fine.triangles.reserve(4 * mesh.triangles.size());
  parents.clear();
  std::unordered_map<uint64_t, uint32_t> middle;
  middle.reserve(3 * mesh.points.size());
  const auto half = [&](uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [entry, fresh] = middle.emplace(uint64_t(a) << 32 | b, static_cast<uint32_t>(fine.points.size()));
    if (fresh) {
      fine.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
      parents.push_back({a, b});
    }
    return entry->second;
  };
  for (const Triangle& t : mesh.triangles) {
    const uint32_t ab = half(t[0], t[1]), bc = half(t[1], t[2]), ca = half(t[2], t[0]);
    fine.triangles.push_back({t[0], ab, ca});
    fine.triangles.push_back({ab, t[1], bc});
    fine.triangles.push_back({ca, bc, t[2]});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

MeshPlan plan_mesh(uint32_t count) {
  if (count < 500 || count > 2000000) throw std::runtime_error("the vertex count must lie in 500..2000000");
  // a refinement step turns V vertices into 4 V - 6
  MeshPlan plan{count, 0};
  while (plan.base > 24000) {
    plan.base = (plan.base + 6 + 2) / 4;
    ++plan.levels;
  }
  return plan;
}

TriangleMesh base_mesh(const ImplicitBody& body, uint32_t base_count) {
  // fine enough for the thinnest parts, at least as many vertices as asked for
  const double diagonal = glm::length(body.upper - body.lower);
  // a surface a fifth of a cell outside catches tips thinner than the grid; from there Newton steps find the body,
  // while from inside a blunt end would stay blunt
  const double spacing = diagonal / 230;
  TriangleMesh start = polygonise(body, spacing, 0.2 * spacing);
  for (dvec3& p : start.points) p = body.project(p, 3);
  if (count_pieces(start) != 1) throw std::runtime_error("the body has several pieces; let its blobs touch");
  const TriangleMesh mesh = remesh(body, start, base_count);
  const size_t edges = mesh.triangles.size() * 3 / 2;
  if (mesh.points.size() + mesh.triangles.size() != edges + 2) {
    throw std::runtime_error("the body has a handle; keep its limbs apart");
  }
  return mesh;
}

TriangleMesh refine(const ImplicitBody& body, const TriangleMesh& mesh, std::vector<std::array<uint32_t, 2>>& parents) {
  TriangleMesh fine = subdivide(mesh, parents);
  const std::vector<dvec3> before = fine.points;
  for (size_t v = mesh.points.size(); v < fine.points.size(); ++v) fine.points[v] = body.project(fine.points[v], 2);
  std::vector<dvec3> normals;
  for (const dvec3& p : fine.points) normals.push_back(body.gradient(p));
  keep_upright(before, fine.points, normals, fine.triangles);
  relax(body, fine, 2, 0.5, 1);
  return fine;
}

std::vector<uint32_t> spatial_order(const std::vector<dvec3>& points) {
  dvec3 low(1e300), high(-1e300);
  for (const dvec3& p : points) {
    low = min(low, p);
    high = max(high, p);
  }
  const double scale = 2097151.0 / std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-300});
  std::vector<std::pair<uint64_t, uint32_t>> key(points.size());
  for (uint32_t v = 0; v < points.size(); ++v) {
    const dvec3 q = scale * (points[v] - low);
    key[v] = {spread_bits(uint64_t(q.x)) | spread_bits(uint64_t(q.y)) << 1 | spread_bits(uint64_t(q.z)) << 2, v};
  }
  std::sort(key.begin(), key.end());
  std::vector<uint32_t> order(points.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = key[i].second;
  return order;
}

TriangleMesh reorder(const TriangleMesh& mesh, const std::vector<uint32_t>& order,
                     std::vector<uint32_t>& triangle_order) {
  TriangleMesh result;
  std::vector<uint32_t> name(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) {
    name[order[i]] = i;
    result.points.push_back(mesh.points[order[i]]);
  }
  std::vector<Triangle> renamed(mesh.triangles.size());
  for (size_t t = 0; t < renamed.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) renamed[t][k] = name[mesh.triangles[t][k]];
    std::rotate(renamed[t].begin(), std::min_element(renamed[t].begin(), renamed[t].end()), renamed[t].end());
  }
  triangle_order.resize(renamed.size());
  std::iota(triangle_order.begin(), triangle_order.end(), 0u);
  std::sort(triangle_order.begin(), triangle_order.end(),
            [&](uint32_t a, uint32_t b) { return renamed[a] != renamed[b] ? renamed[a] < renamed[b] : a < b; });
  for (uint32_t t : triangle_order) result.triangles.push_back(renamed[t]);
  return result;
}

}  // namespace samples
