#include "quads/extract.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

class Extractor {
 public:
  Extractor(const remesh::FluxSurface& surface, const GridMap& map, const remesh::Table<std::uint8_t>& features,
            std::int32_t& backward, Memory& memory)
      : s_(surface),
        map_(map),
        features_(features),
        backward_(backward),
        memory_(memory),
        half_(std::int64_t{1} << (map.bits - 1)),
        cells_(memory),
        first_(memory),
        low_(memory),
        parent_(memory),
        piece_parent_(memory),
        line_start_(memory),
        lines_(memory),
        place_(memory),
        quality_(memory),
        on_border_(memory),
        corners_(memory),
        sides_(memory),
        feature_(memory),
        border_lines_(memory),
        crossing_(memory),
        region_(memory) {}

  QuadComplex run() {
    order_lines();
    make_cells();
    join_cells();
    make_quads();
    place_vertices();
    return join_quads();
  }

 private:
  // The columns of the grid that the image of a triangle touches: `columns` from u on. In a column, the cells from low_
  // on are touched, and they have the numbers from first_ on. A long thin triangle touches few of those in its box.
  struct Cells {
    std::int32_t column, u, columns;
  };
  std::int32_t cell_of(std::int64_t x) const noexcept { return static_cast<std::int32_t>((x + half_) >> map_.bits); }
  std::int64_t line(std::int32_t c) const noexcept { return 2 * half_ * c + half_; }
  std::int32_t number(std::int32_t t, std::int32_t i, std::int32_t j) const noexcept {
    const std::int32_t column = cells_[t].column + (i - cells_[t].u);
    return first_[column] + (j - low_[column]);
  }
  // The piece of a line between cell (i, j) and the next one: (i + 1, j) for a u-line, (i, j + 1) for a v-line.
  std::int32_t piece(std::int32_t t, std::int32_t i, std::int32_t j, int kind) const noexcept {
    return 2 * number(t, i, j) + kind;
  }
  static std::int32_t root(remesh::Table<std::int32_t>& parent, std::int32_t a) noexcept {
    while (parent[a] != a) a = parent[a] = parent[parent[a]];
    return a;
  }
  static void unite(remesh::Table<std::int32_t>& parent, std::int32_t a, std::int32_t b) noexcept {
    a = root(parent, a);
    b = root(parent, b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
  std::int32_t find(std::int32_t a) noexcept { return root(parent_, a); }
  bool owns(std::int32_t h) const noexcept { return !s_.is_real(s_.twin[h]) || h < s_.twin[h]; }

  // Lists the lines that cross each edge, in order from the tail of the half-edge that owns it: 0 for a u-line, 1 for a
  // v-line of its triangle.
  void order_lines() {
    const std::int32_t halves = 3 * s_.real_triangles;
    line_start_.assign(halves + 1, 0);
    Poller poller;
    for (std::int32_t h = 0; h < halves; ++h) {
      poller.due();
      line_start_[h] = lines_.size();
      if (!owns(h)) continue;
      const std::int32_t g = remesh::FluxSurface::next(h);
      const std::int64_t du = map_.u[g] - map_.u[h], dv = map_.v[g] - map_.v[h], wu = std::llabs(du),
                         wv = std::llabs(dv);
      std::int32_t i = cell_of(map_.u[h]), j = cell_of(map_.v[h]);
      const std::int32_t to_i = cell_of(map_.u[g]), to_j = cell_of(map_.v[g]);
      while (i != to_i || j != to_j) {
        bool take_u = j == to_j;
        if (i != to_i && j != to_j) {
          const std::int64_t a = std::llabs(line(du > 0 ? i : i - 1) - map_.u[h]),
                             b = std::llabs(line(dv > 0 ? j : j - 1) - map_.v[h]);
          take_u = a * wv <= b * wu;  // a / wu <= b / wv
        }
        lines_.push_back(static_cast<std::uint8_t>(!take_u));
        if (take_u) {
          i += du > 0 ? 1 : -1;
        } else {
          j += dv > 0 ? 1 : -1;
        }
      }
    }
    line_start_[halves] = lines_.size();
    // The lines of half-edges that own no edge start where the next one's do; lines_of() looks at the owner.
  }

  void make_cells() {
    cells_.assign(s_.real_triangles, Cells{0, 0, 0});
    std::int64_t total = 0;
    remesh::Table<std::int32_t> low(memory_), high(memory_);  // of the touched cells, by column of the triangle
    Poller poller;
    for (std::int32_t t = 0; t < s_.real_triangles; ++t) {
      poller.due();
      const auto [left, right] = std::minmax({map_.u[3 * t], map_.u[3 * t + 1], map_.u[3 * t + 2]});
      const std::int32_t u = cell_of(left), columns = cell_of(right) - u + 1;
      cells_[t] = {first_.size(), u, columns};
      low.assign(columns, INT32_MAX);
      high.assign(columns, INT32_MIN);
      const auto touch = [&](std::int32_t i, std::int32_t j) {
        low[i - u] = std::min(low[i - u], j);
        high[i - u] = std::max(high[i - u], j);
      };
      for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h)
        walk(
            h, [&](std::int32_t i, std::int32_t j, int, std::int32_t) { touch(i, j); }, touch);
      for (std::int32_t c = 0; c < columns; ++c) {
        first_.push_back(static_cast<std::int32_t>(total));
        low_.push_back(low[c]);
        total += std::int64_t{high[c]} - low[c] + 1;
      }
      if (total > INT32_MAX / 2) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the quads are too many");
    }
    first_.push_back(static_cast<std::int32_t>(total));
    parent_.assign(static_cast<std::int32_t>(total), 0);
    for (std::int32_t c = 0; c < parent_.size(); ++c) parent_[c] = c;
    piece_parent_.assign(2 * parent_.size(), 0);
    for (std::int32_t p = 0; p < piece_parent_.size(); ++p) piece_parent_[p] = p;
    feature_.assign(piece_parent_.size(), 0);
  }

  // Walks along half-edge h of its triangle and calls work(i, j, line, step) at every line. There the walk leaves cell
  // (i, j), and i (line 0) or j (line 1) changes by `step`. Then calls end(i, j).
  template <class Work, class End>
  void walk(std::int32_t h, Work&& work, End&& end) const {
    const std::int32_t g = remesh::FluxSurface::next(h);
    const bool own = owns(h);
    const std::int32_t owner = own ? h : s_.twin[h];
    std::int32_t i = cell_of(map_.u[h]), j = cell_of(map_.v[h]);
    const std::int32_t su = map_.u[g] > map_.u[h] ? 1 : -1, sv = map_.v[g] > map_.v[h] ? 1 : -1;
    const std::int32_t begin = line_start_[owner], stop = line_start_[owner + 1];
    // A quarter turn between the triangles exchanges u-lines and v-lines.
    const bool odd = !own && is_odd(h);
    for (std::int32_t k = 0; k < stop - begin; ++k) {
      const int found = lines_[own ? begin + k : stop - 1 - k];
      const int kind = odd ? 1 - found : found;
      work(i, j, kind, kind == 0 ? su : sv);
      if (kind == 0) {
        i += su;
      } else {
        j += sv;
      }
    }
    end(i, j);
  }
  bool is_odd(std::int32_t h) const noexcept {
    const std::int32_t g = s_.twin[h];
    const std::int64_t du = map_.u[remesh::FluxSurface::next(h)] - map_.u[h],
                       dv = map_.v[remesh::FluxSurface::next(h)] - map_.v[h],
                       eu = map_.u[g] - map_.u[remesh::FluxSurface::next(g)],
                       ev = map_.v[g] - map_.v[remesh::FluxSurface::next(g)];
    // Without a turn or with a half turn, the vectors are (u, v) and +-(u, v). If both fit, so does either order.
    return !((du == eu && dv == ev) || (du == -eu && dv == -ev));
  }

  // Makes cells of neighbouring triangles one where they touch, and the pieces of lines that meet there.
  void join_cells() {
    remesh::Table<std::int32_t> mine(memory_), other(memory_), my_pieces(memory_), other_pieces(memory_);
    Poller poller;
    for (std::int32_t h = 0; h < 3 * s_.real_triangles; ++h) {
      poller.due();
      const std::int32_t g = s_.twin[h];
      if (!owns(h)) continue;
      const auto list = [&](std::int32_t half, remesh::Table<std::int32_t>& out, remesh::Table<std::int32_t>& pieces) {
        out.clear();
        pieces.clear();
        walk(
            half,
            [&](std::int32_t i, std::int32_t j, int kind, std::int32_t step) {
              out.push_back(number(half / 3, i, j));
              const std::int32_t back = step < 0 ? 1 : 0;
              pieces.push_back(piece(half / 3, kind == 0 ? i - back : i, kind == 0 ? j : j - back, kind));
            },
            [&](std::int32_t i, std::int32_t j) {
              out.push_back(number(half / 3, i, j));
              if (i != cell_of(map_.u[remesh::FluxSurface::next(half)]) ||
                  j != cell_of(map_.v[remesh::FluxSurface::next(half)]))
                fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "the two sides of a seam have different lines");
            });
      };
      list(h, mine, my_pieces);
      if (s_.is_real(g)) {
        list(g, other, other_pieces);
        for (std::int32_t k = 0; k < mine.size(); ++k) unite(parent_, mine[k], other[mine.size() - 1 - k]);
        for (std::int32_t k = 0; k < my_pieces.size(); ++k)
          unite(piece_parent_, my_pieces[k], other_pieces[my_pieces.size() - 1 - k]);
      }
      for (const std::int32_t p : my_pieces) {
        if (features_[h]) feature_[p] = 1;
        if (!s_.is_real(g)) border_lines_.push_back({h, p});
      }
    }
  }

  void make_quads() {
    remesh::Table<std::int32_t> up(memory_), down(memory_);
    Poller poller;
    for (std::int32_t t = 0; t < s_.real_triangles; ++t) {
      poller.due();
      const Cells& cells = cells_[t];
      if (cells.columns < 2) continue;
      // By u-line: the row where the turn around the triangle crosses it towards larger and towards smaller u.
      up.assign(cells.columns - 1, 0);
      down.assign(cells.columns - 1, 0);
      for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
        walk(
            h,
            [&](std::int32_t i, std::int32_t j, int kind, std::int32_t step) {
              if (kind == 0) (step > 0 ? up[i - cells.u] : down[i - 1 - cells.u]) = j;
            },
            [](std::int32_t, std::int32_t) {});
      }
      for (std::int32_t c = 0; c + 1 < cells.columns; ++c) {
        const std::int32_t i = cells.u + c;
        const bool backward = up[c] > down[c];
        for (std::int32_t j = std::min(up[c], down[c]); j < std::max(up[c], down[c]); ++j) {
          const std::int32_t corner[4] = {number(t, i, j), number(t, i + 1, j), number(t, i + 1, j + 1),
                                          number(t, i, j + 1)};
          // Side k runs from corner k to the next, and the other way round where the map is turned over.
          const std::int32_t side[4] = {piece(t, i, j, 0), piece(t, i + 1, j, 1), piece(t, i, j + 1, 0),
                                        piece(t, i, j, 1)};
          for (int k = 0; k < 4; ++k) {
            corners_.push_back(find(corner[backward ? 3 - k : k]));
            sides_.push_back(side[backward ? (6 - k) % 4 : k]);
          }
          backward_ += backward;
        }
      }
    }
  }

  // Finds a place for every cell: where the map has its whole numbers, or else the middle of a piece of an edge.
  void place_vertices() {
    place_.assign(parent_.size(), remesh::SurfacePoint{});
    quality_.assign(parent_.size(), 0);
    on_border_.assign(parent_.size(), 0);
    Poller poller;
    for (std::int32_t t = 0; t < s_.real_triangles; ++t) {
      poller.due();
      const Cells& cells = cells_[t];
      std::int64_t u[3], v[3];
      for (int k = 0; k < 3; ++k) {
        u[k] = map_.u[3 * t + k];
        v[k] = map_.v[3 * t + k];
      }
      const std::int64_t area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
      for (std::int32_t i = cells.u; area != 0 && i < cells.u + cells.columns; ++i) {
        const std::int32_t column = cells.column + (i - cells.u), rows = first_[column + 1] - first_[column];
        for (std::int32_t j = low_[column]; j < low_[column] + rows; ++j) {
          const std::int64_t x = 2 * half_ * i, y = 2 * half_ * j;
          remesh::SurfacePoint point;
          point.triangle = t;
          bool inside = true, on_feature = false;
          for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const std::int64_t part = (u[a] - x) * (v[b] - y) - (u[b] - x) * (v[a] - y);
            inside &= area > 0 ? part >= 0 : part <= 0;
            on_feature |= part == 0 && features_[3 * t + a];
            point.weight[k] = static_cast<double>(part) / static_cast<double>(area);
          }
          const std::uint8_t quality = on_feature ? at_feature_ : area > 0 ? at_point_ : at_turned_point_;
          if (inside) offer(number(t, i, j), point, quality);
        }
      }
      for (int k = 0; k < 3; ++k) {
        const std::int32_t h = 3 * t + k;
        const bool border = !s_.is_real(s_.twin[h]);
        const std::int64_t du = u[(k + 1) % 3] - u[k], dv = v[(k + 1) % 3] - v[k];
        double from = 0;
        const auto offer_piece = [&](std::int32_t i, std::int32_t j, double to) {
          remesh::SurfacePoint point;
          point.triangle = t;
          const double middle = (from + to) / 2;
          point.weight[k] = 1 - middle;
          point.weight[(k + 1) % 3] = middle;
          const std::int32_t c = number(t, i, j);
          offer(c, point, border ? at_border_ : at_edge_);
          if (border) on_border_[find(c)] = 1;
          from = to;
        };
        walk(
            h,
            [&](std::int32_t i, std::int32_t j, int kind, std::int32_t step) {
              const std::int64_t there =
                  kind == 0 ? line(step > 0 ? i : i - 1) - u[k] : line(step > 0 ? j : j - 1) - v[k];
              offer_piece(i, j, std::max(from, static_cast<double>(there) / static_cast<double>(kind == 0 ? du : dv)));
            },
            [&](std::int32_t i, std::int32_t j) { offer_piece(i, j, 1.0); });
      }
    }
  }
  void offer(std::int32_t cell, const remesh::SurfacePoint& point, std::uint8_t quality) {
    cell = find(cell);
    if (quality_[cell] >= quality) return;
    quality_[cell] = quality;
    place_[cell] = point;
  }

  QuadComplex join_quads() {
    QuadComplex out(memory_);
    remesh::Table<std::int32_t> vertex(parent_.size(), none, memory_), first(piece_parent_.size(), none, memory_);
    for (std::int32_t p = 0; p < feature_.size(); ++p) {
      if (feature_[p]) feature_[root(piece_parent_, p)] = 1;
    }
    out.twin.assign(corners_.size(), none);
    out.feature.assign(corners_.size(), 0);
    for (std::int32_t h = 0; h < corners_.size(); ++h) {
      const std::int32_t cell = corners_[h];
      if (vertex[cell] == none)
        vertex[cell] = out.vertices.add_vertex(
            place_[cell], remesh::position_of(s_, place_[cell]),
            quality_[cell] == at_feature_ ? remesh::QuadMesh::feature : remesh::QuadMesh::free, on_border_[cell], 1);
      out.tail.push_back(vertex[cell]);
      const std::int32_t p = root(piece_parent_, sides_[h]);
      out.feature[h] = feature_[p];
      if (first[p] == none) {
        first[p] = h;
      } else {
        if (out.twin[first[p]] != none) fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "an edge has three quads");
        out.join(first[p], h);
      }
    }
    out.split_fans(memory_);
    if (s_.first_apex < s_.vertex_count()) {  // there are borders
      find_regions();
      if (bridge_walls(out)) out.split_fans(memory_);
      find_holes(out);
    }
    return out;
  }

  // Finds the lines that cross others. A line without a crossing makes no quad, so it separates nothing: its two sides
  // are one region.
  void find_regions() {
    crossing_.assign(piece_parent_.size(), 0);
    for (const std::int32_t p : sides_) crossing_[root(piece_parent_, p)] = 1;
    region_ = parent_;
    for (std::int32_t t = 0; t < s_.real_triangles; ++t) {
      const Cells& cells = cells_[t];
      for (std::int32_t i = cells.u; i < cells.u + cells.columns; ++i) {
        const std::int32_t column = cells.column + (i - cells.u), next = column + 1;
        const std::int32_t low = low_[column], high = low + first_[next] - first_[column];
        for (std::int32_t j = low; j < high; ++j) {
          const bool beside =
              i + 1 < cells.u + cells.columns && j >= low_[next] && j < low_[next] + first_[next + 1] - first_[next];
          if (beside && !crossing_[root(piece_parent_, piece(t, i, j, 0))])
            unite(region_, number(t, i, j), number(t, i + 1, j));
          if (j + 1 < high && !crossing_[root(piece_parent_, piece(t, i, j, 1))])
            unite(region_, number(t, i, j), number(t, i, j + 1));
        }
      }
    }
  }

  // Where a wall between two borders is narrower than the lines are apart, one region reaches both borders and has
  // quads at its two ends only. Two quads join them, (a, i, o, b) and (a, b, i', o'). The vertices a and b of the
  // region are at the ends. The vertices i and o are before and after them on the borders.
  bool bridge_walls(QuadComplex& out) {
    remesh::Table<std::int32_t> of(memory_);  // regions
    remesh::Table<std::int32_t> first(parent_.size(), none, memory_), second(first), count(parent_.size(), 0, memory_);
    for (std::int32_t h = 0; h < corners_.size(); ++h) {
      if (out.twin[h] != none) continue;
      const std::int32_t c = root(region_, corners_[h]);
      (count[c]++ == 0 ? first : second)[c] = h;
      if (count[c] == 2) of.push_back(c);
    }
    bool any = false;
    for (const std::int32_t c : of) {
      if (count[c] != 2) continue;
      const std::int32_t leave[2] = {first[c], second[c]};
      std::int32_t enter[2];
      for (int k = 0; k < 2; ++k) {
        enter[k] = QuadComplex::previous(leave[k]);
        while (out.twin[enter[k]] != none) enter[k] = QuadComplex::previous(out.twin[enter[k]]);
      }
      // The wall beside may have taken a side, or one side leads from end to end, or back to its own end.
      const std::int32_t sides[4] = {enter[0], enter[1], leave[0], leave[1]};
      bool free = true;
      for (int k = 0; k < 4; ++k) {
        free &= out.twin[sides[k]] == none;
        for (int j = 0; j < k; ++j) free &= sides[k] != sides[j];
      }
      if (!free) continue;
      const std::int32_t a = out.tail[leave[0]], b = out.tail[leave[1]], q = out.tail.size();
      for (const std::int32_t v :
           {a, out.tail[enter[0]], out.head(leave[1]), b, a, b, out.tail[enter[1]], out.head(leave[0])}) {
        out.tail.push_back(v);
        out.twin.push_back(none);
        out.feature.push_back(0);
      }
      out.join(q, enter[0]);
      out.join(q + 2, leave[1]);
      out.join(q + 3, q + 4);
      out.join(q + 5, enter[1]);
      out.join(q + 7, leave[0]);
      out.feature[q + 1] = out.feature[q + 6] = 1;
      for (const std::int32_t h : sides) out.feature[h] = 0;
      out.vertices.pinned[a] = out.vertices.pinned[b] = remesh::QuadMesh::free;
      any = true;
    }
    return any;
  }

  // Notes the borders that only lines without a crossing reach: the quads of the region close such a hole.
  void find_holes(QuadComplex& out) {
    remesh::Table<std::int32_t> leaving(parent_.size(), none, memory_);  // by region
    for (std::int32_t h = 0; h < corners_.size(); ++h) leaving[root(region_, corners_[h])] = h;
    remesh::Table<std::uint8_t> seen(3 * s_.real_triangles, 0, memory_), reached(seen);  // by half-edge
    for (const BorderLine& line : border_lines_) reached[line.half] |= crossing_[root(piece_parent_, line.piece)];
    for (std::int32_t start = 0; start < seen.size(); ++start) {
      if (seen[start] || s_.is_real(s_.twin[start])) continue;
      bool crossed = false;
      for (std::int32_t h = start; !seen[h];) {
        seen[h] = 1;
        crossed |= reached[h] != 0;
        h = remesh::FluxSurface::next(h);
        while (s_.is_real(s_.twin[h])) h = remesh::FluxSurface::next(s_.twin[h]);
      }
      if (crossed) continue;
      const std::int32_t c = root(region_, number(start / 3, cell_of(map_.u[start]), cell_of(map_.v[start])));
      if (leaving[c] != none) out.holes.push_back({leaving[c], start});
    }
  }

  // How good a place of a vertex is; the best is taken.
  static constexpr std::uint8_t at_edge_ = 1, at_turned_point_ = 2, at_point_ = 3, at_border_ = 4, at_feature_ = 5;
  const remesh::FluxSurface& s_;
  const GridMap& map_;
  const remesh::Table<std::uint8_t>& features_;
  std::int32_t& backward_;
  Memory& memory_;
  const std::int64_t half_;
  remesh::Table<Cells> cells_;
  remesh::Table<std::int32_t> first_, low_;  // by column of a triangle: its first number and its lowest row
  remesh::Table<std::int32_t> parent_, piece_parent_, line_start_;  // by cell, by piece of a line, by half-edge
  remesh::Table<std::uint8_t> lines_;
  remesh::Table<remesh::SurfacePoint> place_;
  remesh::Table<std::uint8_t> quality_, on_border_;
  remesh::Table<std::int32_t> corners_, sides_;  // cells and pieces of lines, four by quad
  remesh::Table<std::uint8_t> feature_;          // by piece of a line: whether it crosses a feature edge
  struct BorderLine {
    std::int32_t half, piece;
  };
  remesh::Table<BorderLine> border_lines_;  // where lines end at borders: the half-edge and the piece
  remesh::Table<std::uint8_t> crossing_;    // by first piece of a line: whether it is a side of a quad
  remesh::Table<std::int32_t> region_;      // by cell
};

}  // namespace

QuadComplex extract_quads(const remesh::FluxSurface& surface, const GridMap& map,
                          const remesh::Table<std::uint8_t>& features, std::int32_t& backward, Memory& memory) {
  return Extractor(surface, map, features, backward, memory).run();
}

}  // namespace hf_inner::quads
