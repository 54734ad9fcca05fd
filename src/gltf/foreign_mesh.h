// Makes a primitive of a mesh of assimp. Inner header of foreign_scene.cpp.
#ifndef HF_GLTF_FOREIGN_MESH_H
#define HF_GLTF_FOREIGN_MESH_H

#include <assimp/mesh.h>

#include <functional>

#include "gltf/model.h"

namespace hf_gltf {

inline glm::vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

struct ForeignMesh {
  const aiMesh& mesh;
  int node = -1;
  float unit = 1;                              // metres
  std::function<int(const char*)> node_named;  // -1: none
  size_t lost_faces = 0;                       // out
};

// skin: has the bones of the mesh. If a vertex has no bone, the node becomes a joint of the skin.
Primitive foreign_primitive(ForeignMesh& from, Skin& skin);

}  // namespace hf_gltf

#endif
