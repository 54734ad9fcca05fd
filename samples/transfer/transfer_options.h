// The command line of hf_transfer.
#ifndef HF_SAMPLES_TRANSFER_TRANSFER_OPTIONS_H
#define HF_SAMPLES_TRANSFER_TRANSFER_OPTIONS_H

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gltf/model.h"
#include "gltf/regions.h"

namespace samples {

using namespace hf_gltf;

struct TransferCommand {
  std::filesystem::path source, target, pairs, output;
  std::filesystem::path sheet, report, json, edits, joints, suggest;  // empty: not asked for
  std::filesystem::path clips;                                        // a file of clips for the source's skeleton
  std::filesystem::path batch;                                        // a list of transfers (batch.h)
  std::filesystem::path outcome;                                      // JSON: the report, or what went wrong
  unsigned jobs = 0;                                                  // processes of a batch; 0: one for each core
  std::string clip;                                                   // name, index or all; empty: the first
  double rate = 0;  // frames per second; 0: 30, or 60 for clips below a second; -1: the source's own keys
  unsigned threads = 1;
  std::string kind;                              // skin, own-skin, morph, frames; empty: own-skin where there is a skin
  std::string way;                               // skeleton, surface; empty: chosen by what the skeletons say
  std::filesystem::path frames;                  // folder of --out-poses
  std::vector<std::filesystem::path> poses;      // posed copies of the source's mesh
  std::vector<std::string> contacts;             // empty: found
  double morph_tolerance = 1e-3;                 // of the box
  double key_tolerance = 5e-4;                   // of the box
  std::string source_rest, target_rest;          // CLIP@TIME; empty: the pose of the file
  std::optional<Axes> source_axes, target_axes;  // for proposals; found when not given
  std::vector<std::string> sinking;              // pairs whose limb may sink into the ground
  std::vector<std::pair<std::string, double>> dials;  // name and value, over those of PAIRS.json
  bool ground = true;
  bool rigid = true;         // what the skin of the target calls rigid stays rigid
  bool in_place = false;     // clips lose their travel along the ground
  bool root_motion = false;  // it goes to the topmost node over the joints
  bool shapes = false;       // morph targets instead of clips
  bool links = true;         // between the pieces of a model
  bool quiet = false, silent = false, help = false;
};

// Throws std::runtime_error naming the option.
TransferCommand parse_command(int count, char** arguments);
const char* usage();

// "out/walk.glb" -> "out/walk_edited.glb"
std::filesystem::path edited_name(const std::filesystem::path& file);

}  // namespace samples

#endif
