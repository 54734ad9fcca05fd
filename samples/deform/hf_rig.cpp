// hf_rig MESH --handles H.json -o OUT.glb: a surface with handles becomes a skinned model that plays the same poses.
// See README.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "common/links.h"
#include "common/program.h"
#include "common/progress_bar.h"
#include "deform/posable.h"
#include "gltf/animate.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/json_file.h"
#include "gltf/skin_write.h"

namespace {

using namespace samples;
using namespace hf_gltf;

const char* usage =
    "usage: hf_rig MESH --handles H.json -o OUT.glb [options]\n"
    "Makes a skinned model of a surface (glTF, .obj, .off, .ply, .stl): the handles' clusters are its joints, the "
    "clips\n"
    "of H.json are its clips. Beside OUT.glb a JSON of handles, joints and weights is written for tools.\n"
    "  --handles FILE   handles and clips (format in samples/deform/README.md)\n"
    "  -o FILE          the result, .glb or .gltf\n"
    "  --json FILE      handles, joints and weights (default: OUT.json)\n"
    "  --weights N      joints per vertex, 4 or 8 (default 4)\n"
    "  --no-links       pieces of the surface stay apart; otherwise links join them\n"
    "  --threads N      threads the library may use (default 1)\n"
    "  --work-limit N   refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
    "  --memory-limit N refuse a surface that holds more than N MiB (default: by the size)\n"
    "  --quiet          no progress bar\n";

struct Command {
  std::filesystem::path mesh, handles, output, json;
  uint32_t weights = 4, threads = 1;
  bool links = true, quiet = false, help = false;
};

Command parse(Words words) {
  Command out;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      out.help = true;
    } else if (words.is("--handles")) {
      out.handles = words.file();
    } else if (words.is("-o", "--output")) {
      out.output = words.file();
    } else if (words.is("--json")) {
      out.json = words.file();
    } else if (words.is("--weights")) {
      out.weights = words.whole(4, 8);
      if (out.weights != 4 && out.weights != 8) throw std::runtime_error("--weights takes 4 or 8");
    } else if (words.is("--no-links")) {
      out.links = false;
    } else if (words.is("--threads")) {
      out.threads = words.whole(1, 256);
    } else if (words.is("--quiet")) {
      out.quiet = true;
    } else if (words.take_limit()) {
      continue;
    } else {
      words.take_mesh(out.mesh);
    }
  }
  if (out.help) return out;
  if (out.mesh.empty()) throw std::runtime_error("name a mesh; see --help");
  if (out.handles.empty()) throw std::runtime_error("--handles is needed; see --help");
  if (out.output.empty()) throw std::runtime_error("-o is needed: the file to write; see --help");
  if (out.json.empty()) out.json = std::filesystem::path(out.output).replace_extension(".json");
  return out;
}

// The joints' motions of the pose at present, appended to a clip.
void append_frame(const Posable& posable, uint32_t influence_count, const std::vector<double>& pivots, SkinClip& clip) {
  const size_t joints = pivots.size() / 3;
  std::vector<double> rotations(4 * joints), places(3 * joints), scales(3 * joints);
  hf_skin_info info = HF_INIT(hf_skin_info);
  info.influence_count = influence_count;
  info.joint_capacity = static_cast<uint32_t>(joints);
  info.rotations = rotations.data();
  info.translations = places.data();
  info.scales = scales.data();
  expect_ok(hf_pose_get_skin(posable.pose(), &info), "the skin");
  for (size_t j = 0; j < joints; ++j) {
    const double* q = &rotations[4 * j];
    const glm::dquat rotation(q[3], q[0], q[1], q[2]);
    const glm::dvec3 pivot(pivots[3 * j], pivots[3 * j + 1], pivots[3 * j + 2]),
        place(places[3 * j], places[3 * j + 1], places[3 * j + 2]);
    clip.rotations.push_back(rotation);
    clip.translations.push_back(place - rotation * pivot);
    clip.scales.push_back({scales[3 * j], scales[3 * j + 1], scales[3 * j + 2]});
  }
}

nlohmann::json describe(const Posable& posable, const SkinDescription& skin, uint32_t influence_count) {
  nlohmann::json out;
  for (const Posable::Live& live : posable.handles()) {
    hf_handle_info info = HF_INIT(hf_handle_info);
    expect_ok(hf_pose_get_handle(posable.pose(), live.number, &info), "handle \"" + live.name + "\"");
    out["handles"].push_back({{"name", live.name},
                              {"joint", out["handles"].size()},
                              {"centroid", info.centroid},
                              {"vertex_count", info.vertex_count},
                              {"site_count", info.site_count},
                              {"vertices", posable.region_of(live)}});
  }
  for (const SkinJoint& joint : skin.joints)
    out["joints"].push_back({{"name", joint.name}, {"pivot", {joint.pivot.x, joint.pivot.y, joint.pivot.z}}});
  out["weights_per_vertex"] = influence_count;
  out["vertex_joints"] = skin.vertex_joints;
  out["vertex_weights"] = skin.vertex_weights;
  for (const SkinClip& clip : skin.clips)
    out["clips"].push_back({{"name", clip.name}, {"frames", clip.times.size()}, {"seconds", clip.times.back()}});
  return out;
}

void run(const Command& command) {
  ProgressBar bar(command.quiet);
  const RigFile rig = read_rig(command.handles);
  bar.begin("reading " + command.mesh.string());
  const PosableMesh mesh = read_posable(command.mesh);
  bar.begin("factorising");
  Posable::Options options;
  options.bands = rig.bands;
  options.threads = command.threads;
  options.links = command.links;
  options.model = mesh.model.skins.empty() ? nullptr : &mesh.model;
  Posable posable(mesh.flat, options);
  bar.begin("handles");
  posable.add(rig.handles);
  bar.end(std::to_string(rig.handles.size()) + " handles");
  if (const std::string sentence = links_sentence(posable.surface()); !sentence.empty())
    std::printf("%s\n", sentence.c_str());
  for (const std::string& remark : posable.remarks()) std::printf("note: %s\n", remark.c_str());

  hf_skin_info info = HF_INIT(hf_skin_info);
  expect_ok(hf_pose_get_skin(posable.pose(), &info), "the skin");
  const size_t joints = info.joint_count;
  SkinDescription skin;
  skin.influences_per_vertex = command.weights;
  skin.vertex_joints.resize(mesh.flat.positions.size() * command.weights);
  skin.vertex_weights.resize(skin.vertex_joints.size());
  std::vector<double> pivots(3 * joints), axes(4 * joints);
  info.joint_capacity = info.joint_count;
  info.vertex_capacity = info.vertex_count;
  info.influence_count = command.weights;
  info.pivots = pivots.data();
  info.axes = axes.data();
  info.vertex_joints = skin.vertex_joints.data();
  info.vertex_weights = skin.vertex_weights.data();
  expect_ok(hf_pose_get_skin(posable.pose(), &info), "the skin");
  for (size_t j = 0; j < joints; ++j) {
    const std::string name = j < posable.handles().size() ? posable.handles()[j].name : "cluster_" + std::to_string(j);
    skin.joints.push_back({name,
                           {pivots[3 * j], pivots[3 * j + 1], pivots[3 * j + 2]},
                           {axes[4 * j + 3], axes[4 * j], axes[4 * j + 1], axes[4 * j + 2]}});
  }

  std::vector<std::vector<std::vector<double>>> posed;  // by clip and frame
  std::vector<float> normals;
  for (const ClipEntry& entry : rig.clips) {
    bar.begin("clip \"" + entry.name + "\"");
    Posable::Options playing = options;
    playing.on = &posable;
    Posable player(mesh.flat, playing);
    player.add(rig.handles);
    SkinClip clip;
    clip.name = entry.name;
    posed.emplace_back();
    const auto frame = [&](double time) {
      posed.back().emplace_back();
      player.deform(Refine::none, posed.back().back(), normals, 12);
      clip.times.push_back(time);
      append_frame(player, command.weights, pivots, clip);
    };
    frame(0);
    double time = 0;
    for (const Step& step : entry.steps) {
      player.play(step, rig.frame_rate, [&](int f, int count) {
        frame(time + std::max(step.seconds, 1e-3) * f / count);
        bar.update(static_cast<double>(f) / count);
      });
      time += std::max(step.seconds, 1e-3);
    }
    skin.clips.push_back(clip);
    bar.end(std::to_string(clip.times.size()) + " frames");
  }
  bar.begin("writing " + command.output.string());
  write_gltf(skin_model(mesh.model, mesh.flat, skin), command.output);
  write_json(command.json, describe(posable, skin, command.weights));
  bar.end();

  // the file, read again and played, beside what hf_pose_deform gave
  const Model written = read_gltf(command.output);
  const FlatMesh flat = flatten(written);
  std::printf("%s: %u vertices, %zu handles, %zu joints, %u weights per vertex\n", command.output.string().c_str(),
              flat.vertex_count(), posable.handles().size(), joints, command.weights);
  for (size_t c = 0; c < posed.size(); ++c) {
    double worst = 0, squares = 0, count = 0;
    for (size_t f = 0; f < posed[c].size(); ++f) {
      const std::vector<glm::dvec3> played =
          posed_positions(written, flat, written.animations[c], skin.clips[c].times[f]);
      for (size_t v = 0; v < played.size(); ++v) {
        const double off =
            glm::length(played[v] - glm::dvec3(posed[c][f][3 * v], posed[c][f][3 * v + 1], posed[c][f][3 * v + 2]));
        worst = std::max(worst, off);
        squares += off * off;
        count += 1;
      }
    }
    std::printf(
        "  clip \"%s\", %zu frames: played by the skin, vertices are off by %.2f %% of the box at most, %.2f %% in the "
        "mean\n",
        skin.clips[c].name.c_str(), posed[c].size(), 100 * worst / posable.diagonal(),
        100 * std::sqrt(squares / count) / posable.diagonal());
    WidestGap widest(posable.surface());
    for (size_t f = 0; f < posed[c].size(); ++f) {
      char place[32];
      std::snprintf(place, sizeof place, "at %.2f s", skin.clips[c].times[f]);
      widest.take(posed[c][f], place);
    }
    if (const std::string sentence = widest.sentence(posable.diagonal()); !sentence.empty())
      std::printf("  %s\n", sentence.c_str());
  }
}

}  // namespace

int main(int count, char** arguments) { return run_program("hf_rig", usage, count, arguments, parse, run); }
