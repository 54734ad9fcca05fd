// Turns vertices and triangle points that a caller names into inner ones.
//
// `position` is the place in the caller's list and becomes the index of the error; `list` names the list in the text.
#pragma once
#include "hf/base.h"
#include "mesh/mesh.h"

namespace hf_inner {

// The inner vertex, Mesh::none for an isolated one. Throws HF_ERROR_OUT_OF_RANGE.
std::int32_t inner_vertex(const Mesh& mesh, std::uint32_t vertex, std::size_t position, const char* list = "the list");

// The inner vertex. Throws as inner_vertex, and HF_ERROR_INVALID_ARGUMENT for an isolated one.
std::int32_t usable_vertex(const Mesh& mesh, std::uint32_t vertex, std::size_t position, const char* list = "the list");

// A point of the surface: three inner vertices of one component, and their weights.
struct SurfacePlace {
  std::int32_t vertex[3];
  const double* weight;
};

// The point of a triangle as given, or of a face of three corners. Throws as require_triangles,
// HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT (collapsed, or a face of more corners), and as the weights of its
// corners ask: HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (below 0, or of another sum than 1).
SurfacePlace place_in_triangle(const Mesh& mesh, std::uint32_t triangle, const double* weights, std::size_t position);

// The point between three vertices as given. Throws as usable_vertex and place_in_triangle do, and
// HF_ERROR_INVALID_ARGUMENT for vertices that are equal or in different components.
SurfacePlace place_between(const Mesh& mesh, const std::uint32_t* vertices, const double* weights,
                           std::size_t position);

// Throws HF_ERROR_UNSUPPORTED for a surface that was made of a graph. purpose: what the call needs triangles for.
void require_triangles(const Mesh& mesh, const char* purpose, std::uint32_t index = HF_NO_INDEX);

}  // namespace hf_inner
