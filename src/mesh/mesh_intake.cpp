#include "mesh/mesh_intake.h"

#include "base/arguments.h"
#include "mesh/face_intake.h"

namespace hf_inner {
namespace {

// Refuses indices that are twice as wide as the array they are given in. Every second number is then the high half of
// an index: 0, or at most `most`. In a mesh that is meant, half of the triangles cannot lie between so few vertices.
// Indices that are out of range and meshes without a usable triangle are refused as such, later.
void check_width(const MeshInput& input, std::uint32_t most, const char* name, const char* advice) {
  if (input.triangle_count < 2 || input.triangle_count / 2 <= most * (most + 1)) return;
  bool are_low[2] = {true, true};  // high halves come second, or first on a big-endian machine
  for (std::uint32_t t = 0; t < input.triangle_count && (are_low[0] || are_low[1]); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = input.triangles.get(t, k);
      if (v >= input.vertex_count) return;
      bool& low = are_low[(t + k) % 2];
      low = low && v <= most;
    }
  }
  if (are_low[0] == are_low[1]) return;
  fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "every second number of %s is %s: %s", name,
       most == 0 ? "0" : "the high half of an index", advice);
}

}  // namespace

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
  faces.face_count = desc.face_count;
  faces.corner_count = desc.corner_count;
  faces.starts = desc.face_starts;
  faces.sizes = desc.face_sizes;
  faces.corners = desc.corners;
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
  input.vertex_count = desc.vertex_count;
  input.triangle_count = desc.triangle_count;
  input.positions = rows_of(desc.positions, desc.positions_f64, 3, desc.position_stride, "position_stride");
  if (desc.triangles)
    input.triangles = {desc.triangles, stride_of(desc.triangle_stride, 3 * sizeof(std::uint32_t), "triangle_stride")};
  else
    input.triangles = {desc.triangles_u16,
                       stride_of(desc.triangle_stride, 3 * sizeof(std::uint16_t), "triangle_stride")};
  const std::uint32_t stride = desc.triangle_stride;
  if (desc.triangles_u16 && desc.vertex_count > 0 && (stride == 0 || stride == 3 * sizeof(std::uint16_t)))
    check_width(input, (desc.vertex_count - 1) >> 16, "triangles_u16", "give 32-bit indices as triangles");
  if (desc.triangles && (stride == 0 || stride == 3 * sizeof(std::uint32_t)))
    check_width(input, 0, "triangles", "64-bit indices are not taken, copy them to 32 bits");
  input.weld = static_cast<Weld>(desc.weld);
  input.weld_tolerance = desc.weld_tolerance;
  return input;
}

}  // namespace hf_inner
