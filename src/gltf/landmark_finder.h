// The search behind find_landmarks (landmarks.h), shared by its files: landmarks.cpp has head, tail and hands,
// landmark_feet.cpp axes and feet, landmark_trunk.cpp the trunk.
#ifndef HF_GLTF_LANDMARK_FINDER_H
#define HF_GLTF_LANDMARK_FINDER_H

#include <algorithm>
#include <string>
#include <vector>

#include "gltf/landmarks.h"

namespace hf_gltf {

constexpr double same_foot = 0.05;  // of the diagonal
constexpr double ball = 0.03, trunk_ball = 0.04;

// A place at which a body touches the ground.
struct Foot {
  glm::dvec3 place{0, 0, 0};  // lowest vertex nearest to the middle
  uint32_t vertex = 0;
  double forward = 0, side = 0;
  int known_side = 0;  // the side of its leg's joints: 1 left, -1 right, 0 unknown
};

class Finder {
 public:
  explicit Finder(const Body& body)
      : model_(body.model), mesh_(body.mesh), box_(body.mesh), diagonal_(box_.diagonal()), tips_(body.tips) {
    const auto is_loose = [&](uint32_t v) { return mesh_.loose[v] != 0; };
    tips_.erase(std::remove_if(tips_.begin(), tips_.end(), is_loose), tips_.end());
    std::vector<char> taken(mesh_.welded_count, 0);
    for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      char& known = taken[mesh_.welded[v]];
      if (!mesh_.loose[v] && !known) {
        known = 1;
        first_.push_back(v);
      }
    }
  }
  Landmarks find(const Axes* axes);

 private:
  double up(uint32_t v) const { return glm::dot(mesh_.positions[v], axes_.up) - ground_; }
  double forward(uint32_t v) const { return glm::dot(mesh_.positions[v], axes_.forward); }
  double side(uint32_t v) const { return glm::dot(mesh_.positions[v], axes_.right) - middle_; }
  void measure();
  double asymmetry(int axis) const;
  // The part of the body that a vertex belongs to, as far as the skeleton says.
  KnownNode known(uint32_t v) const;
  // The known part that a vertex belongs to, or on which its joint hangs: a horn is part of the head.
  BodyPart carried_by(uint32_t v) const;
  // Whether the skeleton lets the surface guess a hand here, and a foot: not on a head, a tail, a wing or a fin.
  bool may_be_hand(uint32_t v) const;
  bool may_be_foot(uint32_t v) const;
  bool carries_limbs(uint32_t v) const;
  std::vector<uint32_t> of_part(BodyPart part) const;
  void choose_axes();
  void find_axes();
  double toes() const;
  void find_known_feet();
  void find_feet(double reach, double slack);
  // The feet on either side of the middle, by the skeleton first, then by shape. Returns the number of pairs.
  size_t search_feet(std::vector<Foot>& left, std::vector<Foot>& right);
  size_t split_feet(std::vector<Foot>& left, std::vector<Foot>& right) const;
  template <class Value>
  uint32_t best_of(const std::vector<uint32_t>& among, Value value) const;
  Selector express(uint32_t vertex, double radius, const std::vector<std::string>& directions) const;
  void add(const std::string& name, uint32_t vertex, const std::vector<std::string>& directions, double confidence,
           const std::string& found, double radius = ball);
  void add_place(const std::string& name, const glm::dvec3& place, double confidence, const std::string& found);
  std::vector<double> hits(const glm::dvec3& start, const glm::dvec3& direction) const;
  bool top_of_back(double at_forward, glm::dvec3& place) const;
  bool back_at(double height, glm::dvec3& place) const;
  double neck_height(double crotch) const;
  void add_head(), add_ears(), add_tail(), add_hands(), add_fins(), add_trunk();
  bool add_known_fins(BodyPart part, const std::string& name);

  const Model& model_;
  const FlatMesh& mesh_;
  const RegionFinder* regions_ = nullptr;
  Axes axes_;
  std::vector<uint32_t> first_;  // one vertex per welded one of the surface
  SurfaceBox box_;
  double diagonal_, ground_ = 0, height_ = 0, middle_ = 0, front_ = 0, back_ = 0;
  std::vector<Foot> feet_, raised_;  // raised_: ends of arms
  bool known_feet_ = false, first_try_ = true;
  std::vector<uint32_t> tips_;  // extremities
  Landmarks out_;
};

template <class Value>
uint32_t Finder::best_of(const std::vector<uint32_t>& among, Value value) const {
  return *std::max_element(among.begin(), among.end(), [&](uint32_t a, uint32_t b) { return value(a) < value(b); });
}

}  // namespace hf_gltf

#endif
