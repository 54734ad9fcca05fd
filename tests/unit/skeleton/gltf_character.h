// A character of a glTF file as the plain arrays that know_character takes.
#pragma once
#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/model.h"
#include "skeleton/character.h"

namespace hf_test {

struct GltfCharacter {
  std::vector<std::string> texts;
  std::vector<const char*> names;
  std::vector<std::int32_t> parents, vertex_joints, roles, sides;
  std::vector<double> matrices, inverse_binds, positions, weights;
  std::vector<std::uint8_t> bound;
  std::vector<std::uint32_t> triangles, starts, joints;
  double up[3] = {0, 1, 0};
  bool declared = false;  // it has the humanoid of a VRM file

  explicit GltfCharacter(const hf_gltf::Model& model);
  // Pointers into this object.
  hf_inner::CharacterInput input(bool with_names = true, bool with_up = true, bool with_declared = true) const;

 private:
  void add_nodes(const hf_gltf::Model& model);
  void add_surface(const hf_gltf::Model& model);
  void add_declared(const hf_gltf::Model& model);
  void declare(const std::string& bone, int node);
};

}  // namespace hf_test
