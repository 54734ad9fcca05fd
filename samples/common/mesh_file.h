// Surfaces from and to .obj, .off, .ply (text and both binary orders), from .stl (text and binary), and from glTF by
// way of flatten(). What a file is, its first bytes say (gltf/file_kind.h).
//
// The file's own vertex order is kept, isolated vertices too, so that vertex numbers from other tools fit. Polygons are
// kept as they are and cut into size - 2 triangles (face_triangles.h). Faces with fewer than three corners are left out
// with a warning; repeated corners are kept, what they mean is the user's matter.
//
// Every count in a header is checked against what the file can hold before anything is allocated; every index against
// the vertex count. Failure: std::runtime_error naming file, line or element, and what to do. Positions must be finite.
#ifndef HF_SAMPLES_COMMON_MESH_FILE_H
#define HF_SAMPLES_COMMON_MESH_FILE_H

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gltf/flat_mesh.h"

namespace samples {

using namespace hf_gltf;

// What an .obj says of the corners of its faces, and of looks. Other formats have none of it.
struct Corners {
  std::vector<glm::dvec2> texcoords;  // (0, 0) is the lower left of the image
  std::vector<glm::vec3> normals;
  // One a corner, in the order of the faces' corners: into the lists above, or none. Empty: no corner has any.
  std::vector<uint32_t> texcoord_of, normal_of;
  std::vector<std::string> material_names;
  std::vector<uint32_t> material_of;   // one a face, or none; empty: no face has any
  std::vector<std::string> libraries;  // the .mtl files that the .obj names

  static constexpr uint32_t none = UINT32_MAX;
};

struct SurfaceMesh {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;  // three vertices each
  // Faces as in the file: sizes, and their corners behind one another. Empty: the faces are the triangles.
  std::vector<uint32_t> face_sizes, face_vertices;
  // Face f belongs to group_names[face_groups[f]] (.obj "g" and "o"); empty: no groups.
  std::vector<std::string> group_names;
  std::vector<uint32_t> face_groups;
  std::vector<glm::vec3> normals;  // per vertex, or empty
  std::vector<glm::vec4> colors;   // per vertex, rgba 0..1, or empty
  Corners corners;                 // filled where it is asked for
  std::vector<std::string> warnings;
  std::vector<std::string> ignored;  // what the file has beside these, such as "materials"

  size_t face_count() const { return face_sizes.empty() ? triangles.size() / 3 : face_sizes.size(); }
};

struct MeshLimits {
  uint64_t max_file_bytes = 512ull << 20;
  uint32_t max_vertices = 20000000;
  uint32_t max_triangles = 40000000;
};

// corners: reads what an .obj says of corners and looks, and lists it under `ignored` otherwise. A normal that all
// corners of each vertex share becomes the normal of the vertex.
SurfaceMesh read_mesh_file(const std::filesystem::path& file, const MeshLimits& limits = {}, bool corners = false);
// The same from bytes, but for glTF; extension is ".obj", ".off", ".ply" or ".stl", for bytes that do not tell.
SurfaceMesh read_mesh_bytes(const std::vector<uint8_t>& bytes, const std::string& extension, const std::string& name,
                            const MeshLimits& limits = {}, bool corners = false);

// .obj, .off and .ply (binary little endian), .stl (binary), .gltf and .glb (triangles). Numbers are written so that
// they read back exactly as doubles (.ply, .obj, .off) or floats (.stl, .gltf, .glb). Only .obj, .gltf and .glb hold
// corners: in glTF a vertex has a copy for each further pair of normal and texture coordinate, behind all vertices, and
// faces of each material are a primitive. An .obj names the .mtl files; they are not written here.
void write_mesh_file(const SurfaceMesh& mesh, const std::filesystem::path& file);

// The model that is written as glTF. Its materials have names alone.
Model to_model(const SurfaceMesh& mesh, const std::string& name);

// A FlatMesh of one part, welded, for the functions that take one; and the other way round.
FlatMesh to_flat_mesh(const SurfaceMesh& mesh);
SurfaceMesh to_surface_mesh(const FlatMesh& mesh);

}  // namespace samples

#endif
