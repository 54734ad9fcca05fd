#include "weights/guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "gltf/json_file.h"

namespace samples {

using namespace hf_gltf;

void add_given(const Rig& rig, size_t vertex, double radius, PinFile& out) {
  out.vertices.push_back(static_cast<uint32_t>(vertex));
  out.radii.push_back(radius);
  for (size_t k = 0; k < rig.given.per_vertex; ++k) {
    out.joints.push_back(rig.given.joints[vertex * rig.given.per_vertex + k]);
    out.weights.push_back(rig.given.weights[vertex * rig.given.per_vertex + k]);
  }
}

PinFile read_pins(const std::filesystem::path& file, const Rig& rig) {
  constexpr size_t width = 8;
  const JsonFile json(file);
  const JsonReader list = json.root().at("pins");
  PinFile out;
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonReader entry = list.at(i);
    entry.expect_only({"vertex", "radius", "weights"});
    const auto vertex =
        static_cast<size_t>(entry.at("vertex").integer(0, static_cast<int64_t>(rig.positions.size()) - 1));
    out.vertices.push_back(static_cast<uint32_t>(vertex));
    out.radii.push_back(entry.number_or("radius", 0));
    std::vector<std::pair<uint32_t, float>> own;
    if (entry.has("weights")) {
      for (const auto& [name, value] : entry.at("weights").value().items()) {
        if (!value.is_number()) entry.fail("weights." + name + " is no number");
        own.push_back({joint_named(rig, name), value.get<float>()});
      }
    } else {
      for (size_t k = 0; k < rig.given.per_vertex; ++k)
        own.push_back({rig.given.joints[vertex * width + k], rig.given.weights[vertex * width + k]});
    }
    if (own.size() > width) entry.fail("more than 8 weights");
    own.resize(width, {own.empty() ? 0u : own[0].first, 0.0f});
    for (const auto& [joint, weight] : own) {
      out.joints.push_back(joint);
      out.weights.push_back(weight);
    }
  }
  return out;
}

void set_pins(hf::Weights& weights, const PinFile& pins) {
  auto desc = hf::make<hf_pins_desc>();
  desc.pin_count = static_cast<uint32_t>(pins.vertices.size());
  desc.vertices = pins.vertices.data();
  desc.radii = pins.radii.data();
  desc.influence_count = 8;
  desc.joints = pins.joints.data();
  desc.weights = pins.weights.data();
  weights.set_pins(desc);
}

RigWeights weights_of(const hf::Weights& weights) {
  hf::WeightsOut computed = weights.weights();
  return {computed.influence_count, std::move(computed.joints), std::move(computed.weights)};
}

namespace {

// A place for a pin: a vertex, and the radius of the disc around it.
struct PinPlace {
  size_t vertex;
  double radius;
};

// Places to try for the next pin. of_vertex: the mean distance of each vertex. Half of them are the vertices that are
// farthest off, apart from each other. The others stand for the cells of a grid with the largest sums of distances, so
// that many vertices that are a little off count too. Vertices at the places of pins are left out.
std::vector<PinPlace> pin_places(const Rig& rig, const std::vector<double>& of_vertex, const PinFile& pins) {
  constexpr size_t most = 4;               // vertices of each kind; each try costs as much as the comparison
  constexpr double apart = 0.05;           // of the box; also the side of a cell
  constexpr double radii[] = {0.0, 0.05};  // of the box
  std::vector<size_t> order, found;
  for (size_t v = 0; v < of_vertex.size(); ++v) {
    const bool pinned = std::any_of(pins.vertices.begin(), pins.vertices.end(),
                                    [&](uint32_t w) { return rig.positions[v] == rig.positions[w]; });
    if (of_vertex[v] > 0 && !pinned) order.push_back(v);
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return of_vertex[a] > of_vertex[b]; });
  const auto add = [&](size_t v) {
    const bool near = std::any_of(found.begin(), found.end(), [&](size_t w) {
      return glm::length(rig.positions[v] - rig.positions[w]) < apart * rig.diagonal;
    });
    if (!near) found.push_back(v);
  };
  for (size_t i = 0; i < order.size() && found.size() < most; ++i) add(order[i]);

  struct Cell {
    double sum = 0;
    glm::dvec3 middle{0.0};  // times the sum
    std::vector<size_t> vertices;
  };
  std::map<std::array<int64_t, 3>, Cell> cells;
  for (const size_t v : order) {
    const glm::dvec3 at = rig.positions[v] / (apart * rig.diagonal);
    Cell& cell = cells[{std::llround(at.x), std::llround(at.y), std::llround(at.z)}];
    cell.sum += of_vertex[v];
    cell.middle += of_vertex[v] * rig.positions[v];
    cell.vertices.push_back(v);
  }
  std::vector<const Cell*> heavy;
  for (const auto& entry : cells) heavy.push_back(&entry.second);
  std::stable_sort(heavy.begin(), heavy.end(), [](const Cell* a, const Cell* b) { return a->sum > b->sum; });
  for (size_t i = 0; i < heavy.size() && found.size() < 2 * most; ++i) {
    const Cell& cell = *heavy[i];
    const glm::dvec3 middle = cell.middle / cell.sum;
    add(*std::min_element(cell.vertices.begin(), cell.vertices.end(), [&](size_t a, size_t b) {
      return glm::length(rig.positions[a] - middle) < glm::length(rig.positions[b] - middle);
    }));
  }
  std::vector<PinPlace> out;
  for (const size_t v : found) {
    for (const double radius : radii) out.push_back({v, radius * rig.diagonal});
  }
  return out;
}

// Sets the pins if their discs do not meet.
bool try_pins(hf::Weights& weights, const PinFile& pins) {
  try {
    set_pins(weights, pins);
  } catch (const hf::Error& error) {
    if (error.code() != HF_ERROR_DUPLICATE) throw;
    return false;
  }
  return true;
}

}  // namespace

void guide(const Model& model, const Rig& rig, const std::vector<Pose>& poses, uint32_t count, PinFile pins,
           hf::Weights& weights) {
  Comparison now = compare(model, rig, poses, weights_of(weights));
  for (uint32_t i = 0; i < count; ++i) {
    PinFile best;
    Comparison least;
    for (const PinPlace& place : pin_places(rig, now.of_vertex, pins)) {
      PinFile tried = pins;
      add_given(rig, place.vertex, place.radius, tried);
      if (!try_pins(weights, tried)) continue;
      Comparison found = compare(model, rig, poses, weights_of(weights));
      if (best.vertices.empty() || found.mean < least.mean) {
        least = std::move(found);
        best = std::move(tried);
      }
    }
    if (best.vertices.empty()) break;
    pins = std::move(best);
    now = std::move(least);
    set_pins(weights, pins);
  }
}

}  // namespace samples
