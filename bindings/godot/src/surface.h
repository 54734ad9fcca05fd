// The class that scripts see, free of any engine. It holds a surface and one of each thing that is made on it.
// A table of methods takes plain arguments to plain values. gdnative.cpp and gdextension.cpp only convert.
#pragma once
#include <array>
#include <hf/hf.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hf_godot {

using Doubles = std::vector<double>;
using Numbers = std::vector<uint32_t>;
struct Surface;

// A script's argument: null, a number, text, a list of numbers, a list of lists, named numbers, bytes, or another
// surface.
struct Argument {
  bool null = true;
  double number = 0;
  std::string text;
  Doubles list;
  std::vector<Doubles> lists;
  std::map<std::string, double> named;
  std::vector<uint8_t> bytes;
  std::shared_ptr<Surface> surface;
};
using Arguments = std::vector<Argument>;

struct Value {
  enum Kind { nothing, truth, number, integers, reals, vectors, bytes, named, rows, lists, lines } kind = nothing;
  double real = 0;
  Numbers whole;
  std::vector<float> floats;  // reals, or xyz of vectors
  std::vector<uint8_t> octets;
  std::map<std::string, double> fields;
  std::vector<std::map<std::string, double>> table;  // rows
  std::vector<Numbers> sets;                         // lists of whole numbers
  std::vector<std::vector<float>> polylines;         // xyz of each line's points
};

[[noreturn]] inline void fail(const std::string& message, hf_result code = HF_ERROR_INVALID_ARGUMENT) {
  hf_error_detail detail{};
  detail.code = code;
  detail.index = HF_NO_INDEX;
  message.copy(detail.message, sizeof detail.message - 1);
  throw hf::Error(detail);
}

struct Surface {
  // Several may share one mesh and factor (share_from).
  std::shared_ptr<hf::Handle<hf_surface, hf_surface_destroy>> mesh;
  hf::Handle<hf_solver, hf_solver_destroy> solver;
  hf::Handle<hf_pose, hf_pose_destroy> pose;
  hf::Handle<hf_transfer, hf_transfer_destroy> transfer;
  std::array<hf::Handle<hf_geodesics, hf_geodesics_destroy>, HF_GEODESICS_HEAT + 1> geodesics;  // by method
  hf::Handle<hf_direction, hf_direction_destroy> direction;
  hf::Handle<hf_quads, hf_quads_destroy> quads;
  hf::Handle<hf_flow, hf_flow_destroy> flow;
  hf::Handle<hf_region, hf_region_destroy> region;
  hf::Handle<hf_detail, hf_detail_destroy> detail;
  hf::Handle<hf_retarget, hf_retarget_destroy> retarget;  // needs no mesh
  hf::History<decltype(solver)> solver_history;
  hf::History<decltype(direction)> direction_history;
  hf::History<decltype(region)> region_history;
  hf_surface get() const { return mesh ? mesh->get() : nullptr; }
  // Forgets everything made on the mesh.
  void forget() {
    solver = {};
    solver_history = {};
    pose = {};
    transfer = {};
    geodesics = {};
    direction = {};
    direction_history = {};
    quads = {};
    flow = {};
    region = {};
    detail = {};
    proposed = {};
    moved = false;
  }
  size_t vertex_count = 0;
  bool moved = false;             // to an edited surface since the mesh was made or shared
  size_t target_count = 0;        // vertices of the transfer's target
  size_t target_joints = 0;       // numbers of the joints of the retarget's target
  std::vector<float> normals;     // of the last deform
  std::vector<Numbers> proposed;  // vertices of each proposed handle
  std::vector<float> joints;      // of the source of the retarget, as the library wants them
  // the last failure, for scripts that have no exceptions
  std::string error_name, error_message;
  double error_index = -1;
};

using Method = Value (*)(Surface&, const Arguments&);
struct Entry {
  const char* name;
  int least, most;  // arguments
  Method method;
};
const std::vector<Entry>& methods();           // all of them
const std::vector<Entry>& solver_methods();    // those of surface_solver.cpp
const std::vector<Entry>& pose_methods();      // those of surface_pose.cpp
const std::vector<Entry>& field_methods();     // those of surface_fields.cpp
const std::vector<Entry>& region_methods();    // those of surface_regions.cpp
const std::vector<Entry>& edit_methods();      // those of surface_edit.cpp
const std::vector<Entry>& retarget_methods();  // those of surface_retarget.cpp
const std::vector<Entry>& made_methods();      // those of surface_made.cpp

hf_solver solver_of(Surface& surface);  // made when there is none
hf_pose pose_of(Surface& surface);

// Calls a method; a failure is kept in the surface and gives Value::nothing.
Value call(Surface& surface, const Entry& entry, const Arguments& arguments) noexcept;

}  // namespace hf_godot
