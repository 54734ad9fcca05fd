// hf_make_assets OUTDIR [--vertices N] [--creature NAME]
//
// Writes the sample creatures as OUTDIR/NAME.glb. N counts vertices of the closed surface (default 20000). NAME may
// also be biped_tall or biped_small (the biped in other rigs, creature_rig.h), face (with 52 morph targets) or
// face_other (another head without).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "assets/creature.h"
#include "assets/creature_gltf.h"
#include "assets/creature_rig.h"
#include "assets/face_gltf.h"
#include "gltf/file_name.h"
#include "gltf/gltf_write.h"

namespace {

struct Options {
  std::string folder;
  uint32_t vertices = 20000;
  std::vector<std::string> creatures;
  bool help = false;
};

Options parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= count) throw std::runtime_error(word + " needs a value");
      return arguments[++i];
    };
    if (word == "--help" || word == "-h") {
      options.help = true;
    } else if (word == "--vertices") {
      const std::string text = value();
      char* end = nullptr;
      const unsigned long number = std::strtoul(text.c_str(), &end, 10);
      if (text.empty() || *end != 0 || number > 2000000) {
        throw std::runtime_error("--vertices takes a number in 500..2000000, not " + text);
      }
      options.vertices = static_cast<uint32_t>(number);
    } else if (word == "--creature") {
      options.creatures.push_back(value());
    } else if (!word.empty() && word[0] == '-') {
      throw std::runtime_error("unknown option " + word + "; see --help");
    } else if (options.folder.empty()) {
      options.folder = word;
    } else {
      throw std::runtime_error("one output folder only, not also " + word);
    }
  }
  if (options.folder.empty() && !options.help) throw std::runtime_error("name an output folder; see --help");
  if (options.creatures.empty()) options.creatures = samples::creature_names();
  return options;
}

// A head with about as many vertices as asked for: four columns for three rows.
void write_face(const Options& options, const std::string& name) {
  const auto rows = static_cast<uint32_t>(std::max(30.0, std::sqrt(0.75 * options.vertices)));
  const auto columns = std::max<uint32_t>(40, options.vertices / rows);
  const samples::Face face = samples::make_face(columns, rows, name == "face_other");
  const std::filesystem::path file = hf_gltf::file_named(options.folder) / (name + ".glb");
  hf_gltf::write_gltf(samples::to_model(face, name, name == "face"), file);
  std::printf("%s: %u vertices, %zu triangles, %zu shapes\n", file.string().c_str(), face.mesh.vertex_count(),
              face.mesh.triangles.size() / 3, name == "face" ? face.shapes.size() : size_t{0});
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const Options options = parse(count, arguments);
    if (options.help) {
      std::printf(
          "usage: hf_make_assets OUTDIR [--vertices N] [--creature NAME]\n"
          "Writes animated, skinned sample creatures as .glb files.\n"
          "  --vertices N     vertices of the closed surface, 500..2000000 (default 20000)\n"
          "  --creature NAME  one of:");
      for (const std::string& name : samples::creature_names()) std::printf(" %s", name.c_str());
      for (const std::string& name : samples::rigged_names()) std::printf(" %s", name.c_str());
      std::printf(" face face_other (default: the creatures; may be repeated)\n");
      return 0;
    }
    std::filesystem::create_directories(hf_gltf::file_named(options.folder));
    for (const std::string& name : options.creatures) {
      if (name == "face" || name == "face_other") {
        write_face(options, name);
        continue;
      }
      const auto start = std::chrono::steady_clock::now();
      const std::vector<std::string> rigged = samples::rigged_names();
      const samples::Creature creature = std::find(rigged.begin(), rigged.end(), name) != rigged.end()
                                             ? samples::make_rigged(name, options.vertices)
                                             : samples::make_creature(name, options.vertices);
      const std::filesystem::path file = hf_gltf::file_named(options.folder) / (name + ".glb");
      hf_gltf::write_gltf(samples::to_model(creature), file);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      std::printf("%s: %u vertices (%u stored, %u charts), %zu triangles, %zu joints, clips", file.string().c_str(),
                  creature.surface_vertex_count, creature.vertex_count(), creature.chart_count,
                  creature.triangles.size() / 3, creature.skeleton.size());
      for (const samples::Clip& clip : creature.clips) std::printf(" %s (%.2f s)", clip.name.c_str(), clip.duration());
      std::printf("; %.1f s\n", seconds);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_make_assets: %s\n", error.what());
    return 1;
  }
  return 0;
}
