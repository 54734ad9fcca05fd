// Turns rings and lines into polygons, and polygons into quads.
//
// A node has the half-edges next, up, previous and down, counter-clockwise. A face is found by repeating three moves:
// go along a half-edge, turn back, turn one half-edge clockwise. A polygon of 2 m corners around a site or saddle is
// split into m quads by a centre vertex that is joined to every second corner. Other polygons are split into quads
// along their best chords. Faces that close a border (at an apex) are left out.
//
// check_quads() verifies a mesh: it has every directed edge once, no corner twice in a face, and the Euler
// characteristic of the input.
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
  Table<SurfacePoint> location;  // By vertex.
  Table<Vec3> position;          // By vertex, inner units.
  static constexpr std::uint8_t free = 0, site = 1, snapped = 2;
  Table<std::uint8_t> pinned;  // by vertex: whether it may not move, and why.
  Table<std::uint8_t> border;  // by vertex: whether it lies on a border.
  Table<float> scale;          // by vertex: factor on the wanted edge length, below 1 if refined.
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

// Marks the vertices of all faces that have a marked vertex; it repeats this `rings` times.
void grow_marks(const QuadMesh& mesh, std::int32_t rings, Table<std::uint8_t>& marked);

Vec3 position_of(const FluxSurface& surface, const SurfacePoint& point) noexcept;

// Makes the polygons between rings of nodes and the lines that cross them. centre: by face, the critical vertex of the
// field inside it, or -1 if there is none.
QuadMesh make_polygons(const FluxField& field, const ArcGraph& graph, const RingMesh& rings,
                       Table<std::int32_t>& centre, Memory& memory);
QuadMesh split_polygons(const FluxSurface& surface, const QuadMesh& polygons, const Table<std::int32_t>& centre,
                        Memory& memory);

// Throws HF_ERROR_INTERNAL with a message that says what is wrong.
void check_quads(const QuadMesh& mesh, std::int32_t euler_characteristic, Memory& memory);

}  // namespace hf_inner
