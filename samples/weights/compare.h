// How far computed weights pose a rig from where given weights pose it.
#ifndef HF_SAMPLES_WEIGHTS_COMPARE_H
#define HF_SAMPLES_WEIGHTS_COMPARE_H

#include "weights/rig.h"

namespace samples {

// Distances in per cent of the box, over all vertices and poses.
struct Comparison {
  double mean = 0, high = 0, worst = 0;  // high: 95 % are below
  double stretch = 0;                    // 95 % of the edges are stretched less; over the same of the given weights
  uint32_t bare = 0;                     // vertices whose weights do not sum to 1
  size_t worst_pose = 0;                 // the pose of the largest mean
  std::vector<double> of_worst_pose;     // by vertex
  std::vector<double> of_vertex;         // mean over the poses
};

Comparison compare(const Model& model, const Rig& rig, const std::vector<Pose>& poses, const RigWeights& weights);

// A sheet: given weights, computed weights and their difference in colour, at rest and in the pose of the largest
// difference. Without given weights: the computed ones, at rest and in the pose that moves most.
void write_weight_sheet(const std::string& file, const Model& model, const Rig& rig, const std::vector<Pose>& poses,
                        const RigWeights& weights, const Comparison& found, bool has_given, const std::string& title);

}  // namespace samples

#endif
