// The other ways hf_transfer is used: proposed pairs, contacts, the target's own skin, morph targets, mesh sequences,
// and the live sample.
#include <gtest/gtest.h>

#include "common/mesh_file.h"
#include "gltf/animate.h"
#include "support/full.h"
#include "transfer/session.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

fs::path horse_to_bull() { return pairs("horse_to_bull.json"); }

TEST(TransferOutputs, ProposedPairsFindEveryPlaceAndCrossNone) {
  const fs::path list = folder() / "proposed.json", report = folder() / "proposed_report.json";
  std::string said;
  ASSERT_EQ(transfer(both() + " --suggest-pairs " + quoted(list), said), 0) << said;
  std::vector<std::string> names;
  const json proposed = read_json(list);
  for (const json& pair : proposed["pairs"]) {
    names.push_back(pair["name"]);
    const bool nose = pair["name"] == "nose";  // each body carries its head as its kind does
    EXPECT_TRUE(!nose || !pair.value("align", true));
  }
  for (const char* name :
       {"nose", "tail", "front foot left", "front foot right", "hind foot left", "hind foot right", "withers", "rump"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name << "\n" << said;
  ASSERT_EQ(transfer(both() + " --pairs " + quoted(list) + " -o " + quoted(folder() / "proposed.glb") + " --json " +
                         quoted(report),
                     said),
            0)
      << said;
  const json figures = read_json(report);
  for (const json& pair : figures["pairs"]) EXPECT_FALSE(pair["crossed"].get<bool>()) << pair["name"];
  EXPECT_LT(figures["clips"][0]["foot_path_mean"].get<double>(), 0.005);
  EXPECT_LT(figures["clips"][0]["planted_max"].get<double>(), 0.005);
  EXPECT_LT(figures["clips"][0]["foot_sunk"].get<double>(), 0.002);
  // and without a file at all
  EXPECT_EQ(transfer(both() + " -o " + quoted(folder() / "unasked.glb"), said), 0) << said;
  EXPECT_NE(said.find("proposed pairs"), std::string::npos);
}

// Short legs under a large head with ears, a rest in mid-stride, a weapon before the face.
TEST(TransferOutputs, RobotsOfTheDataGetFeetAndFaceForward) {
  struct Robot {
    const char* file;
    std::vector<const char*> places;
  };
  const Robot robots[] = {
      {"q_PlatformerCharacter.glb",
       {"head", "foot left", "foot right", "hand left", "hand right", "seat", "upper back", "ear left", "ear right"}},
      {"q_PlatformerHumanoidRig.glb", {"head", "foot left", "foot right", "hand left", "hand right", "ear left"}},
      {"q_CyberCharacter.glb", {"head", "foot left", "foot right", "hand left", "hand right", "seat"}},
      {"q_Enemy_2Legs.glb", {"foot left", "foot right"}}};
  int seen = 0;
  for (const Robot& robot : robots) {
    if (!fs::exists(data() / robot.file)) continue;
    ++seen;
    const fs::path list = folder() / "robot.json";
    const std::string model = quoted(data() / robot.file);
    std::string said;
    ASSERT_EQ(transfer(model + " " + model + " --suggest-pairs " + quoted(list), said), 0) << said;
    const json proposed = read_json(list);
    EXPECT_EQ(proposed["target_axes"]["forward"], "+z") << robot.file;
    std::set<std::string> names;
    for (const json& pair : proposed["pairs"]) names.insert(pair["name"].get<std::string>());
    for (const char* place : robot.places) EXPECT_TRUE(names.count(place)) << robot.file << ": " << place;
  }
  if (seen == 0) GTEST_SKIP() << "no robots under " << data();
}

TEST(TransferOutputs, ExchangedSidesAreSaid) {
  json list = read_json(horse_to_bull());
  json* sides[2] = {nullptr, nullptr};
  for (json& pair : list["pairs"]) {
    if (pair.contains("both")) {
      pair["source"] = pair["target"] = pair["both"];
      pair.erase("both");
    }
    if (pair["name"] == "front foot left") sides[0] = &pair["target"];
    if (pair["name"] == "front foot right") sides[1] = &pair["target"];
  }
  ASSERT_TRUE(sides[0] && sides[1]);
  std::swap(*sides[0], *sides[1]);
  std::ofstream(folder() / "crossed.json") << list;
  std::string said;
  ASSERT_EQ(
      transfer(both() + " --pairs " + quoted(folder() / "crossed.json") + " -o " + quoted(folder() / "crossed.glb"),
               said),
      0)
      << said;
  EXPECT_NE(said.find("left and right are crossed"), std::string::npos) << said;
}

TEST(TransferOutputs, ContactsAreNamedByPairOrJointAndWrongNamesAreRefused) {
  const std::string start = both() + few_frames + " --pairs " + quoted(horse_to_bull()) + " -o " +
                            quoted(folder() / "contacts.glb") + " --contacts ";
  std::string said;
  ASSERT_EQ(transfer(start + "nose", said), 0) << said;
  EXPECT_NE(said.find("\"nose\" touches the ground"), std::string::npos) << said;
  ASSERT_EQ(transfer(start + "head", said), 0) << said;
  EXPECT_NE(said.find("\"nose\" touches the ground"), std::string::npos) << said;
  ASSERT_EQ(transfer(start + "none", said), 0) << said;
  EXPECT_EQ(said.find("contact:"), std::string::npos) << said;
  EXPECT_EQ(transfer(start + "antlers", said), 1);
  EXPECT_NE(said.find("antlers"), std::string::npos) << said;
}

TEST(TransferOutputs, TheTargetsOwnRigPlaysTheMotion) {
  const fs::path out = folder() / "own.glb", report = folder() / "own.json";
  std::string said;
  ASSERT_EQ(transfer(both() + " --pairs " + quoted(horse_to_bull()) + " --onto-skin -o " + quoted(out) + " --json " +
                         quoted(report),
                     said),
            0)
      << said;
  const hf_gltf::Model made = hf_gltf::read_gltf(out), given = hf_gltf::read_gltf(folder() / "bull.glb");
  ASSERT_EQ(made.skins.size(), given.skins.size());
  EXPECT_EQ(made.skins[0].joints, given.skins[0].joints);
  EXPECT_EQ(made.nodes.size(), given.nodes.size());
  ASSERT_EQ(made.meshes.size(), given.meshes.size());
  EXPECT_EQ(made.meshes[0].primitives[0].positions, given.meshes[0].primitives[0].positions);
  // the new clip, then the bull's own
  ASSERT_EQ(made.animations.size(), given.animations.size() + 1);
  EXPECT_EQ(made.animations.back().name, given.animations.back().name);
  const json figures = read_json(report);
  EXPECT_LT(figures["written_rms"].get<double>(), 0.015);
  EXPECT_LT(figures["written_max"].get<double>(), 0.08);
  EXPECT_GT(figures["written_parts"].get<int>(), 10);
}

TEST(TransferOutputs, ARigThatMadeTheMotionPlaysItBack) {
  // the horse on itself: the frames are nearly those of its own joints
  const fs::path out = folder() / "itself.glb", report = folder() / "itself.json";
  std::string said;
  ASSERT_EQ(transfer(quoted(creature("horse")) + " " + quoted(folder() / "horse.glb") + " --onto-skin -o " +
                         quoted(out) + " --json " + quoted(report),
                     said),
            0)
      << said;
  EXPECT_LT(read_json(report)["written_rms"].get<double>(), 0.007);
}

TEST(TransferOutputs, MorphTargetsKeepEveryFrameWithinTheTolerance) {
  const fs::path out = folder() / "morph.glb", report = folder() / "morph.json";
  std::string said;
  ASSERT_EQ(transfer(both() + " --pairs " + quoted(horse_to_bull()) + " --as morph --morph-tolerance 0.0005 -o " +
                         quoted(out) + " --json " + quoted(report),
                     said),
            0)
      << said;
  const hf_gltf::Model made = hf_gltf::read_gltf(out);
  EXPECT_TRUE(made.skins.empty());
  const json figures = read_json(report);
  EXPECT_EQ(made.meshes[0].primitives[0].targets.size(), figures["written_parts"].get<size_t>());
  EXPECT_LT(figures["written_rms"].get<double>(), 5.01e-4);
  EXPECT_LT(figures["written_parts"].get<int>(), 50);
  for (const float weight : made.animations[0].channels[0].values) EXPECT_TRUE(weight >= 0 && weight <= 1) << weight;
}

TEST(TransferOutputs, MeshSequencesGiveWhatTheClipGives) {
  // the walk of the horse as posed meshes, the bull as a mesh; places as vertices and positions
  const hf_gltf::Model horse = hf_gltf::read_gltf(creature("horse")), bull = hf_gltf::read_gltf(creature("bull"));
  const hf_gltf::FlatMesh from = hf_gltf::flatten(horse), to = hf_gltf::flatten(bull);
  const fs::path place = folder() / "sequence";
  fs::remove_all(place);
  fs::create_directories(place);
  const auto mesh = [](const hf_gltf::FlatMesh& flat, const std::vector<glm::dvec3>& positions) {
    samples::SurfaceMesh out;
    out.positions = positions;
    out.triangles = flat.triangles;
    return out;
  };
  samples::write_mesh_file(mesh(from, from.positions), place / "horse.obj");
  samples::write_mesh_file(mesh(to, to.positions), place / "bull.ply");
  std::string poses;
  for (int f = 0; f < 4; ++f) {
    const fs::path file = place / ("pose" + std::to_string(f) + (f % 2 ? ".obj" : ".ply"));
    samples::write_mesh_file(mesh(from, hf_gltf::posed_positions(horse, from, horse.animations[0], f * 0.1)), file);
    poses += " " + quoted(file);
  }
  std::string said;
  ASSERT_EQ(transfer("--source " + quoted(place / "horse.obj") + " --poses" + poses + " --target " +
                         quoted(place / "bull.ply") + " --suggest-pairs " + quoted(place / "pairs.json"),
                     said),
            0)
      << said;
  ASSERT_EQ(transfer("--source " + quoted(place / "horse.obj") + " --poses" + poses + " --target " +
                         quoted(place / "bull.ply") + " --pairs " + quoted(place / "pairs.json") + " --out-poses " +
                         quoted(place / "out"),
                     said),
            0)
      << said;
  ASSERT_EQ(
      transfer(both() + " --pairs " + quoted(place / "pairs.json") + " --fps 10 --out-poses " + quoted(place / "clip"),
               said),
      0)
      << said;
  double box = 0;
  for (const glm::dvec3& p : to.positions) box = std::max(box, glm::length(p - to.positions[0]));
  for (int f = 0; f < 4; ++f) {
    const std::string number = "_000" + std::to_string(f) + ".ply";
    const samples::SurfaceMesh got = samples::read_mesh_file(place / "out" / ("pose" + number)),
                               clip = samples::read_mesh_file(place / "clip" / (horse.animations[0].name + number));
    ASSERT_EQ(got.positions.size(), to.positions.size());
    EXPECT_EQ(got.triangles, to.triangles);
    double worst = 0;
    for (size_t v = 0; v < got.positions.size(); ++v)
      worst = std::max(worst, glm::distance(got.positions[v], clip.positions[v]));
    EXPECT_LT(worst, 1e-4 * box) << f;
  }
  // a pose with another number of vertices is named
  EXPECT_EQ(transfer("--source " + quoted(place / "horse.obj") + " --poses " + quoted(place / "bull.ply") +
                         " --target " + quoted(place / "bull.ply") + " --pairs " + quoted(place / "pairs.json") +
                         " --out-poses " + quoted(place / "bad"),
                     said),
            1);
  EXPECT_NE(said.find("bull.ply"), std::string::npos) << said;
}

TEST(TransferOutputs, HalfWayBetweenKeysTheFileIsNearTheSolver) {
  // the file at 30 keys a second, played at 60; the solver's own frames at 60
  const fs::path file = folder() / "thirty.glb", frames = folder() / "sixty";
  fs::remove_all(frames);
  const std::string start = both() + " --pairs " + quoted(horse_to_bull());
  std::string said;
  ASSERT_EQ(transfer(start + " --fps 30 --as skin --key-tolerance 0 -o " + quoted(file), said), 0) << said;
  ASSERT_EQ(transfer(start + " --fps 60 --out-poses " + quoted(frames), said), 0) << said;
  const hf_gltf::Model made = hf_gltf::read_gltf(file);
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(made);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(frames)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GT(files.size(), 20u);
  double at_keys = 0, between = 0;
  for (size_t f = 0; f + 1 < files.size(); ++f) {
    const samples::SurfaceMesh expected = samples::read_mesh_file(files[f]);
    const std::vector<glm::dvec3> got =
        hf_gltf::posed_positions(made, mesh, made.animations[0], static_cast<double>(f) / 60);
    ASSERT_EQ(got.size(), expected.positions.size());
    double sum = 0, largest = 0;
    for (size_t v = 0; v < got.size(); ++v) {
      const double d = glm::distance(got[v], expected.positions[v]) / glm::length(high - low);
      sum += d * d / static_cast<double>(got.size());
      largest = std::max(largest, d);
    }
    if (f % 2 == 0) at_keys = std::max(at_keys, largest);
    if (f % 2 == 1) between = std::max(between, std::sqrt(sum));
  }
  std::printf("file against solver: at keys %.1e of the box, half-way between keys %.5f\n", at_keys, between);
  EXPECT_LT(at_keys, 1e-5);
  EXPECT_LT(between, 0.003);
}

TEST(TransferOutputs, KeysThatFollowFromOthersAreLeftOutWithinTheBound) {
  const fs::path whole = folder() / "all_keys.glb", few = folder() / "few_keys.glb",
                 report = folder() / "few_keys.json";
  const std::string start = both() + " --pairs " + quoted(horse_to_bull()) + " --fps 30 ";
  std::string said;
  ASSERT_EQ(transfer(start + "--key-tolerance 0 -o " + quoted(whole), said), 0) << said;
  ASSERT_EQ(transfer(start + "-o " + quoted(few) + " --json " + quoted(report), said), 0) << said;
  const json figures = read_json(report);
  EXPECT_EQ(figures["written_as"], "own-skin");
  EXPECT_LT(figures["keys"].get<int>(), figures["all_keys"].get<int>());
  const hf_gltf::Model a = hf_gltf::read_gltf(whole), b = hf_gltf::read_gltf(few);
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(a);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  for (const double time : hf_gltf::key_times(a.animations[0])) {
    const std::vector<glm::dvec3> wanted = hf_gltf::posed_positions(a, mesh, a.animations[0], time),
                                  got = hf_gltf::posed_positions(b, mesh, b.animations[0], time);
    for (size_t v = 0; v < got.size(); ++v)
      ASSERT_LT(glm::distance(got[v], wanted[v]), 0.0005 * glm::length(high - low)) << v << " at " << time;
  }
}

TEST(TransferOutputs, ClipsOfARealAnimalTakeFewBytes) {
  if (!fs::exists(data() / "q_Horse.glb") || !fs::exists(data() / "q_Wolf.glb"))
    GTEST_SKIP() << "no q_Horse.glb or q_Wolf.glb under " << data();
  // what the wolf takes without the new clips
  const size_t alone = hf_gltf::gltf_bytes(hf_gltf::read_gltf(data() / "q_Wolf.glb"), true).size();
  const auto bytes = [&](const std::string& clip) {
    const fs::path out = folder() / "bytes.glb";
    std::string said;
    EXPECT_EQ(transfer(quoted(data() / "q_Horse.glb") + " " + quoted(data() / "q_Wolf.glb") + " --pairs " +
                           quoted(pairs("q_horse_to_q_wolf.json")) + " --clip " + clip + " -o " + quoted(out),
                       said),
              0)
        << said;
    return static_cast<size_t>(fs::file_size(out)) - alone;
  };
  const size_t walk = bytes("Walk");
  std::printf("a walk takes %zu bytes\n", walk);
  EXPECT_LT(walk, 120000u);
  if (!hf_test::is_full()) return;
  const size_t all = bytes("all");
  std::printf("thirteen clips take %zu bytes\n", all);
  EXPECT_LT(all, 600000u);
}

// A body whose morph target moves few vertices keeps it sparse beside a new clip.
TEST(TransferOutputs, SparseMorphTargetsStaySparse) {
  hf_gltf::Model bull = hf_gltf::read_gltf(creature("bull"));
  hf_gltf::Primitive& primitive = bull.meshes.front().primitives.front();
  hf_gltf::MorphTarget blink;
  blink.positions.assign(primitive.positions.size(), glm::vec3(0));
  blink.positions[7] = glm::vec3(0.1f, 0, 0);
  primitive.targets.push_back(blink);
  const fs::path target = folder() / "sparse_bull.glb", out = folder() / "sparse_out.glb";
  hf_gltf::write_gltf(bull, target);
  std::string said;
  ASSERT_EQ(transfer(quoted(creature("horse")) + " " + quoted(target) + " --pairs " +
                         quoted(pairs("horse_to_bull.json")) + " -o " + quoted(out),
                     said),
            0)
      << said;
  std::ifstream file(out, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  uint32_t length = 0;
  std::copy(all.begin() + 12, all.begin() + 16, reinterpret_cast<char*>(&length));
  const json root = json::parse(all.substr(20, length));
  const size_t accessor = root["meshes"][0]["primitives"][0]["targets"][0]["POSITION"];
  EXPECT_EQ(root["accessors"][accessor]["sparse"]["count"], 1);
  EXPECT_EQ(hf_gltf::read_gltf(out).meshes.front().primitives.front().targets.front().positions[7], blink.positions[7]);
}

TEST(TransferOutputs, FeetComeFromNamesAndBodiesWithoutFeetFromTheirEnds) {
  if (!fs::exists(data() / "q_Horse.glb") || !fs::exists(data() / "q_Manta_ray.glb"))
    GTEST_SKIP() << "no q_Horse.glb or q_Manta_ray.glb under " << data();
  const auto proposed = [&](const char* source, const char* target) {
    const fs::path list = folder() / "named.json";
    std::string said;
    EXPECT_EQ(
        transfer(quoted(data() / source) + " " + quoted(data() / target) + " --suggest-pairs " + quoted(list), said), 0)
        << said;
    std::set<std::string> names;
    const json file = read_json(list);
    for (const json& pair : file["pairs"]) names.insert(pair["name"].get<std::string>());
    return names;
  };
  // the joints of its inverse kinematics own the hoofs: four feet all the same
  const std::set<std::string> horse = proposed("q_Horse.glb", "q_Horse.glb");
  for (const char* name : {"front foot left", "front foot right", "hind foot left", "hind foot right"})
    EXPECT_EQ(horse.count(name), 1u) << name;
  EXPECT_EQ(horse.count("middle foot 1 left"), 0u);
  EXPECT_GE(proposed("q_Horse.glb", "q_Manta_ray.glb").size(), 4u);
}

TEST(TransferOutputs, TravelIsTakenOutAndSwayAndHeightStay) {
  const glm::dvec3 up(0, 1, 0);
  const std::vector<double> times = {0, 0.1, 0.4, 1};
  std::vector<std::vector<double>> still, travels;
  for (const double t : times) {
    const double sway = 0.2 * std::sin(3.14159265358979323846 * t), rise = 0.5 * t;
    still.push_back({sway, rise, 0, sway + 1, rise, 2});
    travels.push_back({sway + 3 * t, rise, -4 * t, sway + 1 + 3 * t, rise, 2 - 4 * t, 1e5 * t, 0, 0});
  }
  samples::take_travel(times, up, {0, 0, 1}, travels);  // the third vertex is loose and does not count
  for (size_t f = 0; f < times.size(); ++f)
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(travels[f][i], still[f][i], 1e-12) << f << " " << i;
  std::vector<std::vector<double>> one = {{1, 2, 3}};
  samples::take_travel({0}, up, {0}, one);
  EXPECT_EQ(one[0], (std::vector<double>{1, 2, 3}));
}

TEST(TransferOutputs, InPlaceIsAnOptionOfTheProgram) {
  // The horse walks away: where its topmost joint is, is keyed anew.
  hf_gltf::Model horse = hf_gltf::read_gltf(creature("horse"));
  hf_gltf::Animation& walk = horse.animations[static_cast<size_t>(hf_gltf::find_animation(horse, "walk"))];
  int top = horse.skins.front().joints.front();
  const auto is_joint = [&](int node) {
    const std::vector<int>& joints = horse.skins.front().joints;
    return std::find(joints.begin(), joints.end(), node) != joints.end();
  };
  while (is_joint(horse.nodes[static_cast<size_t>(top)].parent)) top = horse.nodes[static_cast<size_t>(top)].parent;
  walk.channels.erase(std::remove_if(walk.channels.begin(), walk.channels.end(),
                                     [&](const hf_gltf::Channel& channel) {
                                       return channel.node == top && channel.path == hf_gltf::Path::translation;
                                     }),
                      walk.channels.end());
  hf_gltf::Channel travels_on;
  travels_on.node = top;
  travels_on.times = {0, static_cast<float>(hf_gltf::clip_duration(walk))};
  const glm::vec3 at = horse.nodes[static_cast<size_t>(top)].translation;
  travels_on.values = {at.x, at.y, at.z, at.x, at.y, at.z + 2};
  walk.channels.push_back(travels_on);
  const fs::path walker = folder() / "walks_away.glb";
  hf_gltf::write_gltf(horse, walker);
  const auto travel = [&](const std::string& more, const char* name) {
    const fs::path out = folder() / name;
    std::string said;
    EXPECT_EQ(transfer(quoted(walker) + " " + quoted(creature("bull")) + " --clip walk --pairs " +
                           quoted(pairs("horse_to_bull.json")) + " --as own-skin -o " + quoted(out) + more + few_frames,
                       said),
              0)
        << said;
    const hf_gltf::Model model = hf_gltf::read_gltf(out);
    const hf_gltf::FlatMesh mesh = hf_gltf::flatten(model);
    const hf_gltf::Animation& clip = model.animations.front();
    glm::dvec3 path(0);
    const auto last = hf_gltf::posed_positions(model, mesh, clip, hf_gltf::clip_duration(clip)),
               first = hf_gltf::posed_positions(model, mesh, clip, 0);
    for (size_t v = 0; v < last.size(); ++v) path += (last[v] - first[v]) / static_cast<double>(last.size());
    return std::hypot(path.x, path.z);
  };
  const double walks = travel("", "travels.glb"), stays = travel(" --in-place", "stays.glb");
  std::printf("the walk travels by %.4f, in place by %.4f\n", walks, stays);
  EXPECT_GT(walks, 0.5);
  EXPECT_LT(stays, 0.02 * walks);
  // The travel as a motion of the root: the same body at every time, under two keys.
  const double moved = travel(" --root-motion", "root.glb");
  EXPECT_NEAR(moved, walks, 0.01 * walks);
  const hf_gltf::Model there = hf_gltf::read_gltf(folder() / "root.glb"),
                       plain = hf_gltf::read_gltf(folder() / "stays.glb");
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(there);
  int root = there.skins.front().joints.front();
  while (there.nodes[static_cast<size_t>(root)].parent >= 0) root = there.nodes[static_cast<size_t>(root)].parent;
  const hf_gltf::Animation &clip = there.animations.front(), &still = plain.animations.front();
  const auto channel = std::find_if(clip.channels.begin(), clip.channels.end(), [&](const hf_gltf::Channel& c) {
    return c.node == root && c.path == hf_gltf::Path::translation;
  });
  ASSERT_NE(channel, clip.channels.end());
  for (const double time : {0.0, 0.4, 1.0}) {
    const auto a = hf_gltf::posed_positions(there, mesh, clip, time),
               b = hf_gltf::posed_positions(plain, mesh, still, time);
    const glm::dvec3 shift = a[0] - b[0];
    EXPECT_NEAR(glm::length(shift), moved * time / hf_gltf::clip_duration(clip), 0.02 * moved);
    for (size_t v = 0; v < a.size(); ++v) ASSERT_LT(glm::distance(a[v] - b[v], shift), 1e-5);
  }
  std::string said;
  EXPECT_EQ(transfer(both() + " --pairs " + quoted(pairs("horse_to_bull.json")) + " --as morph --root-motion -o " +
                         quoted(folder() / "no_root.glb"),
                     said),
            1);
  EXPECT_NE(said.find("--root-motion"), std::string::npos) << said;
}

// A node turns the whole model: then its z is up, it lies on its side or on its back. The motion is the same.
TEST(TransferOutputs, AModelThatLiesOrWhoseZIsUpIsFoundByItsLegs) {
  const hf_gltf::Model horse = hf_gltf::read_gltf(creature("horse"));
  std::string said;
  const auto frames = [&](const fs::path& source, const char* name) {
    const fs::path place = folder() / name;
    fs::remove_all(place);
    EXPECT_EQ(
        transfer(quoted(source) + " " + quoted(creature("bull")) + " --fps 10 --out-poses " + quoted(place), said), 0)
        << said;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(place)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<glm::dvec3> out;
    for (const fs::path& file : files)
      for (const glm::dvec3& p : samples::read_mesh_file(file).positions) out.push_back(p);
    return out;
  };
  const std::vector<glm::dvec3> upright = frames(creature("horse"), "upright");
  ASSERT_FALSE(upright.empty());
  struct Turn {
    glm::vec3 axis;
    float angle;
    const char* up;
  };
  const float half = 1.57079632679f;
  for (const Turn& turn : {Turn{{1, 0, 0}, half, "+z"}, Turn{{0, 0, 1}, half, "-x"}, Turn{{0, 0, 1}, 2 * half, "-y"}}) {
    hf_gltf::Model turned = horse;
    hf_gltf::Node top;
    top.name = "top";
    top.rotation = glm::angleAxis(turn.angle, turn.axis);
    top.children = turned.scene_roots;
    const int number = static_cast<int>(turned.nodes.size());
    for (const int root : turned.scene_roots) turned.nodes[static_cast<size_t>(root)].parent = number;
    turned.nodes.push_back(top);
    turned.scene_roots = {number};
    if (!turned.scenes.empty()) turned.scenes[turned.shown_scene].roots = {number};
    const fs::path file = folder() / "turned_horse.glb";
    hf_gltf::write_gltf(turned, file);
    const std::vector<glm::dvec3> got = frames(file, "turned");
    EXPECT_NE(said.find(std::string("up ") + turn.up + " from the skeleton"), std::string::npos) << said;
    ASSERT_EQ(got.size(), upright.size());
    double worst = 0;
    for (size_t v = 0; v < got.size(); ++v) worst = std::max(worst, glm::distance(got[v], upright[v]));
    EXPECT_LT(worst, 1e-3) << turn.up;  // boxes of some 3; joints are floats
  }
}

// The bull with a morph target, a camera, a lamp, extras and copyright.
hf_gltf::Model rich_bull() {
  hf_gltf::Model bull = hf_gltf::read_gltf(creature("bull"));
  hf_gltf::MeshData& mesh = bull.meshes.front();
  for (hf_gltf::Primitive& primitive : mesh.primitives) {
    hf_gltf::MorphTarget blink;
    blink.positions.assign(primitive.positions.size(), glm::vec3(0));
    blink.positions[7] = glm::vec3(0.1f, 0, 0);
    primitive.targets.push_back(blink);
  }
  mesh.target_names = {"blink"};
  mesh.weights = {0.5f};
  bull.asset = R"({"copyright":"somebody","extras":{"seen":true}})";
  bull.cameras = {R"({"type":"perspective","perspective":{"yfov":0.7,"znear":0.1}})"};
  bull.carried.extensions = R"({"KHR_lights_punctual":{"lights":[{"type":"point","name":"lamp"}]}})";
  hf_gltf::Node camera, lamp;
  camera.name = "eye";
  camera.camera = 0;
  camera.translation = {0, 0.5f, 0};
  camera.carried.extras = R"({"lens":35})";
  const int head = hf_gltf::find_node(bull, "head");
  camera.parent = head;
  bull.nodes[static_cast<size_t>(head)].children.push_back(static_cast<int>(bull.nodes.size()));
  bull.nodes.push_back(camera);
  lamp.name = "lamp";
  lamp.translation = {0, 9, 0};
  lamp.carried.extensions = R"({"KHR_lights_punctual":{"light":0}})";
  const int number = static_cast<int>(bull.nodes.size());
  bull.scene_roots.push_back(number);
  for (hf_gltf::Scene& scene : bull.scenes) scene.roots.push_back(number);
  bull.nodes.push_back(lamp);
  return bull;
}

TEST(TransferOutputs, WhatAFileHoldsBesideItsShapeStaysOrIsNamed) {
  const fs::path target = folder() / "rich_bull.glb";
  hf_gltf::write_gltf(rich_bull(), target);
  const hf_gltf::Model given = hf_gltf::read_gltf(target);
  const auto place_of = [](const hf_gltf::Model& model, const char* name) {
    const int node = hf_gltf::find_node(model, name);
    EXPECT_GE(node, 0) << name;
    return node < 0
               ? glm::dvec3(0)
               : glm::dvec3(hf_gltf::global_matrices(model, hf_gltf::rest_pose(model))[static_cast<size_t>(node)][3]);
  };
  for (const std::string kind : {"own-skin", "skin", "morph"}) {
    const fs::path out = folder() / ("rich_" + kind + ".glb");
    std::string said;
    ASSERT_EQ(transfer(quoted(creature("horse")) + " " + quoted(target) + " --pairs " + quoted(horse_to_bull()) +
                           " --as " + kind + " -o " + quoted(out),
                       said),
              0)
        << said;
    const hf_gltf::Model made = hf_gltf::read_gltf(out);
    EXPECT_EQ(json::parse(made.asset)["copyright"], "somebody") << kind;
    EXPECT_EQ(json::parse(made.asset)["extras"]["seen"], true) << kind;
    EXPECT_EQ(made.cameras, given.cameras) << kind;
    EXPECT_EQ(json::parse(made.carried.extensions), json::parse(given.carried.extensions)) << kind;
    for (const char* name : {"eye", "lamp"})
      EXPECT_LT(glm::distance(place_of(made, name), place_of(given, name)), 1e-5) << kind << " " << name;
    const hf_gltf::Node& eye = made.nodes[static_cast<size_t>(hf_gltf::find_node(made, "eye"))];
    EXPECT_EQ(eye.camera, 0) << kind;
    EXPECT_EQ(json::parse(eye.carried.extras)["lens"], 35) << kind;
    const bool clips_stay = made.animations.size() == 1 + given.animations.size();
    EXPECT_EQ(clips_stay, said.find("--as own-skin keeps them") == std::string::npos) << kind << said;
    if (kind == "morph") continue;
    // the same surface at rest under every weight of the morph target
    const hf_gltf::FlatMesh a = hf_gltf::flatten(given), b = hf_gltf::flatten(made);
    ASSERT_EQ(made.meshes.front().target_names, given.meshes.front().target_names) << kind;
    for (const double weight : {0.0, 0.5, 1.0}) {
      hf_gltf::Pose wanted = hf_gltf::rest_pose(given), got = hf_gltf::rest_pose(made);
      for (hf_gltf::Pose* pose : {&wanted, &got})
        for (hf_gltf::NodePose& node : *pose)
          if (!node.weights.empty()) node.weights = {weight};
      const auto from = hf_gltf::posed_positions(given, a, wanted), to = hf_gltf::posed_positions(made, b, got);
      ASSERT_EQ(from.size(), to.size());
      for (size_t v = 0; v < from.size(); ++v) ASSERT_LT(glm::distance(from[v], to[v]), 1e-5) << kind << " " << v;
    }
  }
}

// All weights on one joint: the own skin can only move the bull as a whole, so its sheet is another.
TEST(TransferOutputs, TheSheetDrawsWhatWasWritten) {
  hf_gltf::Model stiff = hf_gltf::read_gltf(creature("bull"));
  for (hf_gltf::Primitive& primitive : stiff.meshes.front().primitives)
    for (hf_gltf::Influences& influences : primitive.influences) {
      influences = {};
      influences.weights[0] = 1;
    }
  const fs::path target = folder() / "stiff_bull.glb", list = folder() / "stiff.json";
  hf_gltf::write_gltf(stiff, target);
  std::string said;
  const std::string files = quoted(creature("horse")) + " " + quoted(target);
  // places, since the joints own nothing now
  ASSERT_EQ(transfer(files + " --suggest-pairs " + quoted(list), said), 0) << said;
  const auto sheet = [&](const std::string& kind) {
    const fs::path picture = folder() / ("stiff_" + kind + ".png");
    EXPECT_EQ(transfer(files + " --pairs " + quoted(list) + few_frames + " --as " + kind + " -o " +
                           quoted(folder() / "stiff_out.glb") + " --sheet " + quoted(picture),
                       said),
              0)
        << said;
    std::ifstream bytes(picture, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(bytes), {});
  };
  const std::string own = sheet("own-skin"), skin = sheet("skin");
  EXPECT_GT(own.size(), 500u);
  EXPECT_NE(own, skin);
  if (!hf_test::is_full()) return;
  EXPECT_EQ(skin, sheet("skin"));
}

TEST(TransferOutputs, TheLiveSampleRunsWhileItsHandlesChange) {
  std::string said;
  ASSERT_EQ(run(quoted(HF_LIVE_TRANSFER_PROGRAM), said), 0) << said;
  EXPECT_NE(said.find("frame 55"), std::string::npos) << said;
}

}  // namespace
