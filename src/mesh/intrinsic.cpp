#include "mesh/intrinsic.h"

#include <algorithm>
#include <cmath>

#include "base/hypotenuse.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/around_edge.h"
#include "mesh/laplacian.h"
#include "mesh/mollify.h"

namespace hf_inner::mesh {
namespace {

// Number of triangles or edges that one thread's job takes. Half and twice the value take the same time within 10 %,
// the noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t cover_piece = 16384;
// flip_to_delaunay stops after this many edge flips per half-edge. So the loop ends even if rounding lets edges flip to
// and fro. It is a bound. Half and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr std::uint64_t flips_per_half = 32;
// The queue of edges to flip is trimmed when it starts with more finished entries than this. It bounds memory; no
// result depends on it. Less copies the rest more often, more keeps memory. Half and double change no bit on eight
// shapes with needles, loose pieces and a long ribbon.
constexpr std::size_t least_trim = 65536;

// Marks the components where every edge joins two triangles that run through it in opposite directions.
Vector<std::uint8_t> plain_components(const Mesh& mesh, const Topology& topology, const Vector<std::uint8_t>* held,
                                      Memory& memory, JobRunner* jobs) {
  const std::size_t edges = at(topology.edge_count()), pieces = (edges + cover_piece - 1) / cover_piece;
  Vector<Vector<Index>> broken(pieces, &memory);  // components of the edges that are not so
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    for (std::size_t e = p * cover_piece; e < std::min(edges, (p + std::size_t{1}) * cover_piece); ++e) {
      const Index begin = topology.edge_triangle_start[e], end = topology.edge_triangle_start[e + 1];
      if (held && (*held)[e]) continue;
      if (end - begin == 2 && topology.forward(begin) != topology.forward(begin + 1)) continue;
      const Index component = mesh.component[at(topology.first(static_cast<Index>(e)))];
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
  cover.tail_.allocate(memory, 3 * at(faces));
  cover.twin_.allocate(memory, 3 * at(faces));
  cover.length_.allocate(memory, 3 * at(faces));
  cover.cotangent_.allocate(memory, 3 * at(faces));
  cover.glue(mesh, topology, back, held, jobs);
  if (cover.measure(mesh, topology, back, jobs)) cover.measure_mollified(mesh, topology, back, jobs);
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
  // A side of a triangle as half-edge of its front and of its back face.
  const auto front = [&](Index side) { return topology.corner(side); };
  const auto reverse = [&](Index side) {
    const Index corner = topology.corner(side);
    return 3 * back[at(corner / 3)] + 2 - corner % 3;
  };
  const auto covered = [&](Index side) { return back[at(topology.triangle(side))] != topology.triangle(side); };
  for_each(jobs, pieces(edges), [&](std::uint32_t p) {
    Vector<EdgeSide> sides(memory_);
    for (std::size_t e = p * cover_piece; e < std::min(edges, (p + std::size_t{1}) * cover_piece); ++e) {
      const Index begin = topology.edge_triangle_start[e], end = topology.edge_triangle_start[e + 1];
      if (held && (*held)[e]) {
        for (Index i = begin; i < end; ++i) {
          twin_[at(front(i))] = front(i);
          if (covered(i)) twin_[at(reverse(i))] = reverse(i);
        }
        continue;
      }
      if (!covered(begin)) {
        twin_[at(front(begin))] = front(begin + 1);
        twin_[at(front(begin + 1))] = front(begin);
        continue;
      }
      sides.clear();
      for (Index i = begin; i < end; ++i) sides.push_back({i, Mesh::none, 0, 0, 0});
      if (sides.size() > 2) sort_around_edge(mesh, topology, static_cast<Index>(e), sides);
      for (std::size_t s = 0; s < sides.size(); ++s) {
        // Triangles at an edge are sorted around it. If a triangle's side runs along the edge's direction, its normal
        // points towards the next triangle.
        const Index here = sides[s].side, there = sides[(s + 1) % sides.size()].side;
        const Index a = topology.forward(here) ? front(here) : reverse(here),
                    b = topology.forward(there) ? reverse(there) : front(there);
        twin_[at(a)] = b;
        twin_[at(b)] = a;
      }
    }
  });
}

void IntrinsicTriangulation::set_face(const double length[3], const double cotangent[3], std::size_t face,
                                      std::size_t back) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    length_[3 * face + k] = length[k];
    cotangent_[3 * face + k] = cotangent[k];
    if (back != face) {
      length_[3 * back + 2 - k] = length[k];
      cotangent_[3 * back + 2 - k] = cotangent[k];
    }
  }
}

bool IntrinsicTriangulation::measure(const Mesh& mesh, const Topology& topology, const Vector<Index>& back,
                                     JobRunner* jobs) {
  const std::size_t triangles = back.size(), pieces = (triangles + cover_piece - 1) / cover_piece;
  Vector<ThinCheck> checks(pieces, memory_);
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    ThinCheck own;
    for (std::size_t t = p * cover_piece; t < std::min(triangles, (p + std::size_t{1}) * cover_piece); ++t) {
      const Index* v = mesh.triangle(static_cast<Index>(t));
      double length[3], corner[3];
      for (std::size_t k = 0; k < 3; ++k)
        length[k] = norm(mesh.positions[at(v[(k + 1) % 3])] - mesh.positions[at(v[k])]);
      own.add(length[0], length[1], length[2]);
      corner_cotangents(mesh, static_cast<Index>(t), corner);
      const double cotangent[3] = {corner[2], corner[0], corner[1]};  // side k is opposite corner k + 2
      set_face(length, cotangent, t, at(back[t]));
    }
    checks[p] = own;
  });
  ThinCheck all;
  for (const ThinCheck& own : checks) all.add(own);
  return all.may_be_thin(topology.edge_count());
}

// Writes lengths and cotangents of the triangles again where edges had to grow.
void IntrinsicTriangulation::measure_mollified(const Mesh& mesh, const Topology& topology, const Vector<Index>& back,
                                               JobRunner* jobs) {
  const MollifiedLengths lengths = MollifiedLengths::make(mesh, topology, *memory_, jobs);
  mollified_ = lengths.thin_count;
  if (lengths.changed.empty()) return;
  changed_.assign(mesh.positions.size(), 0);
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
        changed = changed || lengths.changed[e];
      }
      if (!changed) continue;
      cotangents_of_lengths(length, cotangent);
      set_face(length, cotangent, t, at(back[t]));
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
  std::uint8_t moved[4];
  for (int q = 0; q < 4; ++q) {
    tails[q] = tail_[at(from[q])];
    lengths[q] = length_[at(from[q])];
    moved[q] = flipped_[at(from[q])];
    twins[q] = twin_[at(from[q])];
  }
  const Index k = tails[1], m = tails[3];
  for (int q = 0; q < 4; ++q) {
    // The four outer edges of the two faces get new numbers. Two of them may be the same edge.
    const Index* inside = std::find(from, from + 4, twins[q]);
    const Index twin = inside != from + 4 ? to[inside - from] : twins[q];
    tail_[at(to[q])] = tails[q];
    length_[at(to[q])] = lengths[q];
    flipped_[at(to[q])] = moved[q];
    twin_[at(to[q])] = twin;
    twin_[at(twin)] = to[q];
  }
  tail_[at(h0)] = m;
  tail_[at(g0)] = k;
  length_[at(h0)] = length_[at(g0)] = diagonal;
  flipped_[at(h0)] = flipped_[at(g0)] = 1;
  measure_face(h0 / 3);
  measure_face(g0 / 3);
}

std::uint64_t IntrinsicTriangulation::flip_to_delaunay(std::uint64_t flip_limit, JobRunner* jobs) {
  const std::size_t halves = twin_.size(), pieces = (halves + cover_piece - 1) / cover_piece;
  if (flip_limit == 0) flip_limit = flips_per_half * halves;
  Vector<Vector<Index>> found(pieces, memory_);
  for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
    for (std::size_t h = p * cover_piece; h < std::min(halves, (p + std::size_t{1}) * cover_piece); ++h) {
      if (static_cast<Index>(h) < twin_[h] && !is_delaunay(static_cast<Index>(h)))
        found[p].push_back(static_cast<Index>(h));
    }
  });
  Vector<Index> queue(memory_);
  for (const auto& list : found) queue.insert(queue.end(), list.begin(), list.end());
  if (!queue.empty()) flipped_.assign(halves, 0);
  Poller poller;
  std::uint64_t flips = 0;
  for (std::size_t head = 0; head < queue.size() && flips < flip_limit; ++head) {
    poller.due();
    const Index h = queue[head], g = twin_[at(h)];
    if (h / 3 == g / 3 || is_delaunay(h)) continue;  // not to flip; edges that must not flip are their own twins
    flip(h);
    ++flips;
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

namespace {

// Rows of at most this many entries are sorted by insertion, which is quick for the usual seven. Longer ones would take
// quadratic time. No result depends on it.
constexpr std::size_t short_row = 32;

// Sorts the entries of a row by column and adds up the entries of one column. Equal columns are added from the smallest
// weight on, so that both rows of parallel edges get the same sum. Returns the number of entries that are left.
std::size_t sort_row(Index* column, double* weight, std::size_t count, Memory& memory) {
  if (count <= short_row) {
    for (std::size_t i = 1; i < count; ++i) {
      const Index c = column[i];
      const double w = weight[i];
      std::size_t k = i;
      for (; k > 0 && (column[k - 1] > c || (column[k - 1] == c && weight[k - 1] > w)); --k) {
        column[k] = column[k - 1];
        weight[k] = weight[k - 1];
      }
      column[k] = c;
      weight[k] = w;
    }
  } else {
    Vector<std::pair<Index, double>> entries(count, &memory);
    for (std::size_t i = 0; i < count; ++i) entries[i] = {column[i], weight[i]};
    std::sort(entries.begin(), entries.end());
    for (std::size_t i = 0; i < count; ++i) {
      column[i] = entries[i].first;
      weight[i] = entries[i].second;
    }
  }
  std::size_t left = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (left > 0 && column[left - 1] == column[i])
      weight[left - 1] += weight[i];
    else {
      column[left] = column[i];
      weight[left++] = weight[i];
    }
  }
  return left;
}

}  // namespace

// Every row is written where it stays, with one place for the diagonal at its end, then sorted there. Only where edges
// are parallel do rows become shorter and move up.
SymmetricMatrix IntrinsicTriangulation::laplacian(Index vertex_count, Memory& memory, JobRunner* jobs) const {
  const std::size_t n = at(vertex_count), halves = twin_.size();
  SymmetricMatrix matrix(memory);
  Vector<Index>& start = matrix.column_start;
  start.assign(n + 1, 1);  // the diagonals
  start[0] = 0;
  const auto head_of = [&](std::size_t h) { return tail_[at(twin_[h])]; };
  for (std::size_t h = 0; h < halves; ++h) start[at(tail_[h]) + 1] += tail_[h] != head_of(h);
  for (std::size_t v = 0; v < n; ++v) start[v + 1] += start[v];
  poll();
  matrix.row.resize(at(start[n]));
  matrix.value.resize(at(start[n]));
  poll();
  Vector<Index> cursor(start.begin(), start.end() - 1, &memory);
  // Each thread reads all half-edges and writes the rows of its own vertices, in the same order for any number of them.
  const std::size_t ranges = jobs ? jobs->thread_count() : 1;
  for_each(jobs, static_cast<std::uint32_t>(ranges), [&](std::uint32_t r) {
    const Index first = static_cast<Index>(n * r / ranges), end = static_cast<Index>(n * (r + 1) / ranges);
    Poller poller;
    for (std::size_t h = 0; h < halves; ++h) {
      poller.due();
      const Index i = tail_[h];
      if (i < first || i >= end) continue;
      const Index j = head_of(h);
      if (i == j) continue;
      const std::size_t to = at(cursor[at(i)]++);
      matrix.row[to] = j;
      matrix.value[to] = share(static_cast<Index>(h / 3)) * std::max(0.0, edge_weight(static_cast<Index>(h)));
    }
  });
  poll();
  const std::uint32_t pieces = static_cast<std::uint32_t>((n + cover_piece - 1) / cover_piece);
  for_each(jobs, pieces, [&](std::uint32_t p) {
    for (std::size_t v = p * cover_piece; v < std::min(n, (p + std::size_t{1}) * cover_piece); ++v) {
      Index* const column = matrix.row.data() + start[v];
      double* const value = matrix.value.data() + start[v];
      const std::size_t count = sort_row(column, value, at(start[v + 1] - start[v]) - 1, memory);
      cursor[v] = static_cast<Index>(count) + 1;  // the length of the row
      double sum = 0;
      for (std::size_t i = 0; i < count; ++i) {
        sum += value[i];
        value[i] = -value[i];
      }
      std::size_t diagonal = count;
      for (; diagonal > 0 && at(column[diagonal - 1]) > v; --diagonal) {
        column[diagonal] = column[diagonal - 1];
        value[diagonal] = value[diagonal - 1];
      }
      column[diagonal] = static_cast<Index>(v);
      value[diagonal] = sum;
    }
  });
  poll();
  std::size_t to = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t from = at(start[v]), count = at(cursor[v]);
    start[v] = static_cast<Index>(to);
    if (to != from) {
      std::copy_n(matrix.row.begin() + static_cast<std::ptrdiff_t>(from), count,
                  matrix.row.begin() + static_cast<std::ptrdiff_t>(to));
      std::copy_n(matrix.value.begin() + static_cast<std::ptrdiff_t>(from), count,
                  matrix.value.begin() + static_cast<std::ptrdiff_t>(to));
    }
    to += count;
  }
  start[n] = static_cast<Index>(to);
  matrix.row.resize(to);
  matrix.value.resize(to);
  return matrix;
}

}  // namespace hf_inner::mesh
