// Quads of a core that was made of another one: of half its surface, or of its surface with more vertices.
#pragma once
#include "quads/field_quads.h"
#include "quads/intake.h"

namespace hf_inner::quads {

// A core of other triangles with the operator and the limits of `whole`. position: inner units of `whole`.
std::shared_ptr<const surface::Core> core_like(const surface::Core& whole, Span<const Vec3> position,
                                               Span<const Index> corner);

// Options for the quads of such a core. Vertices are numbers in the lists that core_like was given. Lengths and places
// are in the units of `whole`.
class OtherOptions {
 public:
  // length: of edges of quads. The options get no guides, creases and poles.
  OtherOptions(const FieldQuadOptions& given, std::shared_ptr<const surface::Core> core, double length);
  void add_guide(const QuadGuide& guide, Index vertex);
  void add_crease(Index a, Index b);  // nothing if the core has no such edge
  void add_pole(const QuadPole& pole);
  // Adds guides for the poles.
  void add_pole_guides();
  // The options, which end with *this.
  const FieldQuadOptions& get() noexcept;

 private:
  FieldQuadOptions options_;
  QuadLists lists_;
};

}  // namespace hf_inner::quads
