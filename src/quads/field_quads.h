// Quad meshes from smooth crosses: crosses along the curvature, a seamless map to the grid, its quads, evened out and
// fitted to the surface.
//
// The crosses decide the places of irregular vertices: one at each singularity. Everything but the rounding of the map
// is independent of the edge length, so several edge lengths cost little more than one.
#pragma once
#include <optional>

#include "mesh/mirror_plane.h"
#include "quads/apart.h"
#include "quads/chords.h"
#include "quads/cross_field.h"
#include "quads/extract.h"
#include "remesh/quad_distance.h"
#include "surface/core.h"

namespace hf_inner::quads {

// Wanted edge length of quads, as a share of the box: trades detail for faces. At half the value: four times the faces.
constexpr double default_edge_length = 0.022;
// Rounds that even out a quad mesh. On more irregular quads 30 rounds gave a figure of eight aspects of 2.6 instead of
// 2.5. There 120 rounds gave the same as 60.
constexpr std::int32_t default_relax_rounds = 60;

// A direction that edges of quads follow. weight: 1 holds it; less mixes it with the direction of the curvature.
struct QuadGuide {
  static constexpr Index of_pole = -1;
  Index vertex = -1;
  Vec3 vector;
  double weight = 1;
  Index given = of_pole;  // its number in the caller's list, or of_pole: then it may stand on the surface
};

// An irregular vertex at a place that the caller chooses (poles.h).
struct QuadPole {
  Vec3 place;          // near the surface, inner units
  std::int32_t quads;  // how many meet there: 3 or 5
  Vec3 direction;      // of one side of the irregular vertex; its part along the surface counts; 0: any
};

struct FieldQuadOptions {
  std::shared_ptr<const surface::Core> core;
  double edge_length = default_edge_length;  // inner units
  std::int32_t faces = 0;                    // wanted number of quads, which replaces the edge length; 0: none
  std::int32_t relax = default_relax_rounds;
  bool strict = false;  // throws QuadSource::LostComponent where a component needs shorter edges (counted_quads.h)
  double facet = 0;     // inner units: facets of about this size are no shape that crosses follow; 0: triangles
  double crease = 0;    // radians: edges that bend more are kept; 0: none
  Span<const Index> crease_edges;  // edges that are kept whatever their angle
  Span<const QuadGuide> guides;
  Span<const QuadPole> poles;              // whose guides are among the guides
  std::optional<mesh::MirrorPlane> plane;  // the quads are their own mirror image in it
};

struct FieldQuadReport {
  std::int32_t singularities = 0, parameters = 0, roundings = 0, cut_edges = 0;
  std::int32_t left_out = 0;     // equations of feature edges
  std::int32_t turned_over = 0;  // triangles of the map
  std::int32_t backward = 0;     // crossings of the map
  std::int32_t removed = 0;      // quads of folds
  std::int32_t added = 0;        // quads around thin parts
  std::int32_t chords = 0;       // that were removed
  std::int32_t substitutes = 0;  // components whose quads are not from the map
  std::int32_t split = 0;        // components with quads of their triangles
  std::int32_t tries = 0;
  double edge_length = 0;
  double field_ms = 0, map_ms = 0, quads_ms = 0, fit_ms = 0;
};

struct QuadResult {
  explicit QuadResult(Memory& memory) : mesh(memory) {}
  remesh::QuadMesh mesh;
  std::int32_t euler_characteristic = 0;
};

// The data that quads of one surface share, whatever their creases and guides. Data of an edge length is made again for
// another edge length. An exception leaves parts unmade, which the next call makes.
struct QuadBase {
  explicit QuadBase(std::shared_ptr<const surface::Core> core);
  QuadBase(const QuadBase&) = delete;
  QuadBase& operator=(const QuadBase&) = delete;
  // Makes the curvature and the factor of the crosses for an edge length. facet: as in the options.
  void prepare(double edge_length, double facet);
  // Returns samples of the surface that are so far apart.
  const remesh::QuadDistance& distance(double spacing);

  std::shared_ptr<const surface::Core> core;
  remesh::FluxSurface surface;  // its components stand apart
  Apart apart;
  double area = 0, mean_edge = 0;
  std::optional<field::DirectionMatrix> system;
  std::optional<CrossSmoother> smoother;
  Index passes = -1;                       // of `curvature`; -1: not made
  Vector<std::complex<double>> curvature;  // wished crosses
 private:
  double spacing_ = 0;
  std::optional<remesh::QuadDistance> distance_;
};

struct HalfBase;  // the same for symmetric quads (symmetric.h)
struct CutBase;   // and where long triangles are cut (cut_mesh.h)

// The data that updates of quads keep.
struct QuadKeeper {
  std::shared_ptr<QuadBase> whole;
  std::shared_ptr<HalfBase> half;
  std::shared_ptr<CutBase> cut;
};

double area_of(const surface::Core& core);
// Throws HF_ERROR_TOO_LARGE if the default edge length gives far more quads than anybody wants.
void check_expected(const FieldQuadOptions& options, double area);

// Throws HF_ERROR_UNSUPPORTED for surfaces that are not manifold or cannot be oriented, and where no try gives a mesh
// of discs; HF_ERROR_INVALID_ARGUMENT (index = guide) for a vector that stands on the surface; HF_ERROR_CANCELLED; with
// a plane what make_symmetric_quads throws.
// kept: NULL, or of earlier calls with the same core; receives what this call makes. The result is the same, bit for
// bit.
QuadResult make_field_quads(const FieldQuadOptions& options, FieldQuadReport* report = nullptr,
                            QuadKeeper* kept = nullptr);

}  // namespace hf_inner::quads
