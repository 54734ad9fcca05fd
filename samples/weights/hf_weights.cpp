// hf_weights: computes the skin weights of a model anew and compares them with those it had. See README.md beside this
// file, or --help.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "common/program.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/json_file.h"
#include "weights/carried.h"
#include "weights/compare.h"
#include "weights/guide.h"
#include "weights/skeleton_from.h"

namespace samples {

using namespace hf_gltf;
namespace {

const char* const usage =
    "usage: hf_weights MODEL.glb [-o OUT.glb] [--bones FILE] [--pins FILE] [--keep JOINTS] [--weights 4|8]\n"
    "                  [--all] [--guide N] [--carry FROM.glb] [--mirror negative|positive|both]\n"
    "                  [--skeleton OTHER.glb [--pairs FILE]] [--bend JOINT,AXIS,DEGREES]\n"
    "                  [--sheet FILE.png] [--report FILE.json] [--table]\n"
    "  Computes the weights of a skinned model from its joints, and compares them with the weights of the file.\n"
    "  -o, --output FILE  the model with the new weights\n"
    "  --bones FILE       bones in place of joints: {\"bones\": [{\"joint\": \"arm\", \"head\": [x, y, z],\n"
    "                     \"tail\": [x, y, z], \"deforms\": true}, ...]}; joints that are not named stay\n"
    "  --pins FILE        {\"pins\": [{\"vertex\": 12, \"radius\": 0.1, \"weights\": {\"arm\": 1}}, ...]}; without\n"
    "                     weights, the weights of the file\n"
    "  --keep JOINTS      joints, separated by commas, that keep the weights of the file\n"
    "  --weights N        joints per vertex, 4 or 8 (4)\n"
    "  --guide N          sets N pins with the weights of the file, among the vertices where the pose is farthest off\n"
    "  --all              all joints deform; else those that have weights in the file\n"
    "  --carry FROM.glb   takes the weights of another model in the same place; a model without joints gets its "
    "joints\n"
    "  --mirror SIDE      mirrors the weights of the file to a side of the plane of symmetry, or takes the mean of "
    "both\n"
    "  --skeleton FILE    a model without joints gets the joints of another, at the nodes with their names, "
    "or where\n"
    "                     --pairs (a pairs file of hf_transfer) leads, and between by the boxes\n"
    "  --helpers          prints the joints that look like helpers, and why; use it with --all\n"
    "  --bend JOINT,AXIS,DEGREES  poses the model by turning a joint about its x, y or z, in place of the clips; may "
    "be\n"
    "                     given several times\n"
    "  --sheet FILE       a picture: weights given, computed, their difference\n"
    "  --report FILE      counts, distances and times as JSON\n"
    "  --table            prints one line\n"
    "  --work-limit N     refuse a factorisation of more than N * 10^9 operations (default: by the size)\n"
    "  --memory-limit N   refuse a surface that holds more than N MiB (default: by the size)\n";

struct Command {
  std::filesystem::path mesh, out, bones, pins, sheet, report, carry, skeleton, pairs;
  std::string keep;
  std::vector<std::string> bends;
  uint32_t weights = 4, guide = 0;
  int32_t mirror = -1;
  bool all = false, table = false, helpers = false, help = false;
};

Command parse(Words words) {
  Command out;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      out.help = true;
    } else if (words.is("-o", "--output")) {
      out.out = words.file();
    } else if (words.is("--bones")) {
      out.bones = words.file();
    } else if (words.is("--pins")) {
      out.pins = words.file();
    } else if (words.is("--keep")) {
      out.keep = words.value();
    } else if (words.is("--weights")) {
      out.weights = words.whole(4, 8);
    } else if (words.is("--guide")) {
      out.guide = words.whole(1, 1000);
    } else if (words.is("--all")) {
      out.all = true;
    } else if (words.is("--sheet")) {
      out.sheet = words.file();
    } else if (words.is("--report")) {
      out.report = words.file();
    } else if (words.is("--carry")) {
      out.carry = words.file();
    } else if (words.is("--skeleton")) {
      out.skeleton = words.file();
    } else if (words.is("--pairs")) {
      out.pairs = words.file();
    } else if (words.is("--mirror")) {
      const std::string side = words.value();
      out.mirror = side == "negative"   ? HF_MIRROR_TO_NEGATIVE
                   : side == "positive" ? HF_MIRROR_TO_POSITIVE
                   : side == "both"     ? HF_MIRROR_BOTH
                                        : -1;
      if (out.mirror < 0) throw std::runtime_error("--mirror: negative, positive or both, not " + side);
    } else if (words.is("--bend")) {
      out.bends.push_back(words.value());
    } else if (words.is("--helpers")) {
      out.helpers = true;
    } else if (words.is("--table")) {
      out.table = true;
    } else if (words.take_limit()) {
      continue;
    } else {
      words.take_mesh(out.mesh);
    }
  }
  if (!out.help && out.mesh.empty()) throw std::runtime_error("no model is named; see --help");
  if (!out.carry.empty() && out.mirror >= 0) throw std::runtime_error("--carry and --mirror are both set; set one");
  if (!out.pairs.empty() && out.skeleton.empty()) throw std::runtime_error("--pairs needs --skeleton");
  return out;
}

void read_bones(const std::filesystem::path& file, Rig& rig) {
  const JsonFile json(file);
  const JsonReader list = json.root().at("bones");
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonReader entry = list.at(i);
    entry.expect_only({"joint", "head", "tail", "deforms"});
    const uint32_t joint = joint_named(rig, entry.at("joint").string());
    const auto place = [&](const char* key, std::vector<double>& points) {
      if (!entry.has(key)) return;
      if (points.empty()) points = rig.bones.heads;
      const std::vector<double> p = entry.at(key).numbers(3);
      std::copy(p.begin(), p.end(), points.begin() + static_cast<std::ptrdiff_t>(3 * joint));
    };
    place("head", rig.bones.heads);
    place("tail", rig.bones.tails);
    if (!rig.bones.tails.empty()) rig.bones.axes.clear();
    rig.bones.deforms[joint] = entry.boolean_or("deforms", rig.bones.deforms[joint] != 0);
  }
}

void set_locks(hf::Weights& weights, const std::string& names, const Rig& rig) {
  std::vector<uint32_t> joints;
  for (size_t begin = 0; begin <= names.size();) {
    const size_t end = std::min(names.find(',', begin), names.size());
    joints.push_back(joint_named(rig, names.substr(begin, end - begin)));
    begin = end + 1;
  }
  std::vector<float> values(rig.positions.size() * joints.size(), 0.0f);
  for (size_t i = 0; i < rig.given.joints.size(); ++i) {
    const size_t v = i / rig.given.per_vertex;
    for (size_t j = 0; j < joints.size(); ++j) {
      if (rig.given.joints[i] != joints[j]) continue;
      float& value = values[v * joints.size() + j];
      value = std::min(1.0f, value + rig.given.weights[i]);
    }
  }
  weights.set_locks(joints, values);
}

double milliseconds(const std::chrono::steady_clock::time_point& begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

constexpr std::pair<uint32_t, const char*> reason_names[] = {{HF_HELPER_NAME_ROOT, "named root"},
                                                             {HF_HELPER_NAME_CONTROL, "named control"},
                                                             {HF_HELPER_NAME_END, "named end"},
                                                             {HF_HELPER_ROOT, "root"},
                                                             {HF_HELPER_APART, "apart"},
                                                             {HF_HELPER_NO_LENGTH, "no length"},
                                                             {HF_HELPER_COINCIDENT, "coincident"},
                                                             {HF_HELPER_OUTSIDE, "outside"},
                                                             {HF_HELPER_INFORMS_NONE, "informs none"}};

nlohmann::json reasons_of(uint32_t reasons) {
  nlohmann::json out = nlohmann::json::array();
  for (const auto& [bit, name] : reason_names) {
    if (reasons & bit) out.push_back(name);
  }
  return out;
}

// One line for each joint that is proposed as a helper, and whether the file gives it weights.
void print_helpers(const Rig& rig, const hf::Weights& weights) {
  const std::vector<uint32_t> reasons = weights.helpers(rig.names);
  std::vector<uint8_t> weighted(rig.names.size(), 0);
  for (size_t i = 0; i < rig.given.joints.size(); ++i) weighted[rig.given.joints[i]] |= rig.given.weights[i] > 0;
  for (size_t j = 0; j < rig.joint_count(); ++j)
    std::printf("joint %s %s %s %u %s\n", rig.names[j].c_str(), weighted[j] ? "weighted" : "bare",
                (reasons[j] & HF_HELPER_PROPOSED) ? "proposed" : "-", reasons[j],
                reasons_of(reasons[j]).dump().c_str());
}

nlohmann::json report_of(const Command& options, const Rig& rig, const hf::Weights& weights, const Comparison& found,
                         double surface_ms, double weights_ms) {
  // A moved bone and a pin, each with the new weights out.
  hf::Weights edited = weights.clone();
  hf::Joints moved = rig.bones;
  moved.heads[0] += 0.01 * rig.diagonal;
  const auto begin = std::chrono::steady_clock::now();
  edited.set_joints(moved);
  edited.weights();
  const double bone_ms = milliseconds(begin);
  PinFile pin;
  add_given(rig, rig.positions.size() / 2, 0, pin);
  const auto middle = std::chrono::steady_clock::now();
  set_pins(edited, pin);
  edited.weights();
  const double pin_ms = milliseconds(middle);
  const hf_weights_info info = weights.info();
  const hf_weights_statistics work = weights.statistics();
  nlohmann::json out;
  out["model"] = options.mesh.filename().string();
  out["vertices"] = info.vertex_count;
  out["joints"] = rig.joint_count();
  out["ends"] = rig.end_count;
  out["distance"] = {{"mean", found.mean}, {"high", found.high}, {"worst", found.worst}};
  out["stretch"] = found.stretch;
  out["bare"] = found.bare;
  out["milliseconds"] = {{"surface", surface_ms}, {"weights", weights_ms}, {"bone", bone_ms}, {"pin", pin_ms}};
  out["found"] = {{"informed", info.informed_count},    {"solved", info.solved_count},
                  {"pinned", info.pinned_count},        {"carried", info.nearest_count},
                  {"rigid", info.rigid_count},          {"isolated", info.isolated_count},
                  {"pieces", work.nearest_piece_count}, {"blind", work.blind}};
  const auto [flags, counts] = weights.joints();
  const std::vector<uint32_t> reasons = weights.helpers(rig.names);
  out["bones"] = nlohmann::json::array();
  for (size_t j = 0; j < rig.joint_count(); ++j)
    out["bones"].push_back({{"joint", rig.names[j]},
                            {"deforms", rig.bones.deforms[j]},
                            {"flags", flags[j]},
                            {"vertices", counts[j]},
                            {"helper", (reasons[j] & HF_HELPER_PROPOSED) != 0},
                            {"reasons", reasons_of(reasons[j])}});
  return out;
}

// The model, with the skeleton of another if it has none. given: whether the file has weights. rigs: one a skeleton.
Model read_model(const Command& options, std::vector<Rig>& rigs, bool& given) {
  Model model = read_gltf(options.mesh);
  const std::filesystem::path& other = options.skeleton.empty() ? options.carry : options.skeleton;
  if (other.empty() || (options.skeleton.empty() && !model.skins.empty())) {
    for (const std::vector<int>& skins : skeletons_of(model)) {
      rigs.push_back(read_rig(model, skins));
      if (rigs.back().positions.empty()) rigs.pop_back();
    }
    if (rigs.empty()) throw std::runtime_error(model.name + ": no triangle has joints");
    return model;
  }
  given = false;
  if (!model.skins.empty())
    throw std::runtime_error(model.name + ": the model has joints; --skeleton is for one without");
  const Model source = read_gltf(other);
  std::vector<Landmark> landmarks = name_landmarks(source, model);
  if (!options.pairs.empty()) {
    for (const Landmark& mark : pair_landmarks(options.pairs, source, model)) landmarks.push_back(mark);
  }
  // Weights are carried between models in one place, so the joints stay where they are.
  if (options.skeleton.empty()) landmarks = {};
  TakenSkeleton taken = take_skeleton(source, model, landmarks, options.skeleton.empty());
  rigs.push_back(read_rig(taken.model));
  Rig& rig = rigs.back();
  std::copy_n(taken.deforms.begin(), std::min(taken.deforms.size(), rig.bones.deforms.size()),
              rig.bones.deforms.begin());
  return std::move(taken.model);
}

// Joints of this share or more outside the mesh: the skeleton is of another build. Own skeletons of 36 public models
// have 15 % at most (a spider), skeletons of other bodies 37 % to 77 %. Half warns of long legs; double misses most.
constexpr uint32_t misfit_divisor = 4;

void warn_of_misfit(uint32_t outside, size_t joints) {
  if (outside * misfit_divisor < joints) return;
  std::fprintf(stderr,
               "warning: %u of %zu joints lie outside the mesh, so the skeleton does not fit this body; give --pairs "
               "with places such as hands, elbows, knees and feet, or move joints with --bones\n",
               outside, joints);
}

// What is made of one skeleton and the parts that it moves.
struct Made {
  RigWeights weights;
  nlohmann::json report;
};

// name: of the rig, in what is printed. sheet: the picture, or empty.
Made make_weights(const Command& options, const Model& model, Rig& rig, bool given, const std::string& name,
                  const std::filesystem::path& sheet) {
  if (options.all) std::fill_n(rig.bones.deforms.begin(), static_cast<std::ptrdiff_t>(rig.joint_count()), 1);
  if (!options.bones.empty()) read_bones(options.bones, rig);
  const auto begin = std::chrono::steady_clock::now();
  const hf::Surface surface = surface_of(rig, rig.positions);
  const double surface_ms = milliseconds(begin);
  const auto middle = std::chrono::steady_clock::now();
  hf::Weights weights(surface, rig.bones, options.weights);
  const double weights_ms = milliseconds(middle);
  if (!options.keep.empty()) set_locks(weights, options.keep, rig);
  if (!options.pins.empty()) set_pins(weights, read_pins(options.pins, rig));
  const std::vector<Pose> poses =
      options.bends.empty() ? clip_poses(model, rig) : std::vector<Pose>{bent_pose(model, rig, options.bends)};
  if (options.guide > 0)
    guide(model, rig, poses, options.guide, options.pins.empty() ? PinFile{} : read_pins(options.pins, rig), weights);
  CarriedWeights carried;
  if (!options.carry.empty()) carried = carry_from(read_gltf(options.carry), model, rig, options.weights);
  if (options.mirror >= 0) carried = mirror_given(surface, rig, options.mirror, options.weights);
  Made made;
  made.weights = carried.line.empty() ? weights_of(weights) : carried.weights;
  if (options.helpers) print_helpers(rig, weights);
  const Comparison found = compare(model, rig, poses, made.weights);
  const hf_weights_info info = weights.info();
  const hf_weights_statistics work = weights.statistics();
  if (!options.skeleton.empty()) warn_of_misfit(work.outside_count, rig.joint_count());
  if (options.table) {
    std::printf("%-26s %6u %4zu %7.3f %7.3f %6.3f %4u %5u %5u %7.1f %7.1f\n", name.c_str(), info.vertex_count,
                rig.joint_count(), found.mean, found.high, found.stretch, found.bare,
                info.nearest_count + info.rigid_count, info.isolated_count, surface_ms, weights_ms);
  } else {
    std::printf("%s: %u vertices, %zu joints, %zu poses\n", name.c_str(), info.vertex_count, rig.joint_count(),
                poses.size());
    if (given) {
      std::printf(
          "distance     mean %.3f %%, 95 %% below %.3f %%, worst %.2f %% of the box; stretch %.3f of the file's\n",
          found.mean, found.high, found.worst, found.stretch);
    } else {
      std::printf("distance     none: the file has no weights\n");
    }
    if (!carried.line.empty()) std::printf("%s\n", carried.line.c_str());
    std::printf(
        "vertices     %u informed, %u solved, %u pinned; guessed: %u carried, %u rigid, %u isolated; bare: %u\n",
        info.informed_count, info.solved_count, info.pinned_count, info.nearest_count, info.rigid_count,
        info.isolated_count, found.bare);
    std::printf("bones        %u without length, %u coincident, %u inform none, %u outside, %u look like helpers\n",
                work.no_length_count, work.coincident_count, work.informs_none_count, work.outside_count,
                work.helper_count);
    std::printf("time         surface %.1f ms, weights %.1f ms\n", surface_ms, weights_ms);
  }
  if (!options.report.empty()) {
    made.report = report_of(options, rig, weights, found, surface_ms, weights_ms);
    if (!options.carry.empty()) made.report["carry"] = carried.report;
    if (options.mirror >= 0) made.report["mirror"] = carried.report;
    if (!given) {
      made.report["distance"] = nullptr;
      made.report["stretch"] = nullptr;
    }
  }
  if (!sheet.empty()) {
    char title[200];
    if (given) {
      std::snprintf(title, sizeof title, "%s: mean %.2f %%, 95 %% below %.2f %% of the box", name.c_str(), found.mean,
                    found.high);
    } else {
      std::snprintf(title, sizeof title, "%s: a skeleton taken from another model", name.c_str());
    }
    write_weight_sheet(sheet.string(), model, rig, poses, made.weights, found, given, title);
  }
  return made;
}

// Each skeleton is computed by itself: what one moves hides no bone of another and follows none.
void run(const Command& options) {
  std::vector<Rig> rigs;
  bool given = true;
  Model model = read_model(options, rigs, given);
  std::vector<Made> made;
  for (size_t r = 0; r < rigs.size(); ++r) {
    const std::string number = "-" + std::to_string(r + 1), stem = options.mesh.stem().string();
    std::filesystem::path sheet = options.sheet;
    if (r > 0 && !sheet.empty()) sheet.replace_filename(sheet.stem().string() + number + sheet.extension().string());
    made.push_back(make_weights(options, model, rigs[r], given, rigs.size() > 1 ? stem + number : stem, sheet));
  }
  if (!options.report.empty()) {
    nlohmann::json report = made.front().report;
    if (made.size() > 1) {
      report = {{"model", report["model"]}, {"skeletons", nlohmann::json::array()}};
      for (const Made& one : made) report["skeletons"].push_back(one.report);
    }
    write_json(options.report, report);
  }
  if (options.out.empty()) return;
  std::set<int> written;
  for (size_t r = 0; r < rigs.size(); ++r) write_weights(model, rigs[r], made[r].weights, written);
  write_gltf(model, options.out);
}

}  // namespace
}  // namespace samples

int main(int count, char** arguments) {
  return samples::run_program("hf_weights", samples::usage, count, arguments, samples::parse, samples::run);
}
