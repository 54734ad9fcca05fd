// See transfer_options.h.
#include "transfer/transfer_options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "common/limits.h"
#include "gltf/file_name.h"
#include "gltf/gltf_write.h"

namespace samples {

using namespace hf_gltf;
namespace {

double number_of(const std::string& option, const std::string& text, double low, double high) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(value >= low && value <= high)) {
    throw std::runtime_error(option + " takes a number from " + std::to_string(low) + " to " + std::to_string(high) +
                             ", not \"" + text + "\"");
  }
  return value;
}

glm::dvec3 direction_of(const std::string& option, const std::string& text) {
  for (int c = 0; c < 3; ++c) {
    for (const char sign : {'+', '-'}) {
      if (text != std::string(1, sign) + "xyz"[c] && (sign == '-' || text != std::string(1, "xyz"[c]))) continue;
      glm::dvec3 out(0);
      out[c] = sign == '+' ? 1 : -1;
      return out;
    }
  }
  throw std::runtime_error(option + " takes +x, -x, +y, -y, +z or -z, not \"" + text + "\"");
}

// --up and --forward hold for both models, --source-up and so on for one.
struct GivenAxes {
  std::optional<glm::dvec3> up, forward;
};

std::optional<Axes> axes_of(const GivenAxes& own, const GivenAxes& both, const char* side) {
  const std::optional<glm::dvec3> up = own.up ? own.up : both.up, forward = own.forward ? own.forward : both.forward;
  if (!up && !forward) return {};
  Axes out;
  out.up = up.value_or(out.up);
  // a model whose z is up faces -y, as glTF's exporters turn it
  out.forward = forward.value_or(std::abs(out.up.z) > 0.5 ? glm::dvec3(0, -out.up.z, 0) : glm::dvec3(0, 0, 1));
  if (glm::dot(out.up, out.forward) != 0)
    throw std::runtime_error(std::string("up and forward of the ") + side + " must be two different axes");
  out.right = glm::cross(out.up, out.forward);
  return out;
}

std::vector<std::string> words_between_commas(const std::string& list) {
  std::vector<std::string> out;
  for (size_t from = 0; from <= list.size();) {
    const size_t comma = std::min(list.find(',', from), list.size());
    if (comma > from) out.push_back(list.substr(from, comma - from));
    from = comma + 1;
  }
  return out;
}

}  // namespace

const char* usage() {
  return "usage: hf_transfer SOURCE.glb TARGET.glb [--pairs PAIRS.json] -o OUT.glb [options]\n"
         "       hf_transfer --source REF.obj --poses P1.ply P2.obj ... --target REF.obj [--pairs PAIRS.json] "
         "--out-poses DIR\n"
         "       hf_transfer SOURCE.glb TARGET.glb --suggest-pairs PAIRS.json\n"
         "       hf_transfer CLIPS.glb TARGET.glb -o OUT.glb  (CLIPS has no surface, TARGET has its skeleton)\n"
         "       hf_transfer SOURCE.glb TARGET.glb --pairs PAIRS.json --shapes -o OUT.glb\n"
         "       hf_transfer --batch LIST [--jobs N]\n"
         "       hf_transfer --joints FILE.glb\n"
         "Plays the motion of SOURCE on TARGET: pairs of places say what corresponds, the rotations go over, the\n"
         "target keeps its own shape. OUT.glb is TARGET as it was, with the new clips before its own; a TARGET "
         "without\n"
         "a skin gets a new one. Models are .glb, .gltf or .vrm, and .fbx, .dae or .bvh in builds with assimp.\n"
         "  --pairs FILE    which places correspond, or what joints are (samples/transfer/README.md); without\n"
         "                  it pairs are proposed from shapes and joint names, and said\n"
         "  --suggest-pairs FILE  write the proposal, to be edited, and stop\n"
         "  -o FILE         the result, .glb or .gltf\n"
         "  --clip NAME     a clip by name, by the part after '|', by index, or all (default: the first)\n"
         "  --clips FILE    take the clips of this file, which needs no surface; SOURCE has its skeleton\n"
         "  --fps N         keys per second, 1 to 240 (default 30; 60 for clips below a second), or keys: the source's "
         "own\n"
         "  --way WAY       skeleton: joints of TARGET turn as SOURCE's joints; surface: pairs and clusters transfer "
         "the\n"
         "                  motion. Default: skeleton where both skeletons are understood and their limbs match\n"
         "  --as KIND       own-skin (TARGET's joints turn; the default where it has a skin), skin (a new one),\n"
         "                  morph (morph targets), frames (with --out-poses)\n"
         "  --onto-skin     the same as --as own-skin\n"
         "  --key-tolerance X  how far keys that are left out may move a vertex, in boxes (default 0.0005; 0 keeps "
         "all)\n"
         "  --shapes        the morph targets of SOURCE become morph targets of TARGET; with --clip also clips of "
         "weights\n"
         "  --morph-tolerance X  how far morph targets may be off, in boxes (default 0.001)\n"
         "  --out-poses DIR a mesh file per frame, in TARGET's own vertex order\n"
         "  --source FILE --target FILE --poses FILES  meshes: posed copies of the source instead of a clip\n"
         "  --contacts LIST pairs or joints that touch the ground, with commas; none; found when not given\n"
         "  --sinking LIST  pairs whose limb may sink into the ground, with commas\n"
         "  --dials LIST    stride=1.2,hip_height_share=-0.1,neck_follow=1,tail_follow=-0.5,arm_space_degrees=10,"
         "long_follow=1: see README.md\n"
         "  --in-place      the clip stays where it begins: its straight travel along the ground is taken out\n"
         "  --root-motion   that travel goes to the topmost node over the target's joints, and the body stays in place "
         "under it\n"
         "  --no-ground     feet are not held at the ground, and parts may be under it\n"
         "  --no-rigid      pieces alone on a joint of the target's skin may bend; otherwise a sword stays rigid\n"
         "  --source-rest CLIP@TIME, --target-rest CLIP@TIME  a pose of a clip, in seconds, is the rest pose\n"
         "  --up AXIS, --forward AXIS  for proposals: +y, -z, ...; --source-up, --target-up, --source-forward and\n"
         "                  --target-forward say it for one model (else the skeleton says it, and the report why)\n"
         "  --sheet FILE    a picture: source above, target below, over the clip\n"
         "  --report FILE   the steps and their quality, as text\n"
         "  --json FILE     the same as JSON\n"
         "  --edit FILE     then remove and add pairs in the running session, and write OUT_edited.glb (and sheet)\n"
         "  --no-links      pieces of a model stay apart; otherwise links join them\n"
         "  --threads N     threads the library may use (default 1)\n"
         "  --work-limit N  refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
         "  --memory-limit N refuse a surface that holds more than N MiB (default: by the size)\n"
         "  --joints FILE   list the joints of a model and the vertices they own, and stop\n"
         "  --batch LIST    a transfer for each line of LIST (the words after hf_transfer), each in its own process;\n"
         "                  a line of JSON for each, the largest exit code\n"
         "  --jobs N        processes of a batch at a time (default: one for each core)\n"
         "  --outcome FILE  JSON with the report, or with the error\n"
         "  --quiet         no progress bar; --silent: not a word\n";
}

TransferCommand parse_command(int count, char** arguments) {
  TransferCommand out;
  std::vector<std::string> files;
  GivenAxes both, of_source, of_target;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= count) throw std::runtime_error(word + " needs a value; see --help");
      return arguments[++i];
    };
    if (word == "--help" || word == "-h") {
      out.help = true;
    } else if (word == "--pairs") {
      out.pairs = file_named(value());
    } else if (word == "-o" || word == "--output") {
      out.output = file_named(value());
    } else if (word == "--clip") {
      out.clip = value();
    } else if (word == "--fps") {
      const std::string rate = value();
      out.rate = rate == "keys" ? -1 : number_of(word, rate, 1, 240);
    } else if (word == "--sheet") {
      out.sheet = file_named(value());
    } else if (word == "--report") {
      out.report = file_named(value());
    } else if (word == "--json") {
      out.json = file_named(value());
    } else if (word == "--edit") {
      out.edits = file_named(value());
    } else if (word == "--joints") {
      out.joints = file_named(value());
    } else if (word == "--clips") {
      out.clips = file_named(value());
    } else if (word == "--batch") {
      out.batch = file_named(value());
    } else if (word == "--jobs") {
      out.jobs = static_cast<unsigned>(number_of(word, value(), 1, 1024));
    } else if (word == "--outcome") {
      out.outcome = file_named(value());
    } else if (word == "--silent") {
      out.silent = out.quiet = true;
    } else if (word == "--onto-skin") {
      out.kind = "own-skin";
    } else if (word == "--as") {
      out.kind = value();
      if (out.kind != "skin" && out.kind != "own-skin" && out.kind != "morph" && out.kind != "frames")
        throw std::runtime_error("--as takes skin, own-skin, morph or frames, not \"" + out.kind + "\"");
    } else if (word == "--way") {
      out.way = value();
      if (out.way != "skeleton" && out.way != "surface")
        throw std::runtime_error("--way takes skeleton or surface, not \"" + out.way + "\"");
    } else if (word == "--out-poses") {
      out.frames = file_named(value());
      out.kind = "frames";
    } else if (word == "--source") {
      out.source = file_named(value());
    } else if (word == "--target") {
      out.target = file_named(value());
    } else if (word == "--poses") {
      while (i + 1 < count && arguments[i + 1][0] != '-') out.poses.emplace_back(arguments[++i]);
      if (out.poses.empty()) throw std::runtime_error("--poses needs at least one file");
    } else if (word == "--contacts") {
      out.contacts = words_between_commas(value());
      if (out.contacts.empty()) throw std::runtime_error("--contacts takes names with commas between them, or none");
    } else if (word == "--sinking") {
      out.sinking = words_between_commas(value());
    } else if (word == "--dials") {
      for (const std::string& part : words_between_commas(value())) {
        const size_t equals = part.find('=');
        if (equals == std::string::npos) throw std::runtime_error(word + " takes NAME=VALUE, not \"" + part + "\"");
        out.dials.emplace_back(part.substr(0, equals),
                               number_of(word + " " + part.substr(0, equals), part.substr(equals + 1), -90, 90));
      }
    } else if (word == "--shapes") {
      out.shapes = true;
    } else if (word == "--in-place") {
      out.in_place = true;
    } else if (word == "--root-motion") {
      out.root_motion = true;
    } else if (word == "--no-ground") {
      out.ground = false;
    } else if (word == "--no-rigid") {
      out.rigid = false;
    } else if (word == "--source-rest") {
      out.source_rest = value();
    } else if (word == "--target-rest") {
      out.target_rest = value();
    } else if (word == "--up" || word == "--source-up" || word == "--target-up") {
      (word == "--up" ? both : word == "--source-up" ? of_source : of_target).up = direction_of(word, value());
    } else if (word == "--forward" || word == "--source-forward" || word == "--target-forward") {
      (word == "--forward"          ? both
       : word == "--source-forward" ? of_source
                                    : of_target)
          .forward = direction_of(word, value());
    } else if (word == "--key-tolerance") {
      out.key_tolerance = number_of(word, value(), 0, 1);
    } else if (word == "--morph-tolerance") {
      out.morph_tolerance = number_of(word, value(), 0, 1);
    } else if (word == "--suggest-pairs") {
      out.suggest = file_named(value());
    } else if (word == "--no-links") {
      out.links = false;
    } else if (word == "--threads") {
      out.threads = static_cast<unsigned>(number_of(word, value(), 1, 256));
    } else if (take_limit(word, value)) {
      continue;
    } else if (word == "--quiet") {
      out.quiet = true;
    } else if (!word.empty() && word[0] == '-') {
      throw std::runtime_error("unknown option " + word + "; see --help");
    } else {
      files.push_back(word);
    }
  }
  out.source_axes = axes_of(of_source, both, "source");
  out.target_axes = axes_of(of_target, both, "target");
  if (out.help || !out.joints.empty()) return out;
  if (!out.batch.empty()) {
    if (!files.empty()) throw std::runtime_error("--batch takes its models from the list, not " + files[0]);
    return out;
  }
  if (out.shapes) {
    for (const auto& [given, option] : {std::pair<bool, const char*>(!out.kind.empty(), "--as and --out-poses"),
                                        {!out.way.empty(), "--way"},
                                        {!out.poses.empty(), "--poses"},
                                        {!out.clips.empty(), "--clips"},
                                        {!out.edits.empty(), "--edit"},
                                        {!out.contacts.empty(), "--contacts"},
                                        {!out.dials.empty(), "--dials"}})
      if (given)
        throw std::runtime_error(std::string("--shapes transfers morph targets: it does not go with ") + option);
    if (out.pairs.empty() && out.suggest.empty())
      throw std::runtime_error("--shapes needs --pairs: which places of the two models correspond");
  }
  if (!out.clips.empty() && !out.poses.empty()) throw std::runtime_error("give --clips or --poses, not both");
  if (!out.source.empty() || !out.target.empty()) {
    if (!files.empty() || out.source.empty() || out.target.empty())
      throw std::runtime_error("--source and --target go together, without another file; see --help");
    files = {out.source.string(), out.target.string()};
  }
  if (files.size() != 2) throw std::runtime_error("two models are needed, the source and the target; see --help");
  out.source = file_named(files[0]);
  out.target = file_named(files[1]);
  if (!out.suggest.empty()) return out;
  if (out.kind == "frames") {
    if (out.frames.empty()) throw std::runtime_error("--out-poses is needed: the folder for the frames; see --help");
  } else if (out.output.empty()) {
    throw std::runtime_error("-o is needed: the file to write (or --out-poses, a folder of meshes); see --help");
  } else {
    is_binary_name(out.output);  // refuses other formats before the work
  }
  return out;
}

std::filesystem::path edited_name(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + "_edited" + file.extension().string());
}

}  // namespace samples
