// Lists the contents of a file, each with the formats that can hold it. hf_convert prints from this list the contents
// that a conversion keeps and loses.
#ifndef HF_SAMPLES_CONVERT_CONTENTS_H
#define HF_SAMPLES_CONVERT_CONTENTS_H

#include <string>
#include <vector>

#include "common/mesh_file.h"

namespace samples {

// One bit for each format that is written. glTF: .gltf, .glb and .vrm.
enum Format : unsigned { to_gltf = 1, to_obj = 2, to_off = 4, to_ply = 8, to_stl = 16, to_all = 31 };

struct Content {
  size_t count;
  const char *one, *many;  // names of one and of several; brackets say how it is lost. many: NULL: no count is printed
  unsigned formats;        // bits of the formats that can hold it
};
using Contents = std::vector<Content>;

// surface: the triangles at rest where they are written alone, NULL where the whole model is.
Contents contents_of(const Model& model, const FlatMesh* surface);
Contents contents_of(const SurfaceMesh& mesh);

// "1 skin, 3 clips": the contents that `format` holds, or those that it does not hold. Without contents: "".
std::string list_of(const Contents& contents, Format format, bool kept);

}  // namespace samples

#endif
