// Borders and narrow openings of HF_TRANSFER_STRETCH (gradients.h).
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "transfer/alignment.h"
#include "transfer/constants.h"
#include "transfer/gradients.h"

namespace hf_inner::transfer {

Vec3 Gradients::Place::of(const Vec3* points) const noexcept {
  Vec3 sum;
  for (std::size_t i = 0; i < count; ++i) sum = sum + share[i] * points[vertex[i]];
  return sum;
}

Mat3 Gradients::Place::of(const Mat3* matrices) const noexcept {
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += share[i] * matrices[vertex[i]];
  return sum;
}

void Gradients::Place::add(std::int32_t v, double s) noexcept {
  vertex[count] = v;
  share[count++] = s;
}

// Finds the pairs of places across openings that both surfaces have. A vertex at the far end of one starts no other.
void Gradients::find_openings(const surface::Core& source, const surface::Core& target, const Border& from,
                              const Border& to, Memory& memory) {
  const Vector<std::uint8_t>& on_border = matches_.on_border;
  openings_.clear();
  Vector<Opening> lone(&memory);
  const Span<const std::int32_t> vertices = to.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::size_t v = at(vertices[i]);
    if (!on_border[v]) continue;
    const std::int32_t own = to.edges_at(i)[0];
    const Border::Place here{own, to.first(own) == vertices[i] ? 0.0 : 1.0};
    const Border::Place there = to.facing(target.mesh.positions[v], to.outward(here), widest_opening);
    if (there.edge < 0) continue;
    const std::int32_t a = to.first(there.edge), b = to.second(there.edge);
    if (target.mesh.component[at(a)] != target.mesh.component[v]) continue;
    if (!on_border[at(a)] || !on_border[at(b)]) continue;
    Opening opening;
    const auto add_match = [&](Place& place, std::int32_t vertex, double share) {
      for (std::size_t c = 3 * at(vertex); c < 3 * at(vertex) + 2; ++c)
        place.add(matches_.corner[c], share * matches_.share[c]);
    };
    opening.target[0].add(vertices[i], 1);
    add_match(opening.source[0], vertices[i], 1);
    const double shares[2] = {1 - there.share, there.share};
    for (int k = 0; k < 2; ++k) {
      const std::int32_t vertex = k == 0 ? a : b;
      opening.target[1].add(vertex, shares[k]);
      add_match(opening.source[1], vertex, shares[k]);
      add_match(opening.edge[k], vertex, 1);
    }
    // Both ends may have come to lie on one side of the source's border.
    const Vec3* places = source.mesh.positions.data();
    const Vec3 gap = opening.source[1].of(places) - opening.source[0].of(places);
    Vec3 outward[2];
    for (int side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < opening.source[side].count; ++k)
        outward[side] = outward[side] + opening.source[side].share[k] * from.outward(opening.source[side].vertex[k]);
    const double least = facing_cosine * norm(gap);
    const bool faces = norm(gap) > least_gap && dot(gap, outward[0]) >= least && -dot(gap, outward[1]) >= least;
    (faces ? openings_ : lone).push_back(opening);
  }
  const auto thin = [](Vector<Opening>& list, std::size_t most) {
    const std::size_t step = (list.size() + most - 1) / std::max<std::size_t>(most, 1);
    std::size_t kept = 0;
    for (std::size_t i = 0; step > 0 && i < list.size(); i += step) list[kept++] = list[i];
    list.resize(most > 0 ? kept : 0);
  };
  thin(openings_, most_openings);
  thin(lone, most_openings - openings_.size());
  const std::size_t matched = openings_.size();
  const Vec3* targets = target.mesh.positions.data();
  for (Opening& opening : lone) {
    double nearest = 4 * widest_opening * widest_opening;
    for (std::size_t i = 0; i < matched; ++i) {
      const Vec3 d = openings_[i].target[0].of(targets) - opening.target[0].of(targets);
      if (target.mesh.component[at(openings_[i].target[0].vertex[0])] !=
              target.mesh.component[at(opening.target[0].vertex[0])] ||
          !(dot(d, d) < nearest))
        continue;
      nearest = dot(d, d);
      opening.like = static_cast<std::int32_t>(i);
    }
    if (opening.like >= 0) openings_.push_back(opening);
  }
  open_share_.assign(openings_.size(), 1.0);
}

// Factorises B A^-1 B' plus the give of each constraint; B has a row for each opening.
void Gradients::factorise_openings(const surface::Core& factor, Memory& memory) {
  const std::size_t count = openings_.size();
  forces_.assign(4 * count, 0.0);
  if (count == 0) return;
  const Span<const std::int32_t> position = factor.factor->position();
  const std::size_t n = at(factor.unknown_count()), width = static_cast<std::size_t>(opening_channels);
  Buffer<double> matrix(memory, count * count);
  surface::Workspace z(factor.workspaces, width * n);
  for (std::size_t first = 0; first < count; first += width) {
    const std::size_t channels = std::min(width, count - first);
    std::fill(z.data(), z.data() + channels * n, 0.0);
    const auto row_of = [&](std::int32_t v) { return z.data() + channels * at(position[at(v)]); };
    for (std::size_t k = 0; k < channels; ++k) {
      for (int side = 0; side < 2; ++side) {
        const Place& ends = openings_[first + k].target[side];
        for (std::size_t c = 0; c < ends.count; ++c) row_of(ends.vertex[c])[k] += (side == 0 ? 1 : -1) * ends.share[c];
      }
    }
    factor.factor->solve_in_order(z.data(), static_cast<std::int32_t>(channels), *factor.jobs);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < channels; ++k) {
        const auto value = [&](const Place& ends) {
          double sum = 0;
          for (std::size_t c = 0; c < ends.count; ++c) sum += ends.share[c] * row_of(ends.vertex[c])[k];
          return sum;
        };
        matrix[i * count + first + k] = value(openings_[i].target[0]) - value(openings_[i].target[1]);
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) matrix[i * count + i] *= 1 + opening_give;
  opening_factor_.factorise(std::move(matrix), static_cast<std::int32_t>(count), memory);
}

// The gap that an opening should have. own, still: the target's gap and the source's as the gradients alone change
// them.
Vec3 Gradients::opening_goal(Vec3 own, Vec3 still, Vec3 now, double scale, Vec3 axis) const noexcept {
  const double length = norm(own), from = norm(still), to = norm(now);
  if (!(from > least_gap && length > least_gap)) return own + scale * (now - still);
  if (to == 0) return {};
  const double closed = std::min(1.0, from / to);
  return (closed * length / from) * deform::rotate(minimal_rotation(still, own, axis), now) +
         (scale * (1 - closed)) * now;
}

// How far an opening's gap must change. `along` is the direction of the target's border at the far end. The gap across
// it is carried by itself, so that lids that touch on the source touch on the target wherever they touch. Sets
// open_share: the width of the gap across, as a share of the width that the gradients alone would give.
Vec3 Gradients::opening_miss(const Opening& opening, const Frame& frame, const Mat3& axes, Vec3 gap, Vec3 along,
                             double& open_share) const noexcept {
  const auto across = [](Vec3 v, Vec3 direction) { return v - dot(v, direction) * direction; };
  const Vec3 *target = frame.target->mesh.positions.data(), *source = frame.source->mesh.positions.data();
  const Mat3 gradient = 0.5 * (opening.target[0].of(blended_.data()) + opening.target[1].of(blended_.data()));
  const Vec3 own = gradient * (opening.target[0].of(target) - opening.target[1].of(target));
  const Vec3 own_part = across(own, along);
  if (opening.like >= 0) {
    open_share = open_share_[at(opening.like)];
    return across(open_share * own - gap, along);
  }
  const Vec3 edge = unit_vector(axes * (opening.edge[1].of(frame.posed) - opening.edge[0].of(frame.posed)));
  const Vec3 still = gradient * (axes * (opening.source[0].of(source) - opening.source[1].of(source)));
  const Vec3 now = axes * (opening.source[0].of(frame.posed) - opening.source[1].of(frame.posed));
  const Vec3 whole = opening_goal(own, still, now, frame.scale, along);
  const Vec3 part = across(opening_goal(own_part, across(still, edge), across(now, edge), frame.scale, along), along);
  const double length = norm(own_part);
  open_share = length > least_gap ? norm(part) / length : 1.0;
  return dot(whole, along) * along + part - gap;
}

void Gradients::hold_openings(const Frame& frame, double* z) {
  if (openings_.empty()) return;
  const surface::Core& factor = *frame.factor;
  const Span<const std::int32_t> position = factor.factor->position();
  const Mat3 axes = frame.axes.toRotationMatrix();
  const auto place = [&](const Place& ends) {
    Vec3 sum;
    for (std::size_t c = 0; c < ends.count; ++c) {
      const double* row = z + 3 * at(position[at(ends.vertex[c])]);
      sum = sum + ends.share[c] * Vec3{row[0], row[1], row[2]};
    }
    return sum;
  };
  for (std::size_t i = 0; i < openings_.size(); ++i) {
    const Opening& opening = openings_[i];
    const Place& far = opening.target[1];
    const auto at_vertex = [&](std::size_t c) {
      const double* row = z + 3 * at(position[at(far.vertex[c])]);
      return Vec3{row[0], row[1], row[2]};
    };
    const Vec3 miss = opening_miss(opening, frame, axes, place(opening.target[0]) - place(far),
                                   unit_vector(at_vertex(1) - at_vertex(0)), open_share_[i]);
    forces_[4 * i] = miss.x;
    forces_[4 * i + 1] = miss.y;
    forces_[4 * i + 2] = miss.z;
    forces_[4 * i + 3] = 0;
  }
  opening_factor_.solve(forces_.data());
  const std::size_t numbers = 3 * at(factor.unknown_count());
  surface::Workspace moved(factor.workspaces, numbers);
  std::fill(moved.data(), moved.data() + numbers, 0.0);
  for (std::size_t i = 0; i < openings_.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      const Place& ends = openings_[i].target[side];
      for (std::size_t k = 0; k < ends.count; ++k)
        for (std::size_t c = 0; c < 3; ++c)
          moved[3 * at(position[at(ends.vertex[k])]) + c] += (side == 0 ? 1 : -1) * ends.share[k] * forces_[4 * i + c];
    }
  }
  factor.factor->solve_in_order(moved.data(), 3, *factor.jobs);
  for (std::size_t i = 0; i < numbers; ++i) z[i] += moved[i];
}

}  // namespace hf_inner::transfer
