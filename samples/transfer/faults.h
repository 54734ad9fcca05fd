// Faults of a played clip that an animator would send back, and a confidence that falls with them.
#ifndef HF_SAMPLES_TRANSFER_FAULTS_H
#define HF_SAMPLES_TRANSFER_FAULTS_H

#include <string>
#include <vector>

#include "transfer/session.h"

namespace samples {

// Lengths are in boxes of the target. Lengths of the source count times the larger of two scales: that of the transfer
// and that of the boxes.
struct ClipFaults {
  // Frames in which a vertex's second difference is above 2 % of the box and four times the largest of the source.
  size_t spikes = 0;
  double acceleration = 0;  // root mean square, over the source's; 0: the source does not move
  double stretch = 0;       // 95 % of the edges' |log(length / rest length)| in the worst frame, beyond the source's
  double sunk = 0, gap = 0;
  double held = 0;  // how deep the deepest vertex goes if hands hold it and the body itself does not go so deep
  std::vector<std::string> lost;  // pairs whose limb does not move as its source does
  size_t moving = 0;              // pairs whose limb moves on the source
  // Of the joints, where both skeletons are known. Degrees that arms and legs, and the trunk, are off; below 0:
  // unknown.
  double limbs = -1, trunk = -1;
  double unmatched = 0;  // see PoseFit
  // How high the lowest sole is above that of the source while the source stands, the mean, in boxes; below 0: unknown.
  double hover = -1;
  double uneven = 0;      // see SkeletonPair::unevenness
  double slide = -1;      // of soles that stand on the source, in boxes a second; below 0: unknown
  double confidence = 1;  // 0 to 1
};

// Two bodies whose frames are compared: their surfaces, vertices that do not count, and how lengths go over.
struct Stage {
  const FlatMesh &source, &target;
  const std::vector<uint8_t>&source_out, &target_out;
  double scale = 1;
};

ClipFaults find_faults(const Session& session, const PlayedClip& played);
// The same without pairs.
ClipFaults motion_faults(const Stage& stage, const PlayedClip& played);
// From all faults; called again when some were added.
double confidence_of(const ClipFaults& faults, size_t frames);

// What went wrong, a sentence each; none if nothing did.
std::vector<std::string> fault_sentences(const ClipFaults& faults, const std::string& clip, size_t frames);

}  // namespace samples

#endif
