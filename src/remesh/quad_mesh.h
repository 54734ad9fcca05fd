// Rings and lines to polygons, and polygons to quads.
//
// Faces are the orbits of "go along a half-edge, turn back, turn one step clockwise" over the nodes, whose half-edges
// stand next, up, previous, down counter-clockwise. A polygon of 2 m corners around a site or saddle is split into m
// quads by a vertex put there, joined to every second corner; others lose quads by their best chords. Faces across
// borders (the caps of apexes) are left out.
//
// check() is the oracle: every directed edge once, no corner repeated in a face, the Euler characteristic of the input.
#pragma once
#include "remesh/rings.h"

namespace hf_inner {

struct QuadMesh {
  explicit QuadMesh(Memory& memory)
      : location(memory),
        position(memory),
        pinned(memory),
        border(memory),
        scale(memory),
        face_start(memory),
        corner(memory) {}
  Table<SurfacePoint> location;  // by vertex
  Table<Vec3> position;          // inner units
  static constexpr std::uint8_t free = 0, site = 1, drawn_out = 2;
  Table<std::uint8_t> pinned;  // by vertex: whether it stays where it is, and why
  Table<std::uint8_t> border;  // by vertex
  Table<float> scale;          // by vertex, of the edge length wanted there: below 1 where the mesh was refined
  Table<std::int32_t> face_start, corner;
  std::int32_t face_count() const noexcept { return face_start.size() - 1; }
  std::int32_t size(std::int32_t f) const noexcept { return face_start[f + 1] - face_start[f]; }
  std::int32_t quad_count() const noexcept;
  std::int32_t add_vertex(const SurfacePoint& at, const Vec3& p, std::uint8_t pin, bool is_border, float size) {
    location.push_back(at), pinned.push_back(pin), border.push_back(is_border), scale.push_back(size);
    return position.push_back(p);
  }
};

// The faces around every vertex v: face[start[v] .. start[v + 1]), in no order.
struct VertexFans {
  VertexFans(const QuadMesh& mesh, Memory& memory);
  std::int32_t valence(std::int32_t v) const noexcept { return start[v + 1] - start[v]; }
  Table<std::int32_t> start, face;
};

// Marks the vertices of all faces at marked ones, `rings` times.
void grow_marks(const QuadMesh& mesh, std::int32_t rings, Table<std::uint8_t>& marked);

Vec3 position_of(const FluxSurface& surface, const SurfacePoint& point) noexcept;

// centre: by face, the critical vertex of the surface in it, -1 for faces between rings of one arc.
QuadMesh make_polygons(const FluxField& field, const ArcGraph& graph, const RingMesh& rings,
                       Table<std::int32_t>& centre, Memory& memory);
QuadMesh split_polygons(const FluxSurface& surface, const QuadMesh& polygons, const Table<std::int32_t>& centre,
                        Memory& memory);

// Throws HF_ERROR_INTERNAL naming what does not hold.
void check_quads(const QuadMesh& mesh, std::int32_t euler_characteristic, Memory& memory);

}  // namespace hf_inner
