// A model as one triangle surface in world space at rest, welded, and the way back.
//
// flatten() walks the scene and puts every triangle primitive of every mesh node behind one another, in the file's own
// vertex order. Rest pose: a skinned mesh is skinned with the rest pose of its joint nodes (sum of w J B p). Its own
// node's transform does not count, as glTF says. Other meshes are moved by their node. Morph targets have their default
// weights. Raw POSITION is not the rest pose: many exporters keep axis and scale in the nodes.
//
// Seams: an exporter stores a vertex once per normal and texture coordinate. Vertices at bit-equal rest positions are
// welded; results computed on the welded surface go back to all copies. Copies whose stored positions are bit-equal but
// whose weights differ come out of skinning a rounding error apart: within 1e-6 of the diagonal they are put together.
//
// Positions are computed in double. Cost: linear. Failure: std::runtime_error naming the element.
#ifndef HF_GLTF_FLAT_MESH_H
#define HF_GLTF_FLAT_MESH_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

// Where a run of flat vertices and triangles comes from.
struct FlatPart {
  int node = -1, mesh = -1, primitive = -1;
  uint32_t first_vertex = 0, vertex_count = 0;
  uint32_t first_triangle = 0, triangle_count = 0;
  bool mirrored = false;  // the node's transform flips sides; its triangles are turned round here
};

struct FlatMesh {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;  // three vertices each
  std::vector<glm::vec3> normals;   // at rest, as stored in the file; zero where it has none
  std::vector<glm::vec4> colors;    // COLOR_0, white where a primitive has none; empty where none has any
  std::vector<FlatPart> parts;

  // welded[v] is the index of v's position among the welded vertices, first copy first.
  std::vector<uint32_t> welded;
  uint32_t welded_count = 0;
  // 1 for vertices that no triangle of three welded corners has. They are carried along and are no part of the surface:
  // not of its box, its ground or its limbs. All 0 where every triangle is collapsed.
  std::vector<uint8_t> loose;

  // Fills the three above from positions and triangles.
  void weld();

  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
  uint32_t triangle_count() const { return static_cast<uint32_t>(triangles.size() / 3); }
  // The part a vertex belongs to; its index in the primitive is vertex - first_vertex.
  const FlatPart& part_of_vertex(uint32_t vertex) const;
};

struct FlattenOptions {
  std::vector<int> nodes;           // only these nodes' meshes; empty: every mesh node of the scene
  int skin = -1;                    // only meshes with this skin; -1: all
  uint32_t max_vertices = 4000000;  // checked before allocation, like those below
  uint32_t max_triangles = 8000000;
  // Nodes that share a mesh multiply it: flat vertices, once for the mesh and once for each morph target, may be this
  // many times those stored, and so many more.
  uint32_t max_copies = 4, free_vertices = 100000;
};

FlatMesh flatten(const Model& model, const FlattenOptions& options = {});

// The box of the vertices that are not loose.
struct SurfaceBox {
  explicit SurfaceBox(const FlatMesh& mesh) : SurfaceBox(mesh.positions, mesh.loose) {}
  SurfaceBox(const std::vector<glm::dvec3>& positions, const std::vector<uint8_t>& loose);
  double diagonal() const { return glm::length(high - low); }
  glm::dvec3 low, high;
};
// By vertex: 1 for those that no triangle of three different places has, or all 0, as FlatMesh::loose.
std::vector<uint8_t> loose_vertices(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& triangles);

// Vertices at bit-equal positions (0 and -0 are equal) get one number, counted in order of first appearance. With a
// tolerance > 0 vertices of one cell-neighbourhood closer than it are joined, transitively. Returns the count.
uint32_t weld_positions(const std::vector<glm::dvec3>& positions, std::vector<uint32_t>& welded, double tolerance = 0);

// Connected components of the triangles over vertex numbers below count; vertices of no triangle do not count.
uint32_t count_components(const std::vector<uint32_t>& triangles, const std::vector<uint32_t>* numbers, uint32_t count);

// One vector per vertex: the area-weighted mean of the triangle normals round the welded vertex. All its copies share
// it. It has unit length, or is zero where every triangle is degenerate. creases: copies share only where their stored
// normals agree. So a flat-shaded model stays flat-shaded.
std::vector<glm::vec3> welded_normals(const FlatMesh& mesh, const std::vector<glm::dvec3>& positions,
                                      bool creases = false);

// The nearest float, as a double. Not a plain cast there and back: g++ 12 at -O2 drops that from vector code
// (double(float(x)) of neighbouring members comes out as x).
double float_rounded(double value);
glm::dvec3 float_rounded(const glm::dvec3& p);

// The place of a node whose positions are written as floats. Far from 0 floats lose digits that the surface needs. So
// the node's translation holds the way there, which a file stores in double. 0 where nothing is lost, and where it is
// little. Each coordinate is a float.
glm::dvec3 node_offset(const std::vector<glm::dvec3>& positions);

// Positions as the library takes them: x y z of every vertex.
std::vector<float> float_positions(const std::vector<glm::dvec3>& positions);
std::vector<double> double_positions(const std::vector<glm::dvec3>& positions);
std::vector<glm::dvec3> to_points(const std::vector<float>& xyz);
std::vector<glm::dvec3> to_points(const std::vector<double>& xyz);

// One value per welded vertex to one per vertex.
template <typename T>
std::vector<T> to_copies(const FlatMesh& mesh, const std::vector<T>& welded_values) {
  std::vector<T> values(mesh.positions.size());
  for (size_t v = 0; v < values.size(); ++v) values[v] = welded_values[mesh.welded[v]];
  return values;
}

struct ScatterOptions {
  bool creases = false;  // see welded_normals
};

// Gives the model new rest positions (world space, one per flat vertex). Each primitive gets the positions and normals
// that its node or its skin at rest moves to these places. Rig, animations, looks stay. A mesh used by several nodes is
// copied for each. Where a scale of 0 collapses vertices at rest they keep their stored numbers, and a warning of the
// model counts them.
void scatter(Model& model, const FlatMesh& mesh, const std::vector<glm::dvec3>& positions,
             const ScatterOptions& options = {});

// A still model with the given world positions: the same primitives and looks, no skins, animations or morph targets.
// Every node is at the offset of the whole (node_offset).
Model bake(const Model& model, const FlatMesh& mesh, const std::vector<glm::dvec3>& positions,
           const ScatterOptions& options = {});

// Sets COLOR_0 of every flattened primitive, one colour (linear, rgba) per flat vertex.
void set_colors(Model& model, const FlatMesh& mesh, const std::vector<glm::vec4>& colors);

// Appends a mesh node of line segments (two points each, world space), drawn in one colour: iso-lines.
void add_lines(Model& model, const std::string& name, const std::vector<glm::dvec3>& segment_ends,
               const glm::vec4& color);

// A model of one mesh node; normals are computed.
Model make_model(const std::string& name, const std::vector<glm::dvec3>& positions,
                 const std::vector<uint32_t>& triangles);

}  // namespace hf_gltf

#endif
