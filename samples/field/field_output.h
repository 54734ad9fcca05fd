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

// The parts of a field that are shown. values: one per vertex, or three for vectors; NaN where it has none, which is
// hatched in grey.
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

// Writes one row per line with 17 digits, which read back to the same doubles.
void write_field_text(const std::string& file, const std::vector<double>& field, size_t components);

// Writes a glb. Every triangle is cut along the levels between strips, so a strip has one colour and sharp borders at
// any mesh resolution. Iso-lines and arrows are line primitives.
void write_field_glb(const std::string& file, const FieldView& view);

// Draws a picture. Strips go from blue to yellow, iso-lines are dark, and every site has a red dot. With critical
// points, minima are blue, maxima red and saddles green; sites are then small and black. Vectors are arrows spread
// evenly over the surface. Singularities with an index above zero are red, those below zero blue.
Picture field_picture(const FieldView& view);

}  // namespace samples

#endif
