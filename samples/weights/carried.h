// Weights of a rig from another model, or from the other side of the rig.
#ifndef HF_SAMPLES_WEIGHTS_CARRIED_H
#define HF_SAMPLES_WEIGHTS_CARRIED_H

#include <nlohmann/json.hpp>
#include <string>

#include "weights/rig.h"

namespace samples {

struct CarriedWeights {
  RigWeights weights;
  nlohmann::json report;
  std::string line;  // what was found, for people
};

// Carries the weights of another model, which stands in the same place at rest. Joints are matched by names. Throws
// std::runtime_error naming a joint with weights that the rig does not have. model: the one of the rig.
CarriedWeights carry_from(const Model& from, const Model& model, const Rig& rig, uint32_t influence_count);
// Mirrors the weights of the file. to: an HF_MIRROR_*.
CarriedWeights mirror_given(const hf::Surface& surface, const Rig& rig, int32_t to, uint32_t influence_count);
// The surface of a rig, at the positions given.
hf::Surface surface_of(const Rig& rig, const std::vector<glm::dvec3>& points);

}  // namespace samples

#endif
