// The golden scenes (bindings/golden/README.md) through hf.hpp's handles and the C functions.
//
//   golden MESHES FILE...            runs the scenes of each file
//   golden MESHES FILE --fill OUT    also fills in the figures of every "agree" and writes the scenes to OUT
//
// Other languages, run on the same library, must come to the figures in OUT.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "golden_scene.h"

namespace {

using golden::Json;
using golden::Mismatch;
using golden::Scene;

Json read(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return Json::parse(file);
}

// A step that the interpreter does not know ends the run, also where a failure is expected.
void refuse_unknown_steps(const std::map<std::string, Json>& meshes) {
  Json step = {{"do", "nonsense"}, {"on", "nobody"}, {"error", "HF_ERROR_EMPTY"}};
  try {
    Scene(meshes).step(step, false);
  } catch (const std::exception& error) {
    if (std::string(error.what()) == "unknown step nonsense") return;
  }
  throw std::runtime_error("an unknown step passes");
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) return 2;
  std::map<std::string, Json> meshes;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[0]))
    meshes[entry.path().stem().string()] = read(entry.path());
  refuse_unknown_steps(meshes);
  const bool fill = arguments.size() == 4 && arguments[2] == "--fill";
  int failures = 0, wrong_calls = 0;
  for (size_t i = 1; i < (fill ? 2 : arguments.size()); ++i) {
    Json file = read(arguments[i]);
    for (Json& scene : file["scenes"]) {
      Scene runner(meshes);
      size_t place = 0;
      for (Json& step : scene["steps"]) {
        wrong_calls += step.contains("error");
        try {
          runner.step(step, fill);
        } catch (const Mismatch& mismatch) {
          std::cout << "FAILED " << scene["name"] << ", step " << place << " " << step["do"] << ": " << mismatch.what()
                    << "\n",
              ++failures;
        }
        ++place;
      }
      std::cout << scene["name"].get<std::string>() << ": " << place << " steps\n";
    }
    if (fill) std::ofstream(arguments[3]) << file.dump();
  }
  if (wrong_calls > 100) {  // the run of the bad input: lifetimes too
    golden::check_lifetime(meshes.at("bar"), 40);
    std::cout << "40 rounds of objects destroyed in any order: every byte came back\n";
  }
  std::cout << wrong_calls << " wrong calls answered\n";
  return failures ? 1 : 0;
} catch (const std::exception& error) {
  std::cerr << "error: " << error.what() << "\n";
  return 1;
}
