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
  std::vector<std::string> lost;  // pairs whose limb does not move as its source does
  double confidence = 1;          // 0 to 1
};

ClipFaults find_faults(const Session& session, const PlayedClip& played);

// What went wrong, a sentence each; none if nothing did.
std::vector<std::string> fault_sentences(const ClipFaults& faults, const std::string& clip, size_t frames);

}  // namespace samples

#endif
