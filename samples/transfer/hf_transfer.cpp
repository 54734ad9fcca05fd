// hf_transfer SOURCE.glb TARGET.glb --pairs PAIRS.json -o OUT.glb: the motion of one model played on another. See
// README.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/links.h"
#include "common/mesh_file.h"
#include "common/program.h"
#include "gltf/animate.h"
#include "gltf/clip_binding.h"
#include "gltf/file_bytes.h"
#include "gltf/file_kind.h"
#include "gltf/file_write.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/suggest_pairs.h"
#include "transfer/batch.h"
#include "transfer/clip_sheet.h"
#include "transfer/outputs.h"
#include "transfer/session.h"
#include "transfer/shapes.h"
#include "transfer/skeleton_run.h"
#include "transfer/transfer_inputs.h"
#include "transfer/transfer_options.h"
#include "transfer/transfer_report.h"

namespace {

using namespace samples;
using namespace hf_gltf;

#ifdef _WIN32
constexpr const char* null_device = "NUL";
#else
constexpr const char* null_device = "/dev/null";
#endif

// Contacts of one run. Each clip has its own: a nose that grazes in one clip is free in the others.
struct Contacts {
  std::vector<std::string> lines;
  std::set<std::string> names;

  void set(Session& session, const TransferCommand& command, const std::string& clip,
           const std::vector<std::vector<double>>& poses) {
    for (const std::string& line : session.set_contacts(command.contacts, poses))
      lines.push_back(clip.empty() || !command.contacts.empty() ? line : "clip \"" + clip + "\": " + line);
    for (const PairReport& pair : session.pairs())
      if (pair.contact) names.insert(pair.name);
  }
};

// Returns what the written file plays; of frames and files without it, the computed clips.
std::vector<PlayedClip> write_output(Session& session, const Model& target, const TransferCommand& command,
                                     const std::filesystem::path& output, const std::vector<PlayedClip>& clips,
                                     RunReport& report) {
  OutputFigures figures;
  const double box = session.target_mesh().bounding_box_diagonal;
  report.written_as = command.kind.empty() ? (has_skin(target) ? "own-skin" : "skin") : command.kind;
  std::vector<PlayedClip> written;
  if (report.written_as == "frames") {
    const FileKind kind = kind_of_file(command.target);
    const bool mesh = !is_model(kind);
    const SurfaceMesh rest = mesh ? read_mesh_file(command.target) : to_surface_mesh(session.target_flat());
    write_frames(output, mesh && kind != FileKind::stl ? command.target.extension().string() : ".ply", rest, clips);
    written = clips;
  } else {
    if (command.root_motion && report.written_as != "own-skin")
      throw std::runtime_error("--root-motion needs the target's own skin (--as own-skin): others have no root");
    Model own;
    if (report.written_as == "own-skin") {
      own = own_skin_model(target, session, clips, box, command.key_tolerance, figures);
      write_gltf(own, output);
    } else if (report.written_as == "morph") {
      write_gltf(morph_model(target, session.target_flat(), clips, box, command.morph_tolerance, 64, figures), output);
    } else {
      SkinDescription skin = session.skin();
      for (const PlayedClip& clip : clips) skin.clips.push_back(clip.clip);
      Model model = skin_model(target, session.target_flat(), skin);
      keep_carried(target, model);
      keep_shapes(target, session.target_flat(), model);
      reduce_clips(model, flatten(model), clips.size(), command.key_tolerance * box, figures);
      write_gltf(model, output);
      report.replay = measure_replay(read_gltf(output), clips, box);
    }
    written = written_clips(read_gltf(output), session, clips);
    if (command.root_motion) {  // the figures are those of the body in its place
      add_root_motion(own, root_of_skin(own), clips);
      write_gltf(own, output);
    }
  }
  for (const PlayedClip& clip : written) {
    report.written_feet.push_back(clip.feet);
    report.gaps.push_back(clip.gap);
    report.faults.push_back(find_faults(session, clip));
  }
  if (report.written_as == "skin" || report.written_as == "morph") {
    const char* const advice = has_skin(target) ? "; --as own-skin keeps them" : "";
    if (!target.animations.empty())
      report.warnings.push_back(
          "clips of the target that the file does not get, as it lacks the nodes that they move: " +
          std::to_string(target.animations.size()) + advice);
    size_t shapes = 0;
    for (const MeshData& mesh : target.meshes)
      if (!mesh.primitives.empty()) shapes += mesh.primitives.front().targets.size();
    if (report.written_as == "morph" && shapes > 0)
      report.warnings.push_back(
          "morph targets of the target that the clips' morph targets replace: " + std::to_string(shapes) + advice);
  }
  report.written_rms = figures.rms;
  report.written_max = figures.max;
  report.written_parts = figures.parts;
  report.keys = figures.keys;
  report.all_keys = figures.all_keys;
  return written;
}

// Plays the clips, writes file and sheet, reads the file again.
RunReport run(Session& session, const JointModels& models, const Model& source, const Model& target,
              const Motion& motion, const TransferCommand& command, bool edited, ProgressBar& bar) {
  const auto name = [&](const std::filesystem::path& file) { return edited ? edited_name(file) : file; };
  Contacts contacts;
  std::vector<PlayedClip> clips;
  session.set_in_place(command.in_place || command.root_motion);
  for (const Animation* animation : motion.clips) {
    const double rate = command.rate != 0 ? command.rate : clip_duration(*animation) < 1 ? 60 : 30;
    if (command.contacts.empty() || animation == motion.clips.front())
      contacts.set(session, command, animation->name, some_poses(source, session.source_flat(), *animation));
    clips.push_back(session.play(*animation, rate, bar));
  }
  if (!motion.poses.empty()) {
    std::vector<double> times;
    for (size_t f = 0; f < motion.poses.size(); ++f)
      times.push_back(static_cast<double>(f) / (command.rate > 0 ? command.rate : 30));
    contacts.set(session, command, "", motion.poses);
    clips.push_back(session.play("", times, motion.poses, bar));
  }
  const std::filesystem::path output = name(command.kind == "frames" ? command.frames : command.output);
  bar.begin("writing " + output.string());
  RunReport report = make_report(session, clips, output.string());
  report.contacts = contacts.lines;
  for (PairReport& pair : report.pairs) pair.contact = contacts.names.count(pair.name) > 0;
  const std::vector<PlayedClip> written = write_output(session, target, command, output, clips, report);
  const bool joints = report.written_as == "own-skin";
  judge_pose(models, joints ? read_gltf(output) : target, motion.clips, written, joints, session.scale(), report);
  for (size_t c = 0; c < written.size(); ++c)
    for (const std::string& sentence :
         fault_sentences(report.faults[c], written[c].clip.name, written[c].target_frames.size()))
      report.warnings.push_back(sentence);
  bar.end();
  if (!command.sheet.empty()) {
    const std::filesystem::path sheet = name(command.sheet);
    bar.begin("drawing " + sheet.string());
    write_clip_sheet(sheet, {source, session.source_flat(), session.source_axes()},
                     {target, session.target_flat(), session.target_axes()}, written);
    bar.end();
  }
  return report;
}

Suggestion propose(const Model& source, const Model& target, const TransferCommand& command) {
  const FlatMesh source_mesh = flatten(source), target_mesh = flatten(target);
  const auto axes = [](const std::optional<Axes>& given) { return given ? &*given : nullptr; };
  // a model on itself has its tips found once
  const bool same = source_mesh.positions == target_mesh.positions && source_mesh.triangles == target_mesh.triangles;
  const std::vector<uint32_t> source_tips = tips_of(source_mesh, source.name);
  const Suggestion suggestion = suggest_pairs(
      {source, source_mesh, source_tips, axes(command.source_axes)},
      {target, target_mesh, same ? source_tips : tips_of(target_mesh, target.name), axes(command.target_axes)});
  std::printf("proposed pairs            confidence  on the source; on the target\n");
  for (const SuggestedPair& pair : suggestion.pairs) {
    std::printf("  %-22s %11.2f  %s; %s\n", pair.name.c_str(), pair.confidence, pair.source_found.c_str(),
                pair.target_found.c_str());
  }
  for (const std::string& note : suggestion.notes) std::printf("  note: %s\n", note.c_str());
  return suggestion;
}

// Clips without a surface go to the target's skeleton as they are: no surface is read, and nothing is computed.
nlohmann::json put_clips(const Model& clips, const Model& target, const TransferCommand& command) {
  if (!command.sheet.empty() || !command.suggest.empty() || !command.edits.empty() ||
      (!command.kind.empty() && command.kind != "own-skin"))
    throw std::runtime_error(clips.name +
                             " has no surface: its clips go to TARGET's own skeleton; --sheet, --edit, --suggest-pairs "
                             "and other kinds of --as need a surface");
  BoundClips bound = bind_clips(target, clips, command.clip);
  add_riders(target, bound.model, bound.clips);
  write_gltf(bound.model, command.output);
  nlohmann::json names = nlohmann::json::array();
  for (size_t c = 0; c < bound.clips; ++c) names.push_back(bound.model.animations[c].name);
  char text[256];
  std::snprintf(text, sizeof text, "%zu clips of a skeleton on %s: %zu of %zu joints, lengths times %.4g\n",
                bound.clips, target.name.c_str(), bound.joints, bound.animated, bound.scale);
  std::string all = text;
  if (bound.shared > 0)
    all += "  note: " + std::to_string(bound.shared) +
           " joints share a name with another; they were found by their parents and places\n";
  for (const std::string& name : bound.missing) all += "  note: the model has no joint \"" + name + "\"\n";
  std::fputs(all.c_str(), stdout);
  if (!command.report.empty()) write_bytes(command.report, all);
  return {{"output", command.output.string()},
          {"written_as", "own-skin"},
          {"clips", names},
          {"joints", bound.joints},
          {"animated", bound.animated},
          {"missing", bound.missing},
          {"shared_names", bound.shared},
          {"scale", bound.scale}};
}

void write_reports(const TransferCommand& command, const std::string& text, const nlohmann::json& json) {
  std::fputs(text.c_str(), stdout);
  if (!command.report.empty()) write_bytes(command.report, text);
  if (!command.json.empty()) write_json(command.json, json);
}

// Morph targets in, morph targets out.
int transfer_shapes(const TransferCommand& command, const Model& source, const Model& target, PairsFile pairs,
                    ProgressBar& bar, nlohmann::json& json) {
  pairs.settings.stretch = true;
  pairs.settings.paper = false;
  std::vector<const Animation*> clips;
  if (!command.clip.empty()) clips = choose_clips(source, command.clip);
  Session session(source, target, pairs, command.threads, command.links, bar, false);
  const CarriedShapes carried = carry_shapes(session, source, target, clips, bar);
  write_gltf(carried.model, command.output);
  if (!command.sheet.empty()) {
    std::vector<std::string> names;
    for (const ShapeReport& shape : carried.shapes) names.push_back(shape.name);
    write_shape_sheet(command.sheet, session, source, target, carried.frames, names);
  }
  json = shapes_json(session, carried, command.output.string());
  write_reports(
      command,
      shapes_text(session, carried, command.output.string(), "shapes of " + source.name + " on " + target.name), json);
  return 0;
}

// Joints lead.
int transfer_joints(const JointModels& models, const std::string& why, const TransferCommand& command, ProgressBar& bar,
                    nlohmann::json& json) {
  RunReport report = run_by_joints(models, choose_clips(models.source, command.clip), command, bar);
  report.way_why = why;
  json = to_json(report);
  write_reports(command, to_text(report, models.source.name + " on " + models.target.name), json);
  return 0;
}

double least_confidence(const RunReport& report) {
  double out = 1;
  for (const ClipFaults& faults : report.faults) out = std::min(out, faults.confidence);
  return out;
}

// A folder for files of a trial. It goes with the object.
struct TrialFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("hf_transfer_" + std::to_string(std::random_device()()));
  TrialFolder() {
    if (!std::filesystem::create_directory(path)) throw std::runtime_error(path.string() + " is there already");
  }
  ~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
};

struct Trial {
  RunReport report;
  std::vector<std::pair<std::filesystem::path, std::vector<uint8_t>>> files;  // what the user's files would hold
};

Trial run_trial(const JointModels& models, const TransferCommand& command, ProgressBar& bar) {
  const TrialFolder folder;
  TransferCommand trial = command;
  if (!command.output.empty()) trial.output = folder.path / command.output.filename();
  if (!command.sheet.empty()) trial.sheet = folder.path / command.sheet.filename();
  Trial out{run_by_joints(models, choose_clips(models.source, command.clip), trial, bar), {}};
  for (const auto& [from, to] : {std::pair(trial.output, command.output), {trial.sheet, command.sheet}})
    if (!to.empty()) out.files.emplace_back(to, read_bytes(from, std::numeric_limits<uint64_t>::max()));
  return out;
}

// Where the surface leaves doubt and joints could lead too, both are written, and the better file is kept. A trial that
// fails leaves the motion of the surface. True: joints were better.
bool try_joints(const JointModels& models, RunReport& by_surface, const TransferCommand& command, ProgressBar& bar,
                nlohmann::json& json) {
  constexpr double sure = 0.8;  // an artist uses such a run as it is; a higher bound costs a second run for nothing
  const double doubted = least_confidence(by_surface);
  if (doubted >= sure || (!command.kind.empty() && command.kind != "own-skin")) return false;
  Trial trial;
  try {
    trial = run_trial(models, command, bar);
  } catch (const std::exception& error) {
    bar.end();
    by_surface.warnings.push_back(std::string("joints were tried too, and failed: ") + error.what());
    return false;
  }
  RunReport& report = trial.report;
  if (!(least_confidence(report) > doubted)) return false;
  for (const auto& [to, bytes] : trial.files) write_bytes(to, bytes.data(), bytes.size());
  char why[128];
  std::snprintf(why, sizeof why, "the surfaces reach %.2f of confidence here; --way surface takes them", doubted);
  report.output = command.output.string();
  report.way_why = why;
  json = to_json(report);
  write_reports(command, to_text(report, models.source.name + " on " + models.target.name), json);
  return true;
}

int transfer(TransferCommand command, nlohmann::json& json) {
  ProgressBar bar(command.quiet);
  PairsFile pairs;
  if (!command.pairs.empty()) pairs = read_pairs(command.pairs, !command.shapes && command.edits.empty());
  const EditsFile edits = command.edits.empty() ? EditsFile() : read_edits(command.edits);
  bar.begin("reading models");
  Model own_source = read_model(command.source), own_target = read_model(command.target);
  say_chains(pairs.chains, own_source, own_target);
  if (pairs.pairs.empty()) command.pairs.clear();  // chains name no places of the surfaces
  const std::optional<Pose> source_rest = pose_of(own_source, command.source_rest, "--source-rest"),
                            target_rest = pose_of(own_target, command.target_rest, "--target-rest");
  bar.end();
  if (!has_surface(own_target)) throw std::runtime_error(own_target.name + " has no surface: TARGET needs one");
  if (!has_surface(own_source) && command.clips.empty()) {
    try {
      json = put_clips(rested(own_source, source_rest), rested(own_target, target_rest), command);
    } catch (const std::runtime_error&) {  // another skeleton
      const JointModels models(own_source, own_target, command, source_rest, target_rest);
      if (!models.pair.refusal().empty() || !choose_way(command, models).joints) throw;
      return transfer_joints(models, "SOURCE has no surface, and " + models.pair.limbs_text() + " have partners",
                             command, bar, json);
    }
    if (!command.json.empty()) write_json(command.json, json);
    return 0;
  }
  if (!command.clips.empty()) {
    BoundClips bound = bind_clips(own_source, read_gltf(command.clips), command.clip);
    bound.model.animations.resize(bound.clips);
    own_source = std::move(bound.model);
    command.clip = "all";
  }
  const Model source = rested(own_source, source_rest), target = rested(own_target, target_rest);
  if (!command.suggest.empty()) {
    write_json(command.suggest, propose(source, target, command).file);
    return 0;
  }
  if (command.shapes) return transfer_shapes(command, source, target, pairs, bar, json);
  if (pairs.settings.stretch && (command.kind == "skin" || (command.kind.empty() && !has_skin(target))))
    throw std::runtime_error("mode \"stretch\" gives no skin: take --as own-skin, --as morph or --out-poses");
  const Motion motion = read_motion(source, command);  // a model without a clip is refused before surfaces are made
  bar.begin("looking at the skeletons");
  const JointModels models(own_source, own_target, command, source_rest, target_rest);
  bar.end();
  const ChosenWay way = choose_way(command, models);
  if (way.joints) return transfer_joints(models, way.why, command, bar, json);
  std::string source_axes, target_axes;  // how they were found
  if (command.pairs.empty()) {
    const Suggestion suggestion = propose(source, target, command);
    pairs = parse_pairs(suggestion.file, "the proposed pairs");
    source_axes = axes_sentence(suggestion.source);
    target_axes = axes_sentence(suggestion.target);
  }

  for (const auto& [key, value] : command.dials) set_dial(pairs.dials, key, value);
  for (PairEntry& pair : pairs.pairs)
    pair.sinks =
        pair.sinks || std::find(command.sinking.begin(), command.sinking.end(), pair.name) != command.sinking.end();
  Session session(source, target, pairs, command.threads, command.links, bar, command.ground, command.rigid);
  session.set_proposed(command.pairs.empty());
  for (const auto& [model, surface] :
       {std::pair<const Model*, hf_surface>{&source, session.source_surface()}, {&target, session.target_surface()}}) {
    if (const std::string sentence = links_sentence(surface); !sentence.empty())
      std::printf("%s: %s\n", model->name.c_str(), sentence.c_str());
  }
  if (session.rigid_count() > 0) std::printf("%zu rigid pieces\n", session.rigid_count());
  const auto with_axes = [&](RunReport report) {
    if (!source_axes.empty()) report.source.said = source_axes;
    if (!target_axes.empty()) report.target.said = target_axes;
    report.way_why = way.why;
    return report;
  };
  RunReport first = with_axes(run(session, models, source, target, motion, command, false, bar));
  if (way.either && try_joints(models, first, command, bar, json)) return 0;
  std::string text = to_text(first, source.name + " on " + target.name);
  json = to_json(first);
  bool factorised_again = false;
  if (!command.edits.empty()) {
    const uint32_t before_source = session.statistics().source_factorisation_count,
                   before_target = session.statistics().target_factorisation_count;
    bar.begin("editing pairs");
    session.edit(edits);
    bar.end(std::to_string(edits.remove.size()) + " out, " + std::to_string(edits.add.size()) + " in");
    const RunReport second = with_axes(run(session, models, source, target, motion, command, true, bar));
    char heading[256];
    std::snprintf(heading, sizeof heading,
                  "edited in the session: %zu pairs out, %zu in, %.2f ms and %.2f ms for fields and clusters; "
                  "factorisations source %u -> %u, target %u -> %u",
                  edits.remove.size(), edits.add.size(), second.edit_ms, second.prepare_ms, before_source,
                  second.source_factorisations, before_target, second.target_factorisations);
    text += to_text(second, heading);
    json["edited"] = to_json(second);
    factorised_again = before_source != second.source_factorisations || before_target != second.target_factorisations;
  }
  write_reports(command, text, json);
  if (factorised_again) {
    std::fprintf(stderr, "hf_transfer: the edit factorised a surface again; that is a fault of the library\n");
    return 1;
  }
  return 0;
}

// A command line that is refused says so where its outcome is asked for.
void write_outcome(samples::CommandLine& line, const std::exception& error) {
  for (int i = 1; i + 1 < line.count(); ++i)
    if (std::string(line.words()[i]) == "--outcome")
      write_json(file_named(line.words()[i + 1]), {{"error", error.what()}});
}

// The program as its user calls it: words in, exit code out.
int run_command(const TransferCommand& command, const char* program) {
  if (command.silent && !std::freopen(null_device, "w", stdout)) return 1;
  if (command.help) {
    std::fputs(usage(), stdout);
    return 0;
  }
  if (!command.joints.empty()) {
    list_joints(command.joints);
    return 0;
  }
  if (!command.batch.empty()) return run_batch(program, read_batch(command.batch), command.jobs);
  nlohmann::json report;
  try {
    const int code = transfer(command, report);
    if (!command.outcome.empty()) write_json(command.outcome, {{"report", report}});
    return code;
  } catch (const std::exception& error) {
    if (!command.outcome.empty()) write_json(command.outcome, {{"error", with_limit_option(error.what())}});
    if (!command.silent) throw;
    return 1;
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    samples::CommandLine line(count, arguments);
    TransferCommand command;
    try {
      command = parse_command(line.count(), line.words());
    } catch (const std::exception& error) {
      write_outcome(line, error);
      throw;
    }
    return run_command(command, line.words()[0]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_transfer: %s\n", samples::with_limit_option(error.what()).c_str());
    return 1;
  }
}
