// Axes and feet of a creature. See landmark_finder.h.
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/landmark_finder.h"

namespace hf_gltf {
namespace {

// Up to where feet reach and how far off the ground they may be, of the height: legs are short under a large head, and
// some rest in mid-stride.
constexpr struct {
  double reach, slack;
} stances[] = {{0.12, 0.03}, {0.08, 0.03}, {0.05, 0.03}, {0.03, 0.02}, {0.2, 0.12}, {0.12, 0.1}};

// Bones of legs point along an axis if this share of their sum does: less takes the thighs of what sits for legs that
// stand. The 26 shared models with such names have 0.74 to 1.00 down their own axis, all but three more than 0.85.
constexpr double clearly_down = 0.85;

// The end of a limb: its vertices up to this height over its lowest one, of the height of the body.
constexpr double sole_height = 0.04;
// Two ends on one side belong to one leg if they are nearer to each other along the ground (of the diagonal).
constexpr double same_leg = 0.1;
// Limbs called legs stand on the ground if they come down to the first share of the height, arms to the second. A leg
// in mid-stride is lifted; an arm hangs.
constexpr double leg_reach = 0.25, arm_reach = 0.06;

const std::vector<std::string> leg_words = {"foot", "feet", "hoof",  "paw",  "toe",  "ankle", "leg",
                                            "shin", "calf", "thigh", "knee", "hock", "tarsus"};

int axis_of(const glm::dvec3& direction) { return direction.x != 0 ? 0 : direction.y != 0 ? 1 : 2; }

}  // namespace

// Words of a joint's name: "b_LeftHand_011" -> b left hand.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> out(1);
  char before = 0;
  for (const char c : name) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    const bool starts = std::isupper(static_cast<unsigned char>(c)) && std::islower(static_cast<unsigned char>(before));
    if ((!letter || starts) && !out.back().empty()) out.emplace_back();
    if (letter) out.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    before = c;
  }
  return out;
}

bool has_word(const std::string& name, const std::vector<std::string>& wanted) {
  for (const std::string& word : words_of(name)) {
    // "fingers" counts as "finger"
    for (const std::string& w : wanted)
      if (word == w || word == w + "s") return true;
  }
  return false;
}

// Mean distance of mirrored vertices to the nearest one, about the middle of the box.
double Finder::asymmetry(int axis) const {
  const size_t step = std::max<size_t>(1, first_.size() / 250);
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < first_.size(); i += step, ++count) {
    glm::dvec3 p = mesh_.positions[first_[i]];
    p[axis] = box_.low[axis] + box_.high[axis] - p[axis];
    double nearest = 1e300;
    for (const uint32_t v : first_) {
      const glm::dvec3 d = mesh_.positions[v] - p;
      nearest = std::min(nearest, glm::dot(d, d));
    }
    sum += std::sqrt(nearest);
  }
  return sum / static_cast<double>(count) / diagonal_;
}

// How far the soles reach before the ankles, over the height.
double Finder::toes() const {
  double sole = 0, ankle = 0, soles = 0, ankles = 0;
  for (const uint32_t v : first_) {
    if (up(v) < 0.04 * height_) {
      sole += forward(v);
      soles += 1;
    }
    if (up(v) > 0.07 * height_ && up(v) < 0.13 * height_) {
      ankle += forward(v);
      ankles += 1;
    }
  }
  return soles > 0 && ankles > 0 ? (sole / soles - ankle / ankles) / height_ : 0;
}

// Up is +y, as in glTF, unless the bones of the legs point down another axis: a model whose z is up, or that lies.
void Finder::find_up() {
  const std::vector<glm::dmat4> globals = global_matrices(model_, rest_pose(model_));
  glm::dvec3 down(0);
  for (const Skin& skin : model_.skins) {
    for (const int joint : skin.joints) {
      const int above = model_.nodes[static_cast<size_t>(joint)].parent;
      if (above < 0 || !has_word(model_.nodes[static_cast<size_t>(joint)].name, leg_words) ||
          !has_word(model_.nodes[static_cast<size_t>(above)].name, leg_words))
        continue;
      down += glm::dvec3(globals[static_cast<size_t>(joint)][3] - globals[static_cast<size_t>(above)][3]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    if (std::abs(down[c]) <= clearly_down * glm::length(down)) continue;
    axes_.up = glm::dvec3(0);
    axes_.up[c] = down[c] > 0 ? -1 : 1;
  }
}

void Finder::find_axes() {
  axes_ = Axes();
  find_up();
  // a model whose z is up faces -y, as glTF's exporters turn it
  if (axes_.up.z != 0) axes_.forward = {0, -axes_.up.z, 0};
  axes_.right = glm::cross(axes_.up, axes_.forward);
  // along the side a creature is symmetric; x of a model whose y is up, unless z is clearly the one
  if (asymmetry(axis_of(axes_.forward)) < 0.5 * asymmetry(axis_of(axes_.right))) {
    axes_.forward = axes_.right;
    axes_.right = glm::cross(axes_.up, axes_.forward);
  }
  measure();
  double evidence = std::clamp(toes(), -0.1, 0.1);  // a rest in mid-stride says nothing
  const std::vector<uint32_t> head = named({"head", "jaw", "nose", "snout", "muzzle"});
  if (!head.empty()) {
    // before the feet; the middle of the box would be led astray by a tail or a weapon
    double mean = 0, under = 0, low = 0;
    for (const uint32_t v : head) mean += forward(v) / static_cast<double>(head.size());
    for (const uint32_t v : first_)
      if (up(v) < 0.1 * height_) {
        under += forward(v);
        low += 1;
      }
    evidence += 0.5 * (mean - under / low) / height_;
    const std::vector<uint32_t> eyes = named({"eye"});
    for (const uint32_t v : eyes) evidence += (forward(v) - mean) / height_ / static_cast<double>(eyes.size());
  }
  if (evidence < -0.03) {
    axes_.forward = -axes_.forward;
    axes_.right = -axes_.right;
    measure();
  }
}

// Limbs by the names of their joints. "FrontUpLeg.L", "FrontLowLeg.L" and "FrontFoot.L" are one limb: the words that do
// not name a part of a leg or a side tell limbs apart. The lower end of a limb is a foot if it comes near the ground. A
// limb that does not is kept in raised_: a dinosaur's arm may be called a front foot.
void Finder::find_named_feet() {
  static const std::vector<std::string> arm = {"hand", "palm", "wrist", "forearm", "fore", "arm"};
  std::map<std::string, std::vector<uint32_t>> limbs;
  std::map<std::string, std::string> key_of_joint;
  for (const uint32_t v : first_) {
    const std::string& joint = regions_->owner_name(v);
    const auto known = key_of_joint.find(joint);
    if (known != key_of_joint.end()) {
      if (!known->second.empty()) limbs[known->second].push_back(v);
      continue;
    }
    std::string& key = key_of_joint[joint];
    const bool is_leg = has_word(joint, leg_words);
    if (!is_leg && !has_word(joint, arm)) continue;
    key = is_leg ? "leg" : "arm";
    for (const std::string& word : words_of(joint)) {
      static const std::vector<std::string> parts = {"up",   "upper", "low",  "lower", "l",    "r",
                                                     "left", "right", "b",    "bip",   "bone", "def",
                                                     "mid",  "end",   "base", "ball",  "ik",   "mixamorig"};
      const auto is = [&](const std::vector<std::string>& list) {
        return std::any_of(list.begin(), list.end(),
                           [&](const std::string& other) { return word == other || word == other + "s"; });
      };
      // "mid" tells legs apart where there is a "front" too
      if (!is(leg_words) && !is(arm) && (!is(parts) || word == "mid")) key += " " + word;
    }
    limbs[key].push_back(v);
  }
  feet_.clear();
  raised_.clear();
  for (const auto& [key, vertices] : limbs) {
    for (const double sign : {1.0, -1.0}) {
      double low = 1e300;
      for (const uint32_t v : vertices)
        if (sign * side(v) > 0.01 * diagonal_) low = std::min(low, up(v));
      if (low == 1e300) continue;
      std::vector<uint32_t> end;
      glm::dvec3 mean(0);
      for (const uint32_t v : vertices)
        if (sign * side(v) > 0.01 * diagonal_ && up(v) < low + sole_height * height_) {
          end.push_back(v);
          mean += mesh_.positions[v];
        }
      mean /= static_cast<double>(end.size());
      const uint32_t vertex =
          best_of(end, [&](uint32_t v) { return -up(v) - 0.3 * glm::distance(mesh_.positions[v], mean); });
      const Foot foot = {mesh_.positions[vertex], vertex, glm::dot(mean, axes_.forward),
                         glm::dot(mean, axes_.right) - middle_};
      const bool stands = low < (key.substr(0, 3) == "leg" ? leg_reach : arm_reach) * height_;
      (stands ? feet_ : raised_).push_back(foot);
    }
  }
}

// A joint of an inverse kinematics chain may own the hoof, and the leg above it ends just over the hoof: one foot.
void Finder::merge_feet() {
  std::sort(feet_.begin(), feet_.end(), [&](const Foot& a, const Foot& b) { return up(a.vertex) < up(b.vertex); });
  std::vector<Foot> kept;
  for (const Foot& foot : feet_) {
    const bool same = std::any_of(kept.begin(), kept.end(), [&](const Foot& other) {
      return foot.side * other.side > 0 &&
             std::hypot(foot.side - other.side, foot.forward - other.forward) < same_leg * diagonal_;
    });
    if (!same) kept.push_back(foot);
  }
  feet_.swap(kept);
}

size_t Finder::search_feet(std::vector<Foot>& left, std::vector<Foot>& right) {
  find_named_feet();
  merge_feet();
  size_t pairs = split_feet(left, right);
  if (pairs > 0 && left.size() == right.size()) {
    named_feet_ = true;
    return pairs;
  }
  for (const auto& stance : stances) {
    find_feet(stance.reach, stance.slack);
    pairs = split_feet(left, right);
    if (pairs > 0) return pairs;
    first_try_ = false;
  }
  return 0;
}

void Finder::find_feet(double reach, double slack) {
  feet_.clear();
  // pieces of the surface near the ground
  std::vector<uint32_t> parent(mesh_.welded_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t w) {
    while (parent[w] != w) w = parent[w] = parent[parent[w]];
    return w;
  };
  const auto is_low = [&](uint32_t v) { return up(v) < reach * height_; };
  for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const uint32_t a = mesh_.triangles[t], b = mesh_.triangles[t - t % 3 + (t + 1) % 3];
    if (is_low(a) && is_low(b)) parent[root(mesh_.welded[a])] = root(mesh_.welded[b]);
  }
  struct Piece {
    glm::dvec3 sum{0, 0, 0};
    double count = 0, lowest = 1e300;
    std::vector<uint32_t> vertices;
    glm::dvec3 mean() const { return sum / count; }
  };
  std::vector<Piece> of_root(mesh_.welded_count), pieces;
  for (const uint32_t v : first_) {
    if (!is_low(v)) continue;
    Piece& piece = of_root[root(mesh_.welded[v])];
    piece.sum += mesh_.positions[v];
    piece.count += 1;
    piece.lowest = std::min(piece.lowest, up(v));
    piece.vertices.push_back(v);
  }
  for (Piece& piece : of_root) {
    if (piece.count < 1 || piece.lowest > slack * height_) continue;
    const auto near = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& other) {
      return glm::distance(other.mean(), piece.mean()) < same_foot * diagonal_;
    });
    if (near == pieces.end()) {
      pieces.push_back(piece);
    } else {
      near->sum += piece.sum;
      near->count += piece.count;
      near->vertices.insert(near->vertices.end(), piece.vertices.begin(), piece.vertices.end());
    }
  }
  for (const Piece& piece : pieces) {
    const glm::dvec3 mean = piece.mean();
    const uint32_t vertex =
        best_of(piece.vertices, [&](uint32_t v) { return -up(v) - 0.3 * glm::distance(mesh_.positions[v], mean); });
    feet_.push_back(
        {mesh_.positions[vertex], vertex, glm::dot(mean, axes_.forward), glm::dot(mean, axes_.right) - middle_});
  }
}

// Those on either side of the middle; the number of pairs.
size_t Finder::split_feet(std::vector<Foot>& left, std::vector<Foot>& right) const {
  left.clear();
  right.clear();
  for (const Foot& foot : feet_) {
    if (std::abs(foot.side) > 0.01 * diagonal_) (foot.side > 0 ? left : right).push_back(foot);
  }
  return std::min(left.size(), right.size());
}

}  // namespace hf_gltf
