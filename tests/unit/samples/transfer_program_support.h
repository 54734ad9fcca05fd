// What the tests that run hf_transfer as a user does share: commands, files, the generated creatures, npm packages.
#ifndef HF_TESTS_TRANSFER_PROGRAM_SUPPORT_H
#define HF_TESTS_TRANSFER_PROGRAM_SUPPORT_H

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "assets/creature_gltf.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "support/creature.h"
#include "support/program_support.h"

namespace transfer_program {

namespace fs = std::filesystem;
using nlohmann::json;

inline fs::path folder() {
  const fs::path out = fs::path(HF_BUILD_DIR) / "transfer_program_test";
  fs::create_directories(out);
  return out;
}

inline fs::path pairs(const std::string& name) { return fs::path(HF_SOURCE_DIR) / "samples/transfer/pairs" / name; }

inline fs::path data() {
  const char* given = std::getenv("HF_SHARED_DATA");
  return (given ? fs::path(given) : fs::path(HF_SOURCE_DIR) / "../shared/data") / "gltf";
}

using hf_test::quoted;
using hf_test::run;

inline bool works(const std::string& command) {
  std::string said;
  return run(command, said) == 0;
}

inline int transfer(const std::string& arguments, std::string& output) {
  return run(quoted(HF_TRANSFER_PROGRAM) + " --quiet " + arguments, output);
}

// A fifth of the keys and a third of the time: for what does not depend on how many frames there are.
inline const std::string few_frames = " --fps 6";

// A generated creature's file, made once.
inline fs::path creature(const std::string& name) {
  static std::set<std::string> made;
  const fs::path file = folder() / (name + ".glb");
  if (made.insert(name).second) hf_gltf::write_gltf(samples::to_model(hf_test::creature(name, 1500)), file);
  return file;
}

inline std::string both() { return quoted(creature("horse")) + " " + quoted(creature("bull")); }
inline json read_json(const fs::path& file) { return json::parse(std::ifstream(file)); }

// The folder of node modules that holds a package, or empty; searched: where to put it.
inline fs::path node_modules(const std::string& package, std::string& searched) {
  std::vector<fs::path> places = {fs::path(HF_BUILD_DIR) / "npm/node_modules", fs::path(HF_BUILD_DIR) / "node_modules"};
  if (const char* given = std::getenv("HF_NODE_MODULES")) places.insert(places.begin(), given);
  searched = "the npm package " + package + " is not in HF_NODE_MODULES or " + places.back().string();
  for (const fs::path& place : places)
    if (fs::is_directory(place / package)) return place;
  return {};
}

}  // namespace transfer_program

#endif
