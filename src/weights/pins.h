// Pins: places of the surface whose weights are given. They are sites on the screened operator of a solution.
#pragma once
#include "weights/solution.h"

namespace hf_inner::weights {

struct Pins {
  explicit Pins(Memory& memory)
      : places(&memory), radius(&memory), start(1, 0, &memory), bone(&memory), share(&memory) {}
  Pins(const Pins& other, Memory& memory)
      : places(other.places, &memory),
        radius(other.radius, &memory),
        start(other.start, &memory),
        bone(other.bone, &memory),
        share(other.share, &memory) {}
  std::size_t count() const noexcept { return places.size(); }
  Vector<solve::Site> places;  // hard; a vertex, or a point in a triangle
  Vector<double> radius;       // of the disc around the place, inner unit; 0: the place alone
  Vector<Index> start;         // of the bones of each pin, one more
  Vector<Index> bone;
  Vector<double> share;  // of sum 1
};

// The pins as sites of the engine, on one surface. It depends on the places, not on the weights.
struct PinSites {
  explicit PinSites(Memory& memory) : sites(&memory), pin(&memory) {}
  // Throws HF_ERROR_DUPLICATE (index = pin) if two pins share a vertex.
  PinSites(const Pins& pins, const surface::Core& core, Memory& memory);
  bool operator==(const PinSites& other) const noexcept;
  Vector<solve::Site> sites;
  Vector<Index> pin;  // by site
};

// The columns of the field that pins change. Immutable.
struct PinnedField {
  explicit PinnedField(Memory& memory) : sites(memory), bone_of(&memory), column_of(&memory) {}
  // before: a field of the same solution, or null. If its sites are the same, their elimination paths are used again.
  static std::shared_ptr<const PinnedField> make(std::shared_ptr<const Solution> solution, const Pins& pins,
                                                 const PinnedField* before);
  std::shared_ptr<const Solution> solution;  // keeps the operator of the system
  PinSites sites;
  std::shared_ptr<const solve::ConstraintSystem> system;
  Vector<Index> bone_of;                              // bones of the columns
  Vector<Index> column_of;                            // by bone, or -1: as in the solution
  Buffer<double> field;                               // [vertex][bone_of]
  std::uint32_t path_solves = 0, factorisations = 0;  // of this edit
};

}  // namespace hf_inner::weights
