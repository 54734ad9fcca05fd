#include "peers/paper_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "base/elementary.h"

namespace hf_inner::peers {
namespace {

// Level bands per handle's field, linear and of equal value.
constexpr std::int32_t default_bands = 12;
// Iterations per frame: motion moves on by only one level band per iteration.
constexpr std::uint32_t default_iterations = 200;
// At most this many iterations while the handles stay in place: hundreds are needed to converge. A bound: half and
// double change no bit of a tube's poses, whose motion settles before.
constexpr std::uint32_t idle_limit = 2000;
// Sampled vertices that give a cluster of vertices its motion: fewer take less time. With 240, elastic energies in the
// benchmark fall by 7 to 11 %.
constexpr std::int32_t samples_per_cluster = 40;

// The vertices of each free cluster (piece of a level band, no handle), with their weights.
struct Members {
  Vector<std::int32_t> start, vertex;
  Vector<double> weight;
  Members(const deform::ClusterWeights& weights, std::int32_t vertex_count, Memory& memory)
      : start(weights.free_count() + 1, 0, &memory), vertex(&memory), weight(&memory) {
    const auto for_entries = [&](auto&& use) {
      for (std::int32_t v = 0; v < vertex_count; ++v) {
        for (std::int32_t k = weights.start[v]; k < weights.start[v + 1]; ++k) {
          if (weights.cluster[k] >= weights.handle_count)
            use(v, weights.cluster[k] - weights.handle_count, weights.weight[k]);
        }
      }
    };
    for_entries([&](std::int32_t, std::int32_t f, double) { ++start[f + 1]; });
    for (std::size_t f = 0; f + 1 < start.size(); ++f) start[f + 1] += start[f];
    vertex.resize(start.back());
    weight.resize(start.back());
    Vector<std::int32_t> next(start, &memory);
    for_entries([&](std::int32_t v, std::int32_t f, double w) {
      vertex[next[f]] = v;
      weight[next[f]++] = w;
    });
  }
};

// Matches the shape of one cluster: returns the rigid motion that takes its sampled vertices from rest nearest to
// `position_of(sample)`.
template <class PositionOf>
deform::RigidMotion match_shape(const PaperSystem& system, const mesh::Mesh& mesh, std::int32_t f,
                                const deform::Quaternion& near, PositionOf&& position_of) noexcept {
  double sum = 0;
  Vec3 rest_centre, centre;
  for (std::int32_t k = system.cluster_start[f]; k < system.cluster_start[f + 1]; ++k) {
    const PaperSystem::Member& m = system.member[k];
    sum += m.weight;
    rest_centre = rest_centre + m.weight * mesh.positions[system.sample[m.sample]];
    centre = centre + m.weight * position_of(m.sample);
  }
  if (!(sum > 0)) return {near, {}};
  rest_centre = (1.0 / sum) * rest_centre;
  centre = (1.0 / sum) * centre;
  Mat3 s;
  for (std::int32_t k = system.cluster_start[f]; k < system.cluster_start[f + 1]; ++k) {
    const PaperSystem::Member& m = system.member[k];
    deform::add_outer(s, m.weight, position_of(m.sample) - centre,
                      mesh.positions[system.sample[m.sample]] - rest_centre);
  }
  deform::RigidMotion motion;
  motion.rotation = deform::best_rotation_from(s, near);
  motion.translation = centre - deform::rotate(motion.rotation, rest_centre);
  return motion;
}

// Writes the motion of free cluster f as an iterate of seven numbers, and its distance to the fit as their residual.
void note_motion(const deform::RigidMotion& now, const deform::RigidMotion& fit, std::size_t f,
                 PaperState& state) noexcept {
  double *z = state.iterate.data() + 7 * f, *r = state.residual.data() + 7 * f;
  const double sign = fit.rotation.dot(now.rotation) < 0 ? -1.0 : 1.0;
  for (int i = 0; i < 4; ++i) {
    z[i] = now.rotation.coeffs()[i];
    r[i] = sign * fit.rotation.coeffs()[i] - now.rotation.coeffs()[i];
  }
  const Vec3 t = now.translation, step = fit.translation - now.translation;
  z[4] = t.x;
  z[5] = t.y;
  z[6] = t.z;
  r[4] = step.x;
  r[5] = step.y;
  r[6] = step.z;
}

deform::RigidMotion noted_motion(const PaperState& state, std::size_t f) noexcept {
  const double* z = state.iterate.data() + 7 * f;
  return {deform::normalised(deform::Quaternion({z[0], z[1], z[2]}, z[3])), {z[4], z[5], z[6]}};
}

}  // namespace

PaperSystem::PaperSystem(const surface::Core& core, const deform::ClusterWeights& weights, Memory& memory)
    : handle_count(weights.handle_count),
      free_count(weights.free_count()),
      sample(&memory),
      cluster_start(&memory),
      member(&memory) {
  const mesh::Mesh& mesh = core.mesh;
  const Members members(weights, core.size(), memory);
  Vector<std::int32_t> number(core.size(), -1, &memory);
  Vector<double> distance(&memory);
  cluster_start.push_back(0);
  for (std::int32_t f = 0; f < free_count; ++f) {
    // Farthest-point sampling of the cluster's vertices. The first sample is the vertex with the largest weight.
    const std::int32_t first = members.start[f], count = members.start[f + 1] - first;
    distance.assign(count, std::numeric_limits<double>::infinity());
    auto next = std::max_element(members.weight.begin() + first, members.weight.begin() + first + count) -
                (members.weight.begin() + first);
    for (std::int32_t taken = 0; taken < std::min(count, samples_per_cluster); ++taken) {
      const std::int32_t v = members.vertex[first + next];
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(sample.size());
        sample.push_back(v);
      }
      member.push_back({number[v], members.weight[first + next]});
      for (std::int32_t k = 0; k < count; ++k) {
        const Vec3 d = mesh.positions[members.vertex[first + k]] - mesh.positions[v];
        distance[k] = std::min(distance[k], dot(d, d));
      }
      distance[next] = -1;
      next = std::max_element(distance.begin(), distance.end()) - distance.begin();
    }
    cluster_start.push_back(static_cast<std::int32_t>(member.size()));
  }
}

void PaperState::fit(const PaperSystem& system) {
  motion.assign(system.free_count, deform::RigidMotion());
  position.assign(system.sample.size(), Vec3());
  const std::size_t size = 7 * static_cast<std::size_t>(system.free_count);
  iterate.assign(size, 0.0);
  residual.assign(size, 0.0);
  anderson.fit(size);
}

std::shared_ptr<deform::PoseScheme::State> PaperSystem::rest(Memory& memory) const {
  auto state = make_shared_in<PaperState>(memory, memory);
  state->fit(*this);
  return state;
}

void PaperSystem::fit(const mesh::Mesh& mesh, const Vec3* positions, deform::PoseScheme::State& state) const noexcept {
  for (std::int32_t f = 0; f < free_count; ++f)
    state.motion[f] =
        match_shape(*this, mesh, f, state.motion[f].rotation, [&](std::int32_t s) { return positions[sample[s]]; });
}

deform::SolveReport PaperSystem::solve(const mesh::Mesh& mesh, const deform::ClusterWeights& weights,
                                       std::uint32_t iterations, double tolerance, deform::PoseScheme::State& given,
                                       deform::Affine* transforms) const noexcept {
  PaperState& state = static_cast<PaperState&>(given);
  deform::SolveReport report;
  for (std::int32_t f = 0; f < free_count; ++f) transforms[handle_count + f] = deform::to_affine(state.motion[f]);
  if (free_count == 0) return report;
  state.anderson.forget();
  while (report.iterations < iterations) {
    ++report.iterations;
    report.last_change = 0;
    for (std::size_t s = 0; s < sample.size(); ++s)
      state.position[s] = deform::blend_vertex(mesh, weights, transforms, sample[s]);
    double moved = 0;
    for (std::int32_t f = 0; f < free_count; ++f) {
      const deform::RigidMotion& old = state.motion[f];
      const deform::RigidMotion fit =
          match_shape(*this, mesh, f, old.rotation, [&](std::int32_t s) { return state.position[s]; });
      const double turned = 2.0 * std::sqrt(2.0) * sine(0.5 * deform::angle_between(fit.rotation, old.rotation));
      report.last_change = std::max(report.last_change, turned);
      moved = std::max(moved, norm(fit.translation - old.translation));
      note_motion(old, fit, static_cast<std::size_t>(f), state);
    }
    state.anderson.step(state.iterate, state.residual, 7, deform::longest_leap);
    for (std::int32_t f = 0; f < free_count; ++f) {
      state.motion[f] = noted_motion(state, static_cast<std::size_t>(f));
      transforms[handle_count + f] = deform::to_affine(state.motion[f]);
    }
    if (std::max(report.last_change, moved) < tolerance) break;
  }
  return report;
}

namespace {

class PaperScheme final : public deform::PoseScheme {
 public:
  PaperScheme() noexcept : deform::PoseScheme(bands_of_paper(), peers::default_iterations, peers::idle_limit) {}
  std::shared_ptr<const System> prepare(const surface::Core& core, const deform::ClusterWeights& weights,
                                        Memory& memory) const override {
    return make_shared_in<PaperSystem>(memory, core, weights, memory);
  }

 private:
  static deform::BandOptions bands_of_paper() noexcept {
    deform::BandOptions options;
    options.band_count = default_bands;
    options.degree = 1;
    options.spacing = deform::BandSpacing::equal_value;
    return options;
  }
};

}  // namespace

std::shared_ptr<const deform::PoseScheme> paper_scheme() noexcept {
  // A static object with a destructor would be a call at the end of the process; this one holds nothing and stays.
  alignas(PaperScheme) static unsigned char room[sizeof(PaperScheme)];
  static const PaperScheme* const scheme = new (room) PaperScheme;
  return {std::shared_ptr<void>(), scheme};
}

}  // namespace hf_inner::peers
