#include "mesh/mesh_intake.h"

#include "base/arguments.h"
#include "mesh/face_intake.h"

namespace hf_inner::mesh {
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
  if (!desc.faces) return faces;
  const hf_faces_desc& given = *desc.faces;
  require_zero(given.reserved);
  if (is_given(desc.triangles))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "triangles and faces are both set; set one");
  if (!is_given(given.corners)) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "faces->corners.data is NULL");
  if (!is_given(given.starts) && !is_given(given.sizes))
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "faces->starts.data and faces->sizes.data are both NULL; set one");
  faces.corners = read_indices(given.corners, HF_TYPE_PLAIN, 1, "faces->corners");
  faces.starts = read_indices(given.starts, HF_TYPE_PLAIN, 1, "faces->starts");
  faces.sizes = read_indices(given.sizes, HF_TYPE_PLAIN, 1, "faces->sizes");
  faces.corner_count = given.corners.count;
  if (faces.starts && faces.sizes) check_rows(given.starts, given.sizes.count, "faces->sizes", "faces->starts");
  const std::uint32_t ends = given.starts.count;
  faces.face_count = faces.sizes ? given.sizes.count : ends > 0 ? ends - 1 : 0;  // the last offset is an end
  return faces;
}

std::uint32_t cut_size(const FaceRows& faces) {
  const std::uint64_t count = count_cut_triangles(faces);
  return count < HF_NO_INDEX ? static_cast<std::uint32_t>(count) : HF_NO_INDEX;
}

MeshInput read_mesh(const hf_surface_desc& desc, const FaceRows& faces) {
  const ConstRows positions = read_reals(desc.positions, 3, "positions");
  const IndexRows triangles = read_indices(desc.triangles, HF_TYPE_UINT16, 3, "triangles");
  MeshInput input;
  input.faces = faces;
  input.vertex_count = desc.positions.count;
  input.triangle_count = desc.triangles.count;
  input.positions = positions;
  input.triangles = triangles;
  const bool narrow = desc.triangles.type == HF_TYPE_UINT16;
  const std::uint32_t stride = desc.triangles.stride;
  const bool packed = stride == 0 || stride == 3 * (narrow ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
  if (narrow && packed && input.vertex_count > 0)
    check_width(input, (input.vertex_count - 1) >> 16, "triangles", "its type is HF_TYPE_UINT16, give 0 for 32 bits");
  if (!narrow && packed) check_width(input, 0, "triangles", "64-bit indices are not taken, copy them to 32 bits");
  input.weld = static_cast<Weld>(desc.weld);
  input.weld_tolerance = desc.weld_tolerance;
  return input;
}

}  // namespace hf_inner::mesh
