// Dense kernels of the factorisation. They are compiled once for every instruction set (kernels_plain.cpp,
// kernels_avx2.cpp, kernels_avx512.cpp, kernels_neon.cpp), and one set is chosen at run time. Each element of a result
// is one chain of fused multiply-adds in a fixed order, so AVX2, AVX-512 and NEON give the same bits. The plain build
// rounds every product and differs in the last digits.
//
// A front is the dense matrix of one supernode with nc columns and m rows below its triangle. Its rows lie in tiles of
// 8: the nc triangle rows padded to a multiple of 8, then the m rows padded likewise. The panel holds its columns as
// [tile][column][8]. The update matrix is a lower triangle in column tiles of 8 columns. Tile t is column-major and has
// all rows from 8 t on, so its columns are 8 (T - t) numbers apart for T tiles.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::factor {

// Kernels may touch this many numbers beyond the end of a scratch block: one AVX-512 vector of doubles.
constexpr std::size_t widest_vector = 8;

// Returns where column tile t of an update matrix with `tiles` tiles begins.
constexpr std::int64_t update_tile_start(std::int64_t tiles, std::int64_t t) noexcept {
  return 64 * (t * tiles - t * (t - 1) / 2);
}

// The front (dense matrix of one supernode) that a kernel works on.
struct FrontView {
  double* panel;
  double* update;
  std::int32_t columns;         // nc: columns of the supernode
  std::int32_t below;           // m: rows below the columns' triangle
  std::int32_t triangle_tiles;  // ceil(nc / 8)
  std::int32_t below_tiles;     // ceil(m / 8)
};

// A child's update matrix (its part of the Schur complement) that is added to the parent's front. Its rows form runs
// that are consecutive in the front too.
struct ChildView {
  const double* update;
  std::int32_t tiles;
  std::int32_t size;          // rows of the child below its triangle
  std::int32_t into_panel;    // the leading columns that belong to the parent's triangle
  const std::int32_t* place;  // by row: its place among the padded rows of the parent's front
  const std::int32_t* run;    // first rows of the runs, ending with `size`
};

// Supernodes with at most this many columns are stored inverted: X = L^-1 and B X replace the
// triangle L and the rows B (kernels_narrow.inl).
constexpr std::int32_t narrow_columns = 16;

struct Kernels {
  const char* name;

  // Factors columns [begin, end) of a front, on the tiles (8 rows each) of its triangle that hold them. begin is a
  // multiple of 8, and the columns before it are finished. The diagonal is stored inverted. The pivot of column j must
  // exceed floor[j]. Returns the column whose pivot failed, or -1.
  std::int32_t (*factor_triangle)(const FrontView& front, std::int32_t begin, std::int32_t end, const double* floor);
  // Solves columns [begin, end) on the tiles [tile_begin, tile_end) of 8 rows, which lie below the triangle tiles of
  // these columns.
  void (*solve_tiles)(const FrontView& front, std::int32_t begin, std::int32_t end, std::int32_t tile_begin,
                      std::int32_t tile_end);
  // Computes tiles of 8 columns, [tile_begin, tile_end), of the update matrix -B B'. B are the rows below the triangle.
  void (*form_update)(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end);
  // Adds columns [begin, end) of the child's update matrix to the front's panel and update matrix.
  void (*extend_add)(const FrontView& front, const ChildView& child, std::int32_t begin, std::int32_t end);
  // Finish a front of at most narrow_columns columns, once its update matrix is computed. The first replaces the
  // triangle L by X = L^-1. The second replaces the rows B by W = B X on tiles [tile_begin, tile_end).
  void (*invert_triangle)(const FrontView& front);
  void (*multiply_inverse)(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end);
  // Writes a front's tiles [tile_begin, tile_end) row by row: the packed triangle, then the rows below.
  void (*store_tiles)(const FrontView& front, double* values, std::int32_t tile_begin, std::int32_t tile_end);

  // Backward sweep of one supernode over z[row * channels + channel], for its columns j in [begin, end): z[first + j]
  // -= sum over the rows below of B[row][j] z[row].
  void (*backward_rows)(const double* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                        std::int32_t begin, std::int32_t end, double* z, std::int32_t first, std::int32_t channels);
  // Computes z <- L^-T z on a supernode's packed triangle L.
  void (*backward_triangle)(const double* triangle, std::int32_t columns, double* z, std::int32_t channels);
  // Does both steps of the backward sweep for a narrow supernode (at most narrow_columns columns).
  void (*backward_narrow)(const double* triangle, const std::int32_t* rows, std::int32_t row_count,
                          std::int32_t columns, double* z, std::int32_t first, std::int32_t channels);
  void (*backward_narrow_f32)(const float* triangle, const std::int32_t* rows, std::int32_t row_count,
                              std::int32_t columns, float* z, std::int32_t first, std::int32_t channels);
  // The next two do the same as backward_rows and backward_triangle on the single-precision copy of the factor.
  void (*backward_rows_f32)(const float* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                            std::int32_t begin, std::int32_t end, float* z, std::int32_t first, std::int32_t channels);
  void (*backward_triangle_f32)(const float* triangle, std::int32_t columns, float* z, std::int32_t channels);
  // Forward sweep of one supernode with the triangle L and the rows B below it. The first computes z <- L^-1 z, the
  // second out[k * channels] = B[k] z for every row k of B, without subtracting it. For a narrow supernode the rows
  // come before the triangle.
  void (*forward_triangle)(const double* triangle, std::int32_t columns, double* z, std::int32_t channels);
  void (*forward_rows)(const double* below, std::int32_t row_count, std::int32_t columns, const double* z, double* out,
                       std::int32_t channels);
  void (*forward_triangle_f32)(const float* triangle, std::int32_t columns, float* z, std::int32_t channels);
  void (*forward_rows_f32)(const float* below, std::int32_t row_count, std::int32_t columns, const float* z, float* out,
                           std::int32_t channels);

  // Work on elimination paths: blocks x[nc][lanes] of nc columns, where the sites fill lanes, a multiple of 8. The
  // first computes x <- L^-1 x with the triangle L. The second subtracts x[target[k]] -= B[k] x for every row k below.
  // For a narrow supernode the rows come first.
  void (*path_triangle)(const double* triangle, std::int32_t columns, double* x, std::int32_t lanes);
  void (*path_rows)(const double* below, std::int32_t row_count, std::int32_t columns, const double* x,
                    std::int32_t lanes, double* base, const std::int64_t* target);
  // Multiplies elimination paths a with paths b: gram[i * stride + j] += sum over rows of a[row * a_lanes + i] b[row *
  // b_lanes + j]. Here i < a_count, and j < b_count rounded up to 8.
  void (*gram)(const double* a, std::int32_t a_lanes, std::int32_t a_count, const double* b, std::int32_t b_lanes,
               std::int32_t b_count, std::int32_t rows, double* gram, std::int32_t stride);
};

// Returns the best set of kernels that this processor can run.
const Kernels& choose_kernels() noexcept;

// The sets of kernels by themselves, for tests that compare them. Null when this build or processor has no such set.
const Kernels* plain_kernels() noexcept;
const Kernels* avx2_kernels() noexcept;
const Kernels* avx512_kernels() noexcept;
const Kernels* neon_kernels() noexcept;

}  // namespace hf_inner::factor
