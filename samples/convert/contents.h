// What a file holds, and which formats can hold it: hf_convert tells from it what a conversion keeps and what it loses.
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
  const char *one, *many;  // in brackets: what becomes of it where it is lost. many: NULL if it is not counted
  unsigned formats;        // that hold it
};
using Contents = std::vector<Content>;

Contents contents_of(const Model& model);
Contents contents_of(const SurfaceMesh& mesh);

// "1 skin, 3 clips": the contents that `format` holds, or those that it does not hold. Without contents: "".
std::string list_of(const Contents& contents, Format format, bool kept);

}  // namespace samples

#endif
