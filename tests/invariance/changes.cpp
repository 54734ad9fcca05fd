// The changes that must change nothing: one function each, and one line of the list at the end.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "body.h"

namespace invariance {
namespace {

// ---- vertices in no triangle ----

Copy with_isolated(const Body& body, const std::vector<Vec>& places) {
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  for (const Vec& p : places) {
    copy.points.push_back(p);
    copy.origin.push_back(none);
  }
  copy.added_isolated = static_cast<std::uint32_t>(places.size());
  return copy;
}

std::uint32_t outermost(const Body& body, int axis, double sign) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 1; v < body.vertex_count(); ++v) {
    if (sign * body.points[v][axis] > sign * body.points[best][axis]) best = v;
  }
  return best;
}

// As far as the reports of such files have it: a thousand boxes.
Copy far_vertex(const Body& body) { return with_isolated(body, {body.high + 1000 * body.diagonal * Vec{1, 1, -1}}); }

// Before the nose: nearer to it than any vertex is, and one at the very place of a vertex.
Copy near_vertices(const Body& body) {
  const Vec nose = body.points[outermost(body, 2, 1)];
  return with_isolated(body,
                       {nose + 0.002 * body.diagonal * Vec{0.1, 0.2, 1}, nose + 0.03 * body.diagonal * Vec{1, 1, 1}});
}

Copy foot_vertex(const Body& body) {
  return with_isolated(body, {body.points[outermost(body, 1, -1)] - 0.3 * body.diagonal * Vec{0, 1, 0}});
}

// A scan has them by the hundred, in and about the body.
Copy many_vertices(const Body& body) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.2, 1.2);
  std::vector<Vec> places(200);
  for (Vec& p : places) {
    for (int k = 0; k < 3; ++k) p[k] = body.low[k] + place(random) * (body.high[k] - body.low[k]);
  }
  return with_isolated(body, places);
}

// ---- faces ----

// Every fortieth face once more, with its corners turned.
Copy doubled_faces(const Body& body) {
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  for (std::uint32_t t = 0; t < body.triangles.size(); t += 40) {
    const auto& corners = body.triangles[t];
    copy.triangles.push_back({corners[1], corners[2], corners[0]});
    copy.origin_face.push_back(t);
    ++copy.added_faces;
    ++copy.doubled_faces;
  }
  return copy;
}

// Every fortieth face once more, seen from the other side.
Copy backed_faces(const Body& body) {
  Copy copy = doubled_faces(body);
  for (std::size_t t = body.triangles.size(); t < copy.triangles.size(); ++t)
    std::swap(copy.triangles[t][1], copy.triangles[t][2]);
  return copy;
}

Copy face_order(const Body& body) {
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  std::mt19937 random(11);
  std::shuffle(copy.origin_face.begin(), copy.origin_face.end(), random);
  for (std::size_t t = 0; t < copy.triangles.size(); ++t) {
    copy.triangles[t] = body.triangles[copy.origin_face[t]];
    std::rotate(copy.triangles[t].begin(), copy.triangles[t].begin() + random() % 3, copy.triangles[t].end());
  }
  return copy;
}

// ---- a button: a small closed piece beside the body ----

constexpr double button_size = 0.005;  // of the box; its corners are 1.9 times as far from its middle

// A place inside the box, at its sides and not near the ground, that is farthest from the body.
Vec free_place(const Body& body, double& distance) {
  Vec best{};
  distance = 0;
  const auto inside = [&](double share, int k) {
    const double margin = std::min(2 * button_size * body.diagonal, 0.5 * (body.high[k] - body.low[k]));
    return std::clamp(body.low[k] + share * (body.high[k] - body.low[k]), body.low[k] + margin, body.high[k] - margin);
  };
  for (const double y : {0.5, 0.7, 0.9}) {
    for (const double x : {0.03, 0.25, 0.5, 0.75, 0.97}) {
      for (const double z : {0.03, 0.25, 0.5, 0.75, 0.97}) {
        if (std::abs(x - 0.5) < 0.4 && std::abs(z - 0.5) < 0.4) continue;
        const Vec place{inside(x, 0), inside(y, 1), inside(z, 2)};
        double nearest = body.diagonal;
        for (const Vec& p : body.points) nearest = std::min(nearest, length(p - place));
        if (nearest <= distance) continue;
        distance = nearest;
        best = place;
      }
    }
  }
  return best;
}

Copy button(const Body& body) {
  // links reach 0.05 of the box; a body that fills its box has no such place beside it
  double distance = 0;
  const Vec centre = free_place(body, distance);
  if (distance < 0.07 * body.diagonal) return {};
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  // an icosahedron: no angle of it is smaller than those of a body
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Vec corners[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const std::uint32_t faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  const std::uint32_t base = body.vertex_count();
  for (const Vec& c : corners) {
    copy.points.push_back(centre + button_size * body.diagonal * c);
    copy.origin.push_back(none);
  }
  for (const auto& f : faces) {
    copy.triangles.push_back({base + f[0], base + f[1], base + f[2]});
    copy.origin_face.push_back(none);
    ++copy.added_faces;
  }
  copy.added_pieces = 1;
  return copy;
}

// ---- vertices ----

Copy vertex_order(const Body& body) {
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  std::mt19937 random(13);
  std::shuffle(copy.origin.begin(), copy.origin.end(), random);
  index_copy(body, copy);
  for (std::size_t v = 0; v < copy.points.size(); ++v) copy.points[v] = body.points[copy.origin[v]];
  for (auto& t : copy.triangles) {
    for (std::uint32_t& v : t) v = copy.first[v];
  }
  return copy;
}

// The body falls apart into charts as those of a texture: triangles of one direction have vertices of their own.
Copy seams(const Body& body) {
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  std::vector<std::array<std::uint32_t, 8>> copies(body.points.size());
  for (auto& c : copies) c.fill(none);
  std::vector<char> used(body.points.size(), 0);
  for (auto& t : copy.triangles) {
    const Vec n = cross(body.points[t[1]] - body.points[t[0]], body.points[t[2]] - body.points[t[0]]);
    const int chart = (n[0] > 0) + 2 * (n[1] > 0) + 4 * (n[2] > 0);
    for (std::uint32_t& v : t) {
      if (copies[v][chart] == none && !used[v]) {
        used[v] = 1;
        copies[v][chart] = v;
      } else if (copies[v][chart] == none) {
        copies[v][chart] = static_cast<std::uint32_t>(copy.points.size());
        copy.points.push_back(body.points[v]);
        copy.origin.push_back(v);
      }
      v = copies[v][chart];
    }
  }
  return copy;
}

// ---- frames and units ----

// linear: rows, a rotation or reflection times the scale.
Copy placed(const Body& body, const std::array<Vec, 3>& linear, double scale, const Vec& shift) {
  Copy copy = plain_copy(body);
  copy.form = Form::doubles;
  copy.linear = linear;
  copy.shift = shift;
  copy.scale = scale;
  copy.mirrored = dot(linear[0], cross(linear[1], linear[2])) < 0;
  for (Vec& p : copy.points) p = Vec{dot(linear[0], p), dot(linear[1], p), dot(linear[2], p)} + shift;
  if (copy.mirrored) {
    for (auto& t : copy.triangles) std::swap(t[1], t[2]);
  }
  return copy;
}

std::array<Vec, 3> diagonal_matrix(double x, double y, double z) { return {Vec{x, 0, 0}, Vec{0, y, 0}, Vec{0, 0, z}}; }

Copy moved(const Body& body) { return placed(body, diagonal_matrix(1, 1, 1), 1, body.diagonal * Vec{3.1, -2.3, 5.7}); }

// x to y to z: the box turns with the body, and no number is rounded.
Copy turned(const Body& body) { return placed(body, {Vec{0, 0, 1}, Vec{1, 0, 0}, Vec{0, 1, 0}}, 1, {}); }

Copy turned_askew(const Body& body) {
  const double x = 0.36, y = 0.48, z = 0.8, c = 0.6, s = 0.8, k = 1 - c;  // by 53 degrees about a skew axis
  return placed(body,
                {Vec{c + x * x * k, x * y * k - z * s, x * z * k + y * s},
                 Vec{y * x * k + z * s, c + y * y * k, y * z * k - x * s},
                 Vec{z * x * k - y * s, z * y * k + x * s, c + z * z * k}},
                1, {});
}

Copy scaled(const Body& body, double s) { return placed(body, diagonal_matrix(s, s, s), s, {}); }
Copy scaled_odd(const Body& body) { return scaled(body, 3.7); }
Copy centimetres(const Body& body) { return scaled(body, 0.01); }
Copy hundreds(const Body& body) { return scaled(body, 100); }

// ---- forms of the arrays ----

Copy formed(const Body& body, Form form) {
  Copy copy = plain_copy(body);
  copy.form = form;
  return copy;
}
Copy doubles(const Body& body) { return formed(body, Form::doubles); }
Copy short_indices(const Body& body) { return formed(body, Form::u16); }
Copy strided(const Body& body) { return formed(body, Form::strided); }
Copy faces(const Body& body) { return formed(body, Form::faces); }

}  // namespace

Copy mirrored(const Body& body) { return placed(body, diagonal_matrix(-1, 1, 1), 1, {}); }

const std::vector<Change>& changes() {
  static const std::vector<Change> list = {
      {"far vertex", "a vertex in no triangle, a thousand boxes away", far_vertex},
      {"near vertices", "two vertices in no triangle, before the nose", near_vertices},
      {"foot vertex", "a vertex in no triangle, 0.3 boxes under a foot", foot_vertex},
      {"many vertices", "200 vertices in no triangle, in and about the body", many_vertices},
      {"doubled faces", "every fortieth face once more, its corners turned", doubled_faces},
      {"backed faces", "every fortieth face once more, seen from the other side", backed_faces},
      {"button", "a closed piece of 12 vertices beside the body, inside its box", button},
      {"vertex order", "vertices in random order", vertex_order},
      {"face order", "faces in random order, their corners turned", face_order},
      {"seams", "every vertex once for each of eight directions of its faces", seams},
      {"moved", "by seven boxes", moved},
      {"turned", "x to y to z; up and axes too", turned},
      {"turned askew", "by 53 degrees about a skew axis, so the box is another one", turned_askew},
      {"scaled", "3.7 times as large", scaled_odd},
      {"unit 0.01", "0.01 times as large", centimetres},
      {"unit 100", "100 times as large", hundreds},
      {"mirrored", "x to -x, triangles turned", mirrored},
      {"doubles", "the same positions as doubles", doubles},
      {"16-bit indices", "triangles, HF_TYPE_UINT16", short_indices},
      {"strides", "positions and triangles with gaps between rows", strided},
      {"faces", "triangles as faces of three corners", faces},
  };
  return list;
}

}  // namespace invariance
