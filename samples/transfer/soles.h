// Measured on posed surfaces, part by part: what slides, what sinks, and how much it accelerates. Vertices belong to
// the joints that move them most.
#ifndef HF_SAMPLES_TRANSFER_SOLES_H
#define HF_SAMPLES_TRANSFER_SOLES_H

#include <cstdint>
#include <vector>

#include "gltf/known_body.h"

namespace samples {

using namespace hf_gltf;

struct StandingBody {
  const Model& model;
  const FlatMesh& mesh;
  const KnownBody& known;
};

// By flat vertex: 1 for those that are no part of the body: loose ones, and pieces that hang on no joint of it, such as
// a plane of ground.
std::vector<uint8_t> beside_body(const StandingBody& body);
// The same and what the hands hold.
std::vector<uint8_t> beside_flesh(const StandingBody& body);

// How fast soles of the target slide on the ground while the source's stand, beyond what the source's slide themselves,
// in boxes of the target a second: the mean over feet and frames. Under a clip on the spot the ground
// goes as fast as suits the target. Below 0: nothing stands, or the feet are not known.
double slide_of(const StandingBody& source, const StandingBody& target, double scale, const std::vector<double>& times,
                const std::vector<std::vector<double>>& source_frames,
                const std::vector<std::vector<double>>& target_frames);

// How high the lowest sole of the target is above the lowest of the source, scaled, while that stands: the mean over
// these frames, in boxes of the target. Below 0: nothing stands, or the feet are not known.
double hover_of(const StandingBody& source, const StandingBody& target, double scale,
                const std::vector<std::vector<double>>& source_frames,
                const std::vector<std::vector<double>>& target_frames);

// What a body wears beside its skeleton: the vertex of a node, and that of the body, which are nearest to each other at
// rest, how far they are apart, and the box.
struct Fastening {
  int node = -1;
  size_t own = 0, other = 0;
  double apart = 0, box = 1;
};
// Of those nodes that touch the body. Scenery does not count: ground, rooms, what is larger than the body.
std::vector<Fastening> fastenings_of(const StandingBody& body, const std::vector<int>& nodes);
// How far it comes off the body at most, in boxes.
double comes_off(const Fastening& fastening, const std::vector<std::vector<double>>& frames);

// How much the target accelerates over the source: root mean squares of second differences, where trunk, head, arms
// and legs of each side count the same. So neither the sizes of parts nor how finely they are meshed matter. Lengths of
// the source count times the larger of `scale` and that of the boxes. 0: the source does not move, or no part is
// common.
double acceleration_of(const StandingBody& source, const StandingBody& target, double scale,
                       const std::vector<std::vector<double>>& source_frames,
                       const std::vector<std::vector<double>>& target_frames);

// In boxes of the target: how deep the source's deepest vertex goes under its ground, scaled, and how much deeper the
// target's goes.
struct Depths {
  double source = 0, beyond = 0;
};
Depths depth_of(const StandingBody& source, const StandingBody& target, double scale,
                const std::vector<uint8_t>& source_out, const std::vector<uint8_t>& target_out,
                const std::vector<std::vector<double>>& source_frames,
                const std::vector<std::vector<double>>& target_frames);

}  // namespace samples

#endif
