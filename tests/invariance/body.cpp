#include "body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "gltf/flat_mesh.h"

namespace invariance {

double length(const Vec& a) { return std::sqrt(dot(a, a)); }

namespace {

constexpr std::size_t pick_count = 10;

// Numbers the pieces, which are joined by edges; returns how many vertices each has.
std::vector<std::uint32_t> number_pieces(Body& body) {
  std::vector<std::uint32_t> root(body.points.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) {
      root[v] = root[root[v]];
      v = root[v];
    }
    return v;
  };
  for (const auto& t : body.triangles) {
    root[find(t[1])] = find(t[0]);
    root[find(t[2])] = find(t[0]);
  }
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<std::uint32_t> sizes;
  body.piece.resize(body.points.size());
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
    const auto [at, fresh] = number.try_emplace(find(v), static_cast<std::uint32_t>(sizes.size()));
    if (fresh) sizes.push_back(0);
    body.piece[v] = at->second;
    ++sizes[at->second];
  }
  body.piece_count = static_cast<std::uint32_t>(sizes.size());
  return sizes;
}

// Picks vertices of one piece, each the farthest from those before.
void pick_far_vertices(Body& body, std::uint32_t piece) {
  std::vector<double> nearest(body.points.size(), std::numeric_limits<double>::max());
  std::uint32_t next = 0;
  while (body.piece[next] != piece) ++next;
  body.spacing = body.diagonal;
  while (body.picks.size() < pick_count) {
    body.picks.push_back(next);
    nearest[next] = 0;
    std::uint32_t far = next;
    for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
      nearest[v] = std::min(nearest[v], length(body.points[v] - body.points[next]));
      if (body.piece[v] == piece && nearest[v] > nearest[far]) far = v;
    }
    if (nearest[far] == 0) throw std::runtime_error(body.name + " has too few vertices for its picks");
    if (body.picks.size() < pick_count) body.spacing = nearest[far];
    next = far;
  }
}

void prepare(Body& body) {
  body.low = body.points.front();
  body.high = body.points.front();
  for (const Vec& p : body.points) {
    for (int k = 0; k < 3; ++k) {
      body.low[k] = std::min(body.low[k], p[k]);
      body.high[k] = std::max(body.high[k], p[k]);
    }
  }
  body.diagonal = length(body.high - body.low);
  const std::vector<std::uint32_t> sizes = number_pieces(body);
  pick_far_vertices(body, static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin()));
}

}  // namespace

Body make_body(const std::string& name, const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles) {
  Body body;
  body.name = name;
  std::map<Vec, std::uint32_t> places;
  std::vector<std::uint32_t> welded(xyz.size() / 3, none);
  std::map<std::array<std::uint32_t, 3>, char> seen;
  const auto vertex = [&](std::uint32_t v) {
    if (welded[v] != none) return welded[v];
    const auto part = [&](std::size_t k) { return hf_gltf::float_rounded(xyz[3 * v + k]); };
    const Vec p{part(0), part(1), part(2)};
    const auto [at, fresh] = places.try_emplace(p, body.vertex_count());
    if (fresh) body.points.push_back(p);
    return welded[v] = at->second;
  };
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const std::array<std::uint32_t, 3> corners{vertex(triangles[t]), vertex(triangles[t + 1]),
                                               vertex(triangles[t + 2])};
    std::array<std::uint32_t, 3> key = corners;
    std::sort(key.begin(), key.end());
    const Vec normal =
        cross(body.points[corners[1]] - body.points[corners[0]], body.points[corners[2]] - body.points[corners[0]]);
    if (key[0] == key[1] || key[1] == key[2] || length(normal) == 0 || !seen.try_emplace(key, 1).second) continue;
    body.triangles.push_back(corners);
  }
  // a triangle that was left out may leave a vertex behind
  std::vector<std::uint32_t> kept(body.points.size(), none);
  std::vector<Vec> points;
  for (auto& t : body.triangles) {
    for (std::uint32_t& v : t) {
      if (kept[v] == none) {
        kept[v] = static_cast<std::uint32_t>(points.size());
        points.push_back(body.points[v]);
      }
      v = kept[v];
    }
  }
  body.points = std::move(points);
  prepare(body);
  return body;
}

std::vector<std::uint32_t> ball(const Body& body, std::uint32_t centre, double radius) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
    if (body.piece[v] == body.piece[centre] && length(body.points[v] - body.points[centre]) <= radius) out.push_back(v);
  }
  return out;
}

Copy plain_copy(const Body& body) {
  Copy copy;
  copy.points = body.points;
  copy.triangles = body.triangles;
  copy.origin.resize(body.points.size());
  std::iota(copy.origin.begin(), copy.origin.end(), 0u);
  copy.origin_face.resize(body.triangles.size());
  std::iota(copy.origin_face.begin(), copy.origin_face.end(), 0u);
  copy.form = Form::floats;
  index_copy(body, copy);
  return copy;
}

void index_copy(const Body& body, Copy& copy) {
  copy.first.assign(body.points.size(), none);
  for (std::size_t v = copy.origin.size(); v-- > 0;) {
    if (copy.origin[v] != none) copy.first[copy.origin[v]] = static_cast<std::uint32_t>(v);
  }
  copy.face.assign(body.triangles.size(), none);
  for (std::size_t t = copy.origin_face.size(); t-- > 0;) {
    if (copy.origin_face[t] != none) copy.face[copy.origin_face[t]] = static_cast<std::uint32_t>(t);
  }
}

}  // namespace invariance
