#include "mesh/face_operator.h"

#include <algorithm>

#include "base/index.h"
#include "mesh/face_correction.h"
#include "mesh/face_intake.h"
#include "mesh/polygon_laplacian.h"

namespace hf_inner::mesh {
namespace {

// The same mesh with the other cut of every quad that has one, as far as an operator reads it.
Mesh with_second_cuts(const Mesh& mesh, Memory& memory) {
  Mesh other(memory);
  other.positions.assign(mesh.positions.begin(), mesh.positions.end());
  other.corners.assign(mesh.corners.begin(), mesh.corners.end());
  other.component.assign(mesh.component.begin(), mesh.component.end());
  other.report.component_count = mesh.report.component_count;
  for (Index f = 0; f < mesh.faces.count(); ++f) {
    if (!mesh.faces.second_cut[at(f)]) continue;
    const Span<const Index> q = mesh.faces.corners_of(f);
    const Index t = mesh.faces.triangle_start[at(f)], *const v = mesh.triangle(t);
    std::size_t apart = 0;  // the corner that the first triangle lacks; the other diagonal begins there
    while (std::find(v, v + 3, q[apart]) != v + 3) ++apart;
    Index* to = other.corners.data() + 3 * at(t);
    for (const std::size_t k : {0, 1, 2, 2, 3, 0}) *to++ = q[(apart + k) % 4];
  }
  return other;
}

// Returns the mean of two Laplacians. The diagonal is minus the sum of the rest of its row.
SymmetricMatrix mean(const SymmetricMatrix& a, const SymmetricMatrix& b, Memory& memory) {
  SymmetricMatrix out(memory);
  out.column_start.reserve(a.column_start.size());
  out.column_start.push_back(0);
  out.row.reserve(std::max(a.row.size(), b.row.size()));
  out.value.reserve(out.row.capacity());
  for (Index v = 0; v < a.size(); ++v) {
    std::size_t i = at(a.column_start[at(v)]), j = at(b.column_start[at(v)]), diagonal = 0;
    const std::size_t i_end = at(a.column_start[at(v) + 1]), j_end = at(b.column_start[at(v) + 1]);
    double sum = 0;
    while (i < i_end || j < j_end) {
      const bool from_a = j == j_end || (i < i_end && a.row[i] <= b.row[j]);
      const bool from_b = i == i_end || (j < j_end && b.row[j] <= a.row[i]);
      const Index row = from_a ? a.row[i] : b.row[j];
      const double value = 0.5 * ((from_a ? a.value[i] : 0.0) + (from_b ? b.value[j] : 0.0));
      i += from_a;
      j += from_b;
      if (row == v)
        diagonal = out.row.size();
      else
        sum += value;
      out.row.push_back(row);
      out.value.push_back(value);
    }
    out.value[diagonal] = -sum;
    out.column_start.push_back(static_cast<Index>(out.row.size()));
  }
  return out;
}

DelaunayOperator two_cuts(const Mesh& mesh, const Topology& topology, const Vector<double>& weights, bool with_areas,
                          Memory& memory, JobRunner* jobs) {
  DelaunayOperator out = delaunay_operator(mesh, topology, weights, with_areas, memory, jobs);
  const SharedVector<std::uint8_t>& second = mesh.faces.second_cut;
  if (std::find(second.begin(), second.end(), 1) == second.end()) return out;
  const Mesh other = with_second_cuts(mesh, memory);
  const Topology edges = Topology::make(other, memory, jobs);
  const Vector<double> other_weights = edge_weights(other, edges, OperatorKind::cotangent, memory, jobs);
  const DelaunayOperator more = delaunay_operator(other, edges, other_weights, with_areas, memory, jobs);
  out.laplacian = mean(out.laplacian, more.laplacian, memory);
  for (std::size_t v = 0; v < out.areas.size(); ++v) out.areas[v] = 0.5 * (out.areas[v] + more.areas[v]);
  if (!more.changed.empty()) out.changed.resize(mesh.positions.size(), 0);
  for (std::size_t v = 0; v < more.changed.size(); ++v) out.changed[v] |= more.changed[v];
  return out;
}

}  // namespace

DelaunayOperator face_operator(const Mesh& mesh, const Topology& topology, const Vector<double>& weights,
                               OperatorKind kind, bool with_areas, Memory& memory, JobRunner* jobs) {
  if (kind == OperatorKind::intrinsic_delaunay) {
    DelaunayOperator out = two_cuts(mesh, topology, weights, with_areas, memory, jobs);
    if (mesh.faces.polygon_count > 0) out.laplacian = corrected_by_polygons(mesh, out.laplacian, memory, jobs);
    return out;
  }
  DelaunayOperator out(memory);
  if (kind == OperatorKind::uniform) {
    const Vector<std::uint8_t> side = face_sides(mesh.faces, topology, memory);
    const Vector<double> ones(side.begin(), side.end(), &memory);
    out.laplacian = laplacian(topology, ones, memory, jobs);
    return out;
  }
  out.changed.assign(mesh.positions.size(), 0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3 && is_widened(mesh, t); ++k) out.changed[at(mesh.triangle(t)[k])] = 1;
  }
  out.laplacian = polygon_laplacian(mesh, memory, jobs);
  if (kind == OperatorKind::clamped) clamp_weights(out.laplacian, memory);
  return out;
}

}  // namespace hf_inner::mesh
