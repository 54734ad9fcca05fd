// Axes and feet of a creature. See landmark_finder.h.
#include <cmath>
#include <map>
#include <numeric>

#include "gltf/landmark_finder.h"

namespace hf_gltf {
namespace {

// Up to where feet reach and how far off the ground they may be, of the height: legs are short under a large head, and
// some rest in mid-stride.
constexpr struct {
  double reach, slack;
} stances[] = {{0.12, 0.03}, {0.08, 0.03}, {0.05, 0.03}, {0.03, 0.02}, {0.2, 0.12}, {0.12, 0.1}};

// The end of a limb: its vertices up to this height over its lowest one, of the height of the body.
constexpr double sole_height = 0.04;

int axis_of(const glm::dvec3& direction) { return direction.x != 0 ? 0 : direction.y != 0 ? 1 : 2; }

}  // namespace

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

// The skeleton's axes where it is sure. Else the axes of the surface.
void Finder::choose_axes() {
  if (out_.known.knows_axes()) {
    axes_ = out_.known.axes;
    out_.axes_from = AxesFrom::skeleton;
    measure();
  } else {
    find_axes();
  }
}

void Finder::find_axes() {
  axes_ = Axes();
  // along the side a creature is symmetric; x of a model whose y is up, unless z is clearly the one
  if (asymmetry(axis_of(axes_.forward)) < 0.5 * asymmetry(axis_of(axes_.right))) {
    axes_.forward = axes_.right;
    axes_.right = glm::cross(axes_.up, axes_.forward);
  }
  measure();
  double evidence = std::clamp(toes(), -0.1, 0.1);  // a rest in mid-stride says nothing
  const std::vector<uint32_t> head = of_part(BodyPart::head);
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
  }
  if (evidence < -0.03) {
    axes_.forward = -axes_.forward;
    axes_.right = -axes_.right;
    measure();
  }
}

// The lower end of each leg of the skeleton is a foot. Tips of arms are kept in raised_.
void Finder::find_known_feet() {
  struct End {
    BodyPart part = BodyPart::other;
    int side = 0;
    std::vector<uint32_t> vertices;
  };
  std::map<int, End> limbs;
  for (const uint32_t v : first_) {
    const KnownNode node = known(v);
    if (node.limb < 0 || node.side == 0 || node.part == BodyPart::wing || node.part == BodyPart::fin) continue;
    End& limb = limbs[node.limb];
    limb.part = node.part == BodyPart::leg ? BodyPart::leg : BodyPart::arm;
    limb.side = node.side;
    limb.vertices.push_back(v);
  }
  feet_.clear();
  raised_.clear();
  for (const auto& [number, limb] : limbs) {
    double low = 1e300;
    for (const uint32_t v : limb.vertices) low = std::min(low, up(v));
    std::vector<uint32_t> end;
    glm::dvec3 mean(0);
    for (const uint32_t v : limb.vertices) {
      if (up(v) > low + sole_height * height_) continue;
      end.push_back(v);
      mean += mesh_.positions[v];
    }
    mean /= static_cast<double>(end.size());
    const uint32_t vertex =
        best_of(end, [&](uint32_t v) { return -up(v) - 0.3 * glm::distance(mesh_.positions[v], mean); });
    const Foot foot = {mesh_.positions[vertex], vertex, glm::dot(mean, axes_.forward),
                       glm::dot(mean, axes_.right) - middle_, limb.side};
    (limb.part == BodyPart::leg ? feet_ : raised_).push_back(foot);
  }
}

size_t Finder::search_feet(std::vector<Foot>& left, std::vector<Foot>& right) {
  find_known_feet();
  size_t pairs = split_feet(left, right);
  if (pairs > 0 && left.size() == right.size()) {
    known_feet_ = true;
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
  const auto is_low = [&](uint32_t v) { return up(v) < reach * height_ && may_be_foot(v); };
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
        {mesh_.positions[vertex], vertex, glm::dot(mean, axes_.forward), glm::dot(mean, axes_.right) - middle_, 0});
  }
}

// Those on either side of the middle; the number of pairs.
size_t Finder::split_feet(std::vector<Foot>& left, std::vector<Foot>& right) const {
  left.clear();
  right.clear();
  for (const Foot& foot : feet_) {
    if (foot.known_side != 0)
      (foot.known_side > 0 ? left : right).push_back(foot);
    else if (std::abs(foot.side) > 0.01 * diagonal_)
      (foot.side > 0 ? left : right).push_back(foot);
  }
  return std::min(left.size(), right.size());
}

}  // namespace hf_gltf
