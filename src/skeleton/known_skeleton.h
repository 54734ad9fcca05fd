// A skeleton as a host gives it (hf/skeleton.h), kept with the findings about it.
#pragma once
#include <memory>

#include "hf/skeleton.h"
#include "skeleton/character.h"

namespace hf_inner::skeleton {

struct KnownSkeleton {
  // Throws Error as hf_skeleton_create says. skin: null if there is none.
  KnownSkeleton(const hf_skeleton_desc& desc, const hf_skin_desc* skin, std::shared_ptr<Memory> owner);
  KnownSkeleton(const KnownSkeleton&) = delete;
  KnownSkeleton& operator=(const KnownSkeleton&) = delete;

  std::shared_ptr<Memory> memory;  // outlives everything below
  Vector<char> text;               // the names, zero-terminated
  Vector<const char*> names;
  Vector<std::int32_t> parents, roles, sides;
  Vector<std::uint8_t> bound;
  Vector<double> rest, inverse_binds, travels, positions, weights;
  Vector<std::uint32_t> triangles, joints, starts;
  Vec3 up, forward;
  CharacterInput input;  // points into the arrays above
  Character character;
};

}  // namespace hf_inner::skeleton
