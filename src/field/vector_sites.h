// Moves and turns the vectors of the sites of a field with three channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section
// 3.3).
#pragma once
#include "field/scalar_field.h"

namespace hf_inner::field {

// Throws HF_ERROR_INVALID_ARGUMENT for a field of other than 3 channels, HF_ERROR_UNSUPPORTED on a graph.
void require_vectors(const ScalarField& field);

// Moves sites to vertices of the caller's mesh in the same component. Each vector is carried along the shortest path of
// edges, turned from vertex normal to vertex normal. The call moves all sites or throws. Throws what ScalarField::edit
// throws, and HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT (isolated vertex, another
// component); index = position in the list.
void move_vectors(ScalarField& field, std::uint32_t count, const std::uint32_t* sites, const std::uint32_t* vertices);

// Turns the vectors about their vertex normals by angles in radians. Throws HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE.
void rotate_vectors(ScalarField& field, std::uint32_t count, const std::uint32_t* sites, const double* angles);

}  // namespace hf_inner::field
