// See faults.h.
#include "transfer/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

namespace samples {
namespace {

constexpr double spike_share = 0.02, spike_ratio = 4;
// A source whose mean squared acceleration is smaller (in boxes a frame) does not move.
constexpr double least_squares = 1e-10;
// Frames whose edges are measured, and the shortest edge that counts, in boxes.
constexpr size_t stretch_frames = 12;
constexpr double least_edge = 1e-4;
// A limb that moves less than this on the source (root mean square, in boxes) cannot lose it.
constexpr double moving_limb = 0.02;
// A limb is lost whose motion points elsewhere (cosine) or is that much smaller.
constexpr double lost_cosine = 0.3, lost_ratio = 0.25;
// The confidence is a product of 1 / (1 + (x / limit)^2) over the faults; these limits halve it: a share of frames that
// spike, acceleration beyond the source's, stretch, depth under the ground, gap, and a share of lost limbs.
constexpr double spikes_limit = 0.02, acceleration_limit = 0.5, stretch_limit = 0.5, sunk_limit = 0.02,
                 gap_limit = 0.02, lost_limit = 0.25;
// Faults that a report names, one by one.
constexpr double named_acceleration = 1.5, named_stretch = 0.4, named_sunk = 0.01, named_gap = 0.01;

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

ClipFaults find_faults(const Session& session, const PlayedClip& played) {
  ClipFaults out;
  const double box = session.target_mesh().bounding_box_diagonal,
               source_box = session.source_mesh().bounding_box_diagonal,
               scale = std::max(session.scale(), box / source_box);
  const Jerks from = jerks_of(played.source_frames, session.source_flat().loose, scale / box),
              to = jerks_of(played.target_frames, session.target_flat().loose, 1 / box);
  for (size_t f = 0; f < to.largest.size(); ++f)
    if (to.largest[f] > spike_share && to.largest[f] > spike_ratio * from.largest[f]) ++out.spikes;
  if (from.squares > least_squares) out.acceleration = std::sqrt(to.squares / from.squares);
  out.stretch = std::max(0.0, stretch_of(session.target_flat(), played.target_frames, box) -
                                  stretch_of(session.source_flat(), played.source_frames, source_box));
  out.sunk = session.stretches() ? 0 : std::max(0.0, played.feet.surface_sunk);
  out.gap = played.gap;
  size_t moving = 0;
  for (const LimbMotion& limb : session.limbs_of(played)) {
    if (limb.source_moved < moving_limb) continue;
    ++moving;
    if (limb.cosine < lost_cosine || limb.target_moved < lost_ratio * limb.source_moved) out.lost.push_back(limb.name);
  }
  const auto frames = static_cast<double>(std::max<size_t>(played.target_frames.size(), 1));
  out.confidence =
      fall(static_cast<double>(out.spikes) / frames, spikes_limit) *
      fall(std::max(0.0, out.acceleration - 1), acceleration_limit) * fall(out.stretch, stretch_limit) *
      fall(out.sunk, sunk_limit) * fall(out.gap, gap_limit) *
      fall(moving > 0 ? static_cast<double>(out.lost.size()) / static_cast<double>(moving) : 0, lost_limit);
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
    std::snprintf(text, sizeof text, "the surface sinks by %.1f %% of the box", 100 * faults.sunk);
    out.push_back(name + text);
  }
  if (faults.gap > named_gap) {
    std::snprintf(text, sizeof text, "linked pieces come apart by %.1f %% of the box", 100 * faults.gap);
    out.push_back(name + text);
  }
  for (const std::string& limb : faults.lost) out.push_back(name + "\"" + limb + "\" does not move as its source does");
  return out;
}

}  // namespace samples
