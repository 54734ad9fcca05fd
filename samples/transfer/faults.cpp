// See faults.h.
#include "transfer/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

namespace samples {
namespace {

// A frame jumps if a vertex's second difference is above this share of the box, and so many times the source's. Half of
// them names quick steps; double misses a foot that snaps.
constexpr double spike_share = 0.02, spike_ratio = 4;
// A source whose mean squared acceleration is smaller (in boxes a frame) does not move: rounding of 32-bit keys is
// below.
constexpr double least_squares = 1e-10;
// Frames whose edges are measured: they cost the most of a report. Half can miss the worst pose of a clip.
constexpr size_t stretch_frames = 12;
// The shortest edge that counts, in boxes: stitches below it stretch many times where nothing is seen.
constexpr double least_edge = 1e-4;
// A limb that moves less than this on the source (root mean square, in boxes) cannot lose it: it breathes.
constexpr double moving_limb = 0.02;
// A limb is lost whose motion points elsewhere (cosine: 73 degrees) or is that much smaller. Half lets an arm pass that
// swings across its source; double names limbs that other proportions turn.
constexpr double lost_cosine = 0.3, lost_ratio = 0.25;

// The confidence is a product of 1 / (1 + (x / limit)^2) over the faults, so each limit halves it. Limits were set
// once: where a viewer would send the clip back, not tuned on any half of the runs. A limit of half the size calls runs
// broken that are usable untouched; one of double size calls broken ones usable.
constexpr double spikes_limit = 0.06;     // share of frames: two snaps in a second of 30 frames
constexpr double acceleration_limit = 1;  // beyond the source's, over it: twice as shaky as the source
constexpr double stretch_limit = 0.7;     // one edge in twenty is twice as long, or half
constexpr double sunk_limit = 0.02;       // boxes: a sole is gone in the ground
constexpr double gap_limit = 0.02;        // boxes: daylight between two pieces
constexpr double lost_limit = 0.25;       // share of limbs: one of four stands still
constexpr double hover_limit = 0.05;      // boxes: an ankle's height over the ground
constexpr double uneven_limit = 1;        // see SkeletonPair::unevenness: a stride instead of a stance
constexpr double limbs_limit = 20;        // degrees: an arm is another pose
constexpr double trunk_limit = 25;        // degrees: a bow instead of a stance
constexpr double slide_limit = 0.5;       // boxes a second: half a stride
constexpr double unmatched_limit = 0.5;   // share of limbs: both arms of a person
// What a hand holds goes through the ground unseen from afar: half is lost at this depth, in boxes.
constexpr double held_limit = 0.15;

// Faults that a report names, one by one: at half of the limit or below, where they cost a quarter of the confidence at
// most. Less would name what nobody sees.
constexpr double named_acceleration = 1.5, named_stretch = 0.4, named_sunk = 0.01, named_gap = 0.01, named_limbs = 10,
                 named_trunk = 12, named_slide = 0.2, named_held = 0.02, named_hover = 0.02, named_uneven = 0.5;

using Frames = std::vector<std::vector<double>>;

// Per inner frame the largest second difference of a vertex, and the sum of mean squares.
struct Jerks {
  std::vector<double> largest;
  double squares = 0;
};

Jerks jerks_of(const Frames& frames, const std::vector<uint8_t>& loose, double unit) {
  Jerks out;
  for (size_t f = 1; f + 1 < frames.size(); ++f) {
    double largest = 0, sum = 0;
    for (size_t i = 0; i < frames[f].size(); i += 3) {
      if (loose[i / 3]) continue;
      double square = 0;
      for (size_t c = i; c < i + 3; ++c) {
        const double d = unit * (frames[f + 1][c] - 2 * frames[f][c] + frames[f - 1][c]);
        square += d * d;
      }
      largest = std::max(largest, square);
      sum += square;
    }
    out.largest.push_back(std::sqrt(largest));
    out.squares += sum / static_cast<double>(std::max<std::ptrdiff_t>(std::count(loose.begin(), loose.end(), 0), 1));
  }
  return out;
}

double length_of(const std::vector<double>& xyz, const std::array<uint32_t, 2>& edge) {
  const size_t a = size_t{3} * edge[0], b = size_t{3} * edge[1];
  return std::hypot(xyz[a] - xyz[b], xyz[a + 1] - xyz[b + 1], xyz[a + 2] - xyz[b + 2]);
}

// The stretch of 95 % of the edges in the worst of some frames.
double stretch_of(const FlatMesh& mesh, const Frames& frames, double box) {
  const std::vector<double> rest = double_positions(mesh.positions);
  std::vector<std::array<uint32_t, 2>> edges;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (size_t k = 0; k < 3; ++k) {
      const std::array<uint32_t, 2> edge = {mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]};
      if (mesh.welded[edge[0]] < mesh.welded[edge[1]] && length_of(rest, edge) > least_edge * box)
        edges.push_back(edge);
    }
  double out = 0;
  const size_t step = std::max<size_t>(1, frames.size() / stretch_frames);
  for (size_t f = 0; f < frames.size() && !edges.empty(); f += step) {
    std::vector<double> all;
    for (const auto& edge : edges) {
      const double now = std::max(length_of(frames[f], edge), least_edge * box);
      all.push_back(std::abs(std::log(now / length_of(rest, edge))));
    }
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), at, all.end());
    out = std::max(out, *at);
  }
  return out;
}

double fall(double fault, double limit) { return 1 / (1 + (fault / limit) * (fault / limit)); }

}  // namespace

double confidence_of(const ClipFaults& faults, size_t frame_count) {
  const auto frames = static_cast<double>(std::max<size_t>(frame_count, 1));
  const double lost =
      faults.moving > 0 ? static_cast<double>(faults.lost.size()) / static_cast<double>(faults.moving) : 0;
  return fall(static_cast<double>(faults.spikes) / frames, spikes_limit) *
         fall(std::max(0.0, faults.acceleration - 1), acceleration_limit) * fall(faults.stretch, stretch_limit) *
         fall(faults.sunk, sunk_limit) * fall(faults.held, held_limit) * fall(faults.gap, gap_limit) *
         fall(lost, lost_limit) * fall(std::max(0.0, faults.limbs), limbs_limit) *
         fall(std::max(0.0, faults.trunk), trunk_limit) * fall(std::max(0.0, faults.slide), slide_limit) *
         fall(faults.unmatched, unmatched_limit) * fall(std::max(0.0, faults.hover), hover_limit) *
         fall(faults.uneven, uneven_limit);
}

ClipFaults motion_faults(const Stage& stage, const PlayedClip& played) {
  ClipFaults out;
  const double box = SurfaceBox(stage.target).diagonal();
  const bool has_source = !stage.source.triangles.empty();
  const double source_box = has_source ? SurfaceBox(stage.source).diagonal() : box / stage.scale;
  const double scale = std::max(stage.scale, box / source_box);
  const Jerks from = jerks_of(played.source_frames, stage.source_out, scale / box),
              to = jerks_of(played.target_frames, stage.target_out, 1 / box);
  for (size_t f = 0; f < to.largest.size() && has_source; ++f)
    if (to.largest[f] > spike_share && to.largest[f] > spike_ratio * from.largest[f]) ++out.spikes;
  if (from.squares > least_squares) out.acceleration = std::sqrt(to.squares / from.squares);
  out.stretch = std::max(0.0, stretch_of(stage.target, played.target_frames, box) -
                                  (has_source ? stretch_of(stage.source, played.source_frames, source_box) : 0));
  out.sunk = std::max(0.0, played.feet.surface_sunk);
  out.gap = played.gap;
  out.confidence = confidence_of(out, played.target_frames.size());
  return out;
}

ClipFaults find_faults(const Session& session, const PlayedClip& played) {
  ClipFaults out = motion_faults({session.source_flat(), session.target_flat(), session.source_flat().loose,
                                  session.target_flat().loose, session.scale()},
                                 played);
  if (!session.has_ground()) out.sunk = 0;
  for (const LimbMotion& limb : session.limbs_of(played)) {
    if (limb.source_moved < moving_limb) continue;
    ++out.moving;
    if (limb.cosine < lost_cosine || limb.target_moved < lost_ratio * limb.source_moved) out.lost.push_back(limb.name);
  }
  out.confidence = confidence_of(out, played.target_frames.size());
  return out;
}

std::vector<std::string> fault_sentences(const ClipFaults& faults, const std::string& clip, size_t frames) {
  std::vector<std::string> out;
  const std::string name = "clip \"" + clip + "\": ";
  char text[200];
  if (faults.spikes > 0) {
    std::snprintf(text, sizeof text, "%zu of %zu frames jump; the source does not", faults.spikes, frames);
    out.push_back(name + text);
  }
  if (faults.acceleration > named_acceleration) {
    std::snprintf(text, sizeof text, "it accelerates %.1f times as much as the source", faults.acceleration);
    out.push_back(name + text);
  }
  if (faults.stretch > named_stretch) {
    std::snprintf(text, sizeof text, "one edge in twenty is stretched or squashed %.1f times, beyond the source's",
                  std::exp(faults.stretch));
    out.push_back(name + text);
  }
  if (faults.sunk > named_sunk) {
    std::snprintf(text, sizeof text, "the surface is up to %.1f %% of the box under the ground", 100 * faults.sunk);
    out.push_back(name + text);
  }
  if (faults.held > named_held) {
    std::snprintf(text, sizeof text, "what a hand holds is %.1f %% of the box in the ground", 100 * faults.held);
    out.push_back(name + text);
  }
  if (faults.gap > named_gap) {
    std::snprintf(text, sizeof text, "linked pieces come apart by %.1f %% of the box", 100 * faults.gap);
    out.push_back(name + text);
  }
  if (faults.limbs > named_limbs) {
    std::snprintf(text, sizeof text, "arms and legs point %.0f degrees elsewhere than the source's", faults.limbs);
    out.push_back(name + text);
  }
  if (faults.trunk > named_trunk) {
    std::snprintf(text, sizeof text, "the trunk leans %.0f degrees away from the source's", faults.trunk);
    out.push_back(name + text);
  }
  if (faults.slide > named_slide) {
    std::snprintf(text, sizeof text, "standing feet slide by %.2f boxes a second", faults.slide);
    out.push_back(name + text);
  }
  if (faults.hover > named_hover) {
    std::snprintf(text, sizeof text,
                  "it floats: its soles are %.1f %% of the box over the ground where the source stands",
                  100 * faults.hover);
    out.push_back(name + text);
  }
  if (faults.uneven > named_uneven)
    out.push_back(
        name +
        "one of the bodies rests in a stride or turned aside, and turns count from there: name a standing pose "
        "with --source-rest or --target-rest");
  if (faults.unmatched > 0) {
    std::snprintf(text, sizeof text, "%.0f %% of the arms and legs of one body have no partner in the other",
                  100 * faults.unmatched);
    out.push_back(name + text);
  }
  for (const std::string& limb : faults.lost) out.push_back(name + "\"" + limb + "\" does not move as its source does");
  return out;
}

}  // namespace samples
