// See transfer_report.h.
#include "transfer/transfer_report.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "gltf/animate.h"
#include "gltf/landmarks.h"

namespace samples {

using namespace hf_gltf;
namespace {

// Less is not seen: the soles of a sound walk of samples/assets roll 0.6 % under the ground.
constexpr double told_depth = 0.01;

#if defined(__MINGW32__) && !defined(__clang__)  // its C++ library has the printf of GNU
void print(std::string& out, const char* format, ...) __attribute__((format(gnu_printf, 2, 3)));
#elif defined(__GNUC__)
void print(std::string& out, const char* format, ...) __attribute__((format(printf, 2, 3)));
#endif
void print(std::string& out, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
}

BodyReport body_report(const Axes& axes, const KnownBody& known) {
  BodyReport out;
  out.up = axis_name(axes.up);
  out.forward = axis_name(axes.forward);
  out.said = "up " + out.up + ", faces " + out.forward + ", as the pairs file says";
  out.up_confidence = known.up_confidence;
  out.forward_confidence = known.forward_confidence;
  out.part_confidence = known.part_confidence;
  out.why = known.why;
  return out;
}

nlohmann::json body_json(const BodyReport& body) {
  return {{"up", body.up},
          {"forward", body.forward},
          {"said", body.said},
          {"skeleton",
           {{"up_confidence", body.up_confidence},
            {"forward_confidence", body.forward_confidence},
            {"part_confidence", body.part_confidence},
            {"why", body.why}}}};
}

}  // namespace

ReplayReport measure_replay(const Model& written, const std::vector<PlayedClip>& clips, double box) {
  ReplayReport out;
  const FlatMesh mesh = flatten(written);
  SurfacePoser surface(written, mesh);
  double sum = 0;
  size_t count = 0;
  for (size_t c = 0; c < clips.size(); ++c) {
    const PlayedClip& clip = clips[c];
    const Animation& animation = written.animations[c];
    const size_t step = std::max<size_t>(1, clip.clip.times.size() / 8);
    for (size_t f = 0; f < clip.clip.times.size(); f += step) {
      const std::vector<glm::dvec3> keys = surface.at(animation, clip.clip.times[f]);
      const std::vector<double>& expected = clip.target_frames[f];
      for (size_t v = 0; v < keys.size(); ++v) {
        if (mesh.loose[v]) continue;
        out.key_max = std::max(
            out.key_max,
            glm::distance(keys[v], glm::dvec3(expected[3 * v], expected[3 * v + 1], expected[3 * v + 2])) / box);
      }
      // a straight line through a frame and the one after next, against the frame between: an upper bound of what
      // half-way keys miss
      if (f + 2 >= clip.clip.times.size()) continue;
      const std::vector<double>&next = clip.target_frames[f + 1], &after = clip.target_frames[f + 2];
      for (size_t i = 0; i < expected.size(); ++i) {
        if (mesh.loose[i / 3]) continue;
        const double d = (next[i] - 0.5 * (expected[i] + after[i])) / 4 / box;
        sum += d * d;
      }
      count += static_cast<size_t>(std::count(mesh.loose.begin(), mesh.loose.end(), 0));
    }
  }
  if (count > 0) out.half_rms = std::sqrt(sum / static_cast<double>(count));
  return out;
}

RunReport make_report(Session& session, const std::vector<PlayedClip>& clips, const std::string& output) {
  RunReport out;
  out.output = output;
  out.pairs = session.pairs();
  out.warnings = session.warnings();
  for (const PlayedClip& clip : clips) {
    out.clip_names.push_back(clip.clip.name);
    out.frames.push_back(clip.clip.times.size());
    out.feet.push_back(clip.feet);
    out.frame_ms.push_back(clip.frame_ms);
  }
  out.clusters = session.cluster_count();
  out.scale = session.scale();
  out.scale_from = session.scale_from();
  out.source = body_report(session.source_axes(), session.source_known());
  out.target = body_report(session.target_axes(), session.target_known());
  out.setup_ms = session.setup_ms();
  out.prepare_ms = session.prepare_ms();
  out.edit_ms = session.edit_ms();
  out.source_factorisations = session.statistics().source_factorisation_count;
  out.target_factorisations = session.statistics().target_factorisation_count;
  return out;
}

namespace {

void add_pairs(const RunReport& report, std::string& out) {
  print(out, "  clusters      %u\n", report.clusters);
  print(out, "  factorisation %.1f ms both surfaces; numeric factorisations so far: source %u, target %u\n",
        report.setup_ms, report.source_factorisations, report.target_factorisations);
  print(out, "  pairs         %.1f ms fields, clusters and translations\n", report.prepare_ms);
  print(out, "  pair                     vertices     leak      rest angle  support  kind\n");
  for (const PairReport& pair : report.pairs) {
    std::string kind;
    for (const auto& [is, word] : {std::pair<bool, const char*>(pair.foot, " foot"),
                                   {pair.anchor && !pair.foot, " anchor"},
                                   {pair.trunk, " trunk"},
                                   {pair.contact, " contact"},
                                   {pair.crossed, " CROSSED"}}) {
      if (is) kind += word;
    }
    if (pair.alignment_share > 0) kind += " aligned " + std::to_string(std::lround(100 * pair.alignment_share)) + " %";
    const std::string angle =
        pair.alignment_degrees < 0 ? "-" : std::to_string(static_cast<int>(pair.alignment_degrees + 0.5));
    print(out, "  %-22s %5zu %5zu   %.1e   %10s  %7.2f %s\n", pair.name.c_str(), pair.source_vertices,
          pair.target_vertices, std::max(pair.source_leak, pair.target_leak), angle.c_str(), pair.confidence,
          kind.c_str());
  }
  for (size_t c = 0; c < report.clip_names.size(); ++c) {
    print(out,
          "  clip \"%s\": %zu frames, %.3f ms each; feet off their scaled path by %.2f %% of the box (largest %.2f; "
          "standing they slide %.2f, %.2f)\n",
          report.clip_names[c].c_str(), report.frames[c], report.frame_ms[c], 100 * report.feet[c].path_mean,
          100 * report.feet[c].path_max, 100 * report.feet[c].planted_mean, 100 * report.feet[c].planted_max);
  }
}

// "; 2 of the source have no partner: tail_1 tail_2"; at most 12 names.
void add_names(const std::vector<std::string>& names, const char* what, std::string& out) {
  if (names.empty()) return;
  print(out, "; %zu %s:", names.size(), what);
  for (size_t k = 0; k < std::min<size_t>(names.size(), 12); ++k) out += " " + names[k];
  if (names.size() > 12) out += " ...";
}

void add_joints(const RunReport& report, std::string& out) {
  if (report.same_skeleton) out += "  same skeleton, its keys are copied\n";
  print(out, "  joints        %zu of the target follow", report.joints);
  add_names(report.unmatched, "of the source have no partner", out);
  add_names(report.staying, "of the target stay as they rest", out);
  out += "\n";
  for (size_t c = 0; c < report.clip_names.size(); ++c)
    print(out, "  clip \"%s\": %zu frames, %.3f ms each\n", report.clip_names[c].c_str(), report.frames[c],
          report.frame_ms[c]);
  if (report.drop > 0.001)
    print(out, "  hips          sink by %.1f %% of the box so that feet reach\n", 100 * report.drop);
}

void add_quality(const RunReport& report, std::string& out) {
  for (size_t c = 0; c < report.fits.size(); ++c) {
    const PoseFit& fit = report.fits[c];
    if (fit.compared == 0) continue;
    const auto worst = std::max_element(fit.limbs.begin(), fit.limbs.end(),
                                        [](const LimbFit& a, const LimbFit& b) { return a.mean < b.mean; });
    print(out,
          "  limbs         follow the source to %.0f degrees in \"%s\" (%s %.0f; trunk %.0f; %zu of %zu %s have a "
          "partner)\n",
          std::abs(fit.degrees), report.clip_names[c].c_str(), worst->name.c_str(), worst->mean, fit.trunk_degrees,
          fit.limbs.size(), std::max(fit.source_limbs, fit.target_limbs), fit.flaps ? "limbs" : "arms and legs");
  }
  for (size_t c = 0; c < report.depths.size(); ++c) {
    print(out, "  ground        deepest vertex %.2f %% of the box under it", 100 * report.depths[c]);
    if (c < report.source_depths.size() && report.source_depths[c] > told_depth)
      print(out, ", beyond the source, whose motion goes %.1f %% under its own ground", 100 * report.source_depths[c]);
    if (report.faults[c].sunk < 0.9 * report.depths[c])
      print(out, " (%.2f %% without things in hands and parts that may sink)", 100 * report.faults[c].sunk);
    if (report.faults[c].slide >= 0) print(out, ", standing soles slide %.3f boxes a second", report.faults[c].slide);
    if (report.faults[c].hover > 0.001) print(out, ", soles float by %.2f %%", 100 * report.faults[c].hover);
    print(out, " in \"%s\"\n", report.clip_names[c].c_str());
  }
  for (size_t c = 0; c < report.faults.size(); ++c)
    print(out, "  confidence    %.2f in \"%s\": %zu frames jump, acceleration %.2f times the source's, stretch %.2f\n",
          report.faults[c].confidence, report.clip_names[c].c_str(), report.faults[c].spikes,
          report.faults[c].acceleration, report.faults[c].stretch);
}

}  // namespace

std::string to_text(const RunReport& report, const std::string& heading) {
  std::string out = heading + "\n";
  print(out, "  output        %s\n", report.output.c_str());
  out += "  way           " + report.way + ": " + report.way_why + "\n";
  out += "  source        " + report.source.said + "\n";
  out += "  target        " + report.target.said + "\n";
  print(out, "  scale         %.4f from %s\n", report.scale, report.scale_from.c_str());
  if (report.way == "surface")
    add_pairs(report, out);
  else
    add_joints(report, out);
  if (report.written_as == "skin")
    print(out, "  read back     %.1e of the box at keys; half-way between keys about %.1e\n", report.replay.key_max,
          report.replay.half_rms);
  if (report.written_parts > 0)
    print(out,
          "  written as    %s, %zu parts: %.3f %% of the box from the computed frames (root mean square; largest "
          "%.2f)\n",
          report.written_as.c_str(), report.written_parts, 100 * report.written_rms, 100 * report.written_max);
  if (report.all_keys > 0)
    print(out, "  keys          %zu of %zu are written; the others follow from them\n", report.keys, report.all_keys);
  add_quality(report, out);
  for (size_t c = 0; c < report.gaps.size(); ++c) {
    if (report.gaps[c] > 0)
      print(out, "  gaps          %.2f %% of the box at most between linked pieces in \"%s\"\n", 100 * report.gaps[c],
            report.clip_names[c].c_str());
  }
  for (const std::string& contact : report.contacts) out += "  contact: " + contact + "\n";
  for (const std::string& warning : report.warnings) out += "  note: " + warning + "\n";
  return out;
}

nlohmann::json to_json(const RunReport& report) {
  nlohmann::json pairs = nlohmann::json::array(), clips = nlohmann::json::array();
  for (const PairReport& pair : report.pairs) {
    pairs.push_back(
        {{"name", pair.name},
         {"source_vertices", pair.source_vertices},
         {"target_vertices", pair.target_vertices},
         {"anchor", pair.anchor},
         {"foot", pair.foot},
         {"trunk", pair.trunk},
         {"aligned", pair.alignment_share > 0},
         {"alignment_share", pair.alignment_share},
         {"contact", pair.contact},
         {"crossed", pair.crossed},
         {"source_leak", pair.source_leak},
         {"target_leak", pair.target_leak},
         {"rest_angle_degrees", pair.alignment_degrees < 0 ? nlohmann::json() : nlohmann::json(pair.alignment_degrees)},
         {"confidence", pair.confidence}});
  }
  for (size_t c = 0; c < report.clip_names.size(); ++c) {
    clips.push_back(
        {{"name", report.clip_names[c]}, {"frames", report.frames[c]}, {"ms_per_frame", report.frame_ms[c]}});
    if (c < report.feet.size()) {
      const FootReport& feet = report.feet[c];
      clips.back().update({{"foot_path_mean", feet.path_mean},
                           {"foot_path_max", feet.path_max},
                           {"foot_sunk", feet.sunk},
                           {"planted", feet.planted},
                           {"planted_mean", feet.planted_mean},
                           {"planted_max", feet.planted_max},
                           {"surface_sunk", feet.surface_sunk}});
    }
    if (c < report.depths.size()) clips.back()["depth"] = report.depths[c];
    if (c < report.source_depths.size()) clips.back()["source_depth"] = report.source_depths[c];
    if (c < report.fits.size() && report.fits[c].compared > 0) {
      const PoseFit& fit = report.fits[c];
      nlohmann::json limbs;
      for (const LimbFit& limb : fit.limbs) limbs[limb.name] = {{"mean", limb.mean}, {"worst", limb.worst}};
      clips.back()["limbs"] = {{"degrees", fit.degrees},
                               {"worst", fit.worst},
                               {"trunk_degrees", fit.trunk_degrees},
                               {"trunk_worst", fit.trunk_worst},
                               {"partners", fit.limbs.size()},
                               {"of", std::max(fit.source_limbs, fit.target_limbs)},
                               {"each", limbs}};
    }
    if (c < report.faults.size()) {
      const ClipFaults& faults = report.faults[c];
      clips.back()["confidence"] = faults.confidence;
      clips.back()["faults"] = {{"spikes", faults.spikes},
                                {"acceleration", faults.acceleration},
                                {"stretch", faults.stretch},
                                {"sunk", faults.sunk},
                                {"held", faults.held},
                                {"gap", faults.gap},
                                {"hover", faults.hover < 0 ? nlohmann::json() : nlohmann::json(faults.hover)},
                                {"uneven", faults.uneven},
                                {"lost", faults.lost},
                                {"slide", faults.slide < 0 ? nlohmann::json() : nlohmann::json(faults.slide)},
                                {"sentences", fault_sentences(faults, report.clip_names[c], report.frames[c])}};
    }
    if (c < report.written_feet.size()) {
      clips.back()["written_planted_max"] = report.written_feet[c].planted_max;
      clips.back()["written_planted_mean"] = report.written_feet[c].planted_mean;
    }
  }
  return {{"output", report.output},
          {"way", report.way},
          {"way_why", report.way_why},
          {"same_skeleton", report.same_skeleton},
          {"joints", report.joints},
          {"unmatched", report.unmatched},
          {"staying", report.staying},
          {"clusters", report.clusters},
          {"scale", report.scale},
          {"scale_from", report.scale_from},
          {"source", body_json(report.source)},
          {"target", body_json(report.target)},
          {"factorise_ms", report.setup_ms},
          {"prepare_ms", report.prepare_ms},
          {"edit_ms", report.edit_ms},
          {"source_factorisations", report.source_factorisations},
          {"target_factorisations", report.target_factorisations},
          {"pairs", pairs},
          {"clips", clips},
          {"written_as", report.written_as},
          {"written_rms", report.written_rms},
          {"written_max", report.written_max},
          {"written_parts", report.written_parts},
          {"contacts", report.contacts},
          {"gaps", report.gaps},
          {"keys", report.keys},
          {"all_keys", report.all_keys},
          {"replay_key_max", report.replay.key_max},
          {"replay_half_rms", report.replay.half_rms},
          {"warnings", report.warnings}};
}

}  // namespace samples
