// A field written as text, as a glb of crisp colour strips, and as a picture.
#ifndef HF_SAMPLES_FIELD_OUTPUT_H
#define HF_SAMPLES_FIELD_OUTPUT_H

#include <array>
#include <string>
#include <vector>

#include "common/mesh_file.h"

namespace samples {

// One value a line, 17 digits: reads back to the same double.
void write_field_text(const std::string& file, const std::vector<double>& field);

// Every triangle is cut along the levels between strips, so that a strip has one colour and sharp borders at any mesh
// resolution.
void write_field_glb(const std::string& file, const SurfaceMesh& mesh, const std::vector<double>& field, int strips);

// Strips from blue to yellow with iso-lines, a red dot at every site.
void write_field_picture(const std::string& file, const SurfaceMesh& mesh, const std::vector<double>& field, int strips,
                         const std::vector<glm::dvec3>& sites, const std::array<double, 3>& direction);

}  // namespace samples

#endif
