// The trunk of a creature: where lines through the body leave it. See landmark_finder.h.
#include <cmath>

#include "gltf/landmark_finder.h"

namespace hf_gltf {

// Where a line meets the surface, in order.
std::vector<double> Finder::hits(const glm::dvec3& start, const glm::dvec3& direction) const {
  std::vector<double> out;
  for (size_t t = 0; t < mesh_.triangles.size(); t += 3) {
    const glm::dvec3 a = mesh_.positions[mesh_.triangles[t]], u = mesh_.positions[mesh_.triangles[t + 1]] - a,
                     w = mesh_.positions[mesh_.triangles[t + 2]] - a;
    // Moeller and Trumbore 1997: the weights of two corners, each times the determinant; most lines end at the first
    const glm::dvec3 across = glm::cross(direction, w), from = start - a;
    const double determinant = glm::dot(u, across), size = std::abs(determinant);
    if (size < 1e-12 * diagonal_ * diagonal_) continue;
    const double sign = determinant > 0 ? 1 : -1, beta = sign * glm::dot(from, across);
    if (beta < -1e-9 * size || beta > (1 + 1e-9) * size) continue;
    const glm::dvec3 normal = glm::cross(from, u);
    const double gamma = sign * glm::dot(direction, normal);
    if (gamma < -1e-9 * size || beta + gamma > (1 + 1e-9) * size) continue;
    out.push_back(glm::dot(w, normal) / determinant);
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
    if (widest > 0 && widest < narrowest) {
      narrowest = widest;
      best = level;
    }
  }
  return best;
}

void Finder::add_trunk() {
  double front = -1e300, hind = 1e300;
  for (const Foot& foot : feet_) {
    front = std::max(front, foot.forward);
    hind = std::min(hind, foot.forward);
  }
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
  if (feet_.empty()) {
    front = back_ + 0.7 * (front_ - back_);
    hind = back_ + 0.4 * (front_ - back_);
  } else if (out_.leg_pairs < 2) {
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

}  // namespace hf_gltf
