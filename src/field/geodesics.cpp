#include "field/geodesics.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "field/spread.h"

namespace hf_inner::field {
namespace {

// Sources that one sweep solves together: trades passes over the factor for scratch memory of so many numbers per
// vertex. The sweeps have the same number (channel_block). Half and double move mean distances by 2e-15 on seven
// shapes.
constexpr Index group_size = 8;
// Triangles of one thread's job. Half and double take the same time within 2 % (torus of 102,400 vertices, two
// threads).
constexpr std::int64_t piece = 8192;
// The heat's time step is at least the square of this length (in box diagonals). With a smaller step, the heat at the
// far end would be too small for a double. More smooths distances: at twice the value those on a finely refined
// cylinder move by 1.6 %, and its mean distance by 7 %. Half changes no bit on seven shapes.
constexpr double least_step = 1.0 / 250;
// A vertex's area counts as at least this share of the mean. A vertex without area needs a positive diagonal. It is a
// guard: half and double change no bit on seven shapes.
constexpr double least_mass = 1e-12;
// A triangle with less area over its squared length is left out of the distance; rounding decides the direction of its
// gradient. Half and double change no bit on seven shapes.
constexpr double least_height = 1e-9;

// Shares of progress of a mean distance: its sources are spread, the distances are summed, the sum is integrated.
constexpr float progress_spread = 0.2f, progress_averaged = 0.9f;

double mean_edge(const surface::Core& core) noexcept {
  double sum = 0;
  for (Index e = 0; e < core.topology().edge_count(); ++e)
    sum += norm(core.mesh.positions[at(core.topology().first(e))] - core.mesh.positions[at(core.topology().second(e))]);
  return sum / std::max(1, core.topology().edge_count());
}

}  // namespace

Geodesics::Geodesics(std::shared_ptr<const surface::Core> core, double smoothing)
    : core_(std::move(core)), frames_(core_->memory.get()) {
  const surface::Core& c = *core_;
  const double h = mean_edge(c), least = least_step;
  const double step = std::max(smoothing * h * h, least * least);
  SymmetricMatrix matrix = surface::grounded(c);
  // A vertex without area still needs a positive diagonal.
  const double floor = least_mass / std::max(1, c.size());
  for (std::size_t v = 0; v < at(c.size()); ++v) {
    for (Index i = c.matrix().column_start[v]; i < c.matrix().column_start[v + 1]; ++i) {
      matrix.value[at(i)] = step * c.matrix().value[at(i)];
      if (at(c.matrix().row[at(i)]) == v) matrix.value[at(i)] += std::max(c.areas[v], floor);
    }
  }
  heat_ = c.factor->refactor(matrix, {}, *c.memory, *c.jobs);
  make_frames();
}

// Sorts the triangles by their largest row in the factor. Consecutive triangles then read heat from nearby memory.
void Geodesics::make_frames() {
  const mesh::Mesh& mesh = core_->mesh;
  const Span<const Index> position = heat_->position();
  const auto largest_row = [&](Index t) {
    const Index* v = mesh.triangle(t);
    return std::max({position[at(v[0])], position[at(v[1])], position[at(v[2])]});
  };
  Vector<Index> start(at(core_->size()) + 1, 0, core_->memory.get()),
      order(at(mesh.triangle_count()), core_->memory.get());
  for (Index t = 0; t < mesh.triangle_count(); ++t) ++start[at(largest_row(t)) + 1];
  for (std::size_t row = 0; row + 1 < start.size(); ++row) start[row + 1] += start[row];
  for (Index t = 0; t < mesh.triangle_count(); ++t) order[at(start[at(largest_row(t))]++)] = t;
  frames_.reserve(order.size());
  for (const Index t : order) {
    const Index* v = mesh.triangle(t);
    const Vec3 a = mesh.positions[at(v[0])], e1 = mesh.positions[at(v[1])] - a, e2 = mesh.positions[at(v[2])] - a;
    const Vec3 n = cross(e1, e2);
    const double along = std::sqrt(dot(e1, e1)), area2 = std::sqrt(dot(n, n));
    if (!(area2 > least_height * along * along)) continue;
    frames_.push_back({along,
                       dot(e1, e2) / along,
                       area2 / along,
                       {position[at(v[0])], position[at(v[1])], position[at(v[2])]},
                       mesh.component[at(v[0])]});
  }
}

// Sums the unit directions X of falling heat in each triangle t over the channels, with weights. The result is added to
// sums[2 t] and sums[2 t + 1], in the frame of the triangle. The array `heat` has the index row * channels + c, with
// rows in factor order. The array `weights` has the index component * channels + c.
void Geodesics::add_directions(const double* heat, Index channels, const double* weights, Vector<double>& sums) const {
  const DirectionSums job = {frames_.data(), heat, weights, channels, sums.data()};
  const std::int64_t count = static_cast<std::int64_t>(frames_.size());
  core_->jobs->for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
    hf_inner::field::add_directions(job, p * piece, std::min(count, (p + std::int64_t{1}) * piece));
  });
}

// Solves K d = b for the distance d. The entry b_i is a sum over the triangles at vertex i. Each triangle adds the dot
// product of X and n x e_i, divided by 2. Here X is the unit direction in the triangle, n its normal, and e_i its edge
// opposite to i.
void Geodesics::integrate(const Vector<double>& sums, double* out) const {
  const factor::Factor& factor = *core_->factor;  // it has the rows of the heat: one ordering
  const Span<const Index> position = factor.position();
  surface::Workspace z(core_->workspaces, at(core_->size()));
  std::fill_n(z.data(), at(core_->size()), 0.0);
  for (std::size_t t = 0; t < frames_.size(); ++t) {
    const TriangleFrame& f = frames_[t];
    const double x = 0.5 * sums[2 * t], y = 0.5 * sums[2 * t + 1];
    // Adds to each corner half the dot product of X and n x e. X is the direction of falling heat, n the triangle's
    // normal, and e the edge opposite to the corner.
    z[at(f.row[0])] += -f.py * x + (f.px - f.along) * y;
    z[at(f.row[1])] += f.py * x - f.px * y;
    z[at(f.row[2])] += f.along * y;
  }
  factor.solve_in_order(z.data(), 1, *core_->jobs);
  for (Index v = 0; v < core_->size(); ++v) out[v] = z[at(position[at(v)])];
}

void Geodesics::distance(Span<const Index> sources, double* out) const {
  const surface::Core& core = *core_;
  const std::size_t n = at(core.size()), components = at(core.mesh.component_count());
  const Span<const Index> position = heat_->position();
  Vector<double> sums(2 * frames_.size(), 0.0, core.memory.get());
  const Vector<double> ones(components, 1.0, core.memory.get());
  {
    surface::Workspace heat(core.workspaces, n);
    std::fill_n(heat.data(), n, 0.0);
    for (const Index s : sources) heat[at(position[at(s)])] = 1;
    heat_->solve_in_order(heat.data(), 1, *core.jobs);
    add_directions(heat.data(), 1, ones.data(), sums);
  }
  integrate(sums, out);
  // Shifts the distance of each component so that its mean over the sources is zero.
  Vector<double> offset(components, 0.0, core.memory.get()), count(components, 0.0, core.memory.get());
  for (const Index s : sources) {
    offset[at(core.mesh.component[at(s)])] += out[s];
    count[at(core.mesh.component[at(s)])] += 1;
  }
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t c = at(core.mesh.component[v]);
    out[v] = count[c] > 0 ? std::max(0.0, out[v] - offset[c] / count[c]) : -1.0;
  }
  for (const Index s : sources) out[s] = 0;
}

void Geodesics::average(Index count, double* out) const {
  const surface::Core& core = *core_;
  Memory& memory = *core.memory;
  const std::size_t n = at(core.size()), components = at(core.mesh.component_count());
  const SpreadSamples samples = spread_samples(core.mesh, core.topology(), core.areas, count, memory);
  report(progress_spread);
  Vector<double> sums(2 * frames_.size(), 0.0, &memory);
  surface::Workspace heat(core.workspaces, n * at(group_size));
  for (Index first = 0; first < count; first += group_size) {
    const Index channels = std::min(group_size, count - first);
    // Each channel has one source of heat in every component.
    Vector<Index> start(1, 0, &memory), row(&memory), group_of(at(channels), &memory), column_of(at(channels), &memory);
    Vector<double> value(&memory), weights(components * at(channels), 0.0, &memory);
    for (Index k = 0; k < channels; ++k) {
      for (std::size_t c = 0; c < components; ++c) {
        const std::size_t i = c * at(count) + at(first + k);
        if (samples.vertex[i] == mesh::Mesh::none) continue;
        row.push_back(samples.vertex[i]);
        value.push_back(1);
        weights[c * at(channels) + at(k)] = samples.share[i];
      }
      start.push_back(static_cast<Index>(row.size()));
    }
    Vector<std::shared_ptr<const factor::PathGroup>> groups(&memory);
    heat_->solve_paths({start, row, value}, memory, *core.jobs, groups, group_of, column_of);
    std::fill_n(heat.data(), n * at(channels), 0.0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      Vector<double> identity(at(groups[g]->count()) * at(channels), 0.0, &memory);
      for (Index k = 0; k < channels; ++k) {
        if (at(group_of[at(k)]) == g) identity[at(column_of[at(k)]) * at(channels) + at(k)] = 1;
      }
      heat_->combine(*groups[g], identity.data(), channels, heat.data());
    }
    heat_->backward(heat.data(), channels, *core.jobs);
    add_directions(heat.data(), channels, weights.data(), sums);
    report(progress_spread +
           (progress_averaged - progress_spread) * static_cast<float>(first + channels) / static_cast<float>(count));
  }
  integrate(sums, out);
  report(1.0f);
}

}  // namespace hf_inner::field
