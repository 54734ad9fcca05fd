// A creature as a glTF model: one node with the skinned mesh, the joint nodes below "root", a plain rough material, the
// coat as vertex colours.
#ifndef HF_SAMPLES_ASSETS_CREATURE_GLTF_H
#define HF_SAMPLES_ASSETS_CREATURE_GLTF_H

#include "assets/creature.h"
#include "gltf/model.h"

namespace samples {

using namespace hf_gltf;

Model to_model(const Creature& creature);

}  // namespace samples

#endif
