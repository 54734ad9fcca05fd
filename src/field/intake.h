// Reads the options of solvers, direction fields, levels, distances and extremities, and the edits of sites.
#pragma once
#include "field/distances.h"
#include "field/levels.h"
#include "field/scalar_field.h"
#include "hf/analysis.h"
#include "hf/direction.h"
#include "hf/solver.h"
#include "mesh/places.h"

namespace hf_inner::field {

struct SolverOptions {
  mesh::FieldKind field_kind = mesh::FieldKind::harmonic;
  std::int32_t channels = 1;
  std::uint32_t site_limit = 0;
};
// Returns the options with the defaults filled in. Throws HF_ERROR_INVALID_ARGUMENT.
SolverOptions read_solver_options(const hf_solver_desc& desc);

// Write the sites to add, or the moves of sites, into an edit, which refers to the arrays of the caller. Throw
// HF_ERROR_EMPTY, HF_ERROR_NULL_POINTER or HF_ERROR_INVALID_ARGUMENT; ScalarField::edit checks the contents of the
// arrays.
void read_addition(const hf_sites_desc& desc, FieldEdit& edit);
void read_move(std::uint32_t count, const std::uint32_t* sites, const hf_sites_desc& to, FieldEdit& edit);

// Returns the screening H of all vertices in the inner unit, and its targets: [inner vertex][channels], or empty.
// Throws HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE or HF_ERROR_INVALID_ARGUMENT (index = vertex).
struct ScreeningInput {
  explicit ScreeningInput(Memory& memory) : strength(&memory), target(&memory) {}
  Vector<double> strength, target;
};
ScreeningInput read_screening(const mesh::Mesh& mesh, std::int32_t channels, const double* screening,
                              const double* targets, Memory& memory);

// Returns the corrections of a preview. Throws HF_ERROR_INVALID_ARGUMENT.
std::int32_t read_correction_count(std::uint32_t given);

// Returns the degree of a direction field. Throws HF_ERROR_INVALID_ARGUMENT or HF_ERROR_INVALID_DESC.
std::int32_t read_degree(const hf_direction_desc& desc);
std::uint32_t read_site_limit(std::uint32_t given) noexcept;

// Returns the spacing of levels, and checks how many are asked for. Throws HF_ERROR_INVALID_ARGUMENT.
LevelSpacing read_spacing(std::int32_t given, std::uint32_t level_count);

struct DistanceOptions {
  DistanceMethod method;
  double smoothing;  // of the heat method
};
// Returns the options of distances. Throws HF_ERROR_INVALID_ARGUMENT or HF_ERROR_INVALID_DESC.
DistanceOptions read_geodesics(const hf_geodesics_desc& desc);
// Returns the sources of distances as inner vertices, ascending, each once. Throws HF_ERROR_TOO_LARGE,
// HF_ERROR_OUT_OF_RANGE or HF_ERROR_INVALID_ARGUMENT (index = entry).
Vector<std::int32_t> read_source_vertices(const mesh::Mesh& mesh, std::uint32_t count, const std::uint32_t* sources,
                                          Memory& memory);

// A point of a surface between whose corners distances are measured.
struct PointOnSurface {
  mesh::SurfacePlace place;
  mesh::GeodesicPoint point;
};
// index: the place of the point in the call; name: its name there. Throws HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC,
// HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE or HF_ERROR_INVALID_ARGUMENT.
PointOnSurface point_on_surface(const mesh::TriangleSides& sides, const hf_place* given, const char* name,
                                std::uint32_t index, Memory& memory);

// Returns the radius of a map in the inner unit. Throws HF_ERROR_INVALID_ARGUMENT.
double read_map_radius(const mesh::Mesh& mesh, double given);

// The least length of extremities and proposed handles, as a share of the box diagonal. Throws
// HF_ERROR_INVALID_ARGUMENT.
double read_least_length(double given);
// Returns the desc with the defaults filled in. Throws HF_ERROR_INVALID_ARGUMENT.
hf_extremities_desc read_extremities(hf_extremities_desc desc);

}  // namespace hf_inner::field
