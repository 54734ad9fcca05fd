// The report of a run and its quality, as text and as JSON.
#ifndef HF_SAMPLES_TRANSFER_TRANSFER_REPORT_H
#define HF_SAMPLES_TRANSFER_TRANSFER_REPORT_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf/skeleton_pair.h"
#include "transfer/faults.h"
#include "transfer/session.h"

namespace samples {

// How well a written file gives back the computed frames when it is read again, in box diagonals of the target. It has
// the largest miss at keys. It also estimates the root mean square half-way between keys, as a quarter of the second
// difference of the frames.
struct ReplayReport {
  double key_max = 0, half_rms = 0;
};
ReplayReport measure_replay(const Model& written, const std::vector<PlayedClip>& clips, double box);

// Where a body's axes come from.
struct BodyReport {
  std::string up, forward;                                                // as taken
  std::string said;                                                       // how they were found, a sentence
  double up_confidence = 0, forward_confidence = 0, part_confidence = 0;  // of its skeleton; 0: it has none
  std::vector<std::string> why;                                           // what its skeleton says, sentences
};

struct RunReport {
  std::string output;
  std::string way = "surface", way_why;  // which way the motion went, skeleton or surface
  // Of joints that lead.
  bool same_skeleton = false;
  size_t joints = 0;                   // of the target that follow
  std::vector<std::string> unmatched;  // joints of the source without a partner
  std::vector<std::string> staying;    // joints of the target without one
  double drop = 0;                     // how far the hips sank so that feet reach, in boxes
  std::vector<uint8_t> foot_paths;     // of each clip, see JointClip
  // Of each written clip, where both skeletons are known.
  std::vector<PoseFit> fits;
  std::vector<double> depths;         // of the deepest vertex, deeper than the source's, in boxes
  std::vector<double> source_depths;  // of the source's deepest vertex under its own ground, scaled, in boxes
  std::vector<PairReport> pairs;
  std::vector<std::string> warnings;
  std::vector<std::string> clip_names;
  std::vector<size_t> frames;
  std::vector<FootReport> feet;
  std::vector<double> frame_ms;
  ReplayReport replay;
  std::string written_as = "skin";          // skin, own skin, morph targets, frames
  double written_rms = 0, written_max = 0;  // of own skin and morph targets: from the computed frames, in box diagonals
  size_t written_parts = 0, keys = 0, all_keys = 0;
  std::vector<FootReport> written_feet;  // in the written file
  std::vector<ClipFaults> faults;        // in the written file
  std::vector<double> gaps;              // largest between linked pieces in the written file, in box diagonals
  std::vector<std::string> contacts;
  uint32_t clusters = 0;
  BodyReport source, target;
  std::string scale_from;
  double scale = 1, setup_ms = 0, prepare_ms = 0, edit_ms = 0;
  uint32_t source_factorisations = 0, target_factorisations = 0;
};

RunReport make_report(Session& session, const std::vector<PlayedClip>& clips, const std::string& output);

std::string to_text(const RunReport& report, const std::string& heading);
nlohmann::json to_json(const RunReport& report);

}  // namespace samples

#endif
