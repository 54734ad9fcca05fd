// A mesh of quads as half-edges, and the repairs that make it valid.
//
// Half-edge 4 f + k is side k of quad f, counter-clockwise. Two quads may share several sides, and a quad may share
// sides with itself, so this holds every mesh that lines on a surface can have. A chord is a row of quads, each beside
// the next across opposite sides; it crosses those sides. Chords end at borders or close. A quad has two chords, or one
// that crosses itself.
//
// A valid mesh has no two edges between the same vertices and no quad with a repeated corner. Two edges that bound a
// few quads of a fold become one, and the quads go. Two edges around a thin part stay separate. The two quads of one of
// them get a ring of quads around them (a pillow: Mitchell and Tautges 1995). So the edge gets ends of its own. Every
// repair keeps the Euler characteristic.
#pragma once
#include "remesh/quad_mesh.h"

namespace hf_inner::quads {

struct QuadComplex {
  explicit QuadComplex(Memory& memory) : twin(memory), tail(memory), feature(memory), vertices(memory), holes(memory) {}
  remesh::Table<std::int32_t> twin;     // by half-edge; none at a border
  remesh::Table<std::int32_t> tail;     // by half-edge: its vertex
  remesh::Table<std::uint8_t> feature;  // by half-edge: whether the edge lies on a border or a crease
  remesh::QuadMesh vertices;            // the vertices of all half-edges; no faces
  // Holes of the surface that are still closed: a half-edge that leaves the vertex there, and a half-edge of the
  // surface at the border of the hole. repair_quads() opens them.
  struct Hole {
    std::int32_t half, border;
  };
  remesh::Table<Hole> holes;

  std::int32_t quad_count() const noexcept { return tail.size() / 4; }
  static std::int32_t next(std::int32_t h) noexcept { return h % 4 == 3 ? h - 3 : h + 1; }
  static std::int32_t previous(std::int32_t h) noexcept { return h % 4 == 0 ? h + 3 : h - 1; }
  static std::int32_t opposite(std::int32_t h) noexcept { return h ^ 2; }
  std::int32_t head(std::int32_t h) const noexcept { return tail[next(h)]; }
  // Joins two half-edges. Either may be none, then the other is at a border.
  void join(std::int32_t a, std::int32_t b) noexcept {
    if (a >= 0) twin[a] = b;
    if (b >= 0) twin[b] = a;
  }
  // Gives every fan of quads its own vertex, with the place of the old one. Unused vertices go.
  void split_fans(Memory& memory);
  // Removes quads with dead[quad] != 0. Nothing may be joined to them.
  void remove(const remesh::Table<std::uint8_t>& dead, Memory& memory);
  // Appends the quads of `other` with take[quad] != 0. A quad comes with all quads that it is joined to.
  void append(const QuadComplex& other, const remesh::Table<std::uint8_t>& take, Memory& memory);
  void append(const QuadComplex& other, Memory& memory) {
    append(other, remesh::Table<std::uint8_t>(other.quad_count(), 1, memory), memory);
  }
  remesh::QuadMesh mesh(Memory& memory) const;
  double area(std::int32_t quad) const noexcept;
};

struct QuadEdge {
  std::int32_t a, b, half;  // a <= b: its vertices
};
inline bool same(const QuadEdge& x, const QuadEdge& y) noexcept { return x.a == y.a && x.b == y.b; }
// Every edge once, those between the same vertices one after the other.
Vector<QuadEdge> edges_of(const QuadComplex& quads, Memory& memory);

// The component of the surface where each quad lies.
remesh::Table<std::int32_t> components_of(const remesh::FluxSurface& surface, const QuadComplex& quads, Memory& memory);

// By component of the surface: whether the quads there are valid, connected, and have its Euler characteristic and most
// of its area. areas: by component.
remesh::Table<std::uint8_t> find_sound(const remesh::FluxSurface& surface, const QuadComplex& quads,
                                       const remesh::Table<std::int32_t>& component, const remesh::Table<double>& areas,
                                       Memory& memory);

// Makes three quads of every triangle of the components with take[component] != 0: valid at any genus, but most of
// their vertices are irregular. features: by half-edge of the surface.
QuadComplex split_triangles(const remesh::FluxSurface& surface, const remesh::Table<std::uint8_t>& features,
                            const remesh::Table<std::uint8_t>& take, Memory& memory);

// Makes the fewest quads of the components with take[component] != 0: six of one that closes like a sphere, one of a
// disc. Sets take to 0 for others, and where so few quads lose the shape.
// areas: by component.
QuadComplex least_quads(const remesh::FluxSurface& surface, const remesh::Table<double>& areas,
                        remesh::Table<std::uint8_t>& take, Memory& memory);

struct RepairReport {
  std::int32_t removed = 0;  // quads of folds
  std::int32_t added = 0;    // quads around thin parts
};

// Makes the mesh valid. Only two edges between the same vertices that are both on a border may remain.
void repair_quads(const remesh::FluxSurface& surface, QuadComplex& quads, RepairReport& report, Memory& memory);

// Removes inner vertices of one or two quads. Returns how many quads are gone.
std::int32_t remove_doublets(QuadComplex& quads, Memory& memory);

}  // namespace hf_inner::quads
