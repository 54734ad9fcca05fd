// Pins of a rig: read from a file, or found where they help most.
#ifndef HF_SAMPLES_WEIGHTS_GUIDE_H
#define HF_SAMPLES_WEIGHTS_GUIDE_H

#include <filesystem>
#include <string>
#include <vector>

#include "weights/compare.h"

namespace samples {

// Pins with weights for every joint that any of them names.
struct PinFile {
  std::vector<uint32_t> vertices, joints;
  std::vector<double> radii;
  std::vector<float> weights;
};

// Appends a pin with the weights of the file. radius: of the disc around the vertex, 0: the vertex alone.
void add_given(const Rig& rig, size_t vertex, double radius, PinFile& out);

PinFile read_pins(const std::filesystem::path& file, const Rig& rig);
void set_pins(hf::Weights& weights, const PinFile& pins);
RigWeights weights_of(const hf::Weights& weights);

// Adds pins with the weights of the file, one after the other. Of the places that are tried, the one is kept that
// leaves the smallest mean distance.
void guide(const Model& model, const Rig& rig, const std::vector<Pose>& poses, uint32_t count, PinFile pins,
           hf::Weights& weights);

}  // namespace samples

#endif
