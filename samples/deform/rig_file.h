// The JSON files of hf_rig and hf_deform_script: handles as regions of the surface, and how they move. The format is in
// README.md. Failure: std::runtime_error naming file and key.
#ifndef HF_SAMPLES_DEFORM_RIG_FILE_H
#define HF_SAMPLES_DEFORM_RIG_FILE_H

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace samples {

// Places are fractions of the sides of the rest bounding box (0 0 0 is its lower corner). Lengths are fractions of its
// diagonal.
struct HandleEntry {
  std::string name;
  uint32_t layer = 0;
  std::vector<uint32_t> vertices;  // one of these three
  bool has_point = false;
  glm::dvec3 point{0};
  double radius = 0;
  bool has_box = false;
  glm::dvec3 lower{0}, upper{1};
  bool outside = false;  // of the box
  bool offered = false;  // proposed to be dragged, not to hold; drawn in a colour of its own
  double following = 1;  // how much of the surface follows while it is dragged
};

// Where a handle should move, from its rest place (layer 0) or from where the layers below carry it. Either it turns
// about a point and then moves, or it is the end of a straight beam whose free part bends into an arc.
struct MotionEntry {
  glm::dvec3 axis{0, 1, 0};
  double degrees = 0;
  bool has_pivot = false;
  glm::dvec3 pivot{0};
  glm::dvec3 move{0};  // fractions of the diagonal
  bool bend = false;
  glm::dvec3 bend_from{0}, bend_to{0};
};

// A region that gets another stiffness: 1 as it is, 1e4 rigid.
struct StiffEntry {
  HandleEntry region;  // without a name
  double stiffness = 1;
};

struct Step {
  std::vector<StiffEntry> stiff;
  std::vector<HandleEntry> add;
  std::vector<std::string> remove;
  std::map<std::string, MotionEntry> drag;
  double seconds = 0;
  std::string label;
};

struct ScriptFile {
  bool paper = false, refine = false;
  double frame_rate = 24;
  glm::dvec3 view{0.8, 0.35, 1.0}, up{0, 1, 0};  // for the sheet
  std::vector<Step> steps;
};

struct ClipEntry {
  std::string name;
  std::vector<Step> steps;  // drags only
};

struct RigFile {
  uint32_t bands = 0;
  double frame_rate = 30;
  std::vector<HandleEntry> handles;
  std::vector<ClipEntry> clips;
};

ScriptFile read_script(const std::filesystem::path& file);
RigFile read_rig(const std::filesystem::path& file);

}  // namespace samples

#endif
