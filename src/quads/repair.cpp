#include <algorithm>

#include "base/progress.h"
#include "quads/numbers.h"
#include "quads/quad_complex.h"
#include "remesh/relax.h"

namespace hf_inner::quads {
namespace {

// Two edges between the same vertices that bound at most this many quads are a fold, and the quads go. A larger number
// cuts off thin limbs, a smaller one keeps folds and puts rings around them. With 0 there are 20 % more irregular
// vertices in four coarse runs. A value of 4 changes none of 16 runs. Larger values remove 8 quads more in one, and all
// figures stay the same.
constexpr std::int32_t most_fold_quads = 8;
// Rounds of repairs: each round checks the quads that the round before added. It bounds the time. 6 and 24 change none
// of 16 runs. With 2, one of four coarse runs gets quads of shorter edges in their place.
constexpr std::int32_t repair_rounds = 12;
// The corners of new quads lie this share of the way from the corners of the old ones to their middle. Relaxing moves
// them anyway. 0.175 and 0.7 change 2 of 16 runs. Distances fall by 4 % in four coarse ones, and with 0.7 fewer corners
// are turned over: 111 instead of 150.
constexpr double pillow_share = 0.35;

}  // namespace

std::int32_t remove_doublets(QuadComplex& quads, Memory& memory) {
  remesh::Table<std::uint8_t> dead(quads.quad_count(), 0, memory);
  remesh::Table<std::int32_t> queue(memory);
  const auto next = QuadComplex::next, previous = QuadComplex::previous;
  std::int32_t removed = 0;
  for (std::int32_t h = 0; h < quads.tail.size(); ++h) queue.push_back(h);
  for (std::int32_t place = 0; place < queue.size(); ++place) {
    const std::int32_t h = queue[place], f = h / 4;
    if (dead[f] || quads.twin[h] == none) continue;
    const std::int32_t last = previous(h), k = quads.twin[last];
    if (k == h) {
      // The only quad of a vertex is folded: its other two sides lie on each other.
      const std::int32_t a = quads.twin[next(h)], b = quads.twin[previous(last)];
      if (a == previous(last) || (a == none && b == none)) continue;
      quads.join(a, b);
      dead[f] = 1;
      ++removed;
      for (const std::int32_t g : {a, b}) {
        if (g != none) {
          queue.push_back(g);
          queue.push_back(next(g));
        }
      }
      continue;
    }
    if (k == none || k / 4 == f || previous(k) != quads.twin[h]) continue;
    // The quads (v, p, q, r) and (v, r, s, p) become (s, p, q, r).
    const std::int32_t far = next(k), farther = next(far);
    const auto take = [&](std::int32_t to, std::int32_t from) {
      std::int32_t g = quads.twin[from];
      if (g == far) g = last;
      if (g == farther) g = h;
      quads.join(to, g);
      quads.feature[to] = quads.feature[from];
    };
    const std::int32_t vertex = quads.tail[farther];
    if (vertex == quads.head(next(h))) continue;  // s and q are one vertex
    take(h, farther);
    take(last, far);
    quads.tail[h] = vertex;
    dead[k / 4] = 1;
    ++removed;
    for (std::int32_t side = 4 * f; side < 4 * f + 4; ++side) queue.push_back(side);
    for (std::int32_t side = 4 * f; side < 4 * f + 4; ++side) {
      if (quads.twin[side] != none) {
        queue.push_back(next(quads.twin[side]));
        queue.push_back(quads.twin[side]);
      }
    }
  }
  if (removed > 0) {
    quads.remove(dead, memory);
    quads.split_fans(memory);
  }
  return removed;
}

namespace {

class Repairer {
 public:
  Repairer(const remesh::FluxSurface& surface, QuadComplex& quads, Memory& memory)
      : surface_(surface),
        quads_(quads),
        memory_(memory),
        dead_(quads.quad_count(), 0, memory),
        mark_(quads.quad_count(), 0, memory) {}

  // Finds the edges between the same vertices. Removes small folds between two of them, or else gives all but one of
  // them new ends: a ring of quads, or two more edges at a border. Returns whether there was anything to do.
  bool run(RepairReport& report) {
    const Vector<QuadEdge> edges = edges_of(quads_, memory_);
    const std::int32_t removed = report.removed;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      if (!same(edges[i], edges[i + 1]) || edges[i].a == edges[i].b) continue;
      for (std::size_t j = i + 1; j < edges.size() && same(edges[i], edges[j]); ++j) {
        if (remove_fold(edges[i].half, edges[j].half, report)) break;
      }
    }
    if (report.removed != removed) {
      quads_.remove(dead_, memory_);
      quads_.split_fans(memory_);
      return true;
    }
    // Every quad gets one ring in a round.
    const std::int32_t before = quads_.quad_count();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool loop = edges[i].a == edges[i].b;
      if (!loop && (i == 0 || !same(edges[i - 1], edges[i]))) continue;
      if (!widen(edges[i].half) && !loop) widen(edges[i - 1].half);
    }
    for (std::int32_t f = 0; f < before; ++f) {
      const std::int32_t* v = &quads_.tail[4 * f];
      if ((v[0] == v[2] || v[1] == v[3]) && mark_[f] != pillowed_) pillow_quads(f, none);
    }
    if (quads_.quad_count() == before) return false;
    report.added += quads_.quad_count() - before;
    quads_.split_fans(memory_);
    return true;
  }

  // Opens a hole of two edges at a vertex of the quads; run() gives it two more.
  void open(const QuadComplex::Hole& hole) {
    for (std::int32_t h = hole.half;;) {
      const std::int32_t g = quads_.twin[h];
      if (pillow(h)) {
        const remesh::SurfacePoint from = [&] {
          remesh::SurfacePoint point;
          point.triangle = hole.border / 3;
          point.weight[hole.border % 3] = 1;
          return point;
        }();
        remesh::SurfacePoint thirds[2];
        points_between(from, from, true, thirds);
        quads_.twin[h] = quads_.twin[g] = none;
        quads_.feature[h] = quads_.feature[g] = 1;
        place(quads_.tail[h], from);
        place(quads_.tail[g], thirds[0]);
        return;
      }
      if (g == none) return;
      h = QuadComplex::next(g);
      if (h == hole.half) return;
    }
  }

 private:
  void place(std::int32_t v, const remesh::SurfacePoint& point) {
    remesh::QuadMesh& all = quads_.vertices;
    all.location[v] = point;
    all.position[v] = remesh::position_of(surface_, point);
    all.pinned[v] = remesh::QuadMesh::feature;
    all.border[v] = 1;
  }
  bool widen(std::int32_t h) { return quads_.twin[h] == none ? split_border(h) : pillow(h); }
  // A hole of one edge or two gets two edges more. Its quad (v, w, a, b), with the border side from v to w, becomes
  // (v, p, q, c), (q, w, a, c) and (a, b, v, c). The vertices p and q are on the border, c is inside.
  bool split_border(std::int32_t h) {
    const auto next = QuadComplex::next;
    const std::int32_t f = h / 4, sides[3] = {next(h), next(next(h)), next(next(next(h)))};
    if (is_taken(f)) return false;
    std::int32_t outside[3];
    for (int k = 0; k < 3; ++k) {
      outside[k] = quads_.twin[sides[k]];
      if (outside[k] == none || outside[k] / 4 != f) continue;
      pillow_quads(f, none);  // the quad lies on itself; its ring does not
      return true;
    }
    mark_[f] = pillowed_;
    const std::int32_t v = quads_.tail[h], w = quads_.head(h), a = quads_.tail[sides[1]], b = quads_.tail[sides[2]];
    std::uint8_t feature[3];
    for (int k = 0; k < 3; ++k) feature[k] = quads_.feature[sides[k]];
    remesh::SurfacePoint thirds[2];
    points_between(quads_.vertices.location[v], quads_.vertices.location[w], v == w, thirds);
    std::int32_t fresh[3];
    for (int k = 0; k < 2; ++k)
      fresh[k] = quads_.vertices.add_vertex(thirds[k], remesh::position_of(surface_, thirds[k]),
                                            quads_.vertices.pinned[v], true, quads_.vertices.scale[v]);
    const Vec3 from = quads_.vertices.position[a];
    const remesh::SurfacePoint inside =
        remesh::walk_surface(surface_, quads_.vertices.location[a], 0.5 * (quads_.vertices.position[fresh[0]] - from));
    fresh[2] = quads_.vertices.add_vertex(inside, remesh::position_of(surface_, inside), remesh::QuadMesh::free, false,
                                          quads_.vertices.scale[a]);
    const std::int32_t p = fresh[0], q = fresh[1], c = fresh[2], first = quads_.tail.size();
    const auto set = [&](std::int32_t half, std::int32_t tail, std::uint8_t is_feature) {
      quads_.tail[half] = tail;
      quads_.feature[half] = is_feature;
      quads_.twin[half] = none;
    };
    quads_.tail.resize(first + 8, none);
    quads_.feature.resize(first + 8, 0);
    quads_.twin.resize(first + 8, none);
    const std::int32_t own = 4 * f, right = first, left = first + 4;
    set(own, v, 1);
    set(own + 1, p, 1);
    set(own + 2, q, 0);
    set(own + 3, c, 0);
    set(right, q, 1);
    set(right + 1, w, feature[0]);
    set(right + 2, a, 0);
    set(right + 3, c, 0);
    set(left, a, feature[1]);
    set(left + 1, b, feature[2]);
    set(left + 2, v, 0);
    set(left + 3, c, 0);
    quads_.join(right + 1, outside[0]);
    quads_.join(left, outside[1]);
    quads_.join(left + 1, outside[2]);
    quads_.join(own + 2, right + 3);
    quads_.join(right + 2, left + 3);
    quads_.join(left + 2, own + 3);
    return true;
  }
  // The border half-edge of the surface on which a point lies, or none.
  std::int32_t border_of(const remesh::SurfacePoint& point) const noexcept {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t h = 3 * point.triangle + k;
      if (!surface_.is_real(surface_.twin[h]) && point.weight[(k + 2) % 3] == 0) return h;
    }
    return none;
  }
  // Two points on the border, at a third and at two thirds of the way from one point to another, or right round.
  void points_between(const remesh::SurfacePoint& from, const remesh::SurfacePoint& to, bool round,
                      remesh::SurfacePoint* out) const {
    out[0] = from;
    out[1] = to;
    const std::int32_t begin = border_of(from), end = border_of(to);
    if (begin == none || end == none) return;
    const auto share = [](const remesh::SurfacePoint& point, std::int32_t h) { return point.weight[(h % 3 + 1) % 3]; };
    // The pieces of edges on the way, and their lengths together.
    struct Piece {
      std::int32_t half;
      double from, to, length;
    };
    remesh::Table<Piece> way(memory_);
    double whole = 0, at = share(from, begin);
    for (std::int32_t h = begin;;) {
      const bool last = h == end && (round ? !way.empty() : share(to, end) >= at);
      const double stop = last ? share(to, end) : 1.0;
      const double length = norm(surface_.position[surface_.head(h)] - surface_.position[surface_.tail[h]]);
      way.push_back({h, at, stop, (stop - at) * length});
      whole += way.back().length;
      if (last) break;
      h = remesh::FluxSurface::next(h);
      at = 0;
      while (surface_.is_real(surface_.twin[h])) h = remesh::FluxSurface::next(surface_.twin[h]);
      if (h == begin && h != end) return;  // the other point lies on another border
    }
    double passed = 0;
    int found = 0;
    for (const Piece& piece : way) {
      for (; found < 2 && passed + piece.length >= (found + 1) * whole / 3 && piece.length > 0; ++found) {
        const double step = ((found + 1) * whole / 3 - passed) / piece.length,
                     place = piece.from + step * (piece.to - piece.from);
        remesh::SurfacePoint point;
        point.triangle = piece.half / 3;
        point.weight[piece.half % 3] = 1 - place;
        point.weight[(piece.half % 3 + 1) % 3] = place;
        out[found] = point;
      }
      passed += piece.length;
    }
  }
  // Quads behind the marks are new in this round.
  bool is_taken(std::int32_t f) const noexcept { return f >= mark_.size() || mark_[f] == pillowed_; }
  // Puts a ring of quads around the two quads of an edge, so that the edge lies inside and has new ends.
  bool pillow(std::int32_t h) {
    const std::int32_t g = quads_.twin[h], f = h / 4;
    if (g == none || g / 4 == f || is_taken(f) || is_taken(g / 4)) return false;
    pillow_quads(f, h);
    return true;
  }
  // A ring around quad f, or around it and the quad across `inner`: the old corners of these quads get inner copies.
  void pillow_quads(std::int32_t f, std::int32_t inner) {
    const auto next = QuadComplex::next;
    std::int32_t rim[6], count = 0;
    if (inner == none) {
      for (std::int32_t k = 0; k < 4; ++k) rim[count++] = 4 * f + k;
      mark_[f] = pillowed_;
    } else {
      const std::int32_t g = quads_.twin[inner];
      for (std::int32_t h = next(inner); h != inner; h = next(h)) rim[count++] = h;
      for (std::int32_t h = next(g); h != g; h = next(h)) rim[count++] = h;
      mark_[f] = mark_[g / 4] = pillowed_;
    }
    const remesh::QuadMesh& old = quads_.vertices;
    std::int32_t corner[6], copy[6];
    Vec3 middle{};
    for (int k = 0; k < count; ++k) {
      corner[k] = quads_.tail[rim[k]];
      middle = middle + 1.0 / count * old.position[corner[k]];
    }
    for (int k = 0; k < count; ++k) {
      const std::int32_t v = corner[k];
      const remesh::SurfacePoint point =
          remesh::walk_surface(surface_, old.location[v], pillow_share * (middle - old.position[v]));
      copy[k] = quads_.vertices.add_vertex(point, remesh::position_of(surface_, point), remesh::QuadMesh::free, false,
                                           old.scale[v]);
    }
    const std::int32_t first = quads_.tail.size();
    for (int k = 0; k < count; ++k) {
      // The ring's quad k: (corner k, corner k + 1, copy k + 1, copy k).
      const std::int32_t outside = quads_.twin[rim[k]], m = (k + 1) % count;
      for (const std::int32_t v : {corner[k], corner[m], copy[m], copy[k]}) quads_.tail.push_back(v);
      for (int side = 0; side < 4; ++side) {
        quads_.twin.push_back(none);
        quads_.feature.push_back(side == 0 ? quads_.feature[rim[k]] : std::uint8_t{0});
      }
      // A side of the rim that lies on another one: that one's ring quad joins it later.
      quads_.join(first + 4 * k, outside);
    }
    for (int k = 0; k < count; ++k) {
      const std::int32_t m = (k + 1) % count;
      quads_.join(first + 4 * k + 1, first + 4 * m + 3);
      quads_.join(first + 4 * k + 2, rim[k]);
      quads_.feature[rim[k]] = 0;
    }
    if (inner != none) {
      // The ends of the inner edge belong to both quads.
      const std::int32_t g = quads_.twin[inner];
      quads_.tail[inner] = copy[3];
      quads_.tail[g] = copy[0];
    }
    for (int k = 0; k < count; ++k) quads_.tail[rim[k]] = copy[k];
  }

  // Collects the quads on the left of `start` up to the two edges. Returns false if they are too many or no disc.
  bool collect(std::int32_t start, std::int32_t e, std::int32_t f, remesh::Table<std::int32_t>& region) {
    ++stamp_;
    region.clear();
    region.push_back(start / 4);
    mark_[start / 4] = stamp_;
    const auto barrier = [&](std::int32_t h) { return h == e || h == f || quads_.twin[h] == e || quads_.twin[h] == f; };
    std::int32_t inner_edges = 0;  // twice
    for (std::int32_t i = 0; i < region.size(); ++i) {
      if (region.size() > most_fold_quads || dead_[region[i]]) return false;
      for (std::int32_t h = 4 * region[i]; h < 4 * region[i] + 4; ++h) {
        if (barrier(h)) continue;
        const std::int32_t g = quads_.twin[h];
        if (g == none) return false;
        ++inner_edges;
        if (mark_[g / 4] == stamp_) continue;
        mark_[g / 4] = stamp_;
        region.push_back(g / 4);
      }
    }
    if (region.size() > most_fold_quads) return false;
    // An open disc: faces - inner edges + inner vertices = 1.
    std::int32_t corners[4 * most_fold_quads + 4], count = 0;
    for (const std::int32_t q : region) {
      for (std::int32_t h = 4 * q; h < 4 * q + 4; ++h) corners[count++] = quads_.tail[h];
    }
    std::sort(corners, corners + count);
    const std::int32_t vertices = static_cast<std::int32_t>(std::unique(corners, corners + count) - corners);
    return region.size() - inner_edges / 2 + vertices - 2 == 1;
  }

  bool remove_fold(std::int32_t e, std::int32_t f, RepairReport& report) {
    remesh::Table<std::int32_t> region(memory_);
    for (const std::int32_t side : {e, quads_.twin[e]}) {
      if (side == none || dead_[side / 4] || !collect(side, e, f, region)) continue;
      // The half-edges of both edges that belong to the region; one each, or the edge is inside it.
      std::int32_t of[2] = {none, none};
      bool good = true;
      for (int k = 0; k < 2; ++k) {
        const std::int32_t h = k == 0 ? e : f;
        for (const std::int32_t half : {h, quads_.twin[h]}) {
          if (half == none || mark_[half / 4] != stamp_) continue;
          good &= of[k] == none;
          of[k] = half;
        }
        good &= of[k] != none;
      }
      if (!good) continue;
      const std::int32_t a = quads_.twin[of[0]], b = quads_.twin[of[1]];
      if (a == none && b == none) continue;
      const std::uint8_t feature = quads_.feature[of[0]] | quads_.feature[of[1]];
      for (const std::int32_t half : {a, b}) {
        if (half != none) quads_.feature[half] = feature;
      }
      quads_.join(a, b);
      for (const std::int32_t q : region) dead_[q] = 1;
      report.removed += region.size();
      return true;
    }
    return false;
  }

  static constexpr std::int32_t pillowed_ = -1;
  const remesh::FluxSurface& surface_;
  QuadComplex& quads_;
  Memory& memory_;
  remesh::Table<std::uint8_t> dead_;
  remesh::Table<std::int32_t> mark_;
  std::int32_t stamp_ = 0;
};

// Removes small closed pieces beside larger ones of the same component: lines of a fold that cross each other only.
std::int32_t remove_islands(const remesh::FluxSurface& surface, QuadComplex& quads, Memory& memory) {
  const remesh::Table<std::int32_t> component = components_of(surface, quads, memory);
  remesh::Table<std::int32_t> piece(quads.quad_count(), none, memory), stack(memory), size(memory),
      largest(surface.component_count, none, memory), of(memory);
  remesh::Table<std::uint8_t> open(memory);
  for (std::int32_t start = 0; start < piece.size(); ++start) {
    if (piece[start] != none) continue;
    const std::int32_t number = size.push_back(0);
    open.push_back(0);
    of.push_back(component[start]);
    piece[start] = number;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::int32_t f = stack.back();
      stack.pop_back();
      ++size[number];
      for (std::int32_t h = 4 * f; h < 4 * f + 4; ++h) {
        const std::int32_t g = quads.twin[h];
        if (g == none) {
          open[number] = 1;
        } else if (piece[g / 4] == none) {
          piece[g / 4] = number;
          stack.push_back(g / 4);
        }
      }
    }
    std::int32_t& best = largest[of[number]];
    if (best == none || size[number] > size[best]) best = number;
  }
  remesh::Table<std::uint8_t> dead(piece.size(), 0, memory);
  std::int32_t removed = 0;
  for (std::int32_t f = 0; f < piece.size(); ++f) {
    const std::int32_t p = piece[f];
    dead[f] = p != largest[of[p]] && !open[p] && size[p] <= most_fold_quads;
    removed += dead[f];
  }
  if (removed > 0) {
    quads.remove(dead, memory);
    quads.split_fans(memory);
  }
  return removed;
}

}  // namespace

void repair_quads(const remesh::FluxSurface& surface, QuadComplex& quads, RepairReport& report, Memory& memory) {
  if (!quads.holes.empty()) {
    const std::int32_t before = quads.quad_count();
    Repairer repairer(surface, quads, memory);
    for (const QuadComplex::Hole& hole : quads.holes) repairer.open(hole);
    quads.holes.clear();
    report.added += quads.quad_count() - before;
    quads.split_fans(memory);
  }
  report.removed += remove_islands(surface, quads, memory);
  report.removed += remove_doublets(quads, memory);
  for (std::int32_t round = 0; round < repair_rounds; ++round) {
    poll();
    if (!Repairer(surface, quads, memory).run(report)) return;
    report.removed += remove_doublets(quads, memory);
  }
}

}  // namespace hf_inner::quads
