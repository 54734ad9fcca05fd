// See gradients.h.
#include "transfer/gradients.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {
namespace {

// Sums the triangles' normals at their corners. The length of each is the root of twice the area, so that it grows as
// lengths do.
void find_normals(const mesh::Mesh& mesh, const Vec3* points, Vector<Vec3>& out) {
  std::fill(out.begin(), out.end(), Vec3());
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t* c = mesh.triangle(t);
    const Vec3 n = cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]);
    for (int k = 0; k < 3; ++k) out[at(c[k])] = out[at(c[k])] + n;
  }
  for (Vec3& n : out) n = std::sqrt(norm(n)) * unit_vector(n);
}

// A normal at rest counts half as much as all edges together.
double normal_weight(double size, Vec3 normal) noexcept {
  const double square = dot(normal, normal);
  return square > 0 ? 0.5 * size / square : 0.0;
}

double edge_weight(const surface::Core& core, std::int32_t entry) noexcept {
  return std::clamp(core.weights()[at(core.topology().neighbour_edge[at(entry)])], flattest_weight, steepest_weight);
}

}  // namespace

void Gradients::prepare(const MatchSide& source, const MatchSide& target, const surface::Core& target_factor,
                        Span<const double> target_area, Memory& memory) {
  const std::size_t count = at(target.core->size());
  const mesh::Mesh &from = source.core->mesh, &to = target.core->mesh;
  {
    const Border source_border(*source.core, memory), target_border(*target.core, memory);
    find_matches(source, target, source_border, target_border, memory, matches_);
    find_openings(*source.core, *target.core, source_border, target_border, memory);
    factorise_openings(target_factor, memory);
  }

  const std::size_t n = from.positions.size();
  normal_.assign(n, Vec3());
  now_normal_.assign(n, Vec3());
  find_normals(from, from.positions.data(), normal_);
  inverse_.assign(n, Mat3::Identity());
  gradient_.assign(n, Mat3::Identity());
  for (std::size_t v = 0; v < n; ++v) {
    Mat3 moment = Mat3::Zero();
    for (std::int32_t e = source.core->topology().neighbour_start[v];
         e < source.core->topology().neighbour_start[v + 1]; ++e) {
      const Vec3 d = from.positions[v] - from.positions[at(source.core->topology().neighbour[at(e)])];
      deform::add_outer(moment, edge_weight(*source.core, e), d, d);
    }
    const double size = moment.trace();
    deform::add_outer(moment, normal_weight(size, normal_[v]), normal_[v], normal_[v]);
    moment += (least_edge_moment * size) * Mat3::Identity();
    if (size > 0) inverse_[v] = moment.inverse();
  }

  // The operator's entries, with the length of each target edge over the distance of the matched points.
  const SymmetricMatrix& k = target_factor.matrix();
  matched_.assign(count, Vec3());
  blended_.assign(count, Mat3::Identity());
  Vector<Vec3> rest(count, &memory);
  for (std::size_t v = 0; v < count; ++v)
    for (int c = 0; c < 3; ++c)
      rest[v] = rest[v] + matches_.share[3 * v + at(c)] * from.positions[at(matches_.corner[3 * v + at(c)])];
  ratio_.assign(k.row.size(), 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
      const std::size_t u = at(k.row[at(e)]);
      const double length = norm(rest[v] - rest[u]), own = norm(to.positions[v] - to.positions[u]);
      if (length > 0 && own <= most_edge_ratio * source.unit * length) ratio_[at(e)] = own / length;
    }
  }
  const std::size_t components = at(to.component_count());
  mean_.assign(components, Vec3());
  rest_mean_.assign(components, Vec3());
  centre_.assign(components, Vec3());
  mass_.assign(components, 0.0);
  for (std::size_t v = 0; v < count; ++v) {
    const std::size_t c = at(to.component[v]);
    mass_[c] += target_area[v];
    rest_mean_[c] = rest_mean_[c] + target_area[v] * rest[v];
    centre_[c] = centre_[c] + target_area[v] * to.positions[v];
  }
  for (std::size_t c = 0; c < components; ++c) {
    rest_mean_[c] = (1 / mass_[c]) * rest_mean_[c];
    centre_[c] = (1 / mass_[c]) * centre_[c];
  }
}

void Gradients::find_gradients(const Frame& frame) {
  const surface::Core& source = *frame.source;
  find_normals(source.mesh, frame.posed, now_normal_);
  const Mat3 whole = frame.whole.rotation.toRotationMatrix(), axes = frame.axes.toRotationMatrix();
  const std::size_t n = gradient_.size();
  source.jobs->for_each(static_cast<std::uint32_t>((n + vertex_block - 1) / vertex_block), [&](std::uint32_t b) {
    for (std::size_t v = std::size_t{b} * vertex_block; v < std::min(n, (std::size_t{b} + 1) * vertex_block); ++v) {
      Mat3 moment = Mat3::Zero();
      double size = 0;
      for (std::int32_t e = source.topology().neighbour_start[v]; e < source.topology().neighbour_start[v + 1]; ++e) {
        const std::size_t u = at(source.topology().neighbour[at(e)]);
        const Vec3 d = source.mesh.positions[v] - source.mesh.positions[u];
        const double w = edge_weight(source, e);
        deform::add_outer(moment, w, frame.posed[v] - frame.posed[u], d);
        size += w * dot(d, d);
      }
      deform::add_outer(moment, normal_weight(size, normal_[v]), now_normal_[v], normal_[v]);
      moment += (least_edge_moment * size) * whole;
      const Mat3 gradient = size > 0 ? Mat3(moment * inverse_[v]) : whole;
      gradient_[v] = axes * gradient * axes.transpose();
    }
  });
}

void Gradients::apply(const Frame& frame, Vec3* out) {
  find_gradients(frame);
  const surface::Core &source = *frame.source, &target = *frame.target, &factor = *frame.factor;
  const std::size_t count = blended_.size();
  const Mat3 axes = frame.axes.toRotationMatrix();
  const auto blocks = static_cast<std::uint32_t>((count + vertex_block - 1) / vertex_block);
  const auto each = [&](auto&& job) {
    target.jobs->for_each(blocks, [&](std::uint32_t b) {
      const std::size_t last = std::min(count, (std::size_t{b} + 1) * vertex_block);
      for (std::size_t v = std::size_t{b} * vertex_block; v < last; ++v) job(v);
    });
  };
  each([&](std::size_t v) {
    Vec3 place;
    Mat3 gradient = Mat3::Zero();
    for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) {
      if (!(matches_.share[i] > 0)) continue;
      place = place + matches_.share[i] * frame.posed[at(matches_.corner[i])];
      gradient += matches_.share[i] * gradient_[at(matches_.corner[i])];
    }
    matched_[v] = place;
    blended_[v] = gradient;
  });
  const auto rest_of = [&](std::size_t v) {
    Vec3 place;
    for (std::size_t i = 3 * v; i < 3 * v + 3; ++i)
      if (matches_.share[i] > 0) place = place + matches_.share[i] * source.mesh.positions[at(matches_.corner[i])];
    return place;
  };
  const SymmetricMatrix& k = factor.matrix();
  const Span<const std::int32_t> position = factor.factor->position();
  surface::Workspace z(factor.workspaces, 3 * at(factor.unknown_count()));
  std::fill_n(z.data(), 3 * at(factor.unknown_count()), 0.0);
  each([&](std::size_t v) {
    Vec3 sum;
    const Vec3 rest = rest_of(v);
    for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
      const std::size_t u = at(k.row[at(e)]);
      if (u == v) continue;
      const Mat3 gradient = 0.5 * (blended_[v] + blended_[u]);
      Vec3 y = gradient * (target.mesh.positions[v] - target.mesh.positions[u]);
      if (ratio_[at(e)] > 0) {
        const Vec3 moved = axes * (matched_[v] - matched_[u]), still = axes * (rest - rest_of(u));
        y = y + ratio_[at(e)] * (moved - gradient * still);
      }
      sum = sum - k.value[at(e)] * y;
    }
    double* row = z.data() + 3 * at(position[v]);
    row[0] = sum.x;
    row[1] = sum.y;
    row[2] = sum.z;
  });
  factor.factor->solve_in_order(z.data(), 3, *target.jobs);
  hold_openings(frame, z.data());

  // Each component's mean goes where the matched points go. Offsets between the two rest shapes turn with the body.
  std::fill(mean_.begin(), mean_.end(), Vec3());
  Vector<Vec3>& mean = mean_;
  for (std::size_t v = 0; v < count; ++v) {
    const double* row = z.data() + 3 * at(position[v]);
    const std::size_t c = at(target.mesh.component[v]);
    const Vec3 path = frame.scale * (axes * (matched_[v] - frame.whole.centroid));
    mean[c] = mean[c] + frame.area[v] * (path - Vec3{row[0], row[1], row[2]});
  }
  const Vec3 centroid =
      frame.target_centroid + frame.scale * (axes * (frame.whole.centroid - frame.whole.rest_centroid));
  for (std::size_t c = 0; c < mean.size(); ++c) {
    const Vec3 offset =
        centre_[c] - frame.target_centroid - frame.scale * (axes * (rest_mean_[c] - frame.whole.rest_centroid));
    mean[c] = (1 / mass_[c]) * mean[c] + centroid + deform::rotate(frame.turn, offset);
  }
  each([&](std::size_t v) {
    const double* row = z.data() + 3 * at(position[v]);
    out[v] = Vec3{row[0], row[1], row[2]} + mean[at(target.mesh.component[v])];
  });
}

}  // namespace hf_inner::transfer
