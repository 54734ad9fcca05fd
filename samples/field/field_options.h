// The command line and the edit script of hf_field.
#ifndef HF_SAMPLES_FIELD_OPTIONS_H
#define HF_SAMPLES_FIELD_OPTIONS_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/peers.h"

namespace samples {

// A place on the surface: a vertex, or a point in a triangle.
struct Place {
  uint32_t vertex = 0xFFFFFFFFu;
  uint32_t triangle = 0xFFFFFFFFu;
  std::array<double, 3> weights{};
  bool is_vertex() const { return triangle == 0xFFFFFFFFu; }
};

struct SiteArgument {
  Place place;
  std::vector<double> values;  // one, or the three of a vector
  double stiffness = 0;        // 0 = hard
};

// One line of a script.
struct Edit {
  enum class Kind { add, remove, move, set, undo, redo } kind = Kind::add;
  std::string text;
  std::vector<SiteArgument> sites;  // add, set: places with values; remove: places; move: from, to, from, to ...
};

enum class FieldType { harmonic, biharmonic, vector, direction };

struct FieldOptions {
  std::string mesh, script, out, glb, png;
  std::vector<std::string> sheet;  // meshes of a contact sheet; png is the start of its pictures' names
  std::vector<SiteArgument> sites;
  FieldType kind = FieldType::harmonic;
  int extremities = -1;  // 0 Poisson, 1 geodesic, -1 none
  int isolines = 0;      // lines to draw; 0 = none
  int levels = 0;        // of strips and lines: equal value, area, length
  bool critical_points = false;
  Engine engine = Engine::green;
  int operator_kind = 0, weld = 0;
  uint32_t threads = 1;
  bool links = true;
  int strips = 24;
  std::array<double, 3> direction{0.8, 0.35, 1.0};
  bool help = false;
};

extern const char* const field_usage;

// Throws std::runtime_error naming the argument.
FieldOptions read_field_options(int argc, char** argv);
// components: values of a site, 1 or 3. Throws std::runtime_error naming file and line.
std::vector<Edit> read_edit_script(const std::string& file, size_t components);

}  // namespace samples

#endif
