// A clip of a glTF file on the joints of another, key by key.
#pragma once
#include <string>
#include <vector>

#include "gltf/animate.h"
#include "gltf/model.h"

namespace hf_test {

// 10 numbers a node: translation, rotation x y z w, scale.
std::vector<double> trs_of(const hf_gltf::Pose& pose);

// Replaces the clips of a model by one that plays the frames.
void set_clip(hf_gltf::Model& model, const std::string& name, const std::vector<double>& times,
              const std::vector<std::vector<double>>& frames);

}  // namespace hf_test
