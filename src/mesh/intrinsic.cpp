#include "mesh/intrinsic.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/hypotenuse.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/laplacian.h"
#include "mesh/mollify.h"

namespace hf_inner {
namespace {

// Number of triangles or edges that one thread's job takes. Half and twice the value take the same time within 10 %,
// the noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t cover_piece = 16384;
// flip_to_delaunay stops after this many edge flips per half-edge. So the loop ends even if rounding lets edges flip to
// and fro. It is a bound. Half and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr std::uint64_t flips_per_half = 32;
// A sum of cotangents that divides counts as at least this, so that a flat face does not divide by zero.
constexpr double least_sum = 1e-300;
// The queue of edges to flip is trimmed when it starts with more finished entries than this. It bounds memory; no
// result depends on it. Less copies the rest more often, more keeps memory. Half and double change no bit on eight
// shapes with needles, loose pieces and a long ribbon.
constexpr std::size_t least_trim = 65536;

// A triangle at an edge of the mesh, and the side with which it lies there.
struct Side {
  Index triangle, corner;  // from this corner to the next
  bool forward;            // runs from the edge's first vertex to its second
  double angle;            // about the edge, for edges of three and more
};

Side side_of(const Mesh& mesh, Index triangle, Index first, Index second) noexcept {
  const Index* v = mesh.triangle(triangle);
  for (Index k = 0; k < 3; ++k) {
    const Index a = v[k], b = v[(k + 1) % 3];
    if (a == first && b == second) return {triangle, k, true, 0};
    if (a == second && b == first) return {triangle, k, false, 0};
  }
  return {triangle, 0, true, 0};
}

// Sorts the sides by their angle about the edge, counter-clockwise for a viewer at whom the edge points.
void sort_by_angle(const Mesh& mesh, Index first, Index second, Vector<Side>& sides) {
  const Vec3 origin = mesh.positions[at(first)];
  Vec3 axis = mesh.positions[at(second)] - origin;
  const double length = norm(axis);
  if (length > 0) axis = (1 / length) * axis;
  Vec3 x, y;
  for (Side& side : sides) {
    const Vec3 p = mesh.positions[at(mesh.triangle(side.triangle)[(side.corner + 2) % 3])] - origin;
    const Vec3 radius = p - dot(p, axis) * axis;
    if (!(norm(x) > 0)) x = radius, y = cross(axis, radius);
    side.angle = arc_tangent(dot(y, radius), dot(x, radius));
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.triangle < b.triangle;
  });
}

// Marks the components where every edge joins two triangles that run through it in opposite directions.
Vector<std::uint8_t> plain_components(const Mesh& mesh, const Topology& topology, const Vector<std::uint8_t>* held,
                                      Memory& memory, JobRunner* jobs) {
  const std::size_t edges = at(topology.edge_count()), pieces = (edges + cover_piece - 1) / cover_piece;
  Vector<Vector<Index>> broken(pieces, &memory);  // components of the edges that are not so
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    for (std::size_t e = p * cover_piece; e < std::min(edges, (p + std::size_t{1}) * cover_piece); ++e) {
      const Index begin = topology.edge_triangle_start[e], end = topology.edge_triangle_start[e + 1];
      if (held && (*held)[e]) continue;
      const Index i = topology.first(static_cast<Index>(e)), j = topology.second(static_cast<Index>(e));
      if (end - begin == 2 && side_of(mesh, topology.edge_triangle[at(begin)], i, j).forward !=
                                  side_of(mesh, topology.edge_triangle[at(begin) + 1], i, j).forward)
        continue;
      const Index component = mesh.component[at(i)];
      if (broken[p].empty() || broken[p].back() != component) broken[p].push_back(component);
    }
  });
  Vector<std::uint8_t> plain(at(mesh.component_count()), 1, &memory);
  for (const auto& list : broken) {
    for (const Index component : list) plain[at(component)] = 0;
  }
  return plain;
}

}  // namespace

IntrinsicTriangulation IntrinsicTriangulation::make(const Mesh& mesh, const Topology& topology, Memory& memory,
                                                    JobRunner* jobs, const Vector<std::uint8_t>* held) {
  IntrinsicTriangulation cover(memory);
  const std::size_t triangles = at(mesh.triangle_count());
  const Vector<std::uint8_t> plain = plain_components(mesh, topology, held, memory, jobs);
  Vector<Index> back(triangles, &memory);
  Index faces = mesh.triangle_count();
  for (std::size_t t = 0; t < triangles; ++t) {
    const bool own = plain[at(mesh.component[at(mesh.triangle(static_cast<Index>(t))[0])])] != 0;
    back[t] = own ? static_cast<Index>(t) : faces++;
  }
  if (at(faces) != triangles) {
    cover.doubled_.assign(at(faces), 1);
    for (std::size_t t = 0; t < triangles; ++t) cover.doubled_[t] = back[t] != static_cast<Index>(t);
  }
  cover.tail_.resize(3 * at(faces)), cover.twin_.resize(3 * at(faces));
  cover.length_.resize(3 * at(faces)), cover.cotangent_.resize(3 * at(faces));
  cover.glue(mesh, topology, back, held, jobs);
  cover.measure(mesh, topology, back, jobs);
  return cover;
}

// The back face of a triangle (v0 v1 v2) is the face (v0 v2 v1). The half-edge 2 - k of the back face lies on side k.
void IntrinsicTriangulation::glue(const Mesh& mesh, const Topology& topology, const Vector<Index>& back,
                                  const Vector<std::uint8_t>* held, JobRunner* jobs) {
  const auto pieces = [](std::size_t count) {
    return static_cast<std::uint32_t>((count + cover_piece - 1) / cover_piece);
  };
  const std::size_t triangles = back.size(), edges = at(topology.edge_count());
  for_each(jobs, pieces(triangles), [&](std::uint32_t p) {
    for (std::size_t t = p * cover_piece; t < std::min(triangles, (p + std::size_t{1}) * cover_piece); ++t) {
      const Index* v = mesh.triangle(static_cast<Index>(t));
      for (std::size_t k = 0; k < 3; ++k) {
        tail_[3 * t + k] = v[k];
        if (at(back[t]) != t) tail_[3 * at(back[t]) + k] = v[(3 - k) % 3];
      }
    }
  });
  for_each(jobs, pieces(edges), [&](std::uint32_t p) {
    Vector<Side> sides(memory_);
    for (std::size_t e = p * cover_piece; e < std::min(edges, (p + std::size_t{1}) * cover_piece); ++e) {
      const Index first = topology.first(static_cast<Index>(e)), second = topology.second(static_cast<Index>(e));
      sides.clear();
      for (Index i = topology.edge_triangle_start[e]; i < topology.edge_triangle_start[e + 1]; ++i)
        sides.push_back(side_of(mesh, topology.edge_triangle[at(i)], first, second));
      if (sides.size() > 2) sort_by_angle(mesh, first, second, sides);
      const auto front = [](const Side& s) { return 3 * s.triangle + s.corner; };
      const auto reverse = [&](const Side& s) { return 3 * back[at(s.triangle)] + 2 - s.corner; };
      if (held && (*held)[e]) {
        for (const Side& side : sides) {
          twin_[at(front(side))] = front(side);
          if (back[at(side.triangle)] != side.triangle) twin_[at(reverse(side))] = reverse(side);
        }
        continue;
      }
      if (back[at(sides[0].triangle)] == sides[0].triangle) {
        twin_[at(front(sides[0]))] = front(sides[1]), twin_[at(front(sides[1]))] = front(sides[0]);
        continue;
      }
      for (std::size_t s = 0; s < sides.size(); ++s) {
        // Triangles at an edge are sorted around it. If a triangle's side runs along the edge's direction, its normal
        // points towards the next triangle.
        const Side &here = sides[s], &there = sides[(s + 1) % sides.size()];
        const Index a = here.forward ? front(here) : reverse(here), b = there.forward ? reverse(there) : front(there);
        twin_[at(a)] = b, twin_[at(b)] = a;
      }
    }
  });
}

// Computes edge lengths, mollified where a triangle is degenerate, and the cotangents of the original triangles.
void IntrinsicTriangulation::measure(const Mesh& mesh, const Topology& topology, const Vector<Index>& back,
                                     JobRunner* jobs) {
  const MollifiedLengths lengths = MollifiedLengths::make(mesh, topology, *memory_, jobs);
  mollified_ = lengths.thin_count;
  if (!lengths.changed.empty()) changed_.assign(mesh.positions.size(), 0);
  for (Index e = 0; e < static_cast<Index>(lengths.changed.size()); ++e) {
    if (lengths.changed[at(e)]) changed_[at(topology.first(e))] = changed_[at(topology.second(e))] = 1;
  }
  const std::size_t triangles = back.size();
  for_each(jobs, static_cast<std::uint32_t>((triangles + cover_piece - 1) / cover_piece), [&](std::uint32_t p) {
    for (std::size_t t = p * cover_piece; t < std::min(triangles, (p + std::size_t{1}) * cover_piece); ++t) {
      double cotangent[3], length[3];
      bool changed = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t e = at(lengths.edge_of_side[3 * t + k]);
        length[k] = lengths.length[e];
        changed = changed || (!lengths.changed.empty() && lengths.changed[e]);
      }
      if (changed) {
        cotangents_of_lengths(length, cotangent);
      } else {
        double corner[3];
        corner_cotangents(mesh, static_cast<Index>(t), corner);
        for (std::size_t k = 0; k < 3; ++k) cotangent[k] = corner[(k + 2) % 3];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        length_[3 * t + k] = length[k], cotangent_[3 * t + k] = cotangent[k];
        if (at(back[t]) == t) continue;
        length_[3 * at(back[t]) + 2 - k] = length[k], cotangent_[3 * at(back[t]) + 2 - k] = cotangent[k];
      }
    }
  });
}

void IntrinsicTriangulation::measure_face(Index face) noexcept {
  cotangents_of_lengths(length_.data() + 3 * at(face), cotangent_.data() + 3 * at(face));
}

// Allows for rounding. The two diagonals of a co-circular pair both have weight zero; without this margin rounding
// could flip them for ever.
bool IntrinsicTriangulation::is_delaunay(Index half) const noexcept {
  const double a = cotangent_[at(half)], b = cotangent_[at(twin_[at(half)])];
  return a + b >= -delaunay_rounding * (1 + std::fabs(a) + std::fabs(b));
}

// Flips the edge i -> j, with k on its left and m on its right, to the edge k - m. The new faces are (m k i) and (k m
// j).
void IntrinsicTriangulation::flip(Index half) noexcept {
  const Index h0 = half, h1 = next(h0), h2 = next(h1), g0 = twin_[at(half)], g1 = next(g0), g2 = next(g1);
  // The two faces of the edge i -> j are unfolded into a plane, with i at the origin and j on the x axis.
  const double l = length_[at(h0)];
  const auto apex = [&](Index base, double from_i, double from_j, double& x, double& y) {
    x = 0.5 * (l + (from_i - from_j) * ((from_i + from_j) / l));
    y = 0.5 * quadruple_area(length_.data() + 3 * at(base / 3)) / l;
  };
  double xk, yk, xm, ym;
  apex(h0, length_[at(h2)], length_[at(h1)], xk, yk);
  apex(g0, length_[at(g1)], length_[at(g2)], xm, ym);
  const double diagonal = hypotenuse(xk - xm, yk + ym);

  const Index from[4] = {h1, h2, g1, g2}, to[4] = {g2, h1, h2, g1};
  Index tails[4], twins[4];
  double lengths[4];
  for (int q = 0; q < 4; ++q) {
    tails[q] = tail_[at(from[q])], lengths[q] = length_[at(from[q])];
    twins[q] = twin_[at(from[q])];
  }
  const Index k = tails[1], m = tails[3];
  for (int q = 0; q < 4; ++q) {
    // The four outer edges of the two faces get new numbers. Two of them may be the same edge.
    const Index* inside = std::find(from, from + 4, twins[q]);
    const Index twin = inside != from + 4 ? to[inside - from] : twins[q];
    tail_[at(to[q])] = tails[q], length_[at(to[q])] = lengths[q];
    twin_[at(to[q])] = twin, twin_[at(twin)] = to[q];
  }
  tail_[at(h0)] = m, tail_[at(g0)] = k;
  length_[at(h0)] = length_[at(g0)] = diagonal;
  measure_face(h0 / 3), measure_face(g0 / 3);
}

std::uint64_t IntrinsicTriangulation::flip_to_delaunay(std::uint64_t flip_limit) {
  const Index halves = static_cast<Index>(twin_.size());
  if (flip_limit == 0) flip_limit = flips_per_half * twin_.size();
  Vector<Index> queue(memory_);
  Poller poller;
  for (Index h = 0; h < halves; ++h) {
    poller.due();
    if (h < twin_[at(h)] && !is_delaunay(h)) queue.push_back(h);
  }
  std::uint64_t flips = 0;
  for (std::size_t head = 0; head < queue.size() && flips < flip_limit; ++head) {
    poller.due();
    const Index h = queue[head], g = twin_[at(h)];
    if (h / 3 == g / 3 || is_delaunay(h)) continue;  // not to flip; edges that must not flip are their own twins
    flip(h), ++flips;
    for (const Index outer : {next(h), next(next(h)), next(g), next(next(g))}) {
      if (!is_delaunay(outer)) queue.push_back(outer);
    }
    if (head > least_trim && 2 * head > queue.size()) {
      queue.erase(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(head) + 1);
      head = static_cast<std::size_t>(-1);
    }
  }
  return flips;
}

Vector<double> IntrinsicTriangulation::vertex_areas(Index vertex_count, Memory& memory) const {
  Vector<double> areas(at(vertex_count), 0.0, &memory);
  for (Index f = 0; f < face_count(); ++f) {
    // The area of the face follows from |ij|^2 = 2 area (cot at i + cot at j).
    const std::size_t h = 3 * at(f);
    std::size_t k = 0;  // the longest side, whose quotient has the smallest rounding error
    for (std::size_t q = 1; q < 3; ++q) k = length_[h + q] > length_[h + k] ? q : k;
    const double base = length_[h + k], sum = cotangent_[h + (k + 1) % 3] + cotangent_[h + (k + 2) % 3];
    const double third = share(f) * base * base / (6 * std::max(sum, least_sum));
    for (std::size_t q = 0; q < 3; ++q) areas[at(tail_[h + q])] += third;
  }
  return areas;
}

SymmetricMatrix IntrinsicTriangulation::laplacian(Index vertex_count, Memory& memory, JobRunner* jobs) const {
  const std::size_t n = at(vertex_count);
  struct Entry {
    Index column, half;  // ascending: sums of parallel edges run in the same order in both rows
    bool operator<(const Entry& o) const noexcept { return column != o.column ? column < o.column : half < o.half; }
  };
  Vector<Index> start(n + 1, 0, &memory);
  const Index halves = static_cast<Index>(twin_.size());
  const auto ends = [&](Index h) { return std::make_pair(tail_[at(h)], tail_[at(twin_[at(h)])]); };
  for (Index h = 0; h < halves; ++h) start[at(tail_[at(h)]) + 1] += tail_[at(h)] != tail_[at(twin_[at(h)])];
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  poll();
  Buffer<Entry> entries(memory, at(start[n]));
  Vector<Index> cursor(start.begin(), start.end() - 1, &memory);
  for (Index h = 0; h < halves; ++h) {
    const auto [i, j] = ends(h);
    if (i != j) entries[at(cursor[at(i)]++)] = {j, std::min(h, twin_[at(h)])};
  }
  poll();
  // Sorts each row and merges its entries in place. Afterwards row_length is the number of off-diagonal entries of each
  // row.
  Vector<Index> row_length(n, 0, &memory);
  Buffer<double> value(memory, entries.size());
  const std::uint32_t pieces = static_cast<std::uint32_t>((n + cover_piece - 1) / cover_piece);
  for_each(jobs, pieces, [&](std::uint32_t p) {
    for (std::size_t v = p * cover_piece; v < std::min(n, (p + std::size_t{1}) * cover_piece); ++v) {
      Entry* const begin = entries.data() + start[v];
      Entry* const end = entries.data() + start[v + 1];
      std::sort(begin, end);
      double* const weight = value.data() + start[v];
      Index count = 0;
      for (const Entry* entry = begin; entry != end; ++entry) {
        const double w = share(entry->half / 3) * std::max(0.0, edge_weight(entry->half));
        if (count > 0 && begin[count - 1].column == entry->column) {
          weight[count - 1] += w;
        } else {
          begin[count].column = entry->column, weight[count++] = w;
        }
      }
      row_length[v] = count;
    }
  });
  poll();
  SymmetricMatrix matrix(memory);
  matrix.column_start.assign(n + 1, 0);
  for (std::size_t v = 0; v < n; ++v) matrix.column_start[v + 1] = matrix.column_start[v] + row_length[v] + 1;
  matrix.row.resize(at(matrix.column_start[n])), matrix.value.resize(at(matrix.column_start[n]));
  poll();
  for_each(jobs, pieces, [&](std::uint32_t p) {
    for (std::size_t v = p * cover_piece; v < std::min(n, (p + std::size_t{1}) * cover_piece); ++v) {
      std::size_t to = at(matrix.column_start[v]), diagonal = to;
      bool placed = false;
      double sum = 0;
      const auto place = [&] { diagonal = to, matrix.row[to++] = static_cast<Index>(v), placed = true; };
      for (std::size_t i = at(start[v]); i < at(start[v]) + at(row_length[v]); ++i) {
        if (!placed && at(entries[i].column) > v) place();
        matrix.row[to] = entries[i].column, matrix.value[to++] = -value[i];
        sum += value[i];
      }
      if (!placed) place();
      matrix.value[diagonal] = sum;
    }
  });
  return matrix;
}

}  // namespace hf_inner
