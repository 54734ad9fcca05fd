// Reads the #include lines of the project and fails on a wrong arrow. The arrows are those of the picture in
// docs/architecture.md. A room may include itself, the public headers, and the rooms before it. gltf is a library
// beside the core: it sees itself, the public headers and the rooms skeleton and retarget with base, of which it has a
// copy inside; no room sees it. Bindings see only public headers, samples see gltf besides; public headers see only
// themselves and the C standard library.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

struct Include {
  std::string file;  // relative to the project
  int line;
  std::string name;
  bool quoted;
};

bool is_source(const fs::path& path) {
  static const Names endings = {".h", ".hpp", ".hxx", ".inl", ".ipp", ".in", ".c", ".cc", ".cpp", ".cxx"};
  return endings.count(path.extension().string()) > 0;
}

// The include lines of one text. Blanks before and after the hash are allowed, as the preprocessor allows them.
std::vector<Include> includes_of(std::istream& text, const std::string& file) {
  std::vector<Include> found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", at);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find(line[open] == '<' ? '>' : '"', open + 1);
    if (close == std::string::npos) continue;
    found.push_back({file, number, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return found;
}

const fs::path project = fs::path(HF_SOURCE_DIR);

std::vector<Include> includes_below(const std::string& folder) {
  std::vector<Include> found;
  if (!fs::exists(project / folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(project / folder)) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    std::ifstream text(entry.path());
    for (Include& include : includes_of(text, fs::relative(entry.path(), project).generic_string()))
      found.push_back(std::move(include));
  }
  return found;
}

// The arrows "room --> room" of the picture: by room, the rooms that it stands directly behind.
const std::map<std::string, Names>& drawn() {
  static const std::map<std::string, Names> arrows = [] {
    std::map<std::string, Names> into;
    std::ifstream page(project / "docs/architecture.md");
    const auto name = [](const std::string& word) { return word.substr(0, word.find('[')); };
    for (std::string line; std::getline(page, line);) {
      const std::size_t arrow = line.find(" --> ");
      if (line.rfind("  ", 0) != 0 || arrow == std::string::npos) continue;
      const std::string from = name(line.substr(2, arrow - 2)), to = name(line.substr(arrow + 5));
      into[from];
      into[to].insert(from);
    }
    return into;
  }();
  return arrows;
}

// The rooms each room may include, itself among them.
const std::map<std::string, Names>& arrows() {
  static const std::map<std::string, Names> allowed = [] {
    std::map<std::string, Names> a = drawn();
    a["capi"].erase("peers");  // one file alone may: fault_in_src
    for (auto& [room, before] : a) before.insert(room);
    for (std::size_t step = 0; step < a.size(); ++step) {
      for (auto& room : a) {
        const Names known = room.second;
        for (const std::string& one : known) room.second.insert(a[one].begin(), a[one].end());
      }
    }
    a["gltf"] = {"base", "skeleton", "retarget", "gltf"};
    return a;
  }();
  return allowed;
}

// What is wrong with one include line of src/, or nothing.
std::string fault_in_src(const Include& include) {
  const std::string room = fs::path(include.file).lexically_relative("src").begin()->string();
  const auto allowed = arrows().find(room);
  if (allowed == arrows().end()) return "src/" + room + " is no room of the house: name it in this test";
  if (include.name.find("..") != std::string::npos) return "climbs out of its folder";
  const std::string head = fs::path(include.name).begin()->string();
  if (include.name.find('/') == std::string::npos) {
    // no folder: a system header, or a neighbour in the same room
    if (include.quoted && !fs::exists((project / include.file).parent_path() / include.name))
      return "is not a file of its own room";
    return "";
  }
  if (head == "hf" || (head == "hf_gltf" && room == "gltf")) return "";       // the public headers
  if (include.file == "src/capi/peer_api.cpp" && head == "peers") return "";  // the only file that knows the baselines
  if (arrows().count(head) && !allowed->second.count(head)) return "src/" + room + " must not see src/" + head;
  if (head == "hf_gltf" || head == "tests" || head == "samples" || head == "bindings")
    return "the library must not see " + head;
  return "";
}

// What is wrong with an include line outside of the library: it names a room of src/.
std::string fault_outside(const Include& include) {
  // Programs cut faces by the library's own rule, compiled once more: samples/common/CMakeLists.txt.
  if (include.file == "samples/common/face_triangles.cpp" && include.name == "mesh/face_cut.h") return "";
  if (include.name.find("src/") != std::string::npos) return "reaches into src/";
  if (!include.quoted) return "";
  const fs::path name(include.name);
  if (name.begin() == name.end() || std::next(name.begin()) == name.end()) return "";
  const std::string head = name.begin()->string();
  if (head == "gltf" && include.file.rfind("samples/", 0) == 0) return "";  // the library of models
  // a folder of its own that bears a room's name is fine when the file is there
  const bool own = fs::exists(project / fs::path(include.file).parent_path() / name) ||
                   fs::exists(project / "samples" / name) || fs::exists(project / "bindings" / name);
  if (arrows().count(head) && !own) return "sees the inner room src/" + head + "; only include/hf is public";
  return "";
}

std::string fault_in_public_header(const Include& include) {
  static const Names c_library = {"assert.h",   "complex.h", "ctype.h",   "errno.h",  "fenv.h",   "float.h",
                                  "inttypes.h", "iso646.h",  "limits.h",  "locale.h", "math.h",   "setjmp.h",
                                  "signal.h",   "stdarg.h",  "stdbool.h", "stddef.h", "stdint.h", "stdio.h",
                                  "stdlib.h",   "string.h",  "tgmath.h",  "time.h",   "wchar.h",  "wctype.h"};
  const fs::path file = project / include.file;
  if (include.name == "hf/peers.h") return "shows the baselines to hosts that did not ask for them";
  if (fs::exists(project / "include" / include.name) && include.name.rfind("hf/", 0) == 0) return "";
  // the C++ wrapper sees the C++ standard library, whose headers have no ending
  if (file.extension() == ".hpp" && !include.quoted && include.name.find_first_of("./") == std::string::npos) return "";
  if (file.extension() == ".h" && !include.quoted && c_library.count(include.name)) return "";
  return "is neither a public header nor of the standard library";
}

void expect_no_fault(const std::vector<Include>& includes, std::string (*fault)(const Include&)) {
  for (const Include& include : includes) {
    const std::string what = fault(include);
    if (!what.empty())
      ADD_FAILURE() << include.file << ":" << include.line << ": include of " << include.name << " " << what;
  }
}

TEST(Rooms, IncludeOnlyWhatStandsToTheirLeft) {
  const std::vector<Include> includes = includes_below("src");
  EXPECT_GT(includes.size(), 100u);
  expect_no_fault(includes, fault_in_src);
}

TEST(Rooms, EveryArrowOfThePictureIsAnInclude) {
  std::map<std::string, Names> seen;
  for (const Include& include : includes_below("src")) {
    const std::string room = fs::path(include.file).lexically_relative("src").begin()->string();
    seen[room].insert(fs::path(include.name).begin()->string());
  }
  EXPECT_GT(drawn().size(), 10u);
  for (const auto& [room, before] : drawn()) {
    for (const std::string& one : before) EXPECT_TRUE(seen[room].count(one)) << one << " --> " << room;
  }
}

// The code of a room says its room: namespace hf_inner::mesh in src/mesh. base is hf_inner itself.
TEST(Rooms, EveryFileIsInTheNamespaceOfItsRoom) {
  for (const auto& entry : fs::recursive_directory_iterator(project / "src")) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    const std::string room = fs::relative(entry.path(), project / "src").begin()->string();
    if (room == "gltf") continue;
    const std::string name = room == "base" ? "hf_inner" : "hf_inner::" + room;
    std::ifstream text(entry.path());
    bool opened = false, own = false;
    for (std::string line; std::getline(text, line);) {
      opened = opened || line.rfind("namespace hf_inner", 0) == 0;
      own = own || line == "namespace " + name + " {";
      EXPECT_TRUE(room == "base" || line != "namespace hf_inner {") << entry.path();
    }
    // The ordering METIS is of the room factor. Only peers knows CHOLMOD.
    EXPECT_TRUE(opened == own || entry.path().filename() == "metis_ordering.cpp")
        << entry.path() << " is not in " << name;
  }
}

TEST(Rooms, PublicHeadersIncludeEachOtherAndTheStandardLibraryOnly) {
  const std::vector<Include> includes = includes_below("include");
  EXPECT_GT(includes.size(), 5u);
  expect_no_fault(includes, fault_in_public_header);
}

TEST(Rooms, SamplesAndBindingsSeePublicHeadersAndModelsOnly) {
  expect_no_fault(includes_below("samples"), fault_outside);
  expect_no_fault(includes_below("bindings"), fault_outside);
}

TEST(Rooms, TestsOfThePublicAbiSeePublicHeadersOnly) {
  expect_no_fault(includes_below("tests/api"), fault_outside);
  expect_no_fault(includes_below("tests/consumer"), fault_outside);
}

TEST(Rooms, EveryRoomOfTheHouseIsKnownHere) {
  for (const auto& entry : fs::directory_iterator(project / "src")) {
    if (!entry.is_directory()) continue;
    EXPECT_TRUE(arrows().count(entry.path().filename().string())) << entry.path();
  }
}

// The test must be able to fail: wrong arrows are found, right ones are not.
TEST(Rooms, WrongArrowsAreFound) {
  const auto fault = [](const char* file, const char* name) { return fault_in_src({file, 1, name, true}); };
  EXPECT_NE(fault("src/mesh/mesh.cpp", "factor/factor.h"), "");
  EXPECT_NE(fault("src/factor/factor.cpp", "mesh/mesh.h"), "");
  EXPECT_NE(fault("src/base/memory.h", "surface/core.h"), "");
  EXPECT_NE(fault("src/surface/core.h", "capi/boundary.h"), "");
  EXPECT_NE(fault("src/deform/pose.cpp", "transfer/transfer.h"), "");
  EXPECT_NE(fault("src/detail/a.cpp", "deform/pose.h"), "");
  EXPECT_NE(fault("src/mesh/mesh.cpp", "../factor/factor.h"), "");
  EXPECT_NE(fault("src/solve/site_solver.cpp", "peers/refactor.h"), "");
  EXPECT_NE(fault("src/capi/solver_api.cpp", "peers/refactor.h"), "");
  EXPECT_EQ(fault("src/capi/peer_api.cpp", "peers/refactor.h"), "");
  EXPECT_NE(fault_in_public_header({"include/hf/hf.h", 1, "hf/peers.h", true}), "");
  EXPECT_NE(fault("src/attic/a.cpp", "base/error.h"), "");
  EXPECT_NE(fault("src/mesh/mesh.cpp", "no_such_neighbour.h"), "");
  EXPECT_NE(fault("src/skeleton/character.h", "surface/core.h"), "");
  EXPECT_NE(fault("src/weights/weights.h", "skeleton/character.h"), "");
  EXPECT_EQ(fault("src/skeleton/character.h", "mesh/mesh.h"), "");
  EXPECT_NE(fault("src/gltf/model.h", "mesh/mesh.h"), "");
  EXPECT_NE(fault("src/transfer/transfer.cpp", "gltf/model.h"), "");
  EXPECT_NE(fault("src/capi/field_api.cpp", "hf_gltf/gltf.h"), "");
  EXPECT_EQ(fault("src/gltf/regions.cpp", "gltf/model.h"), "");
  EXPECT_EQ(fault("src/gltf/api.cpp", "hf_gltf/gltf.h"), "");
  EXPECT_EQ(fault("src/capi/field_api.cpp", "transfer/transfer.h"), "");
  EXPECT_EQ(fault("src/transfer/transfer.cpp", "deform/pose.h"), "");
  EXPECT_EQ(fault("src/mesh/mesh.cpp", "hf/surface.h"), "");
  EXPECT_NE(fault_outside({"samples/field/main.cpp", 1, "surface/core.h", true}), "");
  EXPECT_EQ(fault_outside({"samples/field/main.cpp", 1, "gltf/model.h", true}), "");
  EXPECT_NE(fault_outside({"bindings/js/a.cpp", 1, "gltf/model.h", true}), "");
  EXPECT_NE(fault_outside({"samples/common/face_triangles.cpp", 1, "mesh/mesh.h", true}), "");
  EXPECT_NE(fault_outside({"samples/field/main.cpp", 1, "../../src/surface/core.h", true}), "");
  EXPECT_EQ(fault_outside({"samples/field/main.cpp", 1, "hf/hf.h", true}), "");
  EXPECT_NE(fault_in_public_header({"include/hf/base.h", 1, "vector", false}), "");
  EXPECT_NE(fault_in_public_header({"include/hf/base.h", 1, "unistd.h", false}), "");
  EXPECT_EQ(fault_in_public_header({"include/hf/base.h", 1, "stdint.h", false}), "");
}

// base/algebra.h sets what keeps results the same bits; sizes are fixed, so that Eigen allocates nothing.
// The types a text defines for all files to see, as namespace::name. It is read as clang-format leaves it: a type of a
// namespace begins its line. Types of unnamed namespaces belong to their own file and are left out.
std::vector<std::string> types_of(std::istream& text) {
  std::vector<std::string> found;
  std::string line, space, word, name;
  bool own = false;
  while (std::getline(text, line)) {
    std::istringstream words(line);
    if (line.rfind("namespace ", 0) == 0) {
      words >> word >> name;
      if (name == "{") {
        own = true;
      } else {
        space = name;
      }
    }
    if (line == "}  // namespace") own = false;
    if (own || (line.rfind("struct ", 0) != 0 && line.rfind("class ", 0) != 0)) continue;
    words >> word >> name;
    if (name.rfind("alignas", 0) == 0) words >> name;
    if (name.find("::") == std::string::npos && words >> word && (word == "{" || word == ":" || word == "final"))
      found.push_back(space + "::" + name);
  }
  return found;
}

// Two types of one name are one type to the linker: it keeps one constructor for both. Compiled with -Oz, clusters of
// transfers were once made by the constructor of a proposed handle, over the memory beside them.
TEST(Rooms, NoTwoTypesShareAName) {
  std::map<std::string, std::string> first;
  for (const auto& entry : fs::recursive_directory_iterator(project / "src")) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    const std::string file = fs::relative(entry.path(), project).generic_string();
    std::ifstream text(entry.path());
    for (const std::string& type : types_of(text)) {
      const auto place = first.emplace(type, file);
      EXPECT_TRUE(place.second) << type << " is defined in " << place.first->second << " and in " << file;
    }
  }
  EXPECT_GT(first.size(), 300u);
}

TEST(Rooms, EigenComesThroughOneHeaderWithFixedSizes) {
  for (const Include& include : includes_below("src")) {
    if (include.file != "src/base/algebra.h") {
      EXPECT_NE(include.name.compare(0, 6, "Eigen/"), 0) << include.file << ":" << include.line;
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(project / "src")) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    std::ifstream file(entry.path());
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const char* name : {"MatrixX", "VectorX", "ArrayX", "Matrix3X", "Dynamic", "Sparse"})
      EXPECT_EQ(text.find("hf_eigen::" + std::string(name)), std::string::npos) << entry.path() << " names " << name;
  }
}

TEST(Rooms, IncludeLinesAreReadAsThePreprocessorReadsThem) {
  std::istringstream text(
      "  #  include \"a/b.h\"\n#include <c>\n// #include \"d.h\"\n#define include\n#include\t\"e.h\" // x\n");
  const std::vector<Include> found = includes_of(text, "f");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name, "a/b.h");
  EXPECT_TRUE(found[0].quoted);
  EXPECT_EQ(found[1].name, "c");
  EXPECT_FALSE(found[1].quoted);
  EXPECT_EQ(found[2].line, 5);
}

}  // namespace
