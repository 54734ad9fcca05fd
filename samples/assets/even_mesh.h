// From an implicit body to an even triangle mesh with an exact number of vertices.
//
//   polygonise   marching tetrahedra on Kuhn's six tetrahedra per grid cube: always a closed 2-manifold
//   EditMesh     isotropic remeshing (Botsch and Kobbelt 2004): split long, collapse short, flip, relax in the tangent
//                plane, project to the body; collapses keep the topology (link condition, Dey et al. 1999), so thin
//                limbs survive at any vertex count and the genus never changes
//   subdivide    every edge cut in half, new vertices projected; 4 V - 6 vertices for a closed surface of genus 0
//
// base_mesh() and refine() put them together. Cost: 1 to 2 s for the base, about 10 s per 10^6 refined vertices.
// Deterministic. Failure: std::runtime_error (the body is empty, has several pieces or a handle).
#ifndef HF_SAMPLES_ASSETS_EVEN_MESH_H
#define HF_SAMPLES_ASSETS_EVEN_MESH_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "implicit.h"

namespace samples {

using Triangle = std::array<uint32_t, 3>;

struct TriangleMesh {
  std::vector<dvec3> points;
  std::vector<Triangle> triangles;
};

// The set where the field is `level`, on a grid of the given spacing, anywhere inside body.lower..upper. Its vertices
// keep `margin` of a grid edge away from the edge's ends; less gives slivers, as scanners write them.
TriangleMesh polygonise(const ImplicitBody& body, double spacing, double level = 0, double margin = 0.02);

// A closed manifold with exactly `count` vertices, evenly spread relative to body.detail().
TriangleMesh remesh(const ImplicitBody& body, const TriangleMesh& start, uint32_t count);

// One refinement step. parents[i] = the two ends of the edge that new vertex old_count + i came from.
TriangleMesh subdivide(const TriangleMesh& mesh, std::vector<std::array<uint32_t, 2>>& parents);

// Undoes moves that turn triangles against the body: where a triangle's side agrees little with the normals of its
// corners, and less than before the move, its corners go back.
void keep_upright(const std::vector<dvec3>& before, std::vector<dvec3>& after, const std::vector<dvec3>& normals,
                  const std::vector<Triangle>& triangles);

// Moves vertices towards the centres of their rings within the surface, keeping them on the body.
void relax(const ImplicitBody& body, TriangleMesh& mesh, int rounds, double step, int newton_steps);

// How many refinement steps a mesh of `count` vertices takes, and the base it starts from.
struct MeshPlan {
  uint32_t base = 0;
  int levels = 0;
};
MeshPlan plan_mesh(uint32_t count);

// Base mesh for a plan; the caller refines it with refine() so that it can carry attributes along.
TriangleMesh base_mesh(const ImplicitBody& body, uint32_t base_count);
TriangleMesh refine(const ImplicitBody& body, const TriangleMesh& mesh, std::vector<std::array<uint32_t, 2>>& parents);

// Permutation that sorts the points along a Morton curve: order[new] = old.
std::vector<uint32_t> spatial_order(const std::vector<dvec3>& points);

// Renames vertices by order[new] = old and sorts triangles by their smallest vertex, each starting with it.
// triangle_order receives the old index of every triangle.
TriangleMesh reorder(const TriangleMesh& mesh, const std::vector<uint32_t>& order,
                     std::vector<uint32_t>& triangle_order);

}  // namespace samples

#endif
