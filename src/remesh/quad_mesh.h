// A mesh of quads on a surface.
//
// check_quads() verifies a mesh: it has every directed edge once, no corner twice in a face, and the Euler
// characteristic of the surface.
#pragma once
#include "remesh/flux_surface.h"

namespace hf_inner::remesh {

// A point of the surface in a triangle, with the barycentric weights of its corners.
struct SurfacePoint {
  std::int32_t triangle = -1;
  double weight[3] = {0, 0, 0};
};

struct QuadMesh {
  explicit QuadMesh(Memory& memory)
      : location(memory), position(memory), pinned(memory), border(memory), scale(memory), corner(memory) {}
  Table<SurfacePoint> location;  // By vertex.
  Table<Vec3> position;          // By vertex, inner units.
  static constexpr std::uint8_t free = 0, feature = 1, snapped = 2;
  Table<std::uint8_t> pinned;  // by vertex: whether it may not move, and why.
  Table<std::uint8_t> border;  // by vertex: whether it lies on a border.
  Table<float> scale;          // by vertex: factor on the wanted edge length, below 1 if refined.
  Table<std::int32_t> corner;  // four vertices for each quad, counter-clockwise
  std::int32_t face_count() const noexcept { return corner.size() / 4; }
  // The four corners of quad f.
  std::int32_t* quad(std::int32_t f) noexcept { return corner.data() + std::ptrdiff_t{4} * f; }
  const std::int32_t* quad(std::int32_t f) const noexcept { return corner.data() + std::ptrdiff_t{4} * f; }
  void add_quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    for (const std::int32_t v : {a, b, c, d}) corner.push_back(v);
  }
  std::int32_t add_vertex(const SurfacePoint& at, const Vec3& p, std::uint8_t pin, bool is_border, float size) {
    location.push_back(at);
    pinned.push_back(pin);
    border.push_back(is_border);
    scale.push_back(size);
    return position.push_back(p);
  }
};

// The quads around every vertex v: face[start[v] .. start[v + 1]), in no order.
struct VertexFans {
  VertexFans(const QuadMesh& mesh, Memory& memory);
  std::int32_t valence(std::int32_t v) const noexcept { return start[v + 1] - start[v]; }
  Table<std::int32_t> start, face;
};

// Marks the vertices of all quads that have a marked vertex; it repeats this `rings` times.
void grow_marks(const QuadMesh& mesh, std::int32_t rings, Table<std::uint8_t>& marked);

Vec3 position_of(const FluxSurface& surface, const SurfacePoint& point) noexcept;

// Changes the weights of all places to the order of the Mesh's corners: FluxSurface may have turned triangles.
void locate_in_mesh(const FluxSurface& surface, const mesh::Mesh& mesh, QuadMesh& quads);

// Throws HF_ERROR_INTERNAL with a message that names the fault.
void check_quads(const QuadMesh& mesh, std::int32_t euler_characteristic, Memory& memory);

}  // namespace hf_inner::remesh
