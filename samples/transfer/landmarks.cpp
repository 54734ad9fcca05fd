// See landmarks.h.
#include "transfer/landmarks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "transfer/flat_surface.h"

namespace samples {
namespace {

// Up to where feet reach and how far off the ground they may be, of the height: legs are short under a large head, and
// some rest in mid-stride.
constexpr struct {
  double reach, slack;
} stances[] = {{0.12, 0.03}, {0.08, 0.03}, {0.05, 0.03}, {0.03, 0.02}, {0.2, 0.12}, {0.12, 0.1}};
constexpr double same_foot = 0.05;  // of the diagonal
constexpr double ball = 0.03, trunk_ball = 0.04;

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

struct Foot {
  glm::dvec3 place{0, 0, 0};  // lowest vertex nearest to the middle
  uint32_t vertex = 0;
  double forward = 0, side = 0;
};

class Finder {
 public:
  Finder(const Model& model, const FlatMesh& mesh) : model_(model), mesh_(mesh), first_(mesh.welded_count, 0) {
    for (uint32_t v = mesh.vertex_count(); v-- > 0;) first_[mesh.welded[v]] = v;
    low_ = glm::dvec3(std::numeric_limits<double>::infinity()), high_ = -low_;
    for (const glm::dvec3& p : mesh.positions) low_ = glm::min(low_, p), high_ = glm::max(high_, p);
    diagonal_ = glm::length(high_ - low_);
  }
  Landmarks find(const Axes* axes);

 private:
  double up(uint32_t v) const { return glm::dot(mesh_.positions[v], axes_.up) - ground_; }
  double forward(uint32_t v) const { return glm::dot(mesh_.positions[v], axes_.forward); }
  double side(uint32_t v) const { return glm::dot(mesh_.positions[v], axes_.right) - middle_; }
  void measure();
  double asymmetry(int axis) const;
  void find_axes();
  double toes() const;
  void find_feet(double reach, double slack);
  size_t split_feet(std::vector<Foot>& left, std::vector<Foot>& right) const;
  std::vector<uint32_t> named(const std::vector<std::string>& words) const;
  void find_extremities();
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
  void add_head(), add_ears(), add_tail(), add_hands(), add_trunk();

  const Model& model_;
  const FlatMesh& mesh_;
  const RegionFinder* regions_ = nullptr;
  Axes axes_;
  std::vector<uint32_t> first_;  // one vertex per welded one
  glm::dvec3 low_, high_;
  double diagonal_ = 0, ground_ = 0, height_ = 0, middle_ = 0, front_ = 0, back_ = 0;
  std::vector<Foot> feet_;
  std::vector<uint32_t> tips_;  // extremities
  Landmarks out_;
};

void Finder::measure() {
  ground_ = front_ = middle_ = 0;
  double low = 1e300, high = -1e300, left = -1e300, right = 1e300;
  front_ = -1e300, back_ = 1e300;
  for (const glm::dvec3& p : mesh_.positions) {
    low = std::min(low, glm::dot(p, axes_.up)), high = std::max(high, glm::dot(p, axes_.up));
    left = std::max(left, glm::dot(p, axes_.right)), right = std::min(right, glm::dot(p, axes_.right));
    front_ = std::max(front_, glm::dot(p, axes_.forward)), back_ = std::min(back_, glm::dot(p, axes_.forward));
  }
  ground_ = low, height_ = high - low, middle_ = 0.5 * (left + right);
}

// Mean distance of mirrored vertices to the nearest one, about the middle of the box.
double Finder::asymmetry(int axis) const {
  const size_t step = std::max<size_t>(1, first_.size() / 250);
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < first_.size(); i += step, ++count) {
    glm::dvec3 p = mesh_.positions[first_[i]];
    p[axis] = low_[axis] + high_[axis] - p[axis];
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
    if (up(v) < 0.04 * height_) sole += forward(v), soles += 1;
    if (up(v) > 0.07 * height_ && up(v) < 0.13 * height_) ankle += forward(v), ankles += 1;
  }
  return soles > 0 && ankles > 0 ? (sole / soles - ankle / ankles) / height_ : 0;
}

void Finder::find_axes() {
  axes_ = Axes();
  // along the side a creature is symmetric; x unless z is clearly the one
  if (asymmetry(2) < 0.5 * asymmetry(0)) axes_.forward = {1, 0, 0}, axes_.right = glm::cross(axes_.up, axes_.forward);
  measure();
  double evidence = std::clamp(toes(), -0.1, 0.1);  // a rest in mid-stride says nothing
  const std::vector<uint32_t> head = named({"head", "jaw", "nose", "snout", "muzzle"});
  if (!head.empty()) {
    // before the feet; the middle of the box would be led astray by a tail or a weapon
    double mean = 0, under = 0, low = 0;
    for (const uint32_t v : head) mean += forward(v) / static_cast<double>(head.size());
    for (const uint32_t v : first_)
      if (up(v) < 0.1 * height_) under += forward(v), low += 1;
    evidence += 0.5 * (mean - under / low) / height_;
    const std::vector<uint32_t> eyes = named({"eye"});
    for (const uint32_t v : eyes) evidence += (forward(v) - mean) / height_ / static_cast<double>(eyes.size());
  }
  if (evidence < -0.03) axes_.forward = -axes_.forward, axes_.right = -axes_.right, measure();
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
  for (uint32_t w = 0; w < mesh_.welded_count; ++w) {
    if (!is_low(first_[w])) continue;
    Piece& piece = of_root[root(w)];
    piece.sum += mesh_.positions[first_[w]], piece.count += 1, piece.lowest = std::min(piece.lowest, up(first_[w]));
    piece.vertices.push_back(first_[w]);
  }
  for (Piece& piece : of_root) {
    if (piece.count < 1 || piece.lowest > slack * height_) continue;
    const auto near = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& other) {
      return glm::distance(other.mean(), piece.mean()) < same_foot * diagonal_;
    });
    if (near == pieces.end()) {
      pieces.push_back(piece);
    } else {
      near->sum += piece.sum, near->count += piece.count;
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
  left.clear(), right.clear();
  for (const Foot& foot : feet_) {
    if (std::abs(foot.side) > 0.01 * diagonal_) (foot.side > 0 ? left : right).push_back(foot);
  }
  return std::min(left.size(), right.size());
}

std::vector<uint32_t> Finder::named(const std::vector<std::string>& words) const {
  std::vector<uint32_t> out;
  for (const uint32_t v : first_) {
    if (regions_ && has_word(regions_->owner_name(v), words)) out.push_back(v);
  }
  return out;
}

void Finder::find_extremities() {
  const FlatSurface surface(mesh_, model_.name, 1);
  hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
  desc.kind = HF_EXTREMITIES_GEODESIC;
  std::vector<hf_extremity> found(256);
  uint32_t count = 0;
  const hf_result result =
      hf_surface_find_extremities(surface.get(), &desc, static_cast<uint32_t>(found.size()), found.data(), &count);
  if (result != HF_OK) return;  // names and the box are left to go by
  for (uint32_t i = 0; i < count; ++i) tips_.push_back(found[i].vertex);
}

template <class Value>
uint32_t Finder::best_of(const std::vector<uint32_t>& among, Value value) const {
  return *std::max_element(among.begin(), among.end(), [&](uint32_t a, uint32_t b) { return value(a) < value(b); });
}

// A selector that finds the vertex: by its joint when one of the directions leads there, else by its place.
Selector Finder::express(uint32_t vertex, double radius, const std::vector<std::string>& directions) const {
  Selector out;
  out.radius = radius, out.has_radius = true, out.where = "a proposed place";
  const std::string joint = regions_->owner_name(vertex);
  if (!joint.empty() && regions_->is_joint(joint)) {
    out.joints = {joint};
    for (const std::string& direction : directions) {
      out.extreme = direction;
      if (glm::distance(regions_->find({out}).seed, mesh_.positions[vertex]) < 0.025 * diagonal_) return out;
    }
  }
  out.joints.clear(), out.extreme.clear();
  out.has_position = true, out.position = mesh_.positions[vertex];
  return out;
}

void Finder::add(const std::string& name, uint32_t vertex, const std::vector<std::string>& directions,
                 double confidence, const std::string& found, double radius) {
  Landmark landmark;
  landmark.name = name, landmark.place = express(vertex, radius, directions),
  landmark.position = mesh_.positions[vertex];
  landmark.confidence = confidence, landmark.found = found;
  out_.list.push_back(landmark);
}

void Finder::add_place(const std::string& name, const glm::dvec3& place, double confidence, const std::string& found) {
  Landmark landmark;
  landmark.name = name, landmark.position = place, landmark.confidence = confidence, landmark.found = found;
  landmark.place.has_position = landmark.place.has_radius = true, landmark.place.position = place;
  landmark.place.radius = trunk_ball;
  out_.list.push_back(landmark);
}

// Where a line meets the surface, in order.
std::vector<double> Finder::hits(const glm::dvec3& start, const glm::dvec3& direction) const {
  std::vector<double> out;
  for (size_t t = 0; t < mesh_.triangles.size(); t += 3) {
    const glm::dvec3 a = mesh_.positions[mesh_.triangles[t]], u = mesh_.positions[mesh_.triangles[t + 1]] - a,
                     w = mesh_.positions[mesh_.triangles[t + 2]] - a;
    const glm::dvec3 n = glm::cross(u, w);
    const double slope = glm::dot(n, direction);
    if (std::abs(slope) < 1e-12 * diagonal_ * diagonal_) continue;
    const double s = glm::dot(n, a - start) / slope;
    const glm::dvec3 p = start + s * direction - a;
    const double nn = glm::dot(n, n), beta = glm::dot(glm::cross(p, w), n) / nn,
                 gamma = glm::dot(glm::cross(u, p), n) / nn;
    if (beta >= -1e-9 && gamma >= -1e-9 && beta + gamma <= 1 + 1e-9) out.push_back(s);
  }
  std::sort(out.begin(), out.end());
  // a line through an edge meets both its triangles
  out.erase(std::unique(out.begin(), out.end(), [&](double x, double y) { return y - x < 1e-6 * diagonal_; }),
            out.end());
  return out;
}

// Straight up through the belly: the place where the line leaves the body.
bool Finder::top_of_back(double at_forward, glm::dvec3& place) const {
  // a hair beside the middle, where a mirrored model has an edge
  const glm::dvec3 start =
      (middle_ + 1e-4 * diagonal_) * axes_.right + at_forward * axes_.forward + (ground_ - 0.1 * height_) * axes_.up;
  const std::vector<double> cuts = hits(start, axes_.up);
  for (size_t i = 0; i + 1 < cuts.size(); i += 2) {
    if (cuts[i + 1] - cuts[i] < 0.12 * height_) continue;  // thin things: a tail, an udder
    place = start + cuts[i + 1] * axes_.up;
    return true;
  }
  return false;
}

// From behind at a height: where the line enters the body.
bool Finder::back_at(double height, glm::dvec3& place) const {
  const glm::dvec3 start =
      (middle_ + 1e-4 * diagonal_) * axes_.right + (back_ - diagonal_) * axes_.forward + (ground_ + height) * axes_.up;
  const std::vector<double> cuts = hits(start, axes_.forward);
  if (cuts.size() < 2) return false;
  place = start + cuts.front() * axes_.forward;
  return true;
}

// Where someone upright is narrowest between the middle of the trunk and the head.
double Finder::neck_height(double crotch) const {
  const double span = height_ - crotch;
  double best = 0, narrowest = 1e300;
  for (int k = 0; k <= 40; ++k) {
    const double level = crotch + span * (0.3 + 0.5 * k / 40);
    double widest = 0;
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const uint32_t a = mesh_.triangles[t], b = mesh_.triangles[t - t % 3 + (t + 1) % 3];
      if ((up(a) - level) * (up(b) - level) > 0 || up(a) == up(b)) continue;
      const double s = (level - up(a)) / (up(b) - up(a));
      widest = std::max(widest, std::abs(side(a) + s * (side(b) - side(a))));
    }
    if (widest > 0 && widest < narrowest) narrowest = widest, best = level;
  }
  return best;
}

void Finder::add_head() {
  std::vector<uint32_t> head = named({"head", "jaw", "nose", "snout", "muzzle", "beak"});
  const bool by_name = !head.empty();
  if (out_.upright) {
    if (head.empty()) {
      for (const uint32_t v : first_)
        if (std::abs(side(v)) < 0.12 * diagonal_) head.push_back(v);
    }
    double mean = 0;
    for (const uint32_t v : head) mean += forward(v) / static_cast<double>(head.size());
    const auto value = [&](uint32_t v) { return up(v) - 0.3 * std::hypot(side(v), forward(v) - mean); };
    add("head", best_of(head, value), {"up"}, by_name ? 0.9 : 0.7, by_name ? "top of the head joint" : "highest place",
        0.05);
    return;
  }
  if (head.empty()) {
    for (const uint32_t v : first_)
      if (up(v) > 0.25 * height_) head.push_back(v);
  }
  add("nose", best_of(head, [&](uint32_t v) { return forward(v) - 0.3 * std::abs(side(v)); }), {"forward"},
      by_name ? 0.9 : 0.5, by_name ? "front of the head joint" : "foremost place");
}

// Ears by their joints only: their shapes say nothing that horns do not.
void Finder::add_ears() {
  const std::vector<uint32_t> ears = named({"ear"});
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
  const std::vector<uint32_t> tail = named({"tail"});
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
    if (!is_foot && forward(v) < back_ + 0.35 * (front_ - back_) && std::abs(side(v)) < 0.1 * diagonal_)
      rear.push_back(v);
  }
  if (!rear.empty()) {
    add("tail", rear.front(), {"away", "back", "down", "up"}, 0.6, "extremity behind");
    return;
  }
  for (const uint32_t v : first_)
    if (up(v) > 0.3 * height_) rear.push_back(v);
  add("tail", best_of(rear, [&](uint32_t v) { return -forward(v) - 0.3 * std::abs(side(v)); }), {"back"}, 0.3,
      "rearmost place");
}

void Finder::add_hands() {
  const std::vector<uint32_t> hands = named({"hand", "palm", "wrist", "finger", "fist"});
  const glm::dvec3 chest =
      middle_ * axes_.right + 0.5 * (front_ + back_) * axes_.forward + (ground_ + 0.8 * height_) * axes_.up;
  for (const double sign : {1.0, -1.0}) {
    const std::string name = sign > 0 ? "hand left" : "hand right";
    std::vector<uint32_t> own, tips, wide;
    for (const uint32_t v : hands)
      if (sign * side(v) > 0) own.push_back(v);
    const auto is_hand = [&](uint32_t v) {
      return sign * side(v) > 0.1 * height_ && up(v) > 0.05 * height_ && up(v) < 0.85 * height_;
    };
    for (const uint32_t v : tips_)
      if (is_hand(v)) tips.push_back(v);
    for (const uint32_t v : first_)
      if (is_hand(v)) wide.push_back(v);
    const auto reach = [&](uint32_t v) { return glm::distance(mesh_.positions[v], chest); };
    const auto width = [&](uint32_t v) { return sign * side(v); };
    const std::vector<std::string> directions = {"down", "away", sign > 0 ? "right" : "left", "forward"};
    if (!own.empty()) {
      add(name, best_of(own, reach), directions, 0.9, "end of the hand joints");
    } else if (!tips.empty()) {
      add(name, best_of(tips, width), directions, 0.7, "extremity at the side");
    } else if (!wide.empty() && out_.upright) {
      add(name, best_of(wide, width), directions, 0.4, "widest place");
    }
  }
}

void Finder::add_trunk() {
  double front = -1e300, hind = 1e300;
  for (const Foot& foot : feet_) front = std::max(front, foot.forward), hind = std::min(hind, foot.forward);
  glm::dvec3 place;
  if (out_.upright) {
    const glm::dvec3 start = (middle_ + 1e-4 * diagonal_) * axes_.right + 0.5 * (front + hind) * axes_.forward +
                             (ground_ - 0.1 * height_) * axes_.up;
    const std::vector<double> cuts = hits(start, axes_.up);
    const double crotch = cuts.empty() ? 0.5 * height_ : cuts.front() - 0.1 * height_;
    const double neck = neck_height(crotch);
    if (back_at(crotch + 0.17 * (neck - crotch), place))
      add_place("seat", place, 0.7, "back of the body above the legs");
    if (back_at(crotch + 0.75 * (neck - crotch), place))
      add_place("upper back", place, 0.7, "back of the body below the neck");
    return;
  }
  if (out_.leg_pairs < 2) {
    // two legs under a long body: the second place lies towards the head
    front = hind + 0.35 * (front_ - hind);
  }
  // a little inside the stance, where the body is over the feet; further in when the line misses it
  const auto search = [&](const char* name, double from, double towards) {
    for (int k = 0; k < 10; ++k) {
      if (!top_of_back(from + 0.05 * k * (towards - from), place)) continue;
      add_place(name, place, k == 0 ? 0.8 : 0.6, "top of the back above the feet");
      return;
    }
  };
  search("withers", front - 0.08 * (front - hind), hind);
  search("rump", hind + 0.12 * (front - hind), front);
}

Landmarks Finder::find(const Axes* axes) {
  const RegionFinder first(model_, mesh_, Axes());
  regions_ = &first;
  if (axes) {
    axes_ = *axes, measure();
  } else {
    find_axes();
  }
  const RegionFinder finder(model_, mesh_, axes_);
  regions_ = &finder;
  std::vector<Foot> left, right;
  size_t pairs = 0;
  bool first_try = true;
  for (const auto& stance : stances) {
    find_feet(stance.reach, stance.slack);
    pairs = split_feet(left, right);
    if (pairs > 0) break;
    first_try = false;
  }
  if (pairs == 0) {
    throw std::runtime_error(
        model_.name + ": no feet left and right of its middle stand on the ground (" + std::to_string(feet_.size()) +
        " pieces do); give the pairs by hand, or the axes if it does not stand upright along them");
  }
  // ears and hands may hang unevenly at rest; feet rarely do
  double shift = 0;
  for (const Foot& foot : left) shift += 0.5 * foot.side / static_cast<double>(left.size());
  for (const Foot& foot : right) shift += 0.5 * foot.side / static_cast<double>(right.size());
  if (left.size() == right.size() && std::abs(shift) < 0.05 * diagonal_) middle_ += shift;
  out_.axes = axes_, out_.leg_pairs = pairs;
  out_.upright = pairs == 1 && height_ > 1.1 * (front_ - back_);
  find_extremities();
  add_head(), add_ears(), add_tail();
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
          !even       ? 0.5
          : first_try ? 0.9
                      : 0.7,
          !even       ? "one of an odd number on the ground"
          : first_try ? "stands on the ground"
                      : "reaches lowest on its side");
      feet_.push_back(foot);
    }
  }
  if (pairs == 1) add_hands();
  add_trunk();
  return out_;
}

}  // namespace

const Landmark* Landmarks::get(const std::string& name) const {
  for (const Landmark& landmark : list)
    if (landmark.name == name) return &landmark;
  return nullptr;
}

Landmarks find_landmarks(const Model& model, const FlatMesh& mesh, const Axes* axes) {
  return Finder(model, mesh).find(axes);
}

}  // namespace samples
