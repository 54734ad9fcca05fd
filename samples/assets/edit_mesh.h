// A closed triangle mesh whose edges can be split, collapsed and flipped. Half-edge h = 3 t + k runs from corner k of
// triangle t to the next corner; twin[h] is its partner in the neighbouring triangle. Every operation is O(valence) and
// leaves a closed 2-manifold of the same genus, or changes nothing and returns false.
#ifndef HF_SAMPLES_ASSETS_EDIT_MESH_H
#define HF_SAMPLES_ASSETS_EDIT_MESH_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "even_mesh.h"

namespace samples {

constexpr uint32_t no_index = 0xFFFFFFFFu;

class EditMesh {
 public:
  // Throws std::runtime_error when the triangles are not a closed manifold.
  explicit EditMesh(const TriangleMesh& mesh);

  std::vector<dvec3> points;
  std::vector<uint32_t> corner;  // vertex at each half-edge's start; no_index in dead triangles
  std::vector<uint32_t> twin;
  std::vector<uint32_t> outgoing;  // one half-edge per vertex; no_index for dead vertices
  uint32_t live_vertices = 0;

  static uint32_t next(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static uint32_t previous(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  uint32_t from(uint32_t h) const { return corner[h]; }
  uint32_t to(uint32_t h) const { return corner[next(h)]; }
  bool alive(uint32_t h) const { return corner[h] != no_index; }

  // The next outgoing half-edge around the start of h.
  uint32_t rotate(uint32_t h) const { return twin[previous(h)]; }
  uint32_t valence(uint32_t v) const;
  bool connected(uint32_t a, uint32_t b) const;

  // New vertex at p on the edge h; returns its index.
  uint32_t split(uint32_t h, const dvec3& p);
  // Merges the start of h into its end, which moves to p. Refused when the topology or a triangle's side would change.
  bool collapse(uint32_t h, const dvec3& p);
  // Turns the edge in its quad. Refused when the other diagonal exists or a triangle would turn over.
  bool flip(uint32_t h);

  dvec3 face_area(uint32_t t) const;
  TriangleMesh compact() const;

  // Do the triangles around `moved`, but those that contain `skip`, keep their side when it goes to p?
  bool stays_upright(uint32_t moved, const dvec3& p, uint32_t skip) const;

 private:
  void pair(uint32_t a, uint32_t b) {
    twin[a] = b;
    twin[b] = a;
  }
};

}  // namespace samples

#endif
