// Runs a golden scene (bindings/golden/README.md) through hf.hpp's handles and the C functions. It reads the arguments
// of a step and compares figures of the result with those the step expects.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <hf/hf.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace golden {

using Json = nlohmann::ordered_json;
using Doubles = std::vector<double>;
using Numbers = std::vector<uint32_t>;

struct Mismatch : std::runtime_error {
  using std::runtime_error::runtime_error;
};
inline void expect(bool condition, const std::string& what) {
  if (!condition) throw Mismatch(what);
}

[[noreturn]] inline void fail(const std::string& message, hf_result code = HF_ERROR_INVALID_ARGUMENT) {
  hf_error_detail detail{};
  detail.code = code;
  detail.index = HF_NO_INDEX;
  message.copy(detail.message, sizeof detail.message - 1);
  throw hf::Error(detail);
}

inline double number(const Json& value) {
  if (!value.is_string()) return value.get<double>();
  const std::string text = value;
  return text == "nan"   ? std::nan("")
         : text == "inf" ? std::numeric_limits<double>::infinity()
                         : -std::numeric_limits<double>::infinity();
}

struct Object {
  hf::Handle<hf_surface, hf_surface_destroy> surface;
  hf::Handle<hf_solver, hf_solver_destroy> solver;
  hf::Handle<hf_pose, hf_pose_destroy> pose;
  hf::Handle<hf_transfer, hf_transfer_destroy> transfer;
  hf::Handle<hf_geodesics, hf_geodesics_destroy> geodesics;
  hf::Handle<hf_direction, hf_direction_destroy> direction;
  hf::Handle<hf_quads, hf_quads_destroy> quads;
  hf::Handle<hf_flow, hf_flow_destroy> flow;
  hf::Handle<hf_region, hf_region_destroy> region;
  hf::Handle<hf_detail, hf_detail_destroy> detail;
  hf::Handle<hf_weights, hf_weights_destroy> weights;
  hf::History<decltype(solver)> solver_history;
  hf::History<decltype(direction)> direction_history;
  hf::History<decltype(region)> region_history;
  hf::History<decltype(weights)> weights_history;
  size_t vertex_count = 0, source_vertex_count = 0;
};

struct Result {
  std::optional<Doubles> array;
  std::optional<Numbers> numbers;
  std::map<std::string, double> fields;
};

// six numbers for each place: three corners, three barycentrics
std::vector<hf_place> places_of(const Json& step);

// Option names and the places they stand for.
using OptionPlace = std::variant<int32_t*, uint32_t*, double*>;
inline void set_options(const Json& step, const std::map<std::string, OptionPlace>& places) {
  const Json options = step.value("options", Json::object());
  for (const auto& [key, value] : options.items()) {
    const auto found = places.find(key);
    if (found == places.end()) fail("no option " + key);
    std::visit([&value = value](auto* place) { *place = value.template get<std::decay_t<decltype(*place)>>(); },
               found->second);
  }
}

class Scene {
 public:
  explicit Scene(const std::map<std::string, Json>& meshes) : meshes_(meshes) {}

  void step(Json& step, bool fill) {
    Result result;
    try {
      result = run(step);
    } catch (const hf::Error& error) {
      expect(step.contains("error") && step["error"] == hf_result_get_name(error.code()),
             std::string("raised ") + error.what());
      expect(!step.contains("index") || step["index"] == error.index(), "index " + std::to_string(error.index()));
      return;
    }
    expect(!step.contains("error"), "did not fail");
    if (result.array) {
      if (step.contains("expect")) compare(*result.array, step["expect"], fill);
      if (step.contains("same_as")) {
        const Doubles& kept = kept_.at(step["same_as"]);
        expect(kept.size() == result.array->size() &&
                   !std::memcmp(kept.data(), result.array->data(), kept.size() * sizeof(double)),
               "differs from " + step["same_as"].get<std::string>());
      }
      if (step.contains("keep")) kept_[step["keep"]] = *result.array;
    } else if (result.numbers && step.contains("numbers")) {
      expect(step["numbers"].get<Numbers>() == *result.numbers, "numbers");
    } else if (step.contains("expect")) {
      for (const auto& [key, value] : step["expect"].items()) {
        if (key == "tolerance") continue;
        expect(result.fields.count(key) &&
                   std::abs(result.fields[key] - value.get<double>()) <= step["expect"].value("tolerance", 0.0),
               key + " is " + std::to_string(result.fields[key]));
      }
    }
  }

 private:
  static void compare(const Doubles& a, Json& wanted, bool fill) {
    double sum = 0, weighted = 0, least = a.empty() ? 0 : a[0], most = least;
    for (size_t i = 0; i < a.size(); ++i) {
      expect(std::isfinite(a[i]), "not finite");
      sum += a[i];
      weighted += a[i] * static_cast<double>(i % 7 + 1);
      least = std::min(least, a[i]);
      most = std::max(most, a[i]);
    }
    if (fill && wanted.contains("agree")) {
      Json at = Json::array(), values = Json::array();
      for (size_t i = 0; i < a.size(); i += a.size() / 20 + 1) {
        at.push_back(i);
        values.push_back(a[i]);
      }
      const Json tolerance = wanted["tolerance"];
      wanted = {{"count", a.size()}, {"sum", sum}, {"weighted", weighted}, {"min", least},
                {"max", most},       {"at", at},   {"values", values},     {"tolerance", tolerance}};
    }
    const double tolerance = wanted.value("tolerance", 0.0), n = static_cast<double>(a.size());
    const auto near = [&](const char* key, double found, double room) {
      if (wanted.contains(key))
        expect(std::abs(found - wanted[key].get<double>()) <= room, std::string(key) + " is " + std::to_string(found));
    };
    near("count", n, 0);
    near("sum", sum, tolerance * n + 1e-9);
    near("weighted", weighted, 7 * tolerance * n + 1e-9);
    near("min", least, tolerance);
    near("max", most, tolerance);
    const Json places = wanted.value("at", Json::array());
    for (size_t k = 0; k < places.size(); ++k)
      expect(std::abs(a[places[k].get<size_t>()] - wanted["values"][k].get<double>()) <= tolerance,
             "value at " + places[k].dump());
  }

  std::optional<Doubles> doubles(const Json& step, const char* key, std::optional<size_t> count = {}) const {
    if (!step.contains(key) || step[key].is_null()) return {};
    Doubles found;
    if (step[key].is_string())
      found = kept_.at(step[key]);
    else
      for (const Json& value : step[key]) found.push_back(number(value));
    if (count && found.size() != *count) fail(std::string(key) + " must hold " + std::to_string(*count) + " numbers");
    return found;
  }
  static std::optional<Numbers> numbers(const Json& step, const char* key) {
    if (!step.contains(key) || step[key].is_null()) return {};
    return step[key].get<Numbers>();
  }
  template <class T>
  static const T* data(const std::optional<std::vector<T>>& list) {
    return list && !list->empty() ? list->data() : nullptr;
  }
  template <class T>
  static uint32_t count(const std::optional<std::vector<T>>& list) {
    return list ? static_cast<uint32_t>(list->size()) : 1u;
  }
  static std::optional<std::pair<Numbers, Numbers>> regions(const Json& step, const char* key) {
    if (!step.contains(key) || step[key].is_null()) return {};
    std::pair<Numbers, Numbers> both;
    for (const Json& region : step[key]) {
      const Numbers vertices = region.get<Numbers>();
      both.first.push_back(static_cast<uint32_t>(vertices.size()));
      both.second.insert(both.second.end(), vertices.begin(), vertices.end());
    }
    return both;
  }

  Result run(const Json& step);
  Result run_solver(const Json& step);
  Result run_surface(const Json& step);
  Result run_graph(const Json& step);
  void edit_surface(const Json& step, hf_surface surface);
  Result run_mesh(const Json& step, const std::string& what, hf_surface surface);
  Result run_picking(const Json& step, const std::string& what, hf_surface surface, size_t n);
  Result run_looking(const Json& step, const std::string& what, hf_surface surface, size_t n);
  Result run_posing(const Json& step, const std::string& what);
  Result run_direction(const Json& step, const std::string& what);
  Result run_region(const Json& step, const std::string& what);
  Result run_weights(const Json& step, const std::string& what);
  Result run_carried(const Json& step, const std::string& what);
  Result run_quads(const Json& step, const std::string& what);
  void with_quad_options(const Json& step, const std::function<void(const hf_quads_desc&)>& call);
  void make_object(const Json& step, const std::string& what);

  const std::map<std::string, Json>& meshes_;
  std::map<std::string, Object> objects_;
  std::map<std::string, Doubles> kept_;
  std::map<std::string, std::vector<uint8_t>> bytes_;
};

// Throws a Mismatch when something destroyed takes something else along, or memory does not come back.
void check_lifetime(const Json& mesh, int rounds);

}  // namespace golden
