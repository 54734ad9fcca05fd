#include "deform/refine.h"

#include <algorithm>
#include <cmath>

#include "deform/constants.h"
#include "deform/rotation_batch.h"

namespace hf_inner::deform {
namespace {

Vec3 vec3_at(const Buffer<float>& list, std::int32_t v) noexcept {
  const float* x = list.data() + 3 * static_cast<std::size_t>(v);
  return {x[0], x[1], x[2]};
}

void set_vec3(Buffer<float>& list, std::int32_t v, Vec3 p) noexcept {
  float* x = list.data() + 3 * static_cast<std::size_t>(v);
  x[0] = static_cast<float>(p.x);
  x[1] = static_cast<float>(p.y);
  x[2] = static_cast<float>(p.z);
}

// Returns (a + b) v.
inline Vec3 times_sum(const Mat3& a, const Mat3& b, Vec3 v) noexcept {
  const double *m = a.data(), *n = b.data();
  const auto row = [&](int i) {
    return (m[i] + n[i]) * v.x + ((m[i + 3] + n[i + 3]) * v.y + (m[i + 6] + n[i + 6]) * v.z);
  };
  return {row(0), row(1), row(2)};
}

// Calls loop(first, last) for pieces of a list; null: of all vertices. vertex_at gives their vertices.
template <class Loop>
void for_listed(const RefineInput& input, const Vector<std::int32_t>* list, Loop&& loop) {
  for_vertex_pieces(*input.core.jobs, list ? static_cast<std::int32_t>(list->size()) : input.core.size(), loop);
}
inline std::int32_t vertex_at(const Vector<std::int32_t>* list, std::int32_t i) noexcept {
  return list ? (*list)[i] : i;
}

const Vector<std::int32_t>* moved_by(const RefineInput& input) noexcept {
  return input.limbs ? &input.limbs->vertex : nullptr;
}

}  // namespace

Mat3 linear_part(const Affine& affine) noexcept {
  Mat3 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = affine.a[i][j];
  }
  return m;
}

void add_ring(const surface::Core& core, const Rest& rest, const Vec3* positions, std::int32_t v, Mat3& sum) noexcept {
  const mesh::Topology& topology = core.topology();
  for (std::int32_t k = topology.neighbour_start[v]; k < topology.neighbour_start[v + 1]; ++k) {
    const std::int32_t u = topology.neighbour[k];
    add_outer(sum, rest.stiffness[topology.neighbour_edge[k]], positions[v] - positions[u],
              core.mesh.positions[v] - core.mesh.positions[u]);
  }
}

Refinement::Refinement(const surface::Core& core, Memory& memory)
    : memory_(&memory),
      rotation_(static_cast<std::size_t>(core.size()), Mat3::Zero(), &memory),
      field_(memory, 3 * static_cast<std::size_t>(core.size())),
      values_(&memory),
      relative_(&memory),
      along_(&memory),
      elastic_(core.mesh.component_count(), 0, &memory) {}

void Followed::lead(const Vec3* blended, const Vec3* surface) noexcept {
  forget();
  turned = false;
  for (std::size_t v = 0; 3 * v < correction.size(); ++v)
    set_vec3(correction, static_cast<std::int32_t>(v), surface[v] - blended[v]);
}

void Refinement::fit(std::int32_t slot_count, std::uint32_t steps, const Followed* followed) {
  values_.resize(3 * static_cast<std::size_t>(slot_count));
  if (followed) {
    blended_.reserve_at_least(*memory_, rotation_.size());
    begin_.reserve_at_least(*memory_, rotation_.size());
    relative_.resize(followed->rotation.size());
    along_.resize((rotation_.size() + vertex_piece - 1) / vertex_piece);
  }
  if (steps < 2) return;
  before_.reserve_at_least(*memory_, rotation_.size());
  last_.reserve_at_least(*memory_, rotation_.size());
}

void Refinement::fit_rotations(const RefineInput& input, const Vec3* positions) {
  const surface::Core& core = input.core;
  const SymmetricMatrix& k = core.matrix();
  const Vector<std::int32_t>* const list = input.limbs ? &input.limbs->around : nullptr;
  for_listed(input, list, [&](std::int32_t first, std::int32_t last) {
    RotationBatch batch;
    std::int32_t vertex[RotationBatch::lanes];
    int count = 0;
    const auto fit = [&] {
      best_rotations_from(batch, count);
      for (int l = 0; l < count; ++l) rotation_[vertex[l]] = batch.rotation(l).toRotationMatrix();
      count = 0;
    };
    for (std::int32_t i = first; i < last; ++i) {
      const std::int32_t v = vertex_at(list, i), owner = input.reach.owner[v];
      if (owner >= 0) {
        rotation_[v] = linear_part(input.transforms[owner]);
      } else if (elastic_[core.mesh.component[v]]) {
        const Vec3 x = positions[v], p = core.mesh.positions[v];
        double s[3][4] = {};
        for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
          const std::int32_t u = k.row[e];
          const double w = std::fmax(-k.value[e], 0.0);  // the diagonal has weight 0
          const Vec3 moved = w * (x - positions[u]), edge = p - core.mesh.positions[u];
          const double along[3] = {edge.x, edge.y, edge.z};
          for (int j = 0; j < 3; ++j) {
            s[j][0] += moved.x * along[j];
            s[j][1] += moved.y * along[j];
            s[j][2] += moved.z * along[j];
          }
        }
        batch.set_columns(count, s);
        batch.set_rotation(count, input.groups ? (*input.group_rotation)[input.groups->group_of[v]] : Quaternion());
        vertex[count++] = v;
        if (count == RotationBatch::lanes) fit();
      } else {
        rotation_[v] = Mat3::Identity();
      }
    }
    fit();
  });
}

// Computes the right-hand side b - K x, in the unit of the scaled mesh; with limbs only the rows of their vertices.
void Refinement::set_right_hand_side(const RefineInput& input, const Vec3* positions, double* load) {
  const surface::Core& core = input.core;
  const SymmetricMatrix& k = core.matrix();
  const double own_unit = 2.0 / core.mesh.scale;  // contains the 1/2 of the two rotations
  const Vector<std::int32_t>* const list = moved_by(input);
  for_listed(input, list, [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t i = first; i < last; ++i) {
      const std::int32_t v = vertex_at(list, i);
      Vec3 sum;
      if (elastic_[core.mesh.component[v]]) {
        for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
          const std::int32_t u = k.row[e];
          const Vec3 edge = core.mesh.positions[v] - core.mesh.positions[u];
          const Vec3 missing = times_sum(rotation_[v], rotation_[u], edge) - own_unit * (positions[v] - positions[u]);
          sum = sum - 0.5 * k.value[e] * missing;  // the diagonal adds nothing
        }
      }
      double* row = load + 3 * static_cast<std::size_t>(i);
      row[0] = sum.x;
      row[1] = sum.y;
      row[2] = sum.z;
    }
  });
}

void Refinement::begin_from_last(const RefineInput& input, Followed& followed, Vec3* positions) {
  const std::int32_t n = input.core.size();
  relative_.resize(followed.rotation.size());
  for (std::size_t c = 0; c < relative_.size(); ++c) {
    const Quaternion now = best_rotation(linear_part(input.transforms[c]), Quaternion());
    relative_[c] = followed.turned ? Quaternion(now * followed.rotation[c].conjugate()) : Quaternion();
    followed.rotation[c] = now;
  }
  followed.turned = true;
  for_vertex_pieces(*input.core.jobs, n, [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t v = first; v < last; ++v) {
      blended_[v] = positions[v];
      if (input.reach.owner[v] >= 0 || !elastic_[input.core.mesh.component[v]]) {  // after new handles
        set_vec3(followed.correction, v, {});
        set_vec3(followed.change, v, {});
        continue;
      }
      const Quaternion q = blended_rotation(input.weights, relative_, v);
      const Vec3 c = rotate(q, vec3_at(followed.correction, v)), m = rotate(q, vec3_at(followed.change, v));
      set_vec3(followed.correction, v, c);
      set_vec3(followed.change, v, m);
      positions[v] = positions[v] + c;
    }
  });
}

void Refinement::note_correction(const RefineInput& input, Followed& followed, const Vec3* positions) {
  const std::int32_t n = input.core.size();
  for_vertex_pieces(*input.core.jobs, n, [&](std::int32_t first, std::int32_t last) {
    double sum = 0;
    for (std::int32_t v = first; v < last; ++v) {
      const Vec3 c = positions[v] - blended_[v], m = c - vec3_at(followed.correction, v);
      sum += dot(positions[v] - begin_[v], m);
      set_vec3(followed.correction, v, c);
      set_vec3(followed.change, v, m);
    }
    along_[first / vertex_piece] = sum;
  });
  double along = 0;
  for (const double sum : along_) along += sum;
  if (along < 0) std::fill(followed.change.begin(), followed.change.end(), 0.0f);
}

void Refinement::apply(const RefineInput& input, std::uint32_t steps, Followed* followed, Vec3* positions) {
  if (input.weights.elastic_components.empty()) return;
  std::fill(elastic_.begin(), elastic_.end(), std::uint8_t{0});
  for (const std::int32_t c : input.weights.elastic_components) elastic_[c] = 1;
  if (!followed) return take_steps(input, steps, positions);
  begin_from_last(input, *followed, positions);
  for (std::uint32_t k = 0; k < steps; ++k) {
    for_vertex_pieces(*input.core.jobs, input.core.size(), [&](std::int32_t first, std::int32_t last) {
      for (std::int32_t v = first; v < last; ++v)
        begin_[v] = positions[v] = positions[v] + refine_momentum * vec3_at(followed->change, v);
    });
    step(input, positions);
    note_correction(input, *followed, positions);
  }
}

void Refinement::take_steps(const RefineInput& input, std::uint32_t steps, Vec3* positions) {
  const Vector<std::int32_t>* const list = moved_by(input);
  const double radius = 1 - refine_gap / steps;
  double weight = 1;
  for (std::uint32_t k = 0; k < steps; ++k) {
    if (steps > 1) {
      for_listed(input, list, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i) last_[vertex_at(list, i)] = positions[vertex_at(list, i)];
      });
    }
    step(input, positions);
    if (k > 0) {
      weight = k == 1 ? 2 / (2 - radius * radius) : 4 / (4 - radius * radius * weight);
      for_listed(input, list, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i) {
          const std::int32_t v = vertex_at(list, i);
          positions[v] = before_[v] + weight * (positions[v] - before_[v]);
        }
      });
    }
    before_.swap(last_);
  }
}

// Solves for the correction. The vertices around the handles already are where they belong, so it is zero there.
void Refinement::respond(const RefineInput& input, double* load) {
  if (!input.limbs) return input.sites.respond(load, nullptr, 3, field_.data(), values_.data());
  surface::Workspace scratch(input.core.workspaces, 3 * input.limbs->vertex.size());
  input.limbs->factor->solve(load, field_.data(), 3, scratch.data(), *input.core.jobs);
}

void Refinement::step(const RefineInput& input, Vec3* positions) {
  const surface::Core& core = input.core;
  const mesh::Mesh& mesh = core.mesh;
  const Vector<std::int32_t>* const list = moved_by(input);
  fit_rotations(input, positions);
  surface::Workspace load(core.workspaces, 3 * static_cast<std::size_t>(core.size()));
  set_right_hand_side(input, positions, load.data());
  respond(input, load.data());
  for_listed(input, list, [&](std::int32_t first, std::int32_t last) {
    for (std::int32_t i = first; i < last; ++i) {
      const std::int32_t v = vertex_at(list, i);
      if (input.reach.owner[v] >= 0 || !elastic_[mesh.component[v]]) continue;
      const double* u = field_.data() + 3 * static_cast<std::size_t>(i);
      positions[v] = positions[v] + mesh.scale * Vec3{u[0], u[1], u[2]};
    }
  });
}

void GroupStart::choose(const surface::Core& core, const Groups& groups, const Vector<std::int32_t>& active) {
  rotation.assign(groups.count(), Quaternion());
  group_.assign(active.begin(), active.end());
  Vector<std::int32_t> size(groups.count(), 0, start_.get_allocator()),
      slot(groups.count(), -1, start_.get_allocator());
  for (std::size_t g = 0; g < group_.size(); ++g) slot[group_[g]] = static_cast<std::int32_t>(g);
  for (std::int32_t v = 0; v < core.size(); ++v) {
    if (groups.group_of[v] >= 0) ++size[groups.group_of[v]];
  }
  start_.assign(group_.size() + 1, 0);
  for (std::size_t g = 0; g < group_.size(); ++g)
    start_[g + 1] = start_[g] + std::min(size[group_[g]], samples_per_group);
  vertex_.assign(start_.back(), 0);
  // The sampled vertices of a rotation group are every size/count-th vertex, in the order of vertex numbers.
  Vector<std::int32_t> seen(groups.count(), 0, start_.get_allocator()), taken(group_.size(), 0, start_.get_allocator());
  for (std::int32_t v = 0; v < core.size(); ++v) {
    const std::int32_t group = groups.group_of[v];
    if (group < 0 || slot[group] < 0) continue;
    const std::size_t g = static_cast<std::size_t>(slot[group]);
    const std::int64_t count = start_[g + 1] - start_[g];
    if (std::int64_t{seen[group]++} * count / size[group] >= taken[g] && taken[g] < count)
      vertex_[start_[g] + taken[g]++] = v;
  }
}

void GroupStart::fit(const surface::Core& core, const Rest& rest, Span<const Vec3> surface) noexcept {
  for (std::size_t g = 0; g < group_.size(); ++g) {
    Mat3 sum;
    for (std::int32_t k = start_[g]; k < start_[g + 1]; ++k) add_ring(core, rest, surface.data(), vertex_[k], sum);
    rotation[group_[g]] = best_rotation(sum, Quaternion());
  }
}

}  // namespace hf_inner::deform
