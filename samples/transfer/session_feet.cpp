// How feet stand over a clip. See session.h.
#include <cmath>
#include <limits>

#include "transfer/posed_region.h"
#include "transfer/session.h"

namespace samples {
namespace {

// Heights of a foot (in boxes) below which it stands, and above which it is free, as in the library.
constexpr double foot_stands = 0.01, foot_flies = 0.05;
// A foot stands only in frames in which its path along the ground bends by less than this (second difference, in
// boxes): as far as a planted foot may slide.
constexpr double foot_bends = 0.001;
// The cosine of the angle by which a foot that stands may tip, 20 degrees: from there on a body counts as falling.
constexpr double foot_upright = 0.94;

}  // namespace

FootReport Session::feet_of(const PlayedClip& played) const {
  FootReport feet;
  const double box = target_mesh().bounding_box_diagonal;
  const std::vector<double> source_rest = double_positions(source_flat_.positions),
                            target_rest = double_positions(target_flat_.positions);
  glm::dmat3 to_target;  // right, up, forward of the source to those of the target
  {
    const glm::dmat3 source(file_.source_axes.right, file_.source_axes.up, file_.source_axes.forward);
    const glm::dmat3 target(file_.target_axes.right, file_.target_axes.up, file_.target_axes.forward);
    to_target = target * glm::transpose(source);
  }
  size_t count = 0;
  for (const Live& live : live_) {
    if (!live.entry.foot) continue;
    const Region source = without_copies(live.source, source_flat_), target = without_copies(live.target, target_flat_);
    const size_t frames = played.source_frames.size();
    std::vector<glm::dvec3> paths;
    for (const std::vector<double>& posed : played.source_frames)
      paths.push_back(scale_ * (to_target * (centre_of(source, posed) - centre_of(source, source_rest))));
    const auto even = [&](size_t f) {
      if (frames < 3) return true;
      const size_t at = std::clamp<size_t>(f, 1, frames - 2);
      glm::dvec3 bend = paths[at + 1] - 2.0 * paths[at] + paths[at - 1];
      bend -= glm::dot(bend, file_.target_axes.up) * file_.target_axes.up;
      return glm::length(bend) < foot_bends * box;
    };
    bool was_low = false, stood = false;
    glm::dvec3 low_from(0), stood_from(0);
    for (size_t f = 0; f < frames; ++f) {
      glm::dvec3 path = paths[f];
      const glm::dvec3 rise = glm::dot(path, file_.target_axes.up) * file_.target_axes.up;
      path = rise + file_.dials.stride * (path - rise);
      const glm::dvec3 off = centre_of(target, played.target_frames[f]) - centre_of(target, target_rest) - path;
      const double miss = glm::length(off) / box;
      // along the ground, from where the foot began to stand: what would be seen as sliding
      const glm::dvec3 along = off - glm::dot(off, file_.target_axes.up) * file_.target_axes.up;
      feet.path_mean += miss;
      feet.path_max = std::max(feet.path_max, miss);
      ++count;
      const double ground = lowest_of(source_rest, file_.source_axes.up, source_hangs_);
      const bool is_low =
          scale_ * (lowest_of(source, played.source_frames[f], file_.source_axes.up) - ground) < foot_stands * box;
      const bool stands = is_low && even(f) &&
                          glm::dot(file_.source_axes.up, turn_of(source, source_rest, played.source_frames[f]) *
                                                             file_.source_axes.up) > foot_upright;
      if (is_low && !was_low) low_from = along;
      if (stands && !stood) stood_from = along;
      was_low = is_low;
      stood = stands;
      if (is_low) feet.low_max = std::max(feet.low_max, glm::length(along - low_from) / box);
      if (stands) {
        const double slide = glm::length(along - stood_from) / box;
        feet.planted_mean += slide;
        feet.planted_max = std::max(feet.planted_max, slide);
        ++feet.planted;
      }
      const double from = scale_ * std::min(0.0, lowest_of(source, played.source_frames[f], file_.source_axes.up) -
                                                     lowest_of(source, source_rest, file_.source_axes.up));
      const double to = lowest_of(target, played.target_frames[f], file_.target_axes.up) -
                        lowest_of(target, target_rest, file_.target_axes.up);
      feet.sunk = std::max(feet.sunk, (from - to) / box);
    }
  }
  if (count > 0) feet.path_mean /= static_cast<double>(count);
  if (feet.planted > 0) feet.planted_mean /= static_cast<double>(feet.planted);
  const std::vector<double> ground = grounds(played);
  for (size_t f = 0; f < played.source_frames.size(); ++f)
    feet.surface_sunk = std::max(
        feet.surface_sunk, (ground[f] - lowest_of(played.target_frames[f], file_.target_axes.up, sinking_)) / box);
  return feet;
}

// Loose vertices, and those so far below the feet at rest that no foot would stand over them, as the library has it: a
// cape, a tail, scenery. A body whose trunk is below its feet stands on all of it.
std::vector<uint8_t> Session::hanging(bool source) const {
  const FlatMesh& mesh = source ? source_flat_ : target_flat_;
  const glm::dvec3& up = source ? file_.source_axes.up : file_.target_axes.up;
  const std::vector<double> rest = double_positions(mesh.positions);
  std::vector<uint8_t> out = mesh.loose;
  double feet = std::numeric_limits<double>::infinity(), trunk = feet;
  for (const Live& live : live_) {
    const uint32_t flags = live.entry.flags();
    if (!(flags & (HF_PAIR_FOOT | HF_PAIR_TRUNK | HF_PAIR_NECK))) continue;
    double& low = flags & HF_PAIR_FOOT ? feet : trunk;
    low = std::min(low, lowest_of(source ? live.source : live.target, rest, up));
  }
  if (!(feet < trunk)) return out;
  const double limit = feet - foot_stands * (source ? source_finder_ : target_finder_).diagonal();
  for (size_t v = 0; v < out.size(); ++v)
    out[v] = out[v] || glm::dot(up, glm::dvec3(rest[3 * v], rest[3 * v + 1], rest[3 * v + 2])) < limit;
  return out;
}

std::vector<double> Session::grounds(const PlayedClip& played) const {
  const double source_ground = lowest_of(double_positions(source_flat_.positions), file_.source_axes.up, source_hangs_),
               ground = lowest_of(double_positions(target_flat_.positions), file_.target_axes.up, target_hangs_);
  std::vector<double> out;
  for (const std::vector<double>& posed : played.source_frames)
    out.push_back(ground +
                  scale_ * std::min(0.0, lowest_of(posed, file_.source_axes.up, source_hangs_) - source_ground));
  return out;
}

std::vector<double> Session::standing(const PlayedClip& played, size_t frame) const {
  const double box = target_mesh().bounding_box_diagonal;
  const glm::dvec3& up = file_.source_axes.up;
  const double ground = lowest_of(double_positions(source_flat_.positions), up, source_hangs_);
  std::vector<double> out(target_flat_.positions.size(), 0.0);
  for (const Live& live : live_) {
    if (!live.entry.foot) continue;
    const double height = scale_ * (lowest_of(live.source, played.source_frames[frame], up) - ground) / box;
    const double t = std::clamp((foot_flies - height) / (foot_flies - foot_stands), 0.0, 1.0);
    for (const uint32_t v : live.target.vertices) out[v] = t * t * (3 - 2 * t);
  }
  return out;
}

}  // namespace samples
