// A character of a glTF file as the plain arrays that know_character takes.
#pragma once
#include "gltf/character_arrays.h"
#include "skeleton/character.h"

namespace hf_test {

struct GltfCharacter : hf_gltf::CharacterArrays {
  explicit GltfCharacter(const hf_gltf::Model& model);
  GltfCharacter(const hf_gltf::Model& model, const hf_gltf::Pose& pose);
  // Pointers into this object.
  hf_inner::skeleton::CharacterInput input(bool with_names = true, bool with_up = true,
                                           bool with_declared = true) const;
};

}  // namespace hf_test
