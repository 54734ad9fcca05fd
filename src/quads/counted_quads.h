// Quads of about a wanted number, from a map that can be made for any edge length.
#pragma once
#include "quads/field_quads.h"
#include "quads/grid_map.h"

namespace hf_inner::quads {

double area_of(const remesh::FluxSurface& surface);

// How far a number of quads is from the wanted one: half as many are as bad as twice as many.
double miss_of(double ratio) noexcept;

// Makes quads of a map at any edge length. Components whose quads have another Euler characteristic there get quads of
// shorter edges, and at last quads of their triangles.
class QuadSource {
 public:
  // A component that would get quads of shorter edges, thrown where that is not wanted.
  struct LostComponent {};

  // once: make is called once if need be, so the map's factor may go before its end. strict: make throws LostComponent.
  QuadSource(const remesh::FluxSurface& surface, GridMapper& mapper, const remesh::Table<std::uint8_t>& features,
             bool once, bool strict, Memory& memory);
  // Returns valid quads. untangled: which map is taken; components that have no valid quads there take the other one.
  QuadComplex make(double length, bool untangled, FieldQuadReport& report);
  // Whether make can be called once more.
  bool is_open() const noexcept { return !released_; }

 private:
  struct Found {
    explicit Found(Memory& memory) : quads(memory), component(memory), sound(memory) {}
    QuadComplex quads;
    remesh::Table<std::int32_t> component;  // by quad
    remesh::Table<std::uint8_t> sound;      // by component: whether its quads have its Euler characteristic and area
  };
  Found find_in_map(double length, bool untangled, FieldQuadReport& report);
  Found find(double length, bool untangled, FieldQuadReport& report);
  void substitute(double length, bool untangled, remesh::Table<std::uint8_t>& missing, FieldQuadReport& report);

  const remesh::FluxSurface& surface_;
  GridMapper& mapper_;
  const remesh::Table<std::uint8_t>& features_;
  const bool once_, strict_;
  bool released_ = false;
  Memory& memory_;
  QuadComplex substitute_;
  remesh::Table<std::uint8_t> of_substitute_;  // by component: whether substitute_ has it
  remesh::Table<double> area_;                 // by component
  remesh::Table<std::uint8_t> creased_;        // by component: a few quads would not keep its creases
};

// Makes meshes of about `wanted` quads, or of an edge length.
class CountedQuads {
 public:
  CountedQuads(const remesh::FluxSurface& surface, QuadSource& source, double wanted, double edge_length, bool by_count,
               Memory& memory)
      : surface_(surface),
        source_(source),
        wanted_(wanted),
        edge_length_(edge_length),
        by_count_(by_count),
        memory_(memory) {}

  remesh::QuadMesh make(bool untangled, FieldQuadReport& made);
  // Makes another of shorter edges, which has as many quads. share: of the edges of make.
  remesh::QuadMesh make_finer(double share, bool untangled, FieldQuadReport& made);

 private:
  remesh::QuadMesh coarsened(QuadComplex& quads, bool limited, FieldQuadReport& made);

  const remesh::FluxSurface& surface_;
  QuadSource& source_;
  const double wanted_, edge_length_;
  const bool by_count_;
  Memory& memory_;
  double length_ = 0;  // of the lines of make
};

}  // namespace hf_inner::quads
