// See transfer_options.h.
#include "transfer/transfer_options.h"

#include <cstdlib>
#include <stdexcept>

namespace samples {
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

std::string tail_of(const std::string& name) {
  const size_t bar = name.rfind('|');
  return bar == std::string::npos ? name : name.substr(bar + 1);
}

}  // namespace

const char* usage() {
  return "usage: hf_transfer SOURCE.glb TARGET.glb --pairs PAIRS.json -o OUT.glb [options]\n"
         "       hf_transfer --joints FILE.glb\n"
         "Plays the motion of SOURCE on TARGET: pairs of places say what corresponds, the rotations go over, the\n"
         "target keeps its own shape. OUT.glb holds TARGET's surface and looks with a new skin and the clips.\n"
         "  --pairs FILE    which places correspond (format in samples/transfer/README.md)\n"
         "  -o FILE         the result, .glb or .gltf\n"
         "  --clip NAME     a clip by name, by the part after '|', by index, or all (default: the first)\n"
         "  --fps N         keys per second, 1 to 240 (default 30; 60 for clips below a second)\n"
         "  --sheet FILE    a picture: source above, target below, over the clip\n"
         "  --report FILE   what was done and how well, as text\n"
         "  --json FILE     the same as JSON\n"
         "  --edit FILE     then remove and add pairs in the running session, and write OUT_edited.glb (and sheet)\n"
         "  --threads N     threads the library may use (default 1)\n"
         "  --joints FILE   list the joints of a model and the vertices they own, and stop\n"
         "  --quiet         no progress bar\n";
}

TransferCommand parse_command(int count, char** arguments) {
  TransferCommand out;
  std::vector<std::string> files;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= count) throw std::runtime_error(word + " needs a value; see --help");
      return arguments[++i];
    };
    if (word == "--help" || word == "-h") {
      out.help = true;
    } else if (word == "--pairs") {
      out.pairs = value();
    } else if (word == "-o" || word == "--output") {
      out.output = value();
    } else if (word == "--clip") {
      out.clip = value();
    } else if (word == "--fps") {
      out.rate = number_of(word, value(), 1, 240);
    } else if (word == "--sheet") {
      out.sheet = value();
    } else if (word == "--report") {
      out.report = value();
    } else if (word == "--json") {
      out.json = value();
    } else if (word == "--edit") {
      out.edits = value();
    } else if (word == "--joints") {
      out.joints = value();
    } else if (word == "--threads") {
      out.threads = static_cast<unsigned>(number_of(word, value(), 1, 256));
    } else if (word == "--quiet") {
      out.quiet = true;
    } else if (!word.empty() && word[0] == '-') {
      throw std::runtime_error("unknown option " + word + "; see --help");
    } else {
      files.push_back(word);
    }
  }
  if (out.help || !out.joints.empty()) return out;
  if (files.size() != 2) throw std::runtime_error("two models are needed, the source and the target; see --help");
  out.source = files[0], out.target = files[1];
  if (out.pairs.empty())
    throw std::runtime_error("--pairs is needed: which places of the two models correspond; see --help");
  if (out.output.empty()) throw std::runtime_error("-o is needed: the file to write; see --help");
  return out;
}

std::vector<const Animation*> choose_clips(const Model& model, const std::string& wanted) {
  if (model.animations.empty()) throw std::runtime_error(model.name + " has no clip to transfer");
  std::vector<const Animation*> out;
  if (wanted == "all") {
    for (const Animation& animation : model.animations) out.push_back(&animation);
    return out;
  }
  if (wanted.empty()) return {&model.animations.front()};
  for (const Animation& animation : model.animations) {
    if (animation.name == wanted) return {&animation};
  }
  for (const Animation& animation : model.animations) {
    if (tail_of(animation.name) == wanted) return {&animation};
  }
  char* end = nullptr;
  const unsigned long index = std::strtoul(wanted.c_str(), &end, 10);
  if (*end == 0 && index < model.animations.size()) return {&model.animations[index]};
  std::string names;
  for (size_t i = 0; i < model.animations.size(); ++i)
    names += (i ? ", " : "") + std::to_string(i) + " \"" + model.animations[i].name + "\"";
  throw std::runtime_error("--clip: " + model.name + " has no clip \"" + wanted + "\"; it has " + names);
}

std::filesystem::path edited_name(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + "_edited" + file.extension().string());
}

}  // namespace samples
