#include "gltf_character.h"

#include "gltf/stance.h"

namespace hf_test {

GltfCharacter::GltfCharacter(const hf_gltf::Model& model) : CharacterArrays(model, hf_gltf::flatten(model)) {}

GltfCharacter::GltfCharacter(const hf_gltf::Model& model, const hf_gltf::Pose& pose)
    : CharacterArrays(model, hf_gltf::standing(hf_gltf::flatten(model), model, pose), pose) {}

hf_inner::skeleton::CharacterInput GltfCharacter::input(bool with_names, bool with_up, bool with_declared) const {
  auto in = CharacterArrays::input<hf_inner::skeleton::CharacterInput>();
  if (!with_names) in.names = nullptr;
  if (!with_up) in.up = nullptr;
  if (!with_declared) {
    in.forward = nullptr;
    in.roles = in.sides = nullptr;
  }
  return in;
}

}  // namespace hf_test
