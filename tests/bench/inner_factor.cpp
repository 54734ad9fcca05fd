#include "bench/inner_factor.h"

namespace bench {
namespace {

std::shared_ptr<const hf_inner::surface::Core> make_core(const Mesh& mesh,
                                                         const std::shared_ptr<hf_inner::Memory>& memory,
                                                         const std::shared_ptr<hf_inner::JobRunner>& jobs,
                                                         hf_inner::mesh::FieldKind kind) {
  hf_inner::mesh::MeshInput input;
  input.vertex_count = mesh.vertex_count();
  input.triangle_count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  input.positions = {mesh.positions.data(), 3 * sizeof(double)};
  input.triangles = hf_inner::IndexRows(mesh.triangles.data(), 3);
  hf_inner::surface::CoreOptions options;
  options.need_factor = false;
  options.field_kind = kind;
  options.operator_kind = hf_inner::mesh::OperatorKind::cotangent;  // the matrix the peers get
  return hf_inner::surface::Core::make(input, options, memory, jobs);
}

}  // namespace

InnerSystem::InnerSystem(const Mesh& mesh, uint32_t threads, hf_inner::mesh::FieldKind kind)
    : memory_(std::make_shared<hf_inner::Memory>()),
      jobs_(std::make_shared<hf_inner::JobRunner>(threads)),
      core_(make_core(mesh, memory_, jobs_, kind)),
      matrix_(hf_inner::surface::grounded(*core_)),
      coordinates_(hf_inner::surface::ordering_coordinates(core_->mesh, *memory_)) {}

PeerMatrix InnerSystem::peer_matrix() const {
  PeerMatrix out;
  const hf_inner::SymmetricMatrix& a = matrix_;
  for (int32_t v = 0; v < a.size(); ++v) {
    out.start.push_back(static_cast<int>(out.row.size()));
    for (int32_t i = a.column_start[v]; i < a.column_start[v + 1]; ++i) {
      if (a.row[i] < v) continue;
      out.row.push_back(a.row[i]);
      out.value.push_back(a.value[i]);
    }
  }
  out.start.push_back(static_cast<int>(out.row.size()));
  return out;
}

}  // namespace bench
