// Computes exact geodesic distances on a polyhedral surface, with windows (Mitchell, Mount and Papadimitriou 1987).
//
// A window is an interval of an edge. All its points see the same pseudo-source along straight lines, after the
// triangles between are unfolded into a plane. A pseudo-source is a source, or a vertex where a shortest path may bend.
// Such a vertex is at a border, at an edge of three triangles, or has angles that sum to more than 2 pi. Windows pass
// from triangle to triangle in about the order of their distance. Three rules bound or drop a window:
//
//   - A ray that reaches a corner sooner bounds it (Chen and Han 1990).
//   - A path by a corner of the triangle is shorter to every point of the window (Xin and Wang 2009).
//   - Behind a vertex, only directions at an angle of at least pi to both sides of the incoming path are of use.
//
// At edges of three and more triangles a fourth rule holds (shortest_on_edges.h): a window continues only where it is
// shorter than the windows before. Triangles with the same corners count once, so a two-sided sheet is a single one.
//
// The result is exact up to rounding on every set of triangles: with borders, edges of three triangles and slivers.
// Memory: 100 bytes per triangle for the tables of sides, 64 for each call, and 56 for each window of the front.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

// The tables that all calls on one mesh share. Side 3 t + k runs from corner k of triangle t to its next corner.
struct TriangleSides {
  static constexpr std::int32_t border = -1, several = -2;
  TriangleSides(const Mesh& mesh, const Topology& topology, Memory& memory);

  static std::int32_t next(std::int32_t side) noexcept { return side % 3 == 2 ? side - 2 : side + 1; }
  static std::int32_t last(std::int32_t side) noexcept { return side % 3 == 0 ? side + 2 : side - 1; }
  // Tells whether an earlier triangle has the same corners. Two-sided sheets have such triangles. Paths ignore copies.
  bool is_copy(std::int32_t triangle) const noexcept { return edge[3 * static_cast<std::size_t>(triangle)] < 0; }
  // Returns the vertex where the side starts.
  std::int32_t start(std::int32_t side) const noexcept { return mesh.corners[static_cast<std::size_t>(side)]; }
  // Returns the angle of the corner opposite the side.
  double opposite_angle(std::int32_t side) const noexcept;
  // Returns a side on the edge between two neighbours.
  std::int32_t side_between(std::int32_t v, std::int32_t w) const noexcept;

  const Mesh& mesh;
  const Topology& topology;
  Vector<std::int32_t> edge;  // by side; Mesh::none: its triangle is a copy
  Vector<std::int32_t> twin;  // by side: the side of the other triangle; `border`; `several` where there are more
  struct Frame {
    double length, x, y;  // if the side runs from 0 along the x axis, the opposite corner lies at (x, y)
  };
  Vector<Frame> frame;  // by side
  // By vertex: the sum of its angles; infinite where its triangles are not one closed fan.
  Vector<double> angle;
  double mean_length = 0;

 private:
  void mark_several_fans(Memory& memory);
};

// The end of the shortest path to a vertex. The path comes straight from a pseudo-source across a side of a triangle to
// the opposite corner, or along an edge.
struct PathEnd {
  static constexpr std::int32_t unreached = -1, along_edge = -2, at_source = -3;
  std::int32_t side = unreached;  // or one of the numbers above
  std::int32_t from = -1;         // the pseudo-source: a vertex, or -1 for the source point
  double x = 0, y = 0;            // its place (x, -y) in the frame of the side
};

// A point of the surface: a vertex, or its place in each triangle that has it. A point on an edge is in all triangles
// of the edge.
struct GeodesicPoint {
  struct Place {
    std::int32_t triangle;
    double weight[3];  // of its corners
  };
  // Weights up to this share of their sum count as 0. So a ray that hits an edge gives a point of the edge, whatever
  // its rounding (1e-15). Larger values move points that are meant to lie beside an edge.
  static constexpr double least_weight = 1e-12;
  // corners: of a triangle; a corner of weight 0 may be Mesh::none. Without such a triangle, found() is false.
  GeodesicPoint(const TriangleSides& sides, const std::int32_t* corners, const double* weights, Memory& memory);
  bool found() const noexcept { return vertex >= 0 || !places.empty(); }
  Vec3 position(const Mesh& mesh) const noexcept;

  std::int32_t vertex = -1;
  Vector<Place> places;
};

// Bounds what exact_distance computes.
struct ExactTask {
  Span<const std::int32_t> sources;     // vertices
  const GeodesicPoint* from = nullptr;  // or one point
  const GeodesicPoint* to = nullptr;    // with `from`: stops when the path to this point is known
  bool directions = false;              // with `from`: fills ExactDistance::direction
  double reach = 0;                     // above 0: stops beyond this distance
  double at_most = 0;                   // with `to`, above 0: a path of this length to it is known
  std::uint64_t most_windows = 0;       // that a call may make; 0: about 20 t sqrt(t) for t triangles
};

struct ExactDistance {
  explicit ExactDistance(Memory& memory) : distance(&memory), end(&memory), direction(&memory) {}
  Vector<double> distance;  // by vertex; infinite where no source reaches
  Vector<PathEnd> end;      // by vertex
  // By vertex, if asked for: the angle in which the path leaves the source. At a vertex it counts from the edge to
  // first_corner and goes up to fan_angle; at a point inside a triangle it counts from the triangle's first side.
  Vector<double> direction;
  double fan_angle = 0;
  std::int32_t first_corner = -1, first_triangle = -1;
  bool closed_fan = false;
  double to_distance = -1;  // of the task's second point inside a triangle or on an edge; -1: not reached
  PathEnd to_end;           // of that point; along_edge: straight from the corner `from`
  std::int32_t to_place = 0;
  std::uint64_t window_count = 0;  // windows that were made
};

// Computes the distance from the nearest source. Reports progress and can be cancelled. Throws HF_ERROR_TOO_LARGE for
// more windows than the task allows, and std::bad_alloc.
ExactDistance exact_distance(const TriangleSides& sides, const ExactTask& task, Memory& memory);
inline ExactDistance exact_distance(const TriangleSides& sides, Span<const std::int32_t> sources, Memory& memory) {
  ExactTask task;
  task.sources = sources;
  return exact_distance(sides, task, memory);
}

}  // namespace hf_inner::mesh
