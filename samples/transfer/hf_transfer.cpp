// hf_transfer SOURCE.glb TARGET.glb --pairs PAIRS.json -o OUT.glb: the motion of one model played on another. See
// README.md.
#include <cstdio>
#include <exception>

#include "common/animate.h"
#include "common/file_bytes.h"
#include "common/gltf_read.h"
#include "common/gltf_write.h"
#include "transfer/clip_sheet.h"
#include "transfer/session.h"
#include "transfer/transfer_options.h"
#include "transfer/transfer_report.h"

namespace {

using namespace samples;

void list_joints(const std::filesystem::path& file) {
  const Model model = read_gltf(file);
  const FlatMesh mesh = flatten(model);
  const RegionFinder finder(model, mesh, {});
  std::printf("%s: %u vertices, box diagonal %.4f\n", file.string().c_str(), mesh.vertex_count(), finder.diagonal());
  for (const std::string& line : finder.describe_joints()) std::printf("  %s\n", line.c_str());
  for (const Animation& clip : model.animations)
    std::printf("  clip \"%s\", %.2f s\n", clip.name.c_str(), clip_duration(clip));
}

// Plays the clips, writes file and sheet, reads the file again.
RunReport run(Session& session, const Model& source, const Model& target, const TransferCommand& command, bool edited,
              ProgressBar& bar) {
  const auto name = [&](const std::filesystem::path& file) { return edited ? edited_name(file) : file; };
  std::vector<PlayedClip> clips;
  for (const Animation* animation : choose_clips(source, command.clip)) {
    const double rate = command.rate > 0 ? command.rate : clip_duration(*animation) < 1 ? 60 : 30;
    clips.push_back(session.play(*animation, rate, bar));
  }
  SkinDescription skin = session.skin();
  for (const PlayedClip& clip : clips) skin.clips.push_back(clip.clip);
  const std::filesystem::path output = name(command.output);
  bar.begin("writing " + output.string());
  write_gltf(skin_model(target, session.target_flat(), skin), output);
  RunReport report = make_report(session, clips, output.string());
  report.replay = measure_replay(read_gltf(output), clips, session.target_mesh().bounding_box_diagonal);
  bar.end();
  if (!command.sheet.empty()) {
    const std::filesystem::path sheet = name(command.sheet);
    bar.begin("drawing " + sheet.string());
    write_clip_sheet(sheet, session, source, target, clips);
    bar.end();
  }
  return report;
}

int transfer(const TransferCommand& command) {
  ProgressBar bar(command.quiet);
  const PairsFile pairs = read_pairs(command.pairs);
  const EditsFile edits = command.edits.empty() ? EditsFile() : read_edits(command.edits);
  bar.begin("reading models");
  const Model source = read_gltf(command.source), target = read_gltf(command.target);
  bar.end();
  choose_clips(source, command.clip);  // a wrong name should not cost a factorisation

  Session session(source, target, pairs, command.threads, bar);
  const RunReport first = run(session, source, target, command, false, bar);
  std::string text = to_text(first, source.name + " on " + target.name);
  nlohmann::json json = to_json(first);
  bool factorised_again = false;
  if (!command.edits.empty()) {
    const uint32_t before_source = session.source_statistics().factorisation_count,
                   before_target = session.target_statistics().factorisation_count;
    bar.begin("editing pairs");
    session.edit(edits);
    bar.end(std::to_string(edits.remove.size()) + " out, " + std::to_string(edits.add.size()) + " in");
    const RunReport second = run(session, source, target, command, true, bar);
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
  std::fputs(text.c_str(), stdout);
  if (!command.report.empty()) write_bytes(command.report, text);
  if (!command.json.empty()) write_json(command.json, json);
  if (factorised_again) {
    std::fprintf(stderr, "hf_transfer: the edit factorised a surface again; that is a fault of the library\n");
    return 1;
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const TransferCommand command = parse_command(count, arguments);
    if (command.help) {
      std::fputs(usage(), stdout);
      return 0;
    }
    if (!command.joints.empty()) {
      list_joints(command.joints);
      return 0;
    }
    return transfer(command);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_transfer: %s\n", error.what());
    return 1;
  }
}
