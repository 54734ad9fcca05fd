// Materials of an .obj: its .mtl files, and the images that they name.
#ifndef HF_SAMPLES_CONVERT_OBJ_LOOKS_H
#define HF_SAMPLES_CONVERT_OBJ_LOOKS_H

#include <filesystem>

#include "common/mesh_file.h"
#include "gltf/plain_looks.h"

namespace samples {

// The materials that the faces use, from the .mtl files beside `file`: Kd, d, Tr, Pr, Pm and map_Kd. Files that cannot
// be read are warnings of the mesh. png_or_jpeg: leaves out images of other kinds, which glTF does not hold.
PlainLooks read_obj_looks(const std::filesystem::path& file, SurfaceMesh& mesh, bool png_or_jpeg);

// Writes the .mtl of an .obj and its images beside it: a.mtl, a_0.png, ... Gives the mesh the names of the materials
// and of the .mtl. Without materials it writes nothing.
void write_obj_looks(const PlainLooks& looks, const std::filesystem::path& file, SurfaceMesh& mesh);

// The surface of a model at rest with what an .obj holds beside: texture coordinates and materials of faces.
SurfaceMesh to_obj_mesh(const Model& model, const FlatMesh& flat);

}  // namespace samples

#endif
