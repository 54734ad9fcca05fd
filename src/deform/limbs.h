// Finds the limbs of handles, and factorises the system of full-mesh steps that move these limbs alone.
//
// Let phi be the field of a handle, and A(t) the area where phi >= t. Along a limb the field falls a long way over
// little area; on the trunk it falls a little over much area. The limb is where phi is at least the t that makes
//     (1 - t)^1.5 / A(t)
// largest, and a little beyond that. A tube between two handles is all limb. By the maximum principle every part of a
// limb touches its handle.
//
// One step solves the equations of refine.h on the vertices L of all limbs. The other vertices keep their positions:
//     K_LL u = (b - K x)_L,   y_L = x_L + u.
// K_LL has a factor of its own. Cost: a sort of the vertices by field, and the factor, when handles change; a step
// costs as much per vertex as a step on the whole surface. A failed call changes nothing.
#pragma once
#include <cstdint>
#include <memory>

#include "deform/handles.h"
#include "factor/factor.h"

namespace hf_inner::deform {

struct Limbs {
  explicit Limbs(Memory& memory) : vertex(&memory), around(&memory) {}
  std::int32_t size() const noexcept { return static_cast<std::int32_t>(vertex.size()); }
  Vector<std::int32_t> vertex;                   // L, ascending
  Vector<std::int32_t> around;                   // L and its neighbours in K, ascending
  std::shared_ptr<const factor::Factor> factor;  // of K_LL; null: L is empty
  std::uint32_t steps = 0;
};

// Returns the vertices of a handle's limb, ascending, without vertices of handles.
Vector<std::int32_t> limb_of(const surface::Core& core, const Reach& reach, const HandleFields& fields,
                             std::int32_t handle, Memory& memory);

// steps: by handle, 0 where its limb is not meant. The limbs take the largest number of steps.
Limbs make_limbs(const surface::Core& core, const Reach& reach, const HandleFields& fields,
                 Span<const std::uint32_t> steps, Memory& memory);

}  // namespace hf_inner::deform
