// Head, tail and hands of a creature, and the order of the search. See landmarks.h.
#include "gltf/landmarks.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <stdexcept>

#include "gltf/landmark_finder.h"

namespace hf_gltf {

void Finder::measure() {
  ground_ = front_ = middle_ = 0;
  double low = 1e300, high = -1e300, left = -1e300, right = 1e300;
  front_ = -1e300;
  back_ = 1e300;
  for (const uint32_t v : first_) {
    const glm::dvec3& p = mesh_.positions[v];
    low = std::min(low, glm::dot(p, axes_.up));
    high = std::max(high, glm::dot(p, axes_.up));
    left = std::max(left, glm::dot(p, axes_.right));
    right = std::min(right, glm::dot(p, axes_.right));
    front_ = std::max(front_, glm::dot(p, axes_.forward));
    back_ = std::min(back_, glm::dot(p, axes_.forward));
  }
  ground_ = low;
  height_ = high - low;
  middle_ = 0.5 * (left + right);
}

KnownNode Finder::known(uint32_t v) const {
  const int owner = regions_ && out_.known.knows_parts() ? regions_->owner(v) : -1;
  return owner < 0 ? KnownNode() : out_.known.nodes[static_cast<size_t>(owner)];
}

BodyPart Finder::carried_by(uint32_t v) const {
  const int owner = regions_ && out_.known.knows_parts() ? regions_->owner(v) : -1;
  for (int node = owner; node >= 0; node = model_.nodes[static_cast<size_t>(node)].parent) {
    const BodyPart part = out_.known.nodes[static_cast<size_t>(node)].part;
    if (part != BodyPart::other) return part;
  }
  return BodyPart::other;
}

bool Finder::may_be_hand(uint32_t v) const { return carries_limbs(v) && known(v).part != BodyPart::leg; }

bool Finder::may_be_foot(uint32_t v) const { return carries_limbs(v) && known(v).part != BodyPart::trunk; }

bool Finder::carries_limbs(uint32_t v) const {
  const BodyPart part = carried_by(v);
  return part != BodyPart::head && part != BodyPart::ear && part != BodyPart::antenna && part != BodyPart::tail &&
         part != BodyPart::wing && part != BodyPart::fin;
}

std::vector<uint32_t> Finder::of_part(BodyPart part) const {
  std::vector<uint32_t> out;
  for (const uint32_t v : first_)
    if (known(v).part == part) out.push_back(v);
  return out;
}

// A selector that finds the vertex: by its joint when one of the directions leads there, else by its place.
Selector Finder::express(uint32_t vertex, double radius, const std::vector<std::string>& directions) const {
  Selector out;
  out.radius = radius;
  out.has_radius = true;
  out.where = "a proposed place";
  const std::string joint = regions_->owner_name(vertex);
  if (!joint.empty() && regions_->is_joint(joint)) {
    out.joints = {joint};
    for (const std::string& direction : directions) {
      out.extreme = direction;
      if (glm::distance(regions_->find({out}).seed, mesh_.positions[vertex]) < 0.025 * diagonal_) return out;
    }
  }
  out.joints.clear();
  out.extreme.clear();
  out.has_position = true;
  out.position = mesh_.positions[vertex];
  return out;
}

void Finder::add(const std::string& name, uint32_t vertex, const std::vector<std::string>& directions,
                 double confidence, const std::string& found, double radius) {
  Landmark landmark;
  landmark.name = name;
  landmark.place = express(vertex, radius, directions);
  landmark.position = mesh_.positions[vertex];
  landmark.confidence = confidence;
  landmark.found = found;
  out_.list.push_back(landmark);
}

void Finder::add_place(const std::string& name, const glm::dvec3& place, double confidence, const std::string& found) {
  Landmark landmark;
  landmark.name = name;
  landmark.position = place;
  landmark.confidence = confidence;
  landmark.found = found;
  landmark.place.has_position = landmark.place.has_radius = true;
  landmark.place.position = place;
  landmark.place.radius = trunk_ball;
  out_.list.push_back(landmark);
}

void Finder::add_head() {
  std::vector<uint32_t> head = of_part(BodyPart::head);
  const bool by_joint = !head.empty();
  if (out_.upright) {
    if (head.empty()) {
      for (const uint32_t v : first_)
        if (std::abs(side(v)) < 0.12 * diagonal_) head.push_back(v);
    }
    if (head.empty()) head = first_;
    double mean = 0;
    for (const uint32_t v : head) mean += forward(v) / static_cast<double>(head.size());
    const auto value = [&](uint32_t v) { return up(v) - 0.3 * std::hypot(side(v), forward(v) - mean); };
    add("head", best_of(head, value), {"up"}, by_joint ? 0.9 : 0.7,
        by_joint ? "top of the head joint" : "highest place", 0.05);
    return;
  }
  if (head.empty()) {
    for (const uint32_t v : first_)
      if (up(v) > 0.25 * height_) head.push_back(v);
  }
  if (head.empty()) head = first_;
  add("nose", best_of(head, [&](uint32_t v) { return forward(v) - 0.3 * std::abs(side(v)); }), {"forward"},
      by_joint ? 0.9 : 0.5, by_joint ? "front of the head joint" : "foremost place");
}

// Ears by their joints only: their shapes say nothing that horns do not.
void Finder::add_ears() {
  const std::vector<uint32_t> ears = of_part(BodyPart::ear);
  for (const double sign : {1.0, -1.0}) {
    std::vector<uint32_t> own;
    glm::dvec3 base(0);
    for (const uint32_t v : ears)
      if (sign * side(v) > 0) own.push_back(v);
    if (own.empty()) continue;
    // the end that is furthest from where the ear meets the head
    const uint32_t low = best_of(own, [&](uint32_t v) { return -up(v) - sign * side(v); });
    base = mesh_.positions[low];
    const auto reach = [&](uint32_t v) { return glm::distance(mesh_.positions[v], base); };
    add(sign > 0 ? "ear left" : "ear right", best_of(own, reach), {"away", "up"}, 0.8, "tip of the ear joints", 0.02);
  }
}

void Finder::add_tail() {
  const std::vector<uint32_t> tail = of_part(BodyPart::tail);
  if (!tail.empty()) {
    // the end that is furthest from where the tail meets the body
    const uint32_t base = best_of(tail, [&](uint32_t v) { return forward(v); });
    const uint32_t tip =
        best_of(tail, [&](uint32_t v) { return glm::distance(mesh_.positions[v], mesh_.positions[base]); });
    add("tail", tip, {"away", "back", "down", "up"}, 0.9, "tip of the tail joints");
    return;
  }
  if (out_.upright) return;
  std::vector<uint32_t> rear;
  for (const uint32_t v : tips_) {
    const bool is_foot = std::any_of(feet_.begin(), feet_.end(), [&](const Foot& foot) {
      return glm::distance(foot.place, mesh_.positions[v]) < 2 * same_foot * diagonal_;
    });
    const BodyPart part = carried_by(v);
    if (part == BodyPart::wing || part == BodyPart::fin || part == BodyPart::head) continue;
    if (!is_foot && forward(v) < back_ + 0.35 * (front_ - back_) && std::abs(side(v)) < 0.1 * diagonal_)
      rear.push_back(v);
  }
  if (!rear.empty()) {
    add("tail", rear.front(), {"away", "back", "down", "up"}, 0.6, "extremity behind");
    return;
  }
  for (const uint32_t v : first_)
    if (up(v) > 0.3 * height_) rear.push_back(v);
  if (rear.empty()) rear = first_;
  add("tail", best_of(rear, [&](uint32_t v) { return -forward(v) - 0.3 * std::abs(side(v)); }), {"back"}, 0.3,
      "rearmost place");
}

// The shape alone gives hands only to a body with two legs, and on both sides or on none: a horn on one side is no
// hand.
void Finder::add_hands() {
  std::vector<uint32_t> hands = of_part(BodyPart::hand);
  if (hands.empty()) hands = of_part(BodyPart::finger);
  const glm::dvec3 chest =
      middle_ * axes_.right + 0.5 * (front_ + back_) * axes_.forward + (ground_ + 0.8 * height_) * axes_.up;
  const auto reach = [&](uint32_t v) { return glm::distance(mesh_.positions[v], chest); };
  struct Hand {
    uint32_t vertex = 0;
    double confidence = 0;
    const char* found = nullptr;
  } ends[2];
  bool by_joints = false;
  for (const double sign : {1.0, -1.0}) {
    std::vector<uint32_t> own, tips, wide;
    for (const uint32_t v : hands)
      if (sign * known(v).side > 0) own.push_back(v);
    const auto is_hand = [&](uint32_t v) {
      return sign * side(v) > 0.1 * height_ && up(v) > 0.05 * height_ && up(v) < 0.85 * height_ && may_be_hand(v);
    };
    for (const uint32_t v : tips_)
      if (is_hand(v)) tips.push_back(v);
    for (const uint32_t v : first_)
      if (is_hand(v)) wide.push_back(v);
    const auto width = [&](uint32_t v) { return sign * side(v); };
    const auto raised =
        std::find_if(raised_.begin(), raised_.end(), [&](const Foot& foot) { return sign * foot.known_side > 0; });
    Hand& hand = ends[sign > 0 ? 0 : 1];
    const bool known_here = !own.empty() || raised != raised_.end();
    by_joints = by_joints || known_here;
    if (!own.empty())
      hand = {best_of(own, reach), 0.9, "end of the hand joints"};
    else if (raised != raised_.end())
      hand = {raised->vertex, 0.8, "end of the arm joints"};
    else if (out_.leg_pairs == 1 && !tips.empty())
      hand = {best_of(tips, width), 0.7, "extremity at the side"};
    else if (out_.leg_pairs == 1 && !wide.empty() && out_.upright)
      hand = {best_of(wide, width), 0.4, "widest place"};
  }
  if (!by_joints && (!ends[0].found || !ends[1].found)) return;
  for (const bool left : {true, false}) {
    const Hand& hand = ends[left ? 0 : 1];
    if (hand.found)
      add(left ? "hand left" : "hand right", hand.vertex, {"down", "away", left ? "right" : "left", "forward"},
          hand.confidence, hand.found);
  }
}

// The tips of the longest pair of fins or wings of the skeleton. Returns whether there is one.
bool Finder::add_known_fins(BodyPart part, const std::string& name) {
  std::map<int, std::vector<uint32_t>> limbs;
  for (const uint32_t v : of_part(part)) {
    const KnownNode node = known(v);
    if (node.limb >= 0 && node.side != 0) limbs[node.limb].push_back(v);
  }
  struct Tip {
    uint32_t vertex = 0;
    double length = 0;
  };
  std::vector<Tip> sides[2];
  for (const auto& [number, limb] : limbs) {
    // the end that is furthest from where the limb meets the body
    const uint32_t base = best_of(limb, [&](uint32_t v) { return -std::abs(side(v)); });
    const auto reach = [&](uint32_t v) { return glm::distance(mesh_.positions[v], mesh_.positions[base]); };
    const uint32_t tip = best_of(limb, reach);
    sides[known(tip).side > 0 ? 0 : 1].push_back({tip, reach(tip)});
  }
  const Tip* best[2] = {nullptr, nullptr};
  double most = 0;
  for (const Tip& left : sides[0]) {
    const glm::dvec3 mirrored = mesh_.positions[left.vertex] - 2 * side(left.vertex) * axes_.right;
    for (const Tip& right : sides[1]) {
      // tips of a pair mirror each other
      const double value = left.length + right.length - glm::distance(mirrored, mesh_.positions[right.vertex]);
      if (best[0] && value <= most) continue;
      most = value;
      best[0] = &left;
      best[1] = &right;
    }
  }
  if (!best[0]) return false;
  for (const bool left : {true, false})
    add(name + (left ? " left" : " right"), best[left ? 0 : 1]->vertex,
        {"away", left ? "right" : "left", "up", "down", "back"}, 0.9, "tip of the " + name + " joints");
  return true;
}

// Fins of a body without feet: the fins of the skeleton, else the widest places, if they are far from the middle.
void Finder::add_fins() {
  if (add_known_fins(BodyPart::fin, "fin")) return;
  std::vector<uint32_t> free;
  for (const uint32_t v : first_)
    if (may_be_hand(v)) free.push_back(v);
  for (const double sign : {1.0, -1.0}) {
    if (free.empty()) return;
    const uint32_t tip = best_of(free, [&](uint32_t v) { return sign * side(v); });
    if (sign * side(tip) > 0.15 * diagonal_)
      add(sign > 0 ? "fin left" : "fin right", tip, {sign > 0 ? "right" : "left", "away"}, 0.5, "widest place");
  }
}

Landmarks Finder::find(const Axes* axes) {
  const RegionFinder first(model_, mesh_, Axes());
  regions_ = &first;
  out_.known = know_body(model_, mesh_, axes);
  if (axes) {
    axes_ = *axes;
    out_.axes_from = AxesFrom::caller;
    measure();
  } else {
    choose_axes();
  }
  // sides follow the axes, also where the caller has other axes than the skeleton
  if (glm::dot(out_.known.axes.right, axes_.right) < 0)
    for (KnownNode& node : out_.known.nodes) node.side = -node.side;
  const RegionFinder finder(model_, mesh_, axes_);
  regions_ = &finder;
  std::vector<Foot> left, right;
  const size_t pairs = search_feet(left, right);
  // ears and hands may hang unevenly at rest; feet rarely do
  double shift = 0;
  for (const Foot& foot : left) shift += 0.5 * foot.side / static_cast<double>(left.size());
  for (const Foot& foot : right) shift += 0.5 * foot.side / static_cast<double>(right.size());
  if (pairs > 0 && left.size() == right.size() && std::abs(shift) < 0.05 * diagonal_) middle_ += shift;
  out_.axes = axes_;
  out_.leg_pairs = pairs;
  // a cape or a weapon makes a body as long as it is high; the skeleton does not count them
  out_.upright = pairs == 1 && (out_.known.knows_parts() ? out_.known.upright : height_ > 1.1 * (front_ - back_));
  add_head();
  add_ears();
  add_tail();
  feet_.clear();
  for (std::vector<Foot>* feet : {&left, &right}) {
    std::sort(feet->begin(), feet->end(), [](const Foot& a, const Foot& b) { return a.forward > b.forward; });
    const char* word = feet == &left ? " left" : " right";
    for (size_t i = 0; i < pairs; ++i) {
      // the foremost and the last ones when one side has more
      const Foot& foot = i + 1 == pairs ? feet->back() : (*feet)[i];
      const std::string name = pairs == 1       ? "foot"
                               : i == 0         ? "front foot"
                               : i + 1 == pairs ? "hind foot"
                                                : "middle foot " + std::to_string(i);
      const bool even = left.size() == right.size();
      add(name + word, foot.vertex, {"down"},
          !even                       ? 0.5
          : known_feet_ || first_try_ ? 0.9
                                      : 0.7,
          !even         ? "one of an odd number on the ground"
          : known_feet_ ? "end of the leg's joints"
          : first_try_  ? "stands on the ground"
                        : "reaches lowest on its side");
      feet_.push_back(foot);
    }
  }
  if (pairs <= 1) add_hands();
  if (pairs == 0) add_fins();
  add_known_fins(BodyPart::wing, "wing");
  add_trunk();
  return out_;
}

const Landmark* Landmarks::get(const std::string& name) const {
  for (const Landmark& landmark : list)
    if (landmark.name == name) return &landmark;
  return nullptr;
}

std::string axis_name(const glm::dvec3& direction) {
  char text[64];
  for (int c = 0; c < 3; ++c) {
    if (std::abs(direction[c]) == 1) return std::string(direction[c] > 0 ? "+" : "-") + "xyz"[c];
  }
  std::snprintf(text, sizeof text, "%.2f %.2f %.2f", direction.x, direction.y, direction.z);
  return text;
}

std::string axes_sentence(const Landmarks& landmarks) {
  const auto sure = [](double confidence) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2f", confidence);
    return std::string(text);
  };
  const KnownBody& known = landmarks.known;
  const std::string up = axis_name(landmarks.axes.up), forward = axis_name(landmarks.axes.forward);
  if (landmarks.axes_from == AxesFrom::caller) return "up " + up + ", faces " + forward + ", as given";
  if (landmarks.axes_from == AxesFrom::skeleton)
    return "up " + up + " from the skeleton, " + sure(known.up_confidence) + ": " + known.up_why + "; faces " +
           forward + ", " + sure(known.forward_confidence) + ": " + known.forward_why;
  std::string out = "up " + up + ", faces " + forward + ", from the surface";
  if (!known.nodes.empty() && known.part_confidence > 0)
    out += "; its joints say up " + axis_name(known.axes.up) + ", forward " + axis_name(known.axes.forward) +
           " and are not sure, " +
           sure(std::min({known.up_confidence, known.forward_confidence, known.part_confidence}));
  return out;
}

Landmarks find_landmarks(const Body& body) { return Finder(body).find(body.axes); }

}  // namespace hf_gltf
