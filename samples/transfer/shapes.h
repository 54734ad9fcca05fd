// The morph targets of one model as morph targets of another: face shapes, breathing.
#ifndef HF_SAMPLES_TRANSFER_SHAPES_H
#define HF_SAMPLES_TRANSFER_SHAPES_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "transfer/session.h"

namespace samples {

// Largest displacement of a vertex, in box diagonals of the source and of the target.
struct ShapeReport {
  std::string name;
  double source_moved = 0, target_moved = 0;
};

struct CarriedShapes {
  Model model;  // the target with the new morph targets behind its own
  std::vector<ShapeReport> shapes;
  PlayedClip frames;  // one frame for each shape, at full weight
  std::vector<std::string> notes;
};

// Carries every morph target of the source; those of equal names in several meshes are one. The session has mode
// stretch. clips: clips of the source whose morph weights the target plays, before its own clips. Throws
// std::runtime_error if the source has no morph target.
CarriedShapes carry_shapes(Session& session, const Model& source, const Model& target,
                           const std::vector<const Animation*>& clips, ProgressBar& bar);

std::string shapes_text(Session& session, const CarriedShapes& carried, const std::string& output,
                        const std::string& heading);
nlohmann::json shapes_json(Session& session, const CarriedShapes& carried, const std::string& output);

}  // namespace samples

#endif
