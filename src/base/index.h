// The integer type for numbers of vertices, edges, triangles, rows and columns. at() converts it to an array position.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

using Index = std::int32_t;  // -1 often stands for "none"

constexpr std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace hf_inner
