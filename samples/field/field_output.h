// A field written as text, as a glb, and as a picture: strips of colour, iso-lines, critical points, arrows.
#ifndef HF_SAMPLES_FIELD_OUTPUT_H
#define HF_SAMPLES_FIELD_OUTPUT_H

#include <array>
#include <string>
#include <vector>

#include "common/mesh_file.h"
#include "common/picture.h"
#include "field/field_session.h"

namespace samples {

// What is shown of a field. values: one a vertex, NaN where there is none, or three for vectors.
struct FieldView {
  const SurfaceMesh* mesh = nullptr;
  std::vector<double> values;
  size_t components = 1;
  std::vector<double> levels;  // ascending; the strips lie between them
  std::vector<IsoLine> lines;
  std::vector<glm::dvec3> sites;
  std::vector<hf_critical_point> critical;
  std::vector<hf_singularity> singular;
  std::array<double, 3> direction{0.8, 0.35, 1.0};
  int width = 900, height = 760;
};

// One row a line, 17 digits: reads back to the same doubles.
void write_field_text(const std::string& file, const std::vector<double>& field, size_t components);

// Every triangle is cut along the levels between strips, so that a strip has one colour and sharp borders at any mesh
// resolution; iso-lines and arrows are line primitives.
void write_field_glb(const std::string& file, const FieldView& view);

// Strips from blue to yellow, iso-lines dark, a red dot at every site; with critical points: minima blue, maxima red,
// saddles green, sites small and black; vectors as arrows spread evenly over the surface, singularities of index above
// zero red, below zero blue.
Picture field_picture(const FieldView& view);

}  // namespace samples

#endif
