// hf_deform_script MESH --script POSE.json -o OUT.glb --sheet S.png: handles come, go and are dragged by a script. See
// README.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <stdexcept>

#include "common/links.h"
#include "common/program.h"
#include "common/progress_bar.h"
#include "deform/pose_sheet.h"
#include "deform/propose_script.h"
#include "gltf/gltf_write.h"

namespace {

using namespace samples;
using namespace hf_gltf;

const char* usage =
    "usage: hf_deform_script MESH --script POSE.json | --propose [-o OUT.glb] [--sheet S.png] [--frames-obj DIR] "
    "[options]\n"
    "Plays a script of handle insertions, removals and drags on a surface (glTF, .obj, .off, .ply, .stl).\n"
    "  --script FILE      the script (format in samples/deform/README.md)\n"
    "  --propose          lists the handles the library proposes and adds what holds, feet for example; without a "
    "script\n"
    "                     it raises arms and the longest tips, and tilts heads\n"
    "  --up AXIS          away from the ground: x, y, z, -x, -y or -z (default y, as in glTF)\n"
    "  -o FILE            the animation as .glb or .gltf: one shape key per key frame, exact at the keys\n"
    "  --keys N           key frames per second in OUT.glb (default 8)\n"
    "  --sheet FILE       a contact sheet, .png\n"
    "  --tiles N          frames on the sheet, 2 to 23 (default 7)\n"
    "  --frames-obj DIR   every key frame as DIR/frame_0000.obj ..., in the vertex order of MESH\n"
    "  --mode MODE        smooth, or paper in builds with HF_WITH_PEERS; instead of the script's\n"
    "  --given-rotations  a drag without a turn keeps the rotation of its handle; otherwise the rotation is free\n"
    "  --following S      how much follows a drag: 0 the limb alone, 1 all of the surface (default 0.25 for\n"
    "                     proposed tips, 1 for handles of the script)\n"
    "  --limb-steps N     keeps lengths on the limb of a dragged handle: N full-mesh steps there, 0 to 64 (default 0)\n"
    "  --rigid            pieces alone on a joint of the skin stay rigid, a sword for example\n"
    "  --no-links         pieces of the surface stay apart; otherwise links join them\n"
    "  --refine           one full-mesh step on every frame\n"
    "  --lengths          keeps lengths: the full-mesh steps go on from frame to frame\n"
    "  --threads N        threads the library may use (default 1)\n"
    "  --work-limit N     refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
    "  --memory-limit N   refuse a surface that holds more than N MiB (default: by the size)\n"
    "  --quiet            no progress bar\n";

struct Command {
  std::filesystem::path mesh, script, output, sheet, frames;
  std::string mode;
  double keys = 8;
  std::optional<double> following;
  uint32_t tiles = 7, threads = 1, limb_steps = 0;
  glm::dvec3 up{0, 1, 0};
  bool rigid = false, propose = false, refine = false, lengths = false, links = true, given_rotations = false,
       quiet = false, help = false;
};

glm::dvec3 axis_of(const std::string& word) {
  const size_t sign = word.size() == 2 && word[0] == '-' ? 1 : 0;
  const char letter = word.size() == sign + 1 ? word[sign] : ' ';
  if (letter < 'x' || letter > 'z') throw std::runtime_error("--up takes x, y, z, -x, -y or -z");
  glm::dvec3 out(0);
  out[letter - 'x'] = sign == 1 ? -1 : 1;
  return out;
}

Command parse(Words words) {
  Command out;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      out.help = true;
    } else if (words.is("--script")) {
      out.script = words.file();
    } else if (words.is("-o", "--output")) {
      out.output = words.file();
    } else if (words.is("--sheet")) {
      out.sheet = words.file();
    } else if (words.is("--frames-obj")) {
      out.frames = words.file();
    } else if (words.is("--keys")) {
      out.keys = words.number(0.5, 60);
    } else if (words.is("--tiles")) {
      out.tiles = words.whole(2, 23);
    } else if (words.is("--threads")) {
      out.threads = words.whole(1, 256);
    } else if (words.is("--mode")) {
      out.mode = words.value();
      if (out.mode != "smooth" && out.mode != "paper") throw std::runtime_error("--mode takes smooth or paper");
    } else if (words.is("--propose")) {
      out.propose = true;
    } else if (words.is("--up")) {
      out.up = axis_of(words.value());
    } else if (words.is("--refine")) {
      out.refine = true;
    } else if (words.is("--lengths")) {
      out.lengths = true;
    } else if (words.is("--given-rotations")) {
      out.given_rotations = true;
    } else if (words.is("--following")) {
      out.following = words.number(0, 1);
    } else if (words.is("--limb-steps")) {
      out.limb_steps = words.whole(0, 64);
    } else if (words.is("--rigid")) {
      out.rigid = true;
    } else if (words.is("--no-links")) {
      out.links = false;
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
  if (out.script.empty() && !out.propose) throw std::runtime_error("--script or --propose is needed; see --help");
  if (!out.propose && out.output.empty() && out.sheet.empty() && out.frames.empty())
    throw std::runtime_error("nothing to write: give -o, --sheet or --frames-obj; see --help");
  return out;
}

struct Key {
  double time = 0;
  SheetFrame frame;
  std::vector<float> normals;
};

SheetFrame sheet_frame(const Posable& posable, const std::vector<double>& positions, const std::string& label) {
  SheetFrame out;
  out.positions = positions;
  out.label = label;
  out.layer.assign(positions.size() / 3, 0);
  for (const Posable::Live& live : posable.handles()) {
    const auto colour = static_cast<uint8_t>(1 + live.entry.layer + (live.entry.offered ? 1 : 0));
    for (const uint32_t v : posable.region_of(live)) out.layer[v] = colour;
  }
  return out;
}

// Plays the script; keys at its ends and every 1/rate seconds of motion.
std::vector<Key> play(const ScriptFile& script, const Command& command, Posable& posable, ProgressBar& bar) {
  std::vector<Key> keys;
  std::vector<double> positions, before;
  std::vector<float> normals;
  double time = 0, next_key = 0, frame_ms = 0, jump = 0;
  uint32_t frames = 0;
  const auto keep = [&](const std::string& label) {
    if (!keys.empty() && time <= keys.back().time) time = keys.back().time + 1e-3;
    keys.push_back({time, sheet_frame(posable, positions, label), normals});
  };
  const Refine refine = command.lengths                   ? Refine::from_last
                        : script.refine || command.refine ? Refine::one_step
                                                          : Refine::none;
  for (size_t s = 0; s < script.steps.size(); ++s) {
    const Step& step = script.steps[s];
    bar.begin("step " + std::to_string(s + 1) + " of " + std::to_string(script.steps.size()));
    const bool layered =
        !step.add.empty() && !positions.empty() &&
        std::all_of(step.add.begin(), step.add.end(), [](const HandleEntry& h) { return h.layer > 0; });
    if (layered) {  // settled, so that what moves now is the insertion's doing
      for (int i = 0; i < 30; ++i) posable.deform(refine, before, normals);
    }
    posable.stiffen(step.stiff);
    posable.remove(step.remove);
    posable.add(step.add);
    if (layered) {
      posable.deform(refine, positions, normals);
      for (size_t i = 0; i < positions.size(); ++i) jump = std::max(jump, std::abs(positions[i] - before[i]));
    }
    posable.play(step, step.drag.empty() ? 0 : script.frame_rate, [&](int f, int count) {
      const auto start = std::chrono::steady_clock::now();
      posable.deform(refine, positions, normals);
      frame_ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
      ++frames;
      if (!step.drag.empty()) time += step.seconds / count;
      if (f == count || time >= next_key) {
        keep(f == count ? step.label : "");
        next_key = time + 1 / command.keys;
      }
      bar.update(static_cast<double>(f) / count);
    });
    if (step.drag.empty() && step.seconds > 0) {
      time += step.seconds;
      keep("");
    }
    bar.end(std::to_string(posable.handles().size()) + " handles");
  }
  std::printf("%u frames, %.2f ms each; handles inserted on higher layers moved the surface by %.1e of the box\n",
              frames, frame_ms / std::max(frames, 1u), jump / posable.diagonal());
  return keys;
}

// A still model with one shape key per key frame and a clip that goes from one to the next.
Model animated(const PosableMesh& mesh, const std::vector<Key>& keys) {
  Model out = bake(mesh.model, mesh.flat, mesh.flat.positions);
  const glm::dvec3 offset = out.nodes.front().translation;  // of all its nodes
  std::vector<Primitive*> primitives;
  for (MeshData& data : out.meshes) {
    data.weights.assign(keys.size(), 0.0f);
    for (Primitive& primitive : data.primitives) primitives.push_back(&primitive);
  }
  if (primitives.size() != mesh.flat.parts.size()) throw std::runtime_error("the still model has other parts");
  for (size_t p = 0; p < primitives.size(); ++p) {
    const FlatPart& part = mesh.flat.parts[p];
    Primitive& primitive = *primitives[p];
    for (const Key& key : keys) {
      MorphTarget target;
      for (uint32_t i = 0; i < part.vertex_count; ++i) {
        const size_t v = 3 * static_cast<size_t>(part.first_vertex + i);
        const std::vector<double>& x = key.frame.positions;
        target.positions.push_back(
            glm::vec3(glm::dvec3(x[v], x[v + 1], x[v + 2]) - offset - glm::dvec3(primitive.positions[i])));
        if (!primitive.normals.empty())
          target.normals.push_back(glm::vec3(key.normals[v], key.normals[v + 1], key.normals[v + 2]) -
                                   primitive.normals[i]);
      }
      primitive.targets.push_back(std::move(target));
    }
  }
  Animation clip;
  clip.name = "pose";
  for (size_t n = 0; n < out.nodes.size(); ++n) {
    if (out.nodes[n].mesh < 0) continue;
    out.nodes[n].weights.clear();
    Channel channel;
    channel.node = static_cast<int>(n);
    channel.path = Path::weights;
    channel.width = keys.size();
    for (size_t k = 0; k < keys.size(); ++k) {
      channel.times.push_back(static_cast<float>(keys[k].time));
      for (size_t i = 0; i < keys.size(); ++i) channel.values.push_back(i == k ? 1.0f : 0.0f);
    }
    clip.channels.push_back(std::move(channel));
  }
  out.animations = {clip};
  return out;
}

// Lists the proposals. What holds is added before the script; without one, tips are dragged. False: nothing to play.
bool add_proposals(const Command& command, const PosableMesh& mesh, const Posable& posable, ScriptFile& script) {
  std::vector<ProposedHandle> handles = propose(mesh, posable, command.up);
  std::set<uint32_t> taken;  // one handle moves all of a rigid piece
  const auto is_second = [&](const ProposedHandle& handle) {
    const uint32_t part = posable.rigid_part(handle.proposal.vertex);
    return part != HF_NO_INDEX && !taken.insert(part).second;
  };
  handles.erase(std::remove_if(handles.begin(), handles.end(), is_second), handles.end());
  std::printf("%zu proposed handles\n%s", handles.size(), list_of(handles).c_str());
  if (command.output.empty() && command.sheet.empty() && command.frames.empty()) return false;
  if (command.script.empty()) {
    constexpr size_t tips = 3;  // dragged one after the other
    const bool paper = script.paper;
    script = propose_script(mesh.flat, handles, command.up, tips);
    script.paper = paper;
  } else {
    script.steps.insert(script.steps.begin(), hold_step(handles));
  }
  return true;
}

void run(const Command& command) {
  ProgressBar bar(command.quiet);
  ScriptFile script;
  if (!command.script.empty()) script = read_script(command.script);
  if (!command.mode.empty()) script.paper = command.mode == "paper";
  bar.begin("reading " + command.mesh.string());
  const PosableMesh mesh = read_posable(command.mesh);
  bar.begin("factorising");
  Posable::Options options;
  options.paper = script.paper;
  options.threads = command.threads;
  options.links = command.links;
  options.rigid = command.rigid;
  options.following = command.following;
  options.limb_refine = command.limb_steps;
  options.given_rotations = command.given_rotations;
  options.model = mesh.model.skins.empty() ? nullptr : &mesh.model;
  Posable posable(mesh.flat, options);
  bar.end(std::to_string(mesh.flat.vertex_count()) + " vertices");
  if (const std::string sentence = links_sentence(posable.surface()); !sentence.empty())
    std::printf("%s\n", sentence.c_str());
  if (command.propose && !add_proposals(command, mesh, posable, script)) return;
  const std::vector<Key> keys = play(script, command, posable, bar);
  WidestGap widest(posable.surface());
  for (const Key& key : keys) {
    char place[32];
    std::snprintf(place, sizeof place, "at %.2f s", key.time);
    widest.take(key.frame.positions, place);
  }
  if (const std::string sentence = widest.sentence(posable.diagonal()); !sentence.empty())
    std::printf("%s\n", sentence.c_str());
  for (const std::string& remark : posable.remarks()) std::printf("note: %s\n", remark.c_str());

  if (!command.output.empty()) {
    bar.begin("writing " + command.output.string());
    write_gltf(animated(mesh, keys), command.output);
    bar.end(std::to_string(keys.size()) + " keys");
  }
  if (!command.frames.empty()) {
    bar.begin("writing frames to " + command.frames.string());
    std::filesystem::create_directories(command.frames);
    SurfaceMesh frame = mesh.surface;
    for (size_t k = 0; k < keys.size(); ++k) {
      frame.positions = to_points(keys[k].frame.positions);
      if (!frame.normals.empty()) {
        for (size_t v = 0; v < frame.normals.size(); ++v)
          frame.normals[v] = {keys[k].normals[3 * v], keys[k].normals[3 * v + 1], keys[k].normals[3 * v + 2]};
      }
      char name[32];
      std::snprintf(name, sizeof name, "frame_%04zu.obj", k);
      write_mesh_file(frame, command.frames / name);
      bar.update(static_cast<double>(k + 1) / static_cast<double>(keys.size()));
    }
    bar.end(std::to_string(keys.size()) + " frames");
  }
  if (command.sheet.empty()) return;
  bar.begin("drawing " + command.sheet.string());
  // every labelled key, and unlabelled ones between them as far as there is room
  std::vector<size_t> shown;
  for (size_t k = 0; k < keys.size(); ++k) {
    if (!keys[k].frame.label.empty()) shown.push_back(k);
  }
  if (shown.size() > command.tiles) shown.resize(command.tiles);
  for (size_t i = 0; shown.size() < command.tiles && i < command.tiles; ++i) {
    const size_t k = i * (keys.size() - 1) / (command.tiles - 1);
    if (std::find(shown.begin(), shown.end(), k) == shown.end()) shown.push_back(k);
  }
  std::sort(shown.begin(), shown.end());
  std::vector<SheetFrame> frames;
  for (const size_t k : shown) {
    frames.push_back(keys[k].frame);
    char label[32];
    std::snprintf(label, sizeof label, "%.1f s", keys[k].time);
    if (frames.back().label.empty()) frames.back().label = label;
  }
  write_pose_sheet(command.sheet, mesh, frames, script,
                   command.mesh.filename().string() + ", " +
                       (command.script.empty() ? "proposed handles" : command.script.stem().string()) +
                       (script.paper ? ", the paper's scheme" : ""));
  bar.end();
}

}  // namespace

int main(int count, char** arguments) { return run_program("hf_deform_script", usage, count, arguments, parse, run); }
