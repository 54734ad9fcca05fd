// Local operations on a closed half-edge mesh; see edit_mesh.h.
#include "edit_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace samples {

EditMesh::EditMesh(const TriangleMesh& mesh) : points(mesh.points) {
  corner.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) corner.insert(corner.end(), t.begin(), t.end());
  twin.assign(corner.size(), no_index);
  outgoing.assign(points.size(), no_index);
  std::vector<uint32_t> next(corner.size());  // of those that leave the same vertex
  const auto half_edge = [&](uint32_t a, uint32_t b) {
    uint32_t h = outgoing[a];
    while (h != no_index && to(h) != b) h = next[h];
    return h;
  };
  const auto fail = [](uint32_t a, uint32_t b) {
    throw std::runtime_error("the mesh is not a closed manifold at the edge between vertices " + std::to_string(a) +
                             " and " + std::to_string(b));
  };
  for (uint32_t h = 0; h < corner.size(); ++h) {
    if (half_edge(from(h), to(h)) != no_index) fail(from(h), to(h));
    next[h] = outgoing[from(h)];
    outgoing[from(h)] = h;
  }
  for (uint32_t h = 0; h < corner.size(); ++h) {
    twin[h] = half_edge(to(h), from(h));
    if (twin[h] == no_index) fail(from(h), to(h));
  }
  // one fan of triangles per vertex
  std::vector<uint32_t> uses(points.size(), 0);
  for (uint32_t v : corner) ++uses[v];
  for (uint32_t v = 0; v < points.size(); ++v) {
    if (outgoing[v] == no_index) continue;
    ++live_vertices;
    if (valence(v) != uses[v]) fail(v, v);
  }
}

uint32_t EditMesh::valence(uint32_t v) const {
  uint32_t count = 0, h = outgoing[v];
  do {
    ++count;
    h = rotate(h);
  } while (h != outgoing[v]);
  return count;
}

bool EditMesh::connected(uint32_t a, uint32_t b) const {
  uint32_t h = outgoing[a];
  do {
    if (to(h) == b) return true;
    h = rotate(h);
  } while (h != outgoing[a]);
  return false;
}

uint32_t EditMesh::split(uint32_t h, const dvec3& p) {
  // faces (a b c) and (b a d) become (a m c) (m b c) and (b m d) (m a d)
  const uint32_t g = twin[h], hn = next(h), gn = next(g), hp = previous(h), gp = previous(g);
  const uint32_t a = from(h), b = from(g), c = from(hp), d = from(gp);
  const uint32_t m = static_cast<uint32_t>(points.size());
  points.push_back(p);
  const uint32_t t = static_cast<uint32_t>(corner.size()), u = t + 3;
  corner.insert(corner.end(), {m, b, c, m, a, d});
  twin.resize(corner.size(), no_index);
  const uint32_t outer_bc = twin[hn], outer_ad = twin[gn];
  corner[hn] = m;  // (a m c): h = a-m, hn = m-c, hp = c-a
  corner[gn] = m;  // (b m d): g = b-m, gn = m-d, gp = d-b
  pair(t + 1, outer_bc);
  pair(u + 1, outer_ad);
  pair(h, u);
  pair(g, t);
  pair(hn, t + 2);
  pair(gn, u + 2);
  outgoing.push_back(t);
  outgoing[a] = h;
  outgoing[b] = g;
  outgoing[c] = hp;
  outgoing[d] = gp;
  ++live_vertices;
  return m;
}

bool EditMesh::stays_upright(uint32_t moved, const dvec3& p, uint32_t skip) const {
  uint32_t h = outgoing[moved];
  do {
    const uint32_t b = to(h), c = from(previous(h));
    if (b != skip && c != skip) {
      const dvec3 before = cross(points[b] - points[moved], points[c] - points[moved]);
      const dvec3 after = cross(points[b] - p, points[c] - p);
      if (!(dot(before, after) > 0.3 * length(before) * length(after))) return false;
      // no needles: area against the longest edge
      const double longest = std::max({length(points[b] - p), length(points[c] - p), length(points[b] - points[c])});
      if (length(after) < 0.05 * longest * longest) return false;
    }
    h = rotate(h);
  } while (h != outgoing[moved]);
  return true;
}

bool EditMesh::collapse(uint32_t h, const dvec3& p) {
  const uint32_t g = twin[h], a = from(h), b = to(h), c = from(previous(h)), d = from(previous(g));
  if (c == d || valence(c) <= 3 || valence(d) <= 3) return false;
  // link condition: the ends share exactly the two opposite corners
  uint32_t shared = 0, e = outgoing[a];
  do {
    const uint32_t v = to(e);
    if (v != b && connected(v, b)) ++shared;
    e = rotate(e);
  } while (e != outgoing[a]);
  if (shared != 2) return false;
  if (!stays_upright(a, p, b) || !stays_upright(b, p, a)) return false;
  // a's other triangles now start at b
  e = outgoing[a];
  do {
    const uint32_t following = rotate(e);
    corner[e] = b;
    e = following;
  } while (e != outgoing[a]);
  const uint32_t hn = next(h), hp = previous(h), gn = next(g), gp = previous(g);
  const uint32_t outer_bc = twin[hn], outer_ca = twin[hp], outer_ad = twin[gn], outer_db = twin[gp];
  pair(outer_bc, outer_ca);
  pair(outer_ad, outer_db);
  for (uint32_t dead : {h, hn, hp, g, gn, gp}) {
    corner[dead] = no_index;
    twin[dead] = no_index;
  }
  outgoing[a] = no_index;
  // outer_ca runs a(now b)-c ... : pick half-edges by their start
  for (uint32_t live : {outer_bc, outer_ca, outer_ad, outer_db}) outgoing[from(live)] = live;
  points[b] = p;
  --live_vertices;
  return true;
}

bool EditMesh::flip(uint32_t h) {
  const uint32_t g = twin[h], hn = next(h), hp = previous(h), gn = next(g), gp = previous(g);
  const uint32_t a = from(h), b = from(g), c = from(hp), d = from(gp);
  if (c == d || connected(c, d) || valence(a) <= 3 || valence(b) <= 3) return false;
  const dvec3 before =
      cross(points[b] - points[a], points[c] - points[a]) + cross(points[a] - points[b], points[d] - points[b]);
  const dvec3 one = cross(points[d] - points[c], points[b] - points[c]);
  const dvec3 two = cross(points[c] - points[d], points[a] - points[d]);
  const double least = 0.5 * length(before);
  if (!(dot(before, one) > least * length(one)) || !(dot(before, two) > least * length(two))) return false;
  // (a b c) becomes (c d b), (b a d) becomes (d c a); half-edges keep their triangle
  const uint32_t outer_bc = twin[hn], outer_ca = twin[hp], outer_ad = twin[gn], outer_db = twin[gp];
  corner[h] = c;
  corner[hn] = d;
  corner[hp] = b;
  corner[g] = d;
  corner[gn] = c;
  corner[gp] = a;
  pair(h, g);
  pair(hn, outer_db);
  pair(hp, outer_bc);
  pair(gn, outer_ca);
  pair(gp, outer_ad);
  outgoing[a] = gp;
  outgoing[b] = hp;
  outgoing[c] = h;
  outgoing[d] = g;
  return true;
}

dvec3 EditMesh::face_area(uint32_t t) const {
  const dvec3 &a = points[corner[3 * t]], &b = points[corner[3 * t + 1]], &c = points[corner[3 * t + 2]];
  return 0.5 * cross(b - a, c - a);
}

TriangleMesh EditMesh::compact() const {
  TriangleMesh mesh;
  std::vector<uint32_t> name(points.size(), no_index);
  for (uint32_t v = 0; v < points.size(); ++v) {
    if (outgoing[v] == no_index) continue;
    name[v] = static_cast<uint32_t>(mesh.points.size());
    mesh.points.push_back(points[v]);
  }
  for (uint32_t h = 0; h < corner.size(); h += 3) {
    if (alive(h)) mesh.triangles.push_back({name[corner[h]], name[corner[h + 1]], name[corner[h + 2]]});
  }
  return mesh;
}

}  // namespace samples
