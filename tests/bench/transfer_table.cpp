// hf_transfer_table FOLDER [--half choosing|judging|mixed|all] [--source NAME] [--target NAME] [--clip NAME]
//                   [--sample N] [--runs] [--where] [--sinking] [--no-ground] [--no-links] [--itself] [--own-skin]
//                   [--key-tolerance X]
//
// Plays every clip of every shared model on every other and measures what an animator would send back. Constants are
// chosen on pairs whose two models lie in the choosing half. The judging half holds the pairs of the other models.
// One line per pair says what was proposed; --runs adds a line per clip. --sample N takes one run of N, always the same
// ones. --itself plays models on themselves alone. --own-skin measures what hf_transfer writes to the target's own
// skin, instead of the computed frames. Lengths are in boxes of the target.
//
// A length of the source counts times the larger of two scales: that of the transfer, and that of the boxes. A body
// moves by both: its path follows the first, its turning limbs follow the second.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "common/links.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"
#include "gltf/suggest_pairs.h"
#include "transfer/faults.h"
#include "transfer/outputs.h"
#include "transfer/posed_region.h"
#include "transfer/session.h"

namespace {

using namespace samples;
using namespace hf_gltf;
using Frames = std::vector<std::vector<double>>;

// The halves were written down before any constant was chosen. Models that constants.h names were seen before, so they
// are in the choosing half.
struct Listed {
  const char* name;
  bool judging;
};
constexpr Listed listed[] = {{"farm_Cow", false},
                             {"farm_Sheep", false},
                             {"khr_Fox", false},
                             {"q_Cow", false},
                             {"q_Deer", false},
                             {"q_Fox", false},
                             {"q_Horse", false},
                             {"q_Wolf", false},
                             {"CesiumMan", false},
                             {"q_KnightCharacter", false},
                             {"q_CyberCharacter", false},
                             {"q_Man_Casual", false},
                             {"q_Trex", false},
                             {"farm_Llama", true},
                             {"farm_Pug", true},
                             {"q_Alpaca", true},
                             {"q_Husky", true},
                             {"q_Frog", true},
                             {"RiggedFigure", true},
                             {"q_PlatformerCharacter", true},
                             {"q_PlatformerHumanoidRig", true},
                             {"q_Woman_Casual", true},
                             {"q_Enemy_2Legs", true},
                             {"q_Velociraptor", true},
                             {"q_Triceratops", true}};

// A frame spikes if the second difference of a vertex is larger than this share of the box, and than this many times
// the largest of the source in the same frame.
constexpr double spike_share = 0.02, spike_ratio = 4;
// A source stands still in a frame in which no vertex moves further (in boxes). Smaller steps count as the second.
constexpr double still_step = 0.002, least_step = 1e-4;
// A run is calm if it accelerates at most this many times as much as its source, and nearly so up to the second.
constexpr double calm = 1.1, nearly_calm = 1.3;
// A source's step counts for the ratio of steps if it is longer (in boxes).
constexpr double moving_step = 0.005;

struct Loaded {
  const char* name = nullptr;
  bool judging = false;
  Model model;
  FlatMesh flat;
  double box = 1;
  std::vector<double> areas;               // by vertex, as shares
  std::vector<std::vector<double>> times;  // per clip
  std::vector<Frames> frames;
};

double box_of(const std::vector<glm::dvec3>& points) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::length(high - low);
}

// The area around each vertex, as shares of the whole.
std::vector<double> areas_of(const FlatMesh& flat) {
  std::vector<double> out(flat.vertex_count(), 0.0);
  double sum = 0;
  for (size_t t = 0; t < flat.triangles.size(); t += 3) {
    const uint32_t* corner = flat.triangles.data() + t;
    const glm::dvec3 a = flat.positions[corner[0]], b = flat.positions[corner[1]], c = flat.positions[corner[2]];
    const double area = glm::length(glm::cross(b - a, c - a));
    for (int k = 0; k < 3; ++k) out[corner[k]] += area;
    sum += 3 * area;
  }
  for (double& x : out) x /= sum;
  return out;
}

Loaded load(const std::filesystem::path& folder, const Listed& from) {
  Loaded out;
  out.name = from.name;
  out.judging = from.judging;
  out.model = read_gltf(folder / (std::string(from.name) + ".glb"));
  out.flat = flatten(out.model);
  out.box = box_of(out.flat.positions);
  out.areas = areas_of(out.flat);
  return out;
}

void sample_clips(Loaded& model) {
  if (!model.times.empty()) return;
  for (const Animation& clip : model.model.animations) {
    model.times.push_back(frame_times(clip, clip_duration(clip) < 1 ? 60 : 30));
    model.frames.emplace_back();
    for (const double time : model.times.back())
      model.frames.back().push_back(double_positions(posed_positions(model.model, model.flat, clip, time)));
  }
}

// Motion of one clip, per inner frame: the largest second difference and step of a vertex, and the sum of squares over
// vertices, and over the area. A mesh that is finer at its head counts the head more often in the first.
struct Motion {
  std::vector<double> jerk, step;
  double squares = 0, area_squares = 0;
};

// area: of each vertex.
Motion motion_of(const Frames& frames, double unit, const std::vector<double>& area) {
  Motion out;
  const size_t n = frames.front().size();
  for (size_t f = 0; f + 1 < frames.size(); ++f) {
    double step = 0, jerk = 0, squares = 0;
    for (size_t i = 0; i < n; i += 3) {
      double s = 0, j = 0;
      for (size_t c = i; c < i + 3; ++c) {
        const double d = (frames[f + 1][c] - frames[f][c]) * unit;
        s += d * d;
        if (f == 0) continue;
        const double e = (frames[f + 1][c] - 2 * frames[f][c] + frames[f - 1][c]) * unit;
        j += e * e;
      }
      step = std::max(step, s);
      jerk = std::max(jerk, j);
      squares += j;
      out.area_squares += j * area[i / 3];
    }
    out.step.push_back(std::sqrt(step));
    out.jerk.push_back(std::sqrt(jerk));
    out.squares += 3 * squares / static_cast<double>(n);
  }
  return out;
}

struct Run {
  std::string name;
  size_t spikes = 0, frames = 0;
  double confidence = 0, stretch = 0;
  size_t lost = 0;
  double by_area = 0, acceleration = 0, rigid = 0, still = 0, step = 0, slide = 0, low = 0, sunk = 0, gap = 0,
         source_gap = 0, self_mean = -1, self_max = -1, ms = 0;
};

// The surface, or with --no-links one of the same mesh with links, so that gaps are measured at the same places.
hf_surface with_links(hf_surface surface, const Loaded& loaded) {
  static std::map<std::string, hf_surface> made;
  hf_links_info report = HF_INIT(hf_links_info);
  if (hf_surface_get_links_info(surface, &report) != HF_OK || report.piece_count < 2 || report.link_count > 0)
    return surface;
  hf_surface& linked = made[loaded.name];
  const ModelLinks links(&loaded.model, loaded.flat);
  if (!linked && hf_surface_relink(surface, &links.desc, nullptr, &linked) != HF_OK) return surface;
  return linked;
}

// The largest gap between linked pieces; 0 where there is one piece.
double largest_gap(hf_surface surface, const Frames& frames) {
  double out = 0;
  for (const std::vector<double>& frame : frames) {
    hf_gaps_desc posed = HF_INIT(hf_gaps_desc);
    posed.positions_f64 = frame.data();
    hf_gaps_info info = HF_INIT(hf_gaps_info);
    if (hf_surface_measure_gaps(surface, &posed, 0, nullptr, &info) != HF_OK || info.link_count == 0) return 0;
    out = std::max(out, info.worst);
  }
  return out;
}

// The target at rest, moved as one rigid body by the turn and the path of the whole source. No transfer that goes and
// faces as its source can do much better than this where the two bodies are of other shapes.
Frames rigid_frames(const PlayedClip& played, const Loaded& source, const Loaded& target, const Session& session) {
  const Axes &from = session.source_axes(), &to = session.target_axes();
  const glm::dmat3 axes =
      glm::dmat3(to.right, to.up, to.forward) * glm::transpose(glm::dmat3(from.right, from.up, from.forward));
  Region all;
  for (uint32_t v = 0; v < source.flat.vertex_count(); ++v) all.vertices.push_back(v);
  const std::vector<double> rest = double_positions(source.flat.positions);
  glm::dvec3 middle(0);
  for (const glm::dvec3& p : target.flat.positions) middle += p / static_cast<double>(target.flat.positions.size());
  Frames out;
  for (const std::vector<double>& posed : played.source_frames) {
    const glm::dmat3 turn = axes * glm::mat3_cast(turn_of(all, rest, posed)) * glm::transpose(axes);
    const glm::dvec3 place = middle + session.scale() * (axes * (centre_of(all, posed) - centre_of(all, rest)));
    out.emplace_back();
    for (const glm::dvec3& p : target.flat.positions) {
      const glm::dvec3 moved = place + turn * (p - middle);
      for (int c = 0; c < 3; ++c) out.back().push_back(moved[c]);
    }
  }
  return out;
}

Run measure(const PlayedClip& played, const Loaded& source, const Loaded& target, Session& session) {
  Run out;
  out.name = played.clip.name;
  out.frames = played.source_frames.size();
  const double scale = std::max(session.scale(), target.box / source.box);
  const Motion from = motion_of(played.source_frames, scale / target.box, source.areas),
               to = motion_of(played.target_frames, 1 / target.box, target.areas);
  out.by_area = from.squares > 1e-10 ? std::sqrt(to.area_squares / from.area_squares) : 0;
  for (size_t f = 0; f < to.step.size(); ++f) {
    if (to.jerk[f] > spike_share && to.jerk[f] > spike_ratio * from.jerk[f]) ++out.spikes;
    if (from.step[f] < still_step) out.still = std::max(out.still, to.step[f] / std::max(from.step[f], least_step));
    if (from.step[f] > moving_step) out.step = std::max(out.step, to.step[f] / from.step[f]);
  }
  out.acceleration = from.squares > 1e-10 ? std::sqrt(to.squares / from.squares) : 0;
  if (out.acceleration > calm)
    out.rigid = std::sqrt(
        motion_of(rigid_frames(played, source, target, session), 1 / target.box, target.areas).squares / from.squares);
  out.slide = played.feet.planted_max;
  out.low = played.feet.low_max;
  out.sunk = played.feet.surface_sunk;
  out.ms = played.frame_ms;
  out.gap = largest_gap(with_links(session.target_surface(), target), played.target_frames) / target.box;
  out.source_gap = largest_gap(with_links(session.source_surface(), source), played.source_frames) / source.box;
  const ClipFaults faults = find_faults(session, played);
  out.confidence = faults.confidence;
  out.stretch = faults.stretch;
  out.lost = faults.lost.size();
  if (&source != &target) return out;
  out.self_mean = out.self_max = 0;
  for (size_t f = 0; f < out.frames; ++f) {
    double sum = 0;
    for (size_t i = 0; i < played.target_frames[f].size(); ++i) {
      const double d = (played.target_frames[f][i] - played.source_frames[f][i]) / target.box;
      sum += 3 * d * d / static_cast<double>(played.target_frames[f].size());
    }
    out.self_mean += std::sqrt(sum) / static_cast<double>(out.frames);
    out.self_max = std::max(out.self_max, std::sqrt(sum));
  }
  return out;
}

// For the search for causes: the vertex that spikes most, per frame that does.
void say_where(const PlayedClip& played, const Loaded& source, const Loaded& target, Session& session) {
  const RegionFinder finder(target.model, target.flat, Axes());
  const double scale = std::max(session.scale(), target.box / source.box);
  const Motion from = motion_of(played.source_frames, scale / target.box, source.areas);
  for (size_t f = 1; f + 1 < played.target_frames.size(); ++f) {
    double most = 0;
    size_t vertex = 0;
    for (size_t i = 0; i < played.target_frames[f].size(); i += 3) {
      double sum = 0;
      for (size_t c = i; c < i + 3; ++c) {
        const double d =
            played.target_frames[f + 1][c] - 2 * played.target_frames[f][c] + played.target_frames[f - 1][c];
        sum += d * d / target.box / target.box;
      }
      if (std::sqrt(sum) > most) {
        most = std::sqrt(sum);
        vertex = i / 3;
      }
    }
    if (most <= spike_share || most <= spike_ratio * from.jerk[f]) continue;
    const double* p = played.target_frames[f].data() + 3 * vertex;
    std::printf("      %s frame %zu: %.3f of the box (source %.3f), vertex %zu of %s at %.2f %.2f %.2f\n",
                played.clip.name.c_str(), f, most, from.jerk[f], vertex,
                finder.owner_name(static_cast<uint32_t>(vertex)).c_str(), p[0] / target.box, p[1] / target.box,
                p[2] / target.box);
  }
}

// The joints that accelerate most in a run, with their shares of the sum of squares, and the vertices of the largest
// step and of the largest step beside a still source.
void say_fastest(const PlayedClip& played, const Loaded& source, const Loaded& target, Session& session) {
  const RegionFinder finder(target.model, target.flat, Axes());
  const double scale = std::max(session.scale(), target.box / source.box);
  const Motion from = motion_of(played.source_frames, scale / target.box, source.areas);
  std::map<std::string, double> squares;
  double total = 0, most_step = 0, most_still = 0;
  size_t stepper = 0, restless = 0, frame = 0, still_frame = 0;
  const auto& frames = played.target_frames;
  for (size_t f = 0; f + 1 < frames.size(); ++f) {
    for (size_t i = 0; i < frames[f].size(); i += 3) {
      double s = 0, j = 0;
      for (size_t c = i; c < i + 3; ++c) {
        const double d = (frames[f + 1][c] - frames[f][c]) / target.box;
        s += d * d;
        if (f == 0) continue;
        const double e = (frames[f + 1][c] - 2 * frames[f][c] + frames[f - 1][c]) / target.box;
        j += e * e;
      }
      squares[finder.owner_name(static_cast<uint32_t>(i / 3))] += j;
      total += j;
      const double ratio = std::sqrt(s) / std::max(from.step[f], least_step);
      if (from.step[f] > moving_step && ratio > most_step) {
        most_step = ratio;
        stepper = i / 3;
        frame = f;
      }
      if (from.step[f] < still_step && ratio > most_still) {
        most_still = ratio;
        restless = i / 3;
        still_frame = f;
      }
    }
  }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, sum] : squares) order.emplace_back(sum / std::max(total, 1e-300), name);
  std::sort(order.rbegin(), order.rend());
  std::printf("      %s accelerates by", played.clip.name.c_str());
  for (size_t i = 0; i < std::min<size_t>(order.size(), 4); ++i)
    std::printf(" %s %.0f %%", order[i].second.c_str(), 100 * order[i].first);
  std::printf("; step %.2f frame %zu vertex %zu of %s; still %.1f frame %zu vertex %zu of %s\n", most_step, frame,
              stepper, finder.owner_name(static_cast<uint32_t>(stepper)).c_str(), most_still, still_frame, restless,
              finder.owner_name(static_cast<uint32_t>(restless)).c_str());
}

// Whether a run is one of the sample: by its names, so that the sample never changes.
bool in_sample(const std::string& source, const std::string& target, const std::string& clip, uint32_t one_of) {
  uint32_t hash = 2166136261u;
  for (const char c : source + "|" + target + "|" + clip) hash = (hash ^ static_cast<uint8_t>(c)) * 16777619u;
  hash ^= hash >> 16;
  hash *= 0x85ebca6bu;
  hash ^= hash >> 13;
  return hash % one_of == 0;
}

// The deepest vertex under the ground of a run, of those that may not sink.
void say_deepest(const PlayedClip& played, const Loaded& target, const Session& session) {
  const RegionFinder finder(target.model, target.flat, Axes());
  const std::vector<double> grounds = session.grounds(played);
  size_t deepest = 0, frame = 0;
  double most = 0;
  for (size_t f = 0; f < played.target_frames.size(); ++f) {
    const std::vector<double>& xyz = played.target_frames[f];
    for (size_t v = 0; v < session.sinking().size(); ++v) {
      const double depth =
          grounds[f] - glm::dot(session.target_axes().up, glm::dvec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]));
      if (!session.sinking()[v] && depth > most) {
        most = depth;
        deepest = v;
        frame = f;
      }
    }
  }
  std::printf("      %s frame %zu: %.4f of the box under the ground, vertex %zu of %s\n", played.clip.name.c_str(),
              frame, most / target.box, deepest, finder.owner_name(static_cast<uint32_t>(deepest)).c_str());
}

// The link that opens most in a run, and the joints at its ends.
void say_widest(const PlayedClip& played, const Loaded& target, const Session& session) {
  const RegionFinder finder(target.model, target.flat, Axes());
  uint32_t count = 0, worst = HF_NO_INDEX;
  size_t frame = 0;
  double most = 0;
  hf_surface_get_links(session.target_surface(), 0, nullptr, &count);
  std::vector<hf_link> links(count);
  hf_surface_get_links(session.target_surface(), count, links.data(), nullptr);
  for (size_t f = 0; f < played.target_frames.size(); ++f) {
    hf_gaps_desc posed = HF_INIT(hf_gaps_desc);
    posed.positions_f64 = played.target_frames[f].data();
    hf_gaps_info info = HF_INIT(hf_gaps_info);
    if (hf_surface_measure_gaps(session.target_surface(), &posed, 0, nullptr, &info) != HF_OK || info.worst <= most)
      continue;
    most = info.worst;
    worst = info.worst_link;
    frame = f;
  }
  if (worst == HF_NO_INDEX) return;
  const hf_link& link = links[worst];
  const auto corner = std::max_element(link.barycentrics, link.barycentrics + 3) - link.barycentrics;
  const glm::dvec3 p = target.flat.positions[link.vertex] / target.box;
  std::printf("      %s frame %zu: a gap of %.4f of the box from vertex %u of %s at %.2f %.2f %.2f to %s\n",
              played.clip.name.c_str(), frame, most / target.box, link.vertex, finder.owner_name(link.vertex).c_str(),
              p.x, p.y, p.z, finder.owner_name(link.corners[corner]).c_str());
}

// How many vertices of each joint may sink.
void say_sinking(const Loaded& target, const Session& session) {
  const RegionFinder finder(target.model, target.flat, Axes());
  std::map<std::string, std::pair<size_t, size_t>> of_joint;
  for (uint32_t v = 0; v < target.flat.vertex_count(); ++v) {
    std::pair<size_t, size_t>& count = of_joint[finder.owner_name(v)];
    ++count.second;
    count.first += session.sinking()[v];
  }
  for (const auto& [joint, count] : of_joint)
    if (count.first > 0)
      std::printf("      sinks: %zu of %zu vertices of %s\n", count.first, count.second, joint.c_str());
}

struct Options {
  std::filesystem::path folder;
  uint32_t sample = 1;
  std::string half = "choosing", source, target, clip;
  bool itself = false, runs = false, links = true, ground = true, where = false, sinking = false, own_skin = false;
  double key_tolerance = 0.0005;  // of hf_transfer
};

// Ranks from 1; equal numbers share the mean of theirs.
std::vector<double> ranks(const std::vector<double>& numbers) {
  std::vector<size_t> order(numbers.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return numbers[a] < numbers[b]; });
  std::vector<double> out(numbers.size());
  for (size_t i = 0; i < order.size();) {
    size_t j = i;
    while (j < order.size() && numbers[order[j]] == numbers[order[i]]) ++j;
    for (size_t k = i; k < j; ++k) out[order[k]] = 0.5 * static_cast<double>(i + j + 1);
    i = j;
  }
  return out;
}

// Spearman's rank correlation; 0 where one side is constant.
double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean = 0.5 * static_cast<double>(x.size() + 1);
  double xx = 0, yy = 0, xy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
    xy += (x[i] - mean) * (y[i] - mean);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

// How the confidence falls with each measured fault, and with the worst rank of all. Acceleration is a fault beyond the
// source's only.
void print_confidence(const std::vector<Run>& runs) {
  std::vector<double> confidence, spikes, acceleration, sunk, gap, stretch, lost;
  for (const Run& run : runs) {
    confidence.push_back(run.confidence);
    spikes.push_back(static_cast<double>(run.spikes));
    acceleration.push_back(std::max(run.acceleration, 1.0));
    sunk.push_back(run.sunk);
    gap.push_back(run.gap);
    stretch.push_back(run.stretch);
    lost.push_back(static_cast<double>(run.lost));
  }
  std::vector<double> worst(runs.size(), 0.0);
  for (const std::vector<double>* fault : {&spikes, &acceleration, &sunk, &gap}) {
    const std::vector<double> rank = ranks(*fault);
    for (size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], rank[i]);
  }
  std::printf(
      "  confidence, Spearman    spikes %.2f, acceleration %.2f, penetration %.2f, gaps %.2f; worst of these "
      "%.2f; stretch %.2f, lost limbs %.2f\n",
      spearman(confidence, spikes), spearman(confidence, acceleration), spearman(confidence, sunk),
      spearman(confidence, gap), spearman(confidence, worst), spearman(confidence, stretch),
      spearman(confidence, lost));
}

void print_runs(const char* heading, const std::vector<Run>& runs) {
  std::vector<double> ratios;
  size_t calm_area = 0, near_area = 0, spikes = 0, spiked = 0, calm_runs = 0, near = 0, stiff = 0, stiff_near = 0,
         still = 0, step = 0, slide = 0, low = 0, sunk = 0, gap = 0, opened = 0, selves = 0, good = 0;
  double worst_still = 0, worst_step = 0, worst_slide = 0, worst_sunk = 0, worst_gap = 0, worst_self = 0, mean_self = 0,
         ms = 0, frames = 0;
  for (const Run& run : runs) {
    spikes += run.spikes;
    spiked += run.spikes > 0;
    if (run.acceleration > 0) {
      ratios.push_back(run.acceleration);
      calm_runs += run.acceleration <= calm;
      near += run.acceleration <= nearly_calm;
    }
    if (run.acceleration > 0) {
      calm_area += run.by_area <= calm;
      near_area += run.by_area <= nearly_calm;
    }
    stiff += run.rigid > calm;
    stiff_near += run.acceleration > nearly_calm && run.rigid > nearly_calm;
    still += run.still > 2;
    worst_still = std::max(worst_still, run.still);
    step += run.step > 1.5;
    worst_step = std::max(worst_step, run.step);
    low += run.low > 0.001;
    slide += run.slide > 0.001;
    worst_slide = std::max(worst_slide, run.slide);
    sunk += run.sunk > 0.01;
    worst_sunk = std::max(worst_sunk, run.sunk);
    opened += run.gap > std::max(0.005, run.source_gap);
    gap += run.gap > 0.005;
    worst_gap = std::max(worst_gap, run.gap);
    ms += run.ms * static_cast<double>(run.frames);
    frames += static_cast<double>(run.frames);
    if (run.self_mean < 0) continue;
    ++selves;
    good += run.self_mean <= 0.010 && run.self_max <= 0.025;
    mean_self = std::max(mean_self, run.self_mean);
    worst_self = std::max(worst_self, run.self_max);
  }
  std::sort(ratios.begin(), ratios.end());
  const auto part = [&](double share) {
    return ratios.empty() ? 0.0 : ratios[static_cast<size_t>(share * static_cast<double>(ratios.size() - 1))];
  };
  std::printf("%s: %zu runs, %.3f ms a frame\n", heading, runs.size(), frames > 0 ? ms / frames : 0.0);
  std::printf("  spikes                  %zu in %zu runs\n", spikes, spiked);
  std::printf("  acceleration / source's %.1f %% <= 1.1, %.1f %% <= 1.3; median %.2f, 95 %% %.2f, largest %.2f\n",
              100.0 * static_cast<double>(calm_runs) / static_cast<double>(std::max<size_t>(ratios.size(), 1)),
              100.0 * static_cast<double>(near) / static_cast<double>(std::max<size_t>(ratios.size(), 1)), part(0.5),
              part(0.95), part(1));
  std::printf("  acceleration by area    %.1f %% <= 1.1, %.1f %% <= 1.3\n",
              100.0 * static_cast<double>(calm_area) / static_cast<double>(std::max<size_t>(ratios.size(), 1)),
              100.0 * static_cast<double>(near_area) / static_cast<double>(std::max<size_t>(ratios.size(), 1)));
  std::printf("  more, also if rigid     %zu runs > 1.1, %zu runs > 1.3\n", stiff, stiff_near);
  std::printf("  still source            %zu runs step > 2 times; largest %.1f\n", still, worst_still);
  std::printf("  step / source's         %zu runs > 1.5; largest %.2f\n", step, worst_step);
  std::printf("  planted feet slide      %zu runs > 0.001; largest %.4f; %zu with all low feet\n", slide, worst_slide,
              low);
  std::printf("  penetration             %zu runs > 0.01; largest %.4f\n", sunk, worst_sunk);
  std::printf("  gaps                    %zu runs > 0.005, %zu of them more than the source's own; largest %.4f\n", gap,
              opened, worst_gap);
  if (selves > 0)
    std::printf("  on itself               %zu of %zu within 0.010 and 0.025; largest mean %.4f, frame %.4f\n", good,
                selves, mean_self, worst_self);
}

int table(const Options& options) {
  std::vector<Loaded> models;
  for (const Listed& entry : listed) models.push_back(load(options.folder, entry));
  std::vector<Run> all, deaths;
  size_t pairs = 0, refused = 0;
  ProgressBar bar(true);
  for (Loaded& source : models) {
    if (source.model.animations.empty()) continue;
    if (!options.source.empty() && options.source != source.name) continue;
    for (Loaded& target : models) {
      if (!options.target.empty() && options.target != target.name) continue;
      if (options.itself && &source != &target) continue;
      const std::string half = source.judging != target.judging ? "mixed" : source.judging ? "judging" : "choosing";
      if (options.half != "all" && options.half != half) continue;
      const auto chosen = [&](size_t c) {
        const std::string& name = source.model.animations[c].name;
        return (options.clip.empty() || name.find(options.clip) != std::string::npos) &&
               in_sample(source.name, target.name, name, options.sample);
      };
      bool any = false;
      for (size_t c = 0; c < source.model.animations.size(); ++c) any = any || chosen(c);
      if (!any) continue;
      ++pairs;
      std::string proposed;
      std::vector<Run> runs;
      try {
        const Suggestion suggestion = suggest_pairs({source.model, source.flat, tips_of(source.flat, source.name)},
                                                    {target.model, target.flat, tips_of(target.flat, target.name)});
        for (const SuggestedPair& pair : suggestion.pairs) proposed += (proposed.empty() ? "" : ", ") + pair.name;
        Session session(source.model, target.model, parse_pairs(suggestion.file, "the proposed pairs"), 1,
                        options.links, bar, options.ground);
        if (options.sinking) say_sinking(target, session);
        sample_clips(source);
        for (size_t c = 0; c < source.frames.size(); ++c) {
          const Frames& frames = source.frames[c];
          if (!chosen(c) || frames.size() < 3) continue;
          Frames some;
          for (size_t k = 0; k < 24; ++k) some.push_back(frames[k * (frames.size() - 1) / 23]);
          session.set_contacts({}, some);
          PlayedClip played = session.play(source.model.animations[c].name, source.times[c], frames, bar);
          if (options.own_skin && !target.model.skins.empty()) {
            OutputFigures figures;
            const Model written =
                own_skin_model(target.model, session, {played}, target.box, options.key_tolerance, figures);
            played = written_clips(written, session, {played}).front();
          }
          runs.push_back(measure(played, source, target, session));
          if (options.where && runs.back().spikes > 0) say_where(played, source, target, session);
          if (options.where && (runs.back().acceleration > 1.1 || runs.back().step > 1.5 || runs.back().still > 2))
            say_fastest(played, source, target, session);
          if (options.where && runs.back().sunk > 0.01) say_deepest(played, target, session);
          if (options.where && runs.back().gap > 0.005) say_widest(played, target, session);
        }
      } catch (const std::exception& error) {
        ++refused;
        std::printf("%-20s on %-22s refused: %s\n", source.name, target.name, error.what());
        continue;
      }
      size_t spikes = 0;
      double acceleration = 0;
      for (const Run& run : runs) {
        spikes += run.spikes;
        acceleration = std::max(acceleration, run.acceleration);
      }
      std::printf("%-20s on %-22s %zu clips, %zu spikes, acceleration %.2f: %s\n", source.name, target.name,
                  runs.size(), spikes, acceleration, proposed.c_str());
      for (const Run& run : runs) {
        if (options.runs)
          std::printf(
              "    %-36s spikes %2zu accel %.2f (%.2f) still %5.1f step %5.2f slide %.4f (%.4f) sunk %.4f gap %.4f "
              "(%.4f) self "
              "%.4f %.4f confidence %.3f stretch %.2f lost %zu\n",
              run.name.c_str(), run.spikes, run.acceleration, run.rigid, run.still, run.step, run.slide, run.low,
              run.sunk, run.gap, run.source_gap, run.self_mean, run.self_max, run.confidence, run.stretch, run.lost);
        all.push_back(run);
        if (run.name.find("Death") != std::string::npos) deaths.push_back(run);
      }
      std::fflush(stdout);
    }
  }
  std::printf("\n%s half: %zu pairs, %zu refused (%.1f %% transfer)\n", options.half.c_str(), pairs, refused,
              100.0 * static_cast<double>(pairs - refused) / static_cast<double>(std::max<size_t>(pairs, 1)));
  print_runs("all clips", all);
  print_confidence(all);
  if (!deaths.empty()) print_runs("falls", deaths);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    Options options;
    for (int i = 1; i < count; ++i) {
      const std::string word = arguments[i];
      std::string* value = word == "--half"     ? &options.half
                           : word == "--source" ? &options.source
                           : word == "--target" ? &options.target
                           : word == "--clip"   ? &options.clip
                                                : nullptr;
      if (value && i + 1 < count) {
        *value = arguments[++i];
      } else if (word == "--sample" && i + 1 < count) {
        options.sample = static_cast<uint32_t>(std::max(1L, std::strtol(arguments[++i], nullptr, 10)));
      } else if (word == "--runs") {
        options.runs = true;
      } else if (word == "--itself") {
        options.itself = true;
      } else if (word == "--where") {
        options.where = true;
      } else if (word == "--sinking") {
        options.sinking = true;
      } else if (word == "--no-ground") {
        options.ground = false;
      } else if (word == "--own-skin") {
        options.own_skin = true;
      } else if (word == "--key-tolerance" && i + 1 < count) {
        options.key_tolerance = std::strtod(arguments[++i], nullptr);
      } else if (word == "--no-links") {
        options.links = false;
      } else {
        options.folder = word;
      }
    }
    if (options.folder.empty()) throw std::runtime_error("the folder of the models is needed");
    return table(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_transfer_table: %s\n", error.what());
    return 1;
  }
}
