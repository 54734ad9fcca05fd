// Skin weights: from a surface to weights, a moved bone, a pin set and rewritten, and weights carried to a level of
// detail. Each time includes reading the weights of all vertices. Bones of the torus lie one after the other on the
// circle in its tube; those of the creature are its own joints.
#include <cmath>
#include <cstdio>

#include "assets/creature.h"
#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "hf/hf.hpp"

namespace bench {
namespace {

constexpr uint32_t torus_bones = 50;

// The circle in the tube of the generated tori has the radius 1 and lies around the y axis.
hf::Joints bones_of_torus() {
  const double step = 8 * std::atan(1.0) / torus_bones;
  hf::Joints bones;
  for (uint32_t b = 0; b < torus_bones; ++b) {
    for (const uint32_t end : {b, b + 1}) {
      std::vector<double>& out = end == b ? bones.heads : bones.tails;
      out.insert(out.end(), {std::sin(step * end), 0.0, std::cos(step * end)});
    }
    bones.parents.push_back(b == 0 ? HF_NO_INDEX : b - 1);
  }
  return bones;
}

hf::Joints bones_of_creature() {
  hf::Joints bones;
  const samples::Creature creature = samples::make_creature("horse", 1000);
  for (const samples::Joint& joint : creature.skeleton) {
    for (size_t c = 0; c < 3; ++c) {
      const double parent = joint.parent < 0 ? 0 : bones.heads[3 * static_cast<size_t>(joint.parent) + c];
      bones.heads.push_back(parent + joint.translation[c]);
    }
    bones.parents.push_back(joint.parent < 0 ? HF_NO_INDEX : static_cast<uint32_t>(joint.parent));
  }
  return bones;
}

hf::Surface surface_of(const Mesh& mesh, uint32_t threads) {
  auto desc = hf::make<hf_surface_desc>();
  desc.positions = HF_ARRAY(mesh.positions.data(), mesh.vertex_count());
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
  desc.thread_count = threads;
  return hf::Surface(desc);
}

void set_pin(hf::Weights& weights, uint32_t vertex, float share) {
  const uint32_t joints[] = {0, 1};
  const float shares[] = {share, 1 - share};
  auto pin = hf::make<hf_pins_desc>();
  pin.pin_count = 1;
  pin.vertices = &vertex;
  pin.influence_count = 2;
  pin.joints = joints;
  pin.weights = shares;
  weights.set_pins(pin);
}

nlohmann::json measure(const Mesh& mesh, Family family, const Run& run) {
  const hf::Joints bones = family == Family::torus ? bones_of_torus() : bones_of_creature();
  const auto coarse = make_mesh(family, mesh.vertex_count() / 4);
  const hf::Surface surface = surface_of(mesh, run.threads), level = surface_of(*coarse, run.threads);
  std::vector<double> whole, made, bone, pin, rewritten, carried;
  for (uint32_t r = 0; r <= run.repetitions; ++r) {
    const double all = time_ms([&] { hf::Weights(surface_of(mesh, run.threads), bones).weights(); });
    const double alone = time_ms([&] { hf::Weights(surface, bones).weights(); });
    hf::Weights weights(surface, bones);
    hf::Joints moved = bones;
    const size_t turned = 3 * (bones.parents.size() / 2);
    for (size_t c = 0; c < 3; ++c) moved.heads[turned + c] *= 1.001;
    const double bone_ms = time_ms([&] {
      weights.set_joints(moved);
      weights.weights();
    });
    const uint32_t vertex = mesh.vertex_count() / 2;
    const double pin_ms = time_ms([&] {
      set_pin(weights, vertex, 0.25f);
      weights.weights();
    });
    const double again_ms = time_ms([&] {
      set_pin(weights, vertex, 0.75f);
      weights.weights();
    });
    const hf::WeightsOut given = weights.weights();
    hf::WeightsTransferOptions carry;
    carry.joints = given.joints;
    carry.weights = given.weights;
    const double carry_ms = time_ms([&] { hf::Weights::transfer(surface, level, carry); });
    if (r == 0) continue;  // the first one warms
    whole.push_back(all);
    made.push_back(alone);
    bone.push_back(bone_ms);
    pin.push_back(pin_ms);
    rewritten.push_back(again_ms);
    carried.push_back(carry_ms);
  }
  return {{"name", mesh.name},
          {"n", mesh.vertex_count()},
          {"bones", bones.parents.size()},
          {"surface_to_weights_ms", median(whole)},
          {"weights_ms", median(made)},
          {"bone_ms", median(bone)},
          {"pin_ms", median(pin)},
          {"pin_again_ms", median(rewritten)},
          {"carry_n", coarse->vertex_count()},
          {"carry_ms", median(carried)}};
}

}  // namespace

Rows run_weights(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    for (const uint32_t n : {3300u, 13000u, 70000u}) {
      if (run.small && n > 3300) continue;
      const auto mesh = make_mesh(family, run.small ? 2400 : n);
      if (!run.wants(mesh->name)) continue;
      const nlohmann::json row = measure(*mesh, family, run);
      const auto ms = [&](const char* key) { return row.at(key).get<double>(); };
      std::printf(
          "%-14s %2zu bones   surface to weights %8.2f ms, weights alone %8.2f   bone moved %7.2f   pin %6.2f, again "
          "%6.2f   carried to %u vertices %7.2f\n",
          mesh->name.c_str(), row.at("bones").get<size_t>(), ms("surface_to_weights_ms"), ms("weights_ms"),
          ms("bone_ms"), ms("pin_ms"), ms("pin_again_ms"), row.at("carry_n").get<uint32_t>(), ms("carry_ms"));
      std::fflush(stdout);
      if (family == Family::torus && n == 3300)
        report.measure("weights_whole", mesh->name, run.threads, ms("surface_to_weights_ms"));
      if (n == 13000) {
        report.measure("weights_bone", mesh->name, run.threads, ms("bone_ms"));
        report.measure("weights_pin", mesh->name, run.threads, ms("pin_ms"));
      }
      rows.push_back(row);
    }
  }
  return rows;
}

void plot_weights(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"Skin weights", "medians, weights of all vertices read each time", "", "ms"};
  plot.log_y = true;
  write_rows(plot,
             {{"surface to weights", "/surface_to_weights_ms"},
              {"weights alone", "/weights_ms"},
              {"a bone moved", "/bone_ms"},
              {"a pin", "/pin_ms"},
              {"carried to a quarter", "/carry_ms"}},
             runs, file);
}

}  // namespace bench
