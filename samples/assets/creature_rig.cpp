// See creature_rig.h.
#include "creature_rig.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace samples {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

struct Rig {
  const char* name;
  double arms;  // degrees by which the arms rise to the side at rest
  double leg, arm, head;
  const char *left, *right;
  bool side_first;
  std::vector<std::pair<const char*, const char*>> names;  // the biped's, without a side, and the rig's
};

const std::vector<Rig>& rigs() {
  static const std::vector<Rig> all = {{"biped_tall",
                                        52,
                                        1.25,
                                        1.05,
                                        0.9,
                                        "mixamorig:Left",
                                        "mixamorig:Right",
                                        true,
                                        {{"root", "Armature"},
                                         {"hips", "mixamorig:Hips"},
                                         {"spine_1", "mixamorig:Spine"},
                                         {"spine_2", "mixamorig:Spine1"},
                                         {"chest", "mixamorig:Spine2"},
                                         {"neck", "mixamorig:Neck"},
                                         {"head", "mixamorig:Head"},
                                         {"clavicle", "Shoulder"},
                                         {"upper_arm", "Arm"},
                                         {"lower_arm", "ForeArm"},
                                         {"hand", "Hand"},
                                         {"fingers", "HandMiddle1"},
                                         {"thumb", "HandThumb1"},
                                         {"upper_leg", "UpLeg"},
                                         {"lower_leg", "Leg"},
                                         {"foot", "Foot"},
                                         {"toes", "ToeBase"}}},
                                       {"biped_small",
                                        -25,
                                        0.65,
                                        0.85,
                                        1.5,
                                        ".L",
                                        ".R",
                                        false,
                                        {{"root", "rig"},
                                         {"hips", "pelvis"},
                                         {"spine_1", "spine"},
                                         {"spine_2", "spine.001"},
                                         {"chest", "ribs"},
                                         {"neck", "neck"},
                                         {"head", "head"},
                                         {"clavicle", "shoulder"},
                                         {"upper_arm", "upperarm"},
                                         {"lower_arm", "forearm"},
                                         {"hand", "hand"},
                                         {"fingers", "f_middle"},
                                         {"thumb", "thumb"},
                                         {"upper_leg", "thigh"},
                                         {"lower_leg", "shin"},
                                         {"foot", "foot"},
                                         {"toes", "toe"}}}};
  return all;
}

// The name without its side, and the side: 1 left, -1 right, 0 none.
std::pair<std::string, int> parted(const std::string& name) {
  for (const auto& [end, side] : {std::pair<const char*, int>("_L", 1), {"_R", -1}}) {
    const std::string tail = end;
    if (name.size() > tail.size() && name.compare(name.size() - tail.size(), tail.size(), tail) == 0)
      return {name.substr(0, name.size() - tail.size()), side};
  }
  return {name, 0};
}

std::string renamed(const Rig& rig, const std::string& name) {
  const auto [bare, side] = parted(name);
  for (const auto& [from, to] : rig.names) {
    if (bare != from) continue;
    if (side == 0) return to;
    const std::string word = side > 0 ? rig.left : rig.right;
    return rig.side_first ? word + to : to + word;
  }
  return name;
}

using Matrix = std::array<double, 16>;  // columns first

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (size_t c = 0; c < 4; ++c)
    for (size_t r = 0; r < 4; ++r)
      for (size_t k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return out;
}

// What the rig does to a joint at rest: a turn about the forward axis, and a size that its children inherit.
Matrix local(const Rig& rig, const Joint& joint) {
  const auto [bare, side] = parted(joint.name);
  const double size = bare == "upper_leg" ? rig.leg : bare == "upper_arm" ? rig.arm : bare == "head" ? rig.head : 1;
  const double angle = bare == "upper_arm" ? side * rig.arms * degree : 0;
  const double c = size * std::cos(angle), s = size * std::sin(angle);
  return {c, s, 0, 0, -s, c, 0, 0, 0, 0, size, 0, joint.translation[0], joint.translation[1], joint.translation[2], 1};
}

}  // namespace

std::vector<std::string> rigged_names() {
  std::vector<std::string> out;
  for (const Rig& rig : rigs()) out.emplace_back(rig.name);
  return out;
}

Creature make_rigged(const std::string& name, uint32_t vertices) {
  const auto found = std::find_if(rigs().begin(), rigs().end(), [&](const Rig& rig) { return name == rig.name; });
  if (found == rigs().end()) throw std::runtime_error("there is no rig \"" + name + "\"");
  Creature out = make_creature("biped", vertices);
  out.name = name;
  out.clips.clear();
  std::vector<double> world;
  std::vector<Matrix> matrices;
  for (const Joint& joint : out.skeleton) {
    const Matrix own = local(*found, joint);
    matrices.push_back(joint.parent < 0 ? own : product(matrices[static_cast<size_t>(joint.parent)], own));
    world.insert(world.end(), matrices.back().begin(), matrices.back().end());
  }
  const std::vector<double> posed = skin_positions(out, world);
  // normals by the same matrices: sizes are even, so they turn alike
  std::vector<float> normals(out.normals.size(), 0);
  double low = std::numeric_limits<double>::infinity();
  for (size_t v = 0; v < out.vertex_count(); ++v) {
    low = std::min(low, posed[3 * v + 1]);
    double n[3] = {0, 0, 0}, length = 0;
    for (size_t k = 0; k < 4; ++k) {
      const Matrix& m = matrices[out.joints[v][k]];
      for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c)
          n[r] += static_cast<double>(out.weights[v][k]) * m[4 * c + r] * static_cast<double>(out.normals[3 * v + c]);
    }
    for (const double x : n) length += x * x;
    for (size_t r = 0; r < 3; ++r) normals[3 * v + r] = static_cast<float>(n[r] / std::sqrt(std::max(length, 1e-30)));
  }
  // it stands on the ground again
  for (size_t i = 0; i < posed.size(); ++i) out.positions[i] = static_cast<float>(posed[i] - (i % 3 == 1 ? low : 0));
  out.normals = std::move(normals);
  for (size_t j = 0; j < out.skeleton.size(); ++j) {
    Joint& joint = out.skeleton[j];
    for (size_t c = 0; c < 3; ++c) {
      const double above = joint.parent < 0 ? 0 : matrices[static_cast<size_t>(joint.parent)][12 + c];
      joint.translation[c] = matrices[j][12 + c] - above - (joint.parent == 0 && c == 1 ? low : 0);
    }
    joint.name = renamed(*found, joint.name);
  }
  return out;
}

}  // namespace samples
