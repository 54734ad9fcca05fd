// Finds thin parts that no pair moves: antlers, ears, a held weapon. They may sink into the ground
// (transfer_ground.cpp).
//
// A part is thin where a ray from the surface into the body leaves the body soon. Behind the last region of a branch
// all fields are constant: the whole branch has the values of the place where it leaves the body. Its vertices move
// with the clusters there, so raising the branch would raise the body.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/span.h"
#include "surface/geometry.h"

namespace hf_inner::transfer {

// By vertex: 1 if the surface is thin there. geometry: without links.
Vector<std::uint8_t> thin_vertices(const surface::Geometry& geometry, Memory& memory, JobRunner& jobs);

// By vertex: 1 if no field changes there, along no edge. field: `width` values for each vertex.
Vector<std::uint8_t> idle_vertices(const surface::Geometry& geometry, const double* field, std::size_t width,
                                   Memory& memory);

}  // namespace hf_inner::transfer
