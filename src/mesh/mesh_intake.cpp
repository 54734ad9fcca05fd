#include "mesh/mesh_intake.h"

#include "base/arguments.h"
#include "mesh/face_intake.h"

namespace hf_inner {

FaceRows read_faces(const hf_surface_desc& desc) {
  FaceRows faces;
  if (desc.face_count == 0) {
    if (desc.face_starts || desc.face_sizes || desc.corners || desc.corner_count)
      fail(HF_ERROR_EMPTY, HF_NO_INDEX, "face_count is 0, but face_starts, face_sizes, corners or corner_count is set");
    return faces;
  }
  if (desc.triangles || desc.triangles_u16 || desc.triangle_count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "triangles and faces are both set; set one");
  require_either(desc.face_starts, desc.face_sizes, "face_starts and face_sizes");
  require(desc.corners, "corners");
  faces.face_count = desc.face_count, faces.corner_count = desc.corner_count;
  faces.starts = desc.face_starts, faces.sizes = desc.face_sizes, faces.corners = desc.corners;
  faces.face_stride = stride_of(desc.face_stride, sizeof(std::uint32_t), "face_stride");
  faces.corner_stride = stride_of(desc.corner_stride, sizeof(std::uint32_t), "corner_stride");
  return faces;
}

std::uint32_t cut_size(const FaceRows& faces) {
  const std::uint64_t count = count_cut_triangles(faces);
  return count < HF_NO_INDEX ? static_cast<std::uint32_t>(count) : HF_NO_INDEX;
}

MeshInput read_mesh(const hf_surface_desc& desc, const FaceRows& faces) {
  check_one(desc.positions, desc.positions_f64, "positions");
  // An empty mesh is refused as such, by Mesh::make.
  if (desc.vertex_count > 0) require_either(desc.positions, desc.positions_f64, "positions and positions_f64");
  if (desc.triangles && desc.triangles_u16)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "triangles and triangles_u16 are both set; set one");
  if (desc.triangle_count > 0) require_either(desc.triangles, desc.triangles_u16, "triangles and triangles_u16");
  MeshInput input;
  input.faces = faces;
  input.vertex_count = desc.vertex_count, input.triangle_count = desc.triangle_count;
  input.positions = rows_of(desc.positions, desc.positions_f64, 3, desc.position_stride, "position_stride");
  if (desc.triangles)
    input.triangles = {desc.triangles, stride_of(desc.triangle_stride, 3 * sizeof(std::uint32_t), "triangle_stride")};
  else
    input.triangles = {desc.triangles_u16,
                       stride_of(desc.triangle_stride, 3 * sizeof(std::uint16_t), "triangle_stride")};
  input.weld = static_cast<Weld>(desc.weld);
  input.weld_tolerance = static_cast<double>(desc.weld_tolerance);
  return input;
}

}  // namespace hf_inner
