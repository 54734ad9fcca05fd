// PAIRS.json and EDITS.json: which places of two models correspond. The format is in README.md.
#ifndef HF_GLTF_PAIRS_FILE_H
#define HF_GLTF_PAIRS_FILE_H

#include <filesystem>
#include <string>
#include <vector>

#include "gltf/named_chains.h"
#include "gltf/regions.h"

namespace hf_gltf {

struct PairEntry {
  std::string name;
  std::vector<Selector> source, target;
  bool anchor = false, foot = false, trunk = false, contact = false, sinks = false, align = true;
  std::string limb;            // what a dial turns: neck, tail, arm, or empty
  bool contact_given = false;  // the file says whether it is a contact, so nothing is looked for
  uint32_t flags() const;      // HF_PAIR_*
};

struct TransferSettings {
  bool paper = false, stretch = false;
  uint32_t clusters = 0;
  double width = 0, scale = 0, alignment_degrees = 0;  // 0 = the library's default; negative = never
  bool ground = true;                                  // false: the body has no feet and no ground
};

// The dials of an animator; neutral as made (hf_transfer_dials).
struct TransferDials {
  double stride = 1, hip_height_share = 0, neck_follow = 0, tail_follow = 0, arm_space_degrees = 0, long_follow = 0;
};

struct PairsFile {
  Axes source_axes, target_axes;
  TransferSettings settings;
  TransferDials dials;
  std::vector<PairEntry> pairs;
  std::vector<NamedChain> chains;
};

// The limb of a pair that names none, from the name of the pair: neck for nose, head, ear, neck, horn or antler; tail;
// arm for hand or arm. Empty: no limb.
std::string limb_of(const std::string& pair_name);

// Throws std::runtime_error "file: key path: the fault". chains_do: chains without pairs are enough.
PairsFile read_pairs(const std::filesystem::path& file, bool chains_do = false);
// Reads the pairs from a JSON value. `what` names it in messages.
PairsFile parse_pairs(const nlohmann::json& value, const std::string& what);

// The regions of pairs on both models, put behind those that are there. They take no vertex of a region before them,
// and share none. Throws std::runtime_error that names the pair.
void add_regions(const std::vector<PairEntry>& pairs, const RegionFinder& source_finder,
                 const RegionFinder& target_finder, std::vector<Region>& source, std::vector<Region>& target);

// Sets a dial by its key of PAIRS.json. Throws std::runtime_error for unknown keys and values out of range.
void set_dial(TransferDials& dials, const std::string& key, double value);

struct EditsFile {
  std::vector<std::string> remove;
  std::vector<PairEntry> add;
};

EditsFile read_edits(const std::filesystem::path& file);

}  // namespace hf_gltf

#endif
