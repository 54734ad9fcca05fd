// See skeleton_run.h.
#include "transfer/skeleton_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "gltf/clip_binding.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/key_reduce.h"
#include "gltf/landmarks.h"
#include "gltf/node_match.h"
#include "gltf/pose_numbers.h"
#include "transfer/clip_sheet.h"
#include "transfer/faults.h"
#include "transfer/outputs.h"
#include "transfer/soles.h"

namespace samples {
namespace {

// Without the source's surface, or its skeleton, nothing says whether feet slide or limbs follow.
constexpr double unseen_confidence = 0.8;

const Axes* given(const std::optional<Axes>& axes) { return axes ? &*axes : nullptr; }

// The pose that is given, else the one in which the body stands. Moves the mesh there.
Stance stand(const Model& model, FlatMesh& mesh, const Axes* axes, const std::optional<Pose>& chosen) {
  if (chosen) {
    mesh = standing(std::move(mesh), model, *chosen);
    return {*chosen, false, ""};
  }
  std::optional<Stance> found = find_stance(model, mesh, axes);
  if (!found) return {rest_pose(model), false, ""};
  mesh = standing(std::move(mesh), model, found->pose);
  return std::move(*found);
}

// No surface, if the file has that of a part of the body alone, such as a head with the clips of all joints.
FlatMesh whole_surface(const Model& model, const Axes* axes) {
  FlatMesh mesh = flatten(model);
  return know_body(model, mesh, axes, nullptr).partial ? FlatMesh() : mesh;
}

// What asks for places of a surface.
std::string needs_surface(const TransferCommand& command) {
  for (const auto& [is, option] : {std::pair<bool, const char*>(!command.pairs.empty(), "--pairs"),
                                   {!command.edits.empty(), "--edit"},
                                   {!command.contacts.empty(), "--contacts"},
                                   {!command.sinking.empty(), "--sinking"},
                                   {!command.poses.empty(), "--poses"}})
    if (is) return std::string(option) + " names places of the surfaces";
  if (command.kind == "skin") return "--as skin gives the target new joints";
  for (const auto& [name, value] : command.dials)
    if (name != "stride") return "--dials " + name + " turns parts of the surface";
  return {};
}

std::vector<double> times_of(const Animation& clip, double rate) {
  if (rate < 0) return key_times(clip);
  return frame_times(clip, rate > 0 ? rate : clip_duration(clip) < 1 ? 60 : 30);
}

// The channels of the source as they are, on the nodes of the same names, if they play what the frames say.
std::optional<Animation> copied_channels(const JointModels& models, const Animation& clip, const JointClip& played) {
  constexpr double equal = 1e-5;
  std::vector<int> moved;
  for (const Channel& channel : clip.channels)
    if (channel.path != Path::weights) moved.push_back(channel.node);
  std::sort(moved.begin(), moved.end());
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  const NodeMatch match = match_nodes(models.source, moved, models.target);
  Animation out;
  out.name = clip.name;
  for (const Channel& channel : clip.channels) {
    const int there = match.there[static_cast<size_t>(channel.node)];
    if (channel.path == Path::weights || there < 0) continue;
    out.channels.push_back(channel);
    out.channels.back().node = there;
  }
  if (!played.riders.empty()) {
    for (Channel& channel : clip_of_poses(models.target, clip.name, played.times, played.target).channels)
      if (std::find(played.riders.begin(), played.riders.end(), channel.node) != played.riders.end())
        out.channels.push_back(std::move(channel));
  }
  for (size_t f = 0; f < played.times.size(); ++f) {
    const Pose pose = sample(models.target, out, played.times[f]);
    for (size_t n = 0; n < pose.size(); ++n) {
      const glm::dmat4 a = local_matrix(pose[n]), b = local_matrix(played.target[f][n]);
      for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
          if (std::abs(a[c][r] - b[c][r]) > equal * (1 + std::abs(b[c][r]))) return {};
    }
  }
  return out;
}

BodyReport body_of(const KnownBody& known, const Axes* axes, const Stance& stance) {
  BodyReport out;
  out.up = axis_name(known.axes.up);
  out.forward = axis_name(known.axes.forward);
  out.said = "up " + out.up + " (" + (axes ? "as given" : known.up_why) + "), faces " + out.forward + " (" +
             (axes ? "as given" : known.forward_why) + ")";
  if (!stance.from.empty()) out.said += ", stands " + stance.from;
  out.up_confidence = known.up_confidence;
  out.forward_confidence = known.forward_confidence;
  out.part_confidence = known.part_confidence;
  out.why = known.why;
  return out;
}

std::vector<std::vector<double>> frames_of(const Model& model, const FlatMesh& mesh, const Animation& clip,
                                           const std::vector<double>& times) {
  std::vector<std::vector<double>> out;
  SurfacePoser surface(model, mesh);
  for (const double time : times) out.push_back(double_positions(surface.at(clip, time)));
  return out;
}

// The clip of the file with the travel taken out, as the joints played it.
std::vector<std::vector<double>> frames_of(const Model& model, const FlatMesh& mesh, const std::vector<Pose>& poses) {
  std::vector<std::vector<double>> out;
  for (const Pose& pose : poses) out.push_back(double_positions(posed_positions(model, mesh, pose)));
  return out;
}

// Writes the model; returns it as the file gives it back.
Model write_by_joints(const JointModels& models, const std::vector<Animation>& made,
                      const std::vector<PlayedClip>& clips, const TransferCommand& command, double box,
                      RunReport& report) {
  Model out = models.target;
  size_t done = 0;
  for (const Animation& clip : made) insert_clip(out, done++, clip);
  OutputFigures figures;
  report.written_as = command.kind.empty() ? "own-skin" : command.kind;
  const std::filesystem::path file = command.kind == "frames" ? command.frames : command.output;
  if (report.written_as == "frames") {
    write_frames(file, ".ply", to_surface_mesh(models.target_mesh), clips);
    return out;
  }
  if (report.written_as == "morph") {
    write_gltf(morph_model(models.target, models.target_mesh, clips, box, command.morph_tolerance, 64, figures), file);
    report.written_parts = figures.parts;
    report.written_rms = figures.rms;
    report.written_max = figures.max;
    return read_gltf(file);
  }
  if (!report.same_skeleton) reduce_clips(out, models.target_mesh, done, command.key_tolerance * box, figures);
  report.keys = figures.keys;
  report.all_keys = figures.all_keys;
  Model whole = out;
  if (command.root_motion) {
    const int root = models.pair.target_root();
    if (root < 0) throw std::runtime_error("--root-motion: " + models.target.name + " has no node over its joints");
    add_root_motion(whole, root, clips);
  }
  write_gltf(whole, file);
  if (command.root_motion) return out;  // the figures are those of the body in its place
  return read_gltf(file);
}

}  // namespace

JointModels::JointModels(const Model& source_model, const Model& target_model, const TransferCommand& command,
                         const std::optional<Pose>& given_source_rest, const std::optional<Pose>& given_target_rest)
    : source(source_model),
      target(target_model),
      source_mesh(whole_surface(source_model, given(command.source_axes))),
      target_mesh(flatten(target_model)),
      source_stance(stand(source, source_mesh, given(command.source_axes), given_source_rest)),
      target_stance(stand(target, target_mesh, given(command.target_axes), given_target_rest)),
      pair({source, source_mesh, given(command.source_axes), &source_stance.pose},
           {target, target_mesh, given(command.target_axes), &target_stance.pose}),
      source_known(know_body(source, source_mesh, given(command.source_axes), &source_stance.pose)),
      target_known(know_body(target, target_mesh, given(command.target_axes), &target_stance.pose)) {}

ChosenWay choose_way(const TransferCommand& command, const JointModels& models) {
  const SkeletonPair& pair = models.pair;
  const std::string surface = needs_surface(command);
  if (command.way == "surface") return {false, "as asked"};
  if (command.way == "skeleton") {
    if (!surface.empty())
      throw std::runtime_error(surface + ": take it away, or take --way surface instead of --way skeleton");
    if (!pair.refusal().empty()) throw std::runtime_error("--way skeleton: " + pair.refusal() + "; take --way surface");
    return {true, "as asked"};
  }
  if (!surface.empty()) return {false, surface};
  if (!pair.refusal().empty()) return {false, pair.refusal()};
  // The surface has the pose of the file: where a body is not understood in it, joints lead.
  if (pair.four_legged() && !models.source_stance.needed && !models.target_stance.needed)
    return {false, "between bodies on four legs surfaces give the smoother motion; --way skeleton turns joints", true};
  return {true, "both skeletons are understood, and " + pair.limbs_text() + " have partners"};
}

namespace {

// Nothing is under a fish.
bool has_ground(const JointModels& models) { return !models.source_known.swims() && !models.target_known.swims(); }

// The degrees of the arms alone; below 0: there are none.
double arms_of(const PoseFit& fit) {
  double sum = 0, count = 0;
  for (const LimbFit& limb : fit.limbs) {
    if (limb.name.find("arm") == std::string::npos) continue;
    sum += limb.mean;
    count += 1;
  }
  return count > 0 ? sum / count : -1;
}

// How good a motion is, of what its frames alone say.
double confidence_in(const JointModels& models, const JointClip& joints) {
  const StandingBody source{models.source, models.source_mesh, models.source_known},
      target{models.target, models.target_mesh, models.target_known};
  PlayedClip played;
  played.source_frames = frames_of(models.source, models.source_mesh, joints.source);
  played.target_frames = frames_of(models.target, models.target_mesh, joints.target);
  ClipFaults faults = motion_faults(
      {models.source_mesh, models.target_mesh, beside_flesh(source), beside_flesh(target), joints.scale}, played);
  faults.hover = hover_of(source, target, joints.scale, played.source_frames, played.target_frames);
  faults.slide = slide_of(source, target, joints.scale, joints.times, played.source_frames, played.target_frames);
  return confidence_of(faults, played.target_frames.size());
}

// Legs point as those of the source. Where a body hovers so, its feet are also led on the scaled path, and the better
// motion is taken.
JointClip play_best(const JointModels& models, const Animation& clip, const std::vector<double>& times,
                    JointOptions options) {
  // In legs. Half of it is what a heel that lifts costs; double is seen from afar.
  constexpr double hovers = 0.08;
  JointClip joints = models.pair.play(clip, times, options);
  if (!models.pair.two_legged() || !options.ground || !(joints.hover > hovers)) return joints;
  options.foot_path = true;
  JointClip led = models.pair.play(clip, times, options);
  return confidence_in(models, led) > confidence_in(models, joints) ? led : joints;
}

// Says which meshes beside the skeleton stay behind, and how far the body leaves them.
void measure_left_behind(const JointModels& models, const std::vector<Fastening>& left_behind, PlayedClip& played,
                         RunReport& report) {
  for (const Fastening& fastening : left_behind) {
    const double off = comes_off(fastening, played.target_frames);
    if (!(off > 0)) continue;  // the clip of an equal skeleton moves it
    played.gap = std::max(played.gap, off);
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %% of the box", 100 * off);
    report.warnings.push_back("clip \"" + played.clip.name + "\": no clip of " + models.target.name +
                              " says on which joint \"" +
                              models.target.nodes[static_cast<size_t>(fastening.node)].name +
                              "\" rides, so it stays: it comes off by " + text);
  }
}

}  // namespace

void judge_pose(const JointModels& models, const Model& written, const std::vector<const Animation*>& clips,
                const std::vector<PlayedClip>& played, bool with_limbs, double scale, RunReport& report) {
  const StandingBody source{models.source, models.source_mesh, models.source_known},
      target{models.target, models.target_mesh, models.target_known};
  const std::vector<uint8_t> source_out = beside_body(source), target_out = beside_body(target),
                             source_flesh = beside_flesh(source), target_flesh = beside_flesh(target);
  const bool has_source = !models.source_mesh.triangles.empty(), ground = has_ground(models);
  for (size_t c = 0; c < played.size() && c < report.faults.size(); ++c) {
    ClipFaults& faults = report.faults[c];
    PoseFit fit;
    const bool known = with_limbs && models.pair.refusal().empty() && c < clips.size();
    if (known) {
      std::vector<Pose> from, to;
      for (const double time : played[c].clip.times) {
        from.push_back(sample(models.source, *clips[c], time));
        to.push_back(sample(written, written.animations[c], time));
      }
      fit = models.pair.fit(from, to);
      if (models.pair.two_legged())  // legs of animals, and legs whose feet were led, bend in a way of their own
        faults.limbs = c < report.foot_paths.size() && report.foot_paths[c] ? arms_of(fit) : fit.degrees;
      faults.trunk = fit.trunk_degrees;
    }
    // Limbs that nothing leads are as wrong when the surface carries the motion.
    if (models.pair.understood()) faults.unmatched = models.pair.fit({}, {}).unmatched;
    report.fits.push_back(fit);
    if (has_source && models.pair.understood()) {
      const double parts = acceleration_of(source, target, scale, played[c].source_frames, played[c].target_frames);
      if (parts > 0) faults.acceleration = parts;
    }
    if (ground) {
      faults.slide =
          slide_of(source, target, scale, played[c].clip.times, played[c].source_frames, played[c].target_frames);
      faults.hover = hover_of(source, target, scale, played[c].source_frames, played[c].target_frames);
    }
    if (models.pair.understood()) faults.uneven = models.pair.unevenness();
    const auto depth = [&](const std::vector<uint8_t>& source_part, const std::vector<uint8_t>& target_part) {
      return ground ? depth_of(source, target, scale, source_part, target_part, played[c].source_frames,
                               played[c].target_frames)
                    : Depths();
    };
    const Depths deepest = depth(source_out, target_out);
    report.depths.push_back(deepest.beyond);
    report.source_depths.push_back(deepest.source);
    const double flesh = depth(source_flesh, target_flesh).beyond;
    if (report.depths.back() > flesh) faults.held = report.depths.back();
    faults.confidence = confidence_of(faults, played[c].target_frames.size());
    if ((!known || fit.compared == 0 || !has_source) && faults.confidence > unseen_confidence) {
      faults.confidence = unseen_confidence;
      report.warnings.push_back("clip \"" + played[c].clip.name + "\": the confidence stops at 0.8, as " +
                                (has_source ? "no two skeletons say whether limbs follow"
                                            : "the source has no surface to compare feet with"));
    }
  }
}

RunReport run_by_joints(const JointModels& models, const std::vector<const Animation*>& clips,
                        const TransferCommand& command, ProgressBar& bar) {
  JointOptions options;
  options.in_place = command.in_place || command.root_motion;
  options.ground = command.ground && has_ground(models);
  for (const auto& [name, value] : command.dials)
    if (name == "stride") options.stride = value;
  if (!(options.stride > 0)) throw std::runtime_error("--dials stride is not above 0; joints cannot walk so");
  const double box = SurfaceBox(models.target_mesh).diagonal();
  RunReport report;
  report.way = "skeleton";
  std::vector<PlayedClip> played;
  std::vector<Animation> made;
  JointClip last;
  for (const Animation* clip : clips) {
    bar.begin("turning joints for \"" + clip->name + "\"");
    JointClip joints = play_best(models, *clip, times_of(*clip, command.rate), options);
    std::optional<Animation> copied;
    if (joints.same && command.rate == 0) copied = copied_channels(models, *clip, joints);
    if (joints.same && command.rate == 0 && !copied) joints = models.pair.play(*clip, key_times(*clip), options);
    made.push_back(copied ? *copied : clip_of_poses(models.target, clip->name, joints.times, joints.target));
    made.back().name = clip->name;
    PlayedClip out;
    out.clip.name = clip->name;
    out.clip.times = joints.times;
    out.source_frames = options.in_place ? frames_of(models.source, models.source_mesh, joints.source)
                                         : frames_of(models.source, models.source_mesh, *clip, joints.times);
    out.frame_ms = joints.frame_ms;
    out.travel = joints.travel;
    out.target_frames = frames_of(models.target, models.target_mesh, joints.target);
    played.push_back(std::move(out));
    report.same_skeleton = joints.same;
    report.foot_paths.push_back(joints.foot_path);
    if (joints.foot_path)
      report.warnings.push_back("clip \"" + clip->name +
                                "\": feet follow the scaled path of the source's, as legs that point alike would let "
                                "the body float");
    last = std::move(joints);
    bar.end(std::to_string(played.back().clip.times.size()) + " frames");
  }
  report.scale = last.scale;
  report.scale_from = last.scale_from;
  report.joints = last.joints;
  report.unmatched = last.unmatched;
  report.staying = last.staying;
  report.drop = last.drop / box;
  report.source = body_of(models.source_known, given(command.source_axes), models.source_stance);
  report.target = body_of(models.target_known, given(command.target_axes), models.target_stance);
  report.output = (command.kind == "frames" ? command.frames : command.output).string();
  for (const Model* model : {&models.source, &models.target})
    for (const std::string& warning : model->warnings) report.warnings.push_back(model->name + ": " + warning);

  bar.begin("writing " + report.output);
  const Model written = write_by_joints(models, made, played, command, box, report);
  const bool joints_written = report.written_as == "own-skin";
  const FlatMesh again = flatten(written);
  const StandingBody source{models.source, models.source_mesh, models.source_known},
      target{models.target, models.target_mesh, models.target_known};
  const std::vector<uint8_t> source_out = beside_flesh(source), target_out = beside_flesh(target);
  const std::vector<Fastening> left_behind = fastenings_of(target, models.pair.left_behind());
  for (size_t c = 0; c < played.size(); ++c) {
    if (report.written_as != "frames") {
      played[c].target_frames = frames_of(written, again, written.animations[c], played[c].clip.times);
    }
    measure_left_behind(models, left_behind, played[c], report);
    if (has_ground(models))
      played[c].feet.surface_sunk = depth_of(source, target, report.scale, source_out, target_out,
                                             played[c].source_frames, played[c].target_frames)
                                        .beyond;
    report.clip_names.push_back(clips[c]->name);
    report.frames.push_back(played[c].clip.times.size());
    report.frame_ms.push_back(played[c].frame_ms);
    report.faults.push_back(
        motion_faults({models.source_mesh, models.target_mesh, source_out, target_out, report.scale}, played[c]));
  }
  bar.end();
  judge_pose(models, written, clips, played, joints_written, report.scale, report);
  for (size_t c = 0; c < played.size(); ++c)
    for (const std::string& sentence : fault_sentences(report.faults[c], report.clip_names[c], report.frames[c]))
      report.warnings.push_back(sentence);
  if (!command.sheet.empty()) {
    bar.begin("drawing " + command.sheet.string());
    write_clip_sheet(command.sheet, {models.source, models.source_mesh, models.source_known.axes},
                     {models.target, models.target_mesh, models.target_known.axes}, played);
    bar.end();
  }
  return report;
}

}  // namespace samples
