// Kernels for fronts (dense matrices of supernodes): triangle, tiles, update matrix, extend-add, write-out. The
// kernels_*.cpp files include this file after a simd_*.h. All functions are in an unnamed namespace and use no inline
// code of the standard library. So no function compiled for one instruction set is ever linked into another.
#include <cstddef>
#include <cstdint>

#include "base/compiler.h"
#include "factor/kernels.h"

namespace {

using hf_inner::factor::ChildView;
using hf_inner::factor::FrontView;
using D = Simd<double>;
// This many tiles of 8 rows are solved together, so that their rows stay in the cache while all column blocks pass over
// them. Half and double factorise a torus of 90,000 vertices in the same time within 4 %.
constexpr std::int32_t solved_tiles = 6;
// One pass of a matrix product multiplies this many columns: 8 rows of them fill a quarter of a 48 KB cache. Half and
// double factorise a torus of 90,000 vertices in the same time within 4 %.
constexpr std::int32_t update_depth = 192;
constexpr std::int32_t tile_vectors = 8 / D::width;  // vectors per 8-row tile

// Returns vector-row v of a tiled array. A vector-row is a group of D::width rows, one vector.
inline double* vector_row(double* tiles, std::int32_t v, std::int64_t tile_stride) noexcept {
  return tiles + (v / tile_vectors) * tile_stride + (v % tile_vectors) * D::width;
}

// Multiplies two blocks: c[r][j] = (Fresh ? 0 : c[r][j]) - sum over k of a[r][k] b[j][k]. Per k, a and b advance by 8
// doubles; per j, c advances by c_step.
template <int R, int N, bool Fresh>
inline void multiply_block(const double* const* a, const double* b, std::int32_t k_count, double* const* c,
                           std::int64_t c_step) noexcept {
  D::Type sum[R][N];
  for (int r = 0; r < R; ++r) {
    for (int j = 0; j < N; ++j) sum[r][j] = Fresh ? D::zero() : D::load(c[r] + j * c_step);
  }
  std::int64_t offset = 0;
  for (std::int32_t k = 0; k < k_count; ++k, offset += 8) {
    D::Type column[R];
    for (int r = 0; r < R; ++r) column[r] = D::load(a[r] + offset);
    for (int j = 0; j < N; ++j) {
      const D::Type factor = D::all(b[offset + j]);
      for (int r = 0; r < R; ++r) sum[r][j] = D::subtract_product(column[r], factor, sum[r][j]);
    }
  }
  for (int r = 0; r < R; ++r) {
    for (int j = 0; j < N; ++j) D::store(c[r] + j * c_step, sum[r][j]);
  }
}

// Computes one tile of 8 columns for R vector-rows (each as many rows as a vector has numbers).
template <int R, bool Fresh>
inline void multiply_tile(const double* const* a, const double* b, std::int32_t k_count, double* const* c,
                          std::int64_t c_step) noexcept {
  for (int j = 0; j < 8; j += gemm_columns) {
    double* part[R];
    for (int r = 0; r < R; ++r) part[r] = c[r] + j * c_step;
    multiply_block<R, gemm_columns, Fresh>(a, b + j, k_count, part, c_step);
  }
}

// Computes the last `width` columns of a panel for one vector-row (as many rows as a vector has numbers), when the
// number of columns is no multiple of 8.
inline void multiply_narrow(const double* a, const double* b, std::int32_t k_count, double* c,
                            std::int32_t width) noexcept {
  double* row[1] = {c};
  const double* left[1] = {a};
  std::int32_t j = 0;
  for (; j + 4 <= width; j += 4) {
    double* part[1] = {row[0] + 8 * j};
    multiply_block<1, 4, false>(left, b + j, k_count, part, 8);
  }
  for (; j < width; ++j) {
    double* part[1] = {row[0] + 8 * j};
    multiply_block<1, 1, false>(left, b + j, k_count, part, 8);
  }
}

// Updates columns [8 block, 8 block + width) of the panel on vector-rows [v, v_end) (groups of D::width rows): it
// subtracts the products with all columns before them.
inline void panel_multiply(double* panel, std::int64_t tile_stride, std::int32_t v, std::int32_t v_end,
                           std::int32_t block, std::int32_t width) noexcept {
  const double* b = panel + block * tile_stride;
  const std::int32_t k_count = 8 * block;
  if (k_count == 0) return;
  const std::int64_t shift = 64 * static_cast<std::int64_t>(block);
  if (width < 8) {
    for (; v < v_end; ++v) {
      double* row = vector_row(panel, v, tile_stride);
      multiply_narrow(row, b, k_count, row + shift, width);
    }
    return;
  }
  for (; v + gemm_rows <= v_end; v += gemm_rows) {
    const double* a[gemm_rows];
    double* c[gemm_rows];
    for (int r = 0; r < gemm_rows; ++r) {
      double* row = vector_row(panel, v + r, tile_stride);
      a[r] = row;
      c[r] = row + shift;
    }
    multiply_tile<gemm_rows, false>(a, b, k_count, c, 8);
  }
  for (; v < v_end; ++v) {
    double* row = vector_row(panel, v, tile_stride);
    const double* a[1] = {row};
    double* c[1] = {row + shift};
    multiply_tile<1, false>(a, b, k_count, c, 8);
  }
}

// Multiplies one vector-row (as many rows as a vector has numbers) of `Width` columns by the inverse transpose of the 8
// x 8 triangle at `diagonal` ([column][8], diagonal inverted).
template <int Width>
inline void solve_vector_row(double* c, const double* diagonal) noexcept {
  D::Type x[Width];
  for (int j = 0; j < Width; ++j) x[j] = D::load(c + 8 * j);
  for (int j = 0; j < Width; ++j) {
    x[j] = D::multiply(x[j], D::all(diagonal[9 * j]));
    for (int k = j + 1; k < Width; ++k) x[k] = D::subtract_product(x[j], D::all(diagonal[8 * j + k]), x[k]);
  }
  for (int j = 0; j < Width; ++j) D::store(c + 8 * j, x[j]);
}

template <int Width>
void solve_rows_fixed(double* panel, std::int64_t tile_stride, std::int32_t v, std::int32_t v_end,
                      std::int32_t block) noexcept {
  const double* diagonal = panel + block * tile_stride + 64 * static_cast<std::int64_t>(block);
  for (; v < v_end; ++v)
    solve_vector_row<Width>(vector_row(panel, v, tile_stride) + 64 * static_cast<std::int64_t>(block), diagonal);
}

void solve_rows(double* panel, std::int64_t tile_stride, std::int32_t v, std::int32_t v_end, std::int32_t block,
                std::int32_t width) noexcept {
  switch (width) {
    case 1:
      return solve_rows_fixed<1>(panel, tile_stride, v, v_end, block);
    case 2:
      return solve_rows_fixed<2>(panel, tile_stride, v, v_end, block);
    case 3:
      return solve_rows_fixed<3>(panel, tile_stride, v, v_end, block);
    case 4:
      return solve_rows_fixed<4>(panel, tile_stride, v, v_end, block);
    case 5:
      return solve_rows_fixed<5>(panel, tile_stride, v, v_end, block);
    case 6:
      return solve_rows_fixed<6>(panel, tile_stride, v, v_end, block);
    case 7:
      return solve_rows_fixed<7>(panel, tile_stride, v, v_end, block);
    default:
      return solve_rows_fixed<8>(panel, tile_stride, v, v_end, block);
  }
}

// Computes the Cholesky factor of an 8 x 8 tile, right-looking. Entries above the diagonal hold values that are never
// read.
std::int32_t factor_tile(double* tile, std::int32_t width, const double* floor) noexcept {
  for (std::int32_t j = 0; j < width; ++j) {
    const double pivot = tile[9 * j];
    if (!(pivot > floor[j]) || !(pivot <= 1.7976931348623157e308)) return j;
    const double inverse = 1.0 / HF_SQUARE_ROOT(pivot);
    D::Type column[tile_vectors];
    for (int p = 0; p < tile_vectors; ++p) {
      column[p] = D::multiply(D::load(tile + 8 * j + p * D::width), D::all(inverse));
      D::store(tile + 8 * j + p * D::width, column[p]);
    }
    for (std::int32_t k = j + 1; k < width; ++k) {
      const D::Type factor = D::all(tile[8 * j + k]);
      for (int p = 0; p < tile_vectors; ++p) {
        double* target = tile + 8 * k + p * D::width;
        D::store(target, D::subtract_product(column[p], factor, D::load(target)));
      }
    }
    tile[9 * j] = inverse;
  }
  return -1;
}

inline std::int32_t smaller(std::int32_t a, std::int32_t b) noexcept { return a < b ? a : b; }

std::int32_t factor_triangle(const FrontView& front, std::int32_t begin, std::int32_t end, const double* floor) {
  const std::int64_t stride = 8 * static_cast<std::int64_t>(front.columns);
  const std::int32_t last_tile = (end + 7) / 8;
  for (std::int32_t block = begin / 8; block < last_tile; ++block) {
    const std::int32_t width = smaller(8, end - 8 * block);
    panel_multiply(front.panel, stride, block * tile_vectors, last_tile * tile_vectors, block, width);
    const std::int32_t lost =
        factor_tile(front.panel + block * stride + 64 * static_cast<std::int64_t>(block), width, floor + 8 * block);
    if (lost >= 0) return 8 * block + lost;
    solve_rows(front.panel, stride, (block + 1) * tile_vectors, last_tile * tile_vectors, block, width);
  }
  return -1;
}

void solve_tiles(const FrontView& front, std::int32_t begin, std::int32_t end, std::int32_t tile_begin,
                 std::int32_t tile_end) {
  const std::int64_t stride = 8 * static_cast<std::int64_t>(front.columns);
  for (std::int32_t tile = tile_begin; tile < tile_end; tile += solved_tiles) {
    const std::int32_t v = tile * tile_vectors, v_end = smaller(tile + solved_tiles, tile_end) * tile_vectors;
    for (std::int32_t block = begin / 8; 8 * block < end; ++block) {
      const std::int32_t width = smaller(8, end - 8 * block);
      panel_multiply(front.panel, stride, v, v_end, block, width);
      solve_rows(front.panel, stride, v, v_end, block, width);
    }
  }
}

template <bool Fresh>
void update_block(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end, std::int32_t k,
                  std::int32_t k_count) noexcept {
  const std::int64_t stride = 8 * static_cast<std::int64_t>(front.columns);
  double* rows = front.panel + front.triangle_tiles * stride + 8 * static_cast<std::int64_t>(k);
  const std::int32_t v_end = front.below_tiles * tile_vectors;
  for (std::int32_t tile = tile_begin; tile < tile_end; ++tile) {
    const double* b = rows + tile * stride;
    const std::int64_t step = 8 * static_cast<std::int64_t>(front.below_tiles - tile);
    double* target = front.update + hf_inner::factor::update_tile_start(front.below_tiles, tile) -
                     8 * static_cast<std::int64_t>(tile);
    std::int32_t v = tile * tile_vectors;
    for (; v + gemm_rows <= v_end; v += gemm_rows) {
      const double* a[gemm_rows];
      double* c[gemm_rows];
      for (int r = 0; r < gemm_rows; ++r) {
        a[r] = vector_row(rows, v + r, stride);
        c[r] = target + (v + r) * D::width;
      }
      multiply_tile<gemm_rows, Fresh>(a, b, k_count, c, step);
    }
    if (gemm_rows == 3 && v + 2 <= v_end) {
      const double* a[2] = {vector_row(rows, v, stride), vector_row(rows, v + 1, stride)};
      double* c[2] = {target + v * D::width, target + (v + 1) * D::width};
      multiply_tile<2, Fresh>(a, b, k_count, c, step);
      v += 2;
    }
    for (; v < v_end; ++v) {
      const double* a[1] = {vector_row(rows, v, stride)};
      double* c[1] = {target + v * D::width};
      multiply_tile<1, Fresh>(a, b, k_count, c, step);
    }
  }
}

void form_update(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end) {
  update_block<true>(front, tile_begin, tile_end, 0, smaller(update_depth, front.columns));
  for (std::int32_t k = update_depth; k < front.columns; k += update_depth) {
    update_block<false>(front, tile_begin, tile_end, k, smaller(update_depth, front.columns - k));
  }
}

// Adds target[k] += source[k] for k < count.
inline void add_run(double* target, const double* source, std::int32_t count) noexcept {
  std::int32_t k = 0;
  for (; k + D::width <= count; k += D::width) D::store(target + k, D::add(D::load(target + k), D::load(source + k)));
  if (D::width == 8 && count - k > 2) {
    const std::int32_t rest = count - k;
    D::store_part(target + k, D::add(D::load_part(target + k, rest), D::load_part(source + k, rest)), rest);
    return;
  }
  for (; k < count; ++k) target[k] += source[k];
}

// Returns the numbers of column j of a child supernode's update matrix, indexed by its rows.
inline const double* child_column(const ChildView& child, std::int32_t j) noexcept {
  const std::int64_t tile = j >> 3;
  return child.update + hf_inner::factor::update_tile_start(child.tiles, tile) + (j & 7) * 8 * (child.tiles - tile) -
         8 * tile;
}

void extend_add(const FrontView& front, const ChildView& child, std::int32_t begin, std::int32_t end) {
  const std::int64_t tile_stride = 8 * static_cast<std::int64_t>(front.columns);
  const std::int32_t offset = 8 * front.triangle_tiles;
  const std::int32_t* run = child.run;
  for (std::int32_t j = begin; j < end; ++j) {
    while (run[1] <= j) ++run;
    const double* source = child_column(child, j);
    std::int32_t i = j;
    if (j < child.into_panel) {
      // The panel is stored in tiles of 8 rows, so runs of rows are split at tile boundaries.
      double* target = front.panel + 8 * static_cast<std::int64_t>(child.place[j]);
      for (const std::int32_t* r = run; i < child.size; ++r) {
        for (const std::int32_t last = r[1]; i < last;) {
          const std::int32_t place = child.place[i];
          const std::int32_t count = smaller(8 - (place & 7), last - i);
          add_run(target + (place >> 3) * tile_stride + (place & 7), source + i, count);
          i += count;
        }
      }
      continue;
    }
    const std::int64_t column = child.place[j] - offset, tile = column >> 3;
    double* target = front.update + hf_inner::factor::update_tile_start(front.below_tiles, tile) +
                     (column & 7) * 8 * (front.below_tiles - tile) - 8 * tile - offset;
    for (const std::int32_t* r = run; i < child.size; ++r) {
      add_run(target + child.place[i], source + i, r[1] - i);
      i = r[1];
    }
  }
}

// Copies row r of a tile, columns [0, count), to consecutive numbers.
inline void store_row(const double* tile, std::int32_t r, std::int32_t count, double* out) noexcept {
  for (std::int32_t k = 0; k < count; ++k) out[k] = tile[8 * k + r];
}

void store_tiles(const FrontView& front, double* values, std::int32_t tile_begin, std::int32_t tile_end) {
  const std::int64_t columns = front.columns, stride = 8 * columns;
  double* below = values + columns * (columns + 1) / 2;
  for (std::int32_t tile = tile_begin; tile < tile_end; ++tile) {
    const double* source = front.panel + tile * stride;
    double* row[8];
    std::int32_t count = 8;
    std::int64_t whole = columns;  // number of columns that all rows of the tile have
    if (tile < front.triangle_tiles) {
      const std::int64_t first = 8 * static_cast<std::int64_t>(tile);
      count = smaller(8, static_cast<std::int32_t>(columns - first));
      for (std::int32_t r = 0; r < count; ++r) {
        row[r] = values + (first + r) * (first + r + 1) / 2;
        for (std::int64_t k = first; k <= first + r; ++k) row[r][k] = source[8 * k + r];
      }
      whole = first;
    } else {
      const std::int64_t first = 8 * static_cast<std::int64_t>(tile - front.triangle_tiles);
      count = smaller(8, static_cast<std::int32_t>(front.below - first));
      for (std::int32_t r = 0; r < count; ++r) row[r] = below + (first + r) * columns;
    }
    std::int64_t k = 0;
    for (; k < whole; k += 8) {
      const std::int32_t width = whole - k < 8 ? static_cast<std::int32_t>(whole - k) : 8;
      store_transposed(source + 8 * k, row, k, count, width);
    }
  }
}

}  // namespace
