// See matches.h.
#include "transfer/matches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/nearest_rows.h"
#include "transfer/warp.h"

namespace hf_inner::transfer {
namespace {

// Places in the common frame: axes to axes, in lengths of the target.
Vector<Vec3> common_places(const MatchSide& side, Memory& memory) {
  Vector<Vec3> out(&memory);
  for (const Vec3& x : side.core->mesh.positions) out.push_back(side.unit * (side.axes * x));
  return out;
}

Vector<Vec3> common_normals(const MatchSide& side, Memory& memory) {
  const mesh::Mesh& mesh = side.core->mesh;
  Vector<Vec3> out(mesh.positions.size(), Vec3(), &memory);
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t* c = mesh.triangle(t);
    const Vec3 n =
        cross(mesh.positions[at(c[1])] - mesh.positions[at(c[0])], mesh.positions[at(c[2])] - mesh.positions[at(c[0])]);
    for (int k = 0; k < 3; ++k) out[at(c[k])] = out[at(c[k])] + n;
  }
  for (Vec3& n : out) n = side.axes * unit_vector(n);
  return out;
}

// The point of a triangle nearest to a row, as the shares of the second and the third corner, and its squared distance.
struct TrianglePoint {
  double second = 0, third = 0, distance = 0;
};
TrianglePoint nearest_point(const double* row, const double* a, const double* b, const double* c, std::size_t width) {
  double ee = 0, ef = 0, ff = 0, ed = 0, fd = 0, dd = 0;
  for (std::size_t k = 0; k < width; ++k) {
    const double e = b[k] - a[k], f = c[k] - a[k], d = row[k] - a[k];
    ee += e * e;
    ef += e * f;
    ff += f * f;
    ed += e * d;
    fd += f * d;
    dd += d * d;
  }
  const auto distance = [&](double s, double t) {
    return std::max(0.0, dd - 2 * (s * ed + t * fd) + s * s * ee + 2 * s * t * ef + t * t * ff);
  };
  // Two unknowns, by hand: the determinant alone tells whether the triangle is flat.
  const double determinant = ee * ff - ef * ef;
  if (determinant > flat_triangle * ee * ff) {
    const double s = (ff * ed - ef * fd) / determinant, t = (ee * fd - ef * ed) / determinant;
    if (s >= 0 && t >= 0 && s + t <= 1) return {s, t, distance(s, t)};
  }
  TrianglePoint best{0, 0, dd};
  const auto take = [&](double s, double t) {
    const double d = distance(s, t);
    if (d < best.distance) best = {s, t, d};
  };
  if (ee > 0) take(std::clamp(ed / ee, 0.0, 1.0), 0);
  if (ff > 0) take(0, std::clamp(fd / ff, 0.0, 1.0));
  const double gg = ee - 2 * ef + ff;
  if (gg > 0) {
    const double t = std::clamp((ee - ef - ed + fd) / gg, 0.0, 1.0);
    take(1 - t, t);
  }
  return best;
}

// Vertices of a mesh, each the farthest from those before it. first: its start in `from`.
void farthest_points(const Vector<Vec3>& places, Span<const std::int32_t> from, std::size_t most,
                     Vector<std::int32_t>& out, Memory& memory) {
  Vector<double> distance(from.size(), std::numeric_limits<double>::infinity(), &memory);
  std::size_t next = 0;
  for (std::size_t k = 0; k < std::min(most, from.size()); ++k) {
    out.push_back(from[next]);
    const Vec3 at_next = places[at(from[next])];
    double farthest = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Vec3 d = places[at(from[i])] - at_next;
      distance[i] = std::min(distance[i], dot(d, d));
      if (distance[i] > farthest) {
        farthest = distance[i];
        next = i;
      }
    }
    if (!(farthest > 0)) return;
  }
}

// Matches vertices of the target with the source, by rows of coordinates.
class Matcher {
 public:
  Matcher(const MatchSide& source, const MatchSide& target, const Border& source_border, Memory& memory, Matches& out)
      : source_(source),
        target_(target),
        from_border_(source_border),
        width_(source.means.size() + 3),
        source_places_(common_places(source, memory)),
        target_places_(common_places(target, memory)),
        rows_(rows_of(source, source_places_, memory)),
        border_rows_(border_rows(source_border, memory)),
        tree_({rows_.data(), rows_.size()}, width_, memory),
        border_tree_({border_rows_.data(), border_rows_.size()}, width_, memory),
        start_(rows_.size() / width_ + 1, 0, &memory),
        list_(source.core->mesh.corners.size(), 0, &memory),
        out_(out) {
    const mesh::Mesh& mesh = source.core->mesh;
    for (const std::int32_t v : mesh.corners) ++start_[at(v) + 1];
    for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
    Vector<std::int32_t> next(start_, &memory);
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
      list_[at(next[at(mesh.corners[i])]++)] = static_cast<std::int32_t>(i / 3);
    const std::size_t count = target_places_.size();
    out.corner.assign(3 * count, 0);
    out.share.assign(3 * count, 0.0);
    out.on_border.assign(count, std::uint8_t{0});
  }

  // The coordinates of a target vertex at a warped place. row: width numbers.
  void fill_row(std::size_t v, Vec3 place, double* row) const noexcept {
    const std::size_t pairs = width_ - 3;
    for (std::size_t h = 0; h < pairs; ++h) row[h] = match_field_weight * target_.field[v * pairs + h];
    row[pairs] = place.x;
    row[pairs + 1] = place.y;
    row[pairs + 2] = place.z;
  }

  void match_inside(std::size_t v, const double* row) const noexcept {
    const mesh::Mesh& mesh = source_.core->mesh;
    const std::int32_t nearest = tree_.find(row);
    const double* base = rows_.data() + at(nearest) * width_;
    std::int32_t* corner = out_.corner.data() + 3 * v;
    double* share = out_.share.data() + 3 * v;
    corner[0] = corner[1] = corner[2] = nearest;
    share[0] = 1;
    share[1] = share[2] = 0;
    out_.on_border[v] = 0;
    double best = no_height;
    for (std::int32_t i = start_[at(nearest)]; i < start_[at(nearest) + 1]; ++i) {
      const std::int32_t* c = mesh.triangle(list_[at(i)]);
      // The nearest vertex comes first: where it is met exactly, its share is exactly 1.
      const int first = c[0] == nearest ? 0 : c[1] == nearest ? 1 : 2;
      const std::int32_t b = c[(first + 1) % 3], d = c[(first + 2) % 3];
      const TrianglePoint point =
          nearest_point(row, base, rows_.data() + at(b) * width_, rows_.data() + at(d) * width_, width_);
      if (!(point.distance < best)) continue;
      best = point.distance;
      corner[1] = b;
      corner[2] = d;
      share[0] = 1 - point.second - point.third;
      share[1] = point.second;
      share[2] = point.third;
    }
  }

  // Takes the nearest place of the source's border instead, where that is about as near.
  void match_border(std::size_t v, const double* row) const noexcept {
    if (border_rows_.empty()) return;
    double nearest = std::numeric_limits<double>::infinity(), best_share = 0;
    std::int32_t best = -1;
    for (const std::int32_t e : from_border_.edges_at(at(border_tree_.find(row)))) {
      const double *a = rows_.data() + at(from_border_.first(e)) * width_,
                   *b = rows_.data() + at(from_border_.second(e)) * width_;
      double ee = 0, ed = 0, square = 0;
      for (std::size_t k = 0; k < width_; ++k) {
        ee += (b[k] - a[k]) * (b[k] - a[k]);
        ed += (b[k] - a[k]) * (row[k] - a[k]);
      }
      const double share = ee > 0 ? std::clamp(ed / ee, 0.0, 1.0) : 0.0;
      for (std::size_t k = 0; k < width_; ++k) {
        const double d = a[k] + share * (b[k] - a[k]) - row[k];
        square += d * d;
      }
      if (square < nearest) {
        nearest = square;
        best = e;
        best_share = share;
      }
    }
    double free = 0;
    for (std::size_t k = 0; k < width_; ++k) {
      double x = -row[k];
      for (std::size_t i = 3 * v; i < 3 * v + 3; ++i)
        if (out_.share[i] > 0) x += out_.share[i] * rows_[at(out_.corner[i]) * width_ + k];
      free += x * x;
    }
    if (std::sqrt(nearest) > std::sqrt(free) + border_reach) return;
    out_.on_border[v] = 1;
    out_.corner[3 * v] = from_border_.first(best);
    out_.corner[3 * v + 1] = out_.corner[3 * v + 2] = from_border_.second(best);
    out_.share[3 * v] = 1 - best_share;
    out_.share[3 * v + 1] = best_share;
    out_.share[3 * v + 2] = 0;
  }

  Vec3 mix(std::size_t v, const Vector<Vec3>& by_vertex) const noexcept {
    Vec3 sum;
    for (std::size_t i = 3 * v; i < 3 * v + 3; ++i)
      if (out_.share[i] > 0) sum = sum + out_.share[i] * by_vertex[at(out_.corner[i])];
    return sum;
  }
  const Vector<Vec3>& source_places() const noexcept { return source_places_; }
  const Vector<Vec3>& target_places() const noexcept { return target_places_; }
  std::size_t width() const noexcept { return width_; }

 private:
  Vector<double> rows_of(const MatchSide& side, const Vector<Vec3>& places, Memory& memory) const {
    const std::size_t pairs = side.means.size();
    Vector<double> out(places.size() * width_, 0.0, &memory);
    for (std::size_t v = 0; v < places.size(); ++v) {
      double* row = out.data() + v * width_;
      for (std::size_t h = 0; h < pairs; ++h) row[h] = match_field_weight * side.field[v * pairs + h];
      row[pairs] = places[v].x;
      row[pairs + 1] = places[v].y;
      row[pairs + 2] = places[v].z;
    }
    return out;
  }
  Vector<double> border_rows(const Border& border, Memory& memory) const {
    const Span<const std::int32_t> vertices = border.vertices();
    Vector<double> out(vertices.size() * width_, 0.0, &memory);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      std::copy_n(rows_.data() + at(vertices[i]) * width_, width_, out.data() + i * width_);
    return out;
  }

  const MatchSide &source_, &target_;
  const Border& from_border_;
  std::size_t width_;
  Vector<Vec3> source_places_, target_places_;
  Vector<double> rows_, border_rows_;
  NearestRows tree_, border_tree_;
  Vector<std::int32_t> start_, list_;  // triangles by source vertex
  Matches& out_;
};

}  // namespace

void find_matches(const MatchSide& source, const MatchSide& target, const Border& source_border,
                  const Border& target_border, Memory& memory, Matches& out) {
  const Matcher matcher(source, target, source_border, memory, out);
  const std::size_t count = matcher.target_places().size(), width = matcher.width();
  Vector<std::uint8_t> is_border(count, std::uint8_t{0}, &memory);
  for (const std::int32_t v : target_border.vertices()) is_border[at(v)] = 1;

  Vector<Vec3> from(&memory), to(&memory);
  const auto add_pairs = [&] {
    from.clear();
    to.clear();
    for (std::size_t h = 0; h < source.means.size(); ++h) {
      from.push_back(target.axes * target.means[h]);
      to.push_back(source.unit * (source.axes * source.means[h]));
    }
  };
  add_pairs();
  Warp warp(memory);
  warp.fit({from.data(), from.size()}, {to.data(), to.size()}, warp_ridge);

  Vector<std::int32_t> samples(&memory), all(&memory);
  for (std::size_t v = 0; v < count; ++v) all.push_back(static_cast<std::int32_t>(v));
  farthest_points(matcher.target_places(), {all.data(), all.size()}, warp_samples, samples, memory);
  farthest_points(matcher.target_places(), target_border.vertices(), warp_border_samples, samples, memory);
  std::sort(samples.begin(), samples.end());
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  const Vector<Vec3> source_normals = common_normals(source, memory), target_normals = common_normals(target, memory);
  Vector<double> row(width, 0.0, &memory);
  for (std::int32_t round = 0; round < warp_rounds; ++round) {
    add_pairs();
    for (const std::int32_t sample : samples) {
      const std::size_t v = at(sample);
      const Vec3 x = matcher.target_places()[v], warped = warp(x);
      matcher.fill_row(v, warped, row.data());
      matcher.match_inside(v, row.data());
      if (is_border[v]) matcher.match_border(v, row.data());
      const Vec3 place = matcher.mix(v, matcher.source_places());
      if (is_border[v] && !out.on_border[v]) continue;
      if (norm(place - warped) > warp_reach) continue;
      if (dot(unit_vector(matcher.mix(v, source_normals)), target_normals[v]) < warp_cosine) continue;
      from.push_back(x);
      to.push_back(place);
    }
    warp.fit({from.data(), from.size()}, {to.data(), to.size()}, warp_ridge);
  }

  const std::size_t blocks = (count + owner_block - 1) / owner_block;
  Vector<double> rows(blocks * width, 0.0, &memory);
  target.core->jobs->for_each(static_cast<std::uint32_t>(blocks), [&](std::uint32_t block) {
    double* own = rows.data() + std::size_t{block} * width;
    for (std::size_t v = std::size_t{block} * owner_block; v < std::min(count, (std::size_t{block} + 1) * owner_block);
         ++v) {
      matcher.fill_row(v, warp(matcher.target_places()[v]), own);
      matcher.match_inside(v, own);
      if (is_border[v]) matcher.match_border(v, own);
    }
  });
}

}  // namespace hf_inner::transfer
