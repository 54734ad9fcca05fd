#include "solve/dense_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/compiler.h"
#include "base/hypotenuse.h"
#include "base/index.h"
#include "factor/kernels.h"

namespace hf_inner::solve {
namespace {

// Rows and columns whose products are summed together: 4 x 4 products with four sums each fill 16 registers of AVX2, or
// half of the registers of AVX-512. With 800 rows of both signs a factorisation takes 96 ms, 48 ms with 2 and 66 ms
// with 8 (AVX2), but these round otherwise: fields get other bits.
constexpr std::int32_t tile = 4;
// Running sums of a product. Their order decides the last bits, so the number equals the lanes of HF_FOUR_LANES.
constexpr std::size_t sums_of_product = 4;
// Rows that take plane rotations together, since one row is a chain of dependent operations. With 800 rows 2 takes 15 %
// longer, 8 takes 14 % less.
constexpr std::int32_t rotated_together = 4;
// Columns that are factored before all rows below are solved for them: trades passes over the rows for work on one
// thread. With half and double, 100 sites on a torus of 90,000 vertices take 4.0 to 4.9 ms. No result depends on it.
constexpr std::int32_t block_columns = 64;

// A pivot of the sites' dense system below this share of its diagonal entry has too few digits left: corrections of the
// field no longer help. Independent vertices stay above 1e-9 even on small meshes with a bi-harmonic operator, and
// points that are no closer than dependence.h allows above 1e-11. A hard point between soft sites of a stiffness near
// 1e12 falls below. At a tenth of the value, more fields of such sites are wrong. At twice the value, three points in
// one triangle of a finely refined cylinder are refused in a bi-harmonic field; half changes nothing on eight shapes.
constexpr double pivot_floor = 1e-11;

// Rates for removing a site's row from the dense factor: the nanoseconds of one rotation for one number behind the row,
// and the flops of a factorisation in one nanosecond. They decide between two routes with the same result, so wrong
// rates cost only time. Half and double of both change no bit where 150 of 300 sites leave eight shapes. With AVX-512
// and 800 rows, the rotations of the first row take 1.3 ms, as predicted, and a factorisation 4.1 ms, at 41 flops.
constexpr double rotation_ns = 2, factor_rate = 15;
// A dense factorisation of fewer rows than least_parallel runs on one thread. Above that, a thread's job takes
// tiles_per_job tiles of eight rows. Smaller jobs would cost more to hand out than to do. On two threads and a torus of
// 102,400 vertices half and double of each add 500 and 1,200 sites in the same time within 2 %.
constexpr std::int32_t least_parallel = 400, tiles_per_job = 12;

// Computes dots[i * tile + j] = a_i . b_j over `count` entries. Each product has four running sums in one fixed order,
// so every instruction set gives the same bits.
HF_FOUR_LANES
void tile_dots(const double* const a[tile], const double* const b[tile], std::size_t count, double* dots) {
  constexpr std::size_t lanes = sums_of_product;
  double sum[tile * tile][lanes] = {};
  std::size_t p = 0;
  for (; p + lanes <= count; p += lanes) {
    for (std::size_t i = 0; i < tile; ++i) {
      for (std::size_t j = 0; j < tile; ++j) {
        for (std::size_t k = 0; k < lanes; ++k) sum[i * tile + j][k] += a[i][p + k] * b[j][p + k];
      }
    }
  }
  for (; p < count; ++p) {
    for (std::size_t i = 0; i < tile; ++i) {
      for (std::size_t j = 0; j < tile; ++j) sum[i * tile + j][0] += a[i][p] * b[j][p];
    }
  }
  for (std::size_t q = 0; q < tile * tile; ++q) dots[q] = (sum[q][0] + sum[q][2]) + (sum[q][1] + sum[q][3]);
}

}  // namespace

DenseBlock::DenseBlock(Memory& memory, std::size_t border, const double* corner)
    : memory_(&memory),
      ids_(&memory),
      sign_(&memory),
      m_(&memory),
      l_(&memory),
      border_(border),
      n_(&memory),
      m_inverse_n_(&memory) {
  if (corner) std::copy_n(corner, border * border, corner_);
}

DenseBlock::DenseBlock(const DenseBlock& other)
    : memory_(other.memory_),
      ids_(other.ids_, other.memory_),
      sign_(other.sign_, other.memory_),
      m_(other.m_, other.memory_),
      l_(other.l_, other.memory_),
      valid_(other.valid_),
      negative_(other.negative_),
      border_(other.border_),
      n_(other.n_, other.memory_),
      m_inverse_n_(other.m_inverse_n_, other.memory_) {
  std::copy(std::begin(other.corner_), std::end(other.corner_), corner_);
  std::copy(std::begin(other.schur_), std::end(other.schur_), schur_);
}

// Updates the dense factor L after row r was removed, by plane rotations: adds column r below row r to the later
// columns. Each row first takes the rotations of the rows above it, then makes its own. Four rows are processed at
// once, because one row is a chain of dependent operations.
void DenseBlock::update_without(std::int32_t r) {
  struct Rotation {
    double c, s, inverse_c;
  };
  Vector<Rotation> rotation(static_cast<std::size_t>(valid_), memory_);
  constexpr std::int32_t together = rotated_together;
  for (std::int32_t begin = r + 1; begin < valid_; begin += together) {
    const std::int32_t rows = std::min(together, valid_ - begin);
    double* l[together];
    double left[together];
    for (std::int32_t t = 0; t < together; ++t) {
      l[t] = l_.data() + row(begin + std::min(t, rows - 1));
      left[t] = l[t][r];
    }
    for (std::int32_t j = r + 1; rows == together && j < begin; ++j) {
      const Rotation q = rotation[static_cast<std::size_t>(j)];
      for (std::int32_t t = 0; t < together; ++t) {
        l[t][j] = (l[t][j] + q.s * left[t]) * q.inverse_c;
        left[t] = q.c * left[t] - q.s * l[t][j];
      }
    }
    for (std::int32_t t = 0; t < rows; ++t) {
      const std::int32_t i = begin + t;
      for (std::int32_t j = rows == together ? begin : r + 1; j < i; ++j) {
        const Rotation q = rotation[static_cast<std::size_t>(j)];
        l[t][j] = (l[t][j] + q.s * left[t]) * q.inverse_c;
        left[t] = q.c * left[t] - q.s * l[t][j];
      }
      const double pivot = 1 / l[t][i], radius = hypotenuse(pivot, left[t]);
      rotation[static_cast<std::size_t>(i)] = {radius / pivot, left[t] / pivot, pivot / radius};
      l[t][i] = 1 / radius;
    }
  }
}

void DenseBlock::keep_rows(Span<const std::int32_t> rows) {
  for (Vector<double>* packed : {&m_, &l_}) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j)
        (*packed)[to++] = (*packed)[row(rows[i]) + static_cast<std::size_t>(rows[j])];
    }
    packed->resize(to);
  }
  negative_ = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ids_[i] = ids_[at(rows[i])];
    sign_[i] = sign_[at(rows[i])];
    negative_ += sign_[i] < 0;
    for (std::size_t p = 0; p < border_; ++p) n_[i * border_ + p] = n_[at(rows[i]) * border_ + p];
  }
  ids_.resize(rows.size());
  sign_.resize(rows.size());
  n_.resize(rows.size() * border_);
}

void DenseBlock::remove(Span<const std::int32_t> ids) {
  if (ids.empty()) return;
  Vector<std::int32_t> leaving(ids.begin(), ids.end(), memory_);
  std::sort(leaving.begin(), leaving.end());
  const auto leaves = [&](std::int32_t id) { return std::binary_search(leaving.begin(), leaving.end(), id); };
  const double k = count(), d = static_cast<double>(ids.size()), left = k - d;
  Vector<std::int32_t> kept(memory_);
  kept.reserve(ids_.size());
  std::int32_t first = count();
  for (std::int32_t i = count() - 1; i >= 0; --i) {
    if (leaves(ids_[static_cast<std::size_t>(i)])) first = i;
  }
  const double before = static_cast<double>(first);
  const double fresh = (left * left * left - before * before * before) / 3 / factor_rate;
  if (negative_ == 0 && d * rotation_ns * (k - first) * k < fresh) {
    // Removes rows of the dense factor from the last to the first. Removing a late row is cheap, because few rows lie
    // behind it.
    for (std::int32_t r = count() - 1; r >= 0; --r) {
      if (!leaves(ids_[static_cast<std::size_t>(r)])) continue;
      if (r < valid_) {
        update_without(r);
        --valid_;
      }
      kept.clear();
      for (std::int32_t i = 0; i < count(); ++i) {
        if (i != r) kept.push_back(i);
      }
      keep_rows(kept);
    }
    return;
  }
  for (std::int32_t i = 0; i < count(); ++i) {
    if (!leaves(ids_[static_cast<std::size_t>(i)])) kept.push_back(i);
  }
  keep_rows(kept);
  valid_ = std::min(valid_, first);
}

void DenseBlock::append(std::int32_t id, const double* values, bool positive, const double* border) {
  const std::size_t width = static_cast<std::size_t>(count()) + 1;
  m_.insert(m_.end(), values, values + width);
  l_.resize(m_.size(), 0.0);
  ids_.push_back(id);
  sign_.push_back(positive ? 1.0 : -1.0);
  negative_ += !positive;
  for (std::size_t p = 0; p < border_; ++p) n_.push_back(border ? border[p] : 1.0);
}

std::int32_t DenseBlock::factorise_signed() {
  const std::int32_t k = count();
  // Processes four rows of the dense matrix at a time on a fixed grid. The array `scaled` holds these rows of the
  // factor L, multiplied by the signs (+1 or -1) of their columns.
  Vector<double> scaled(static_cast<std::size_t>(tile) * static_cast<std::size_t>(k), 0.0, memory_);
  double dots[tile * tile];
  while (valid_ < k) {
    const std::int32_t grid = valid_ / tile * tile, end = std::min(grid + tile, k);
    const double* mine[tile];
    for (std::int32_t i = 0; i < tile; ++i)
      mine[i] =
          scaled.data() + static_cast<std::size_t>(std::min(grid + i, end - 1) - grid) * static_cast<std::size_t>(k);
    for (std::int32_t j0 = 0; j0 <= grid; j0 += tile) {
      const double* other[tile];
      for (std::int32_t j = 0; j < tile; ++j) other[j] = l_.data() + row(std::min(j0 + j, k - 1));
      // At j0 = grid the products are between the four rows. The first `grid` entries of these rows are known by then.
      tile_dots(mine, other, static_cast<std::size_t>(j0), dots);
      for (std::int32_t i = valid_; i < end; ++i) {
        double* l = l_.data() + row(i);
        double* sigma = scaled.data() + static_cast<std::size_t>(i - grid) * static_cast<std::size_t>(k);
        const double* m = m_.data() + row(i);
        const double* known = dots + (i - grid) * tile;
        for (std::int32_t j = j0; j < std::min(j0 + tile, i); ++j) {
          const double* lj = l_.data() + row(j);
          double sum = m[j] - known[j - j0];
          for (std::int32_t p = j0; p < j; ++p) sum -= sigma[p] * lj[p];
          l[j] = sign_[static_cast<std::size_t>(j)] * sum * lj[j];
          sigma[j] = sign_[static_cast<std::size_t>(j)] * l[j];
        }
        if (j0 < grid) continue;
        double pivot = m[i] - known[i - grid];
        for (std::int32_t p = grid; p < i; ++p) pivot -= sigma[p] * l[p];
        pivot *= sign_[static_cast<std::size_t>(i)];
        if (!(pivot > pivot_floor * std::fabs(m[i]))) return i;
        l[i] = 1 / std::sqrt(pivot);
      }
    }
    valid_ = end;
  }
  return -1;
}

// Factorises the dense matrix of the sites with the dense kernels of the sparse factor. The kernels work on one dense
// triangle of k columns. Rows of L that are up to date are copied into it. Every number is one chain of operations in
// column order, so its bits do not depend on which rows were present before.
std::int32_t DenseBlock::factorise_positive(JobRunner& jobs) {
  const factor::Kernels& kernels = factor::choose_kernels();
  const std::int32_t k = count(), done = valid_ / 8 * 8, tiles = (k + 7) / 8;
  if (valid_ == k) return -1;
  const std::size_t stride = 8 * static_cast<std::size_t>(k);
  Buffer<double> panel(*memory_, static_cast<std::size_t>(tiles) * stride);
  const auto pieces = [&](std::int32_t begin, std::int32_t end, std::int32_t step, auto&& work) {
    if (begin >= end) return;
    jobs.for_each(static_cast<std::uint32_t>((end - begin + step - 1) / step), [&](std::uint32_t piece) {
      const std::int32_t from = begin + static_cast<std::int32_t>(piece) * step;
      work(from, std::min(end, from + step));
    });
  };
  const std::int32_t step = k < least_parallel ? tiles : tiles_per_job;
  pieces(0, tiles, step, [&](std::int32_t from, std::int32_t to) {
    for (std::int32_t t = from; t < to; ++t) {
      double* tile = panel.data() + static_cast<std::size_t>(t) * stride;
      for (std::int32_t i = 8 * t; i < 8 * t + 8; ++i) {
        const double* source = i < k ? (i < done ? l_ : m_).data() + row(i) : nullptr;
        const std::int32_t width = i < k ? i + 1 : 0;
        double* to_row = tile + (i & 7);
        for (std::int32_t j = 0; j < width; ++j) to_row[8 * j] = source[j];
        for (std::int32_t j = width; j < std::min(k, 8 * t + 8); ++j) to_row[8 * j] = 0;
      }
    }
  });
  factor::FrontView front;
  front.panel = panel.data();
  front.update = nullptr;
  front.columns = k;
  front.below = 0;
  front.triangle_tiles = tiles;
  front.below_tiles = 0;
  Vector<double> floor(static_cast<std::size_t>(k), memory_);
  for (std::int32_t i = 0; i < k; ++i)
    floor[static_cast<std::size_t>(i)] = pivot_floor * std::fabs(m_[row(i) + static_cast<std::size_t>(i)]);
  constexpr std::int32_t block = block_columns;
  for (std::int32_t begin = 0; begin < k;) {
    const std::int32_t end = std::min(begin < done ? done : k, begin + block);
    if (begin >= done) {
      const std::int32_t failed = kernels.factor_triangle(front, begin, end, floor.data());
      if (failed >= 0) {
        // The rows above the row with the failed pivot stay, so the next call finds the same row.
        return failed;
      }
    }
    pieces(begin < done ? done / 8 : (end + 7) / 8, tiles, step,
           [&](std::int32_t from, std::int32_t to) { kernels.solve_tiles(front, begin, end, from, to); });
    begin = end;
  }
  pieces(done / 8, tiles, step, [&](std::int32_t from, std::int32_t to) {
    for (std::int32_t i = 8 * from; i < std::min(k, 8 * to); ++i) {
      const double* tile = panel.data() + static_cast<std::size_t>(i / 8) * stride + (i & 7);
      double* l = l_.data() + row(i);
      for (std::int32_t j = 0; j <= i; ++j) l[j] = tile[8 * j];
    }
  });
  valid_ = k;
  return -1;
}

double DenseBlock::pivot_share(std::int32_t i) const noexcept {
  const std::size_t diagonal = row(i) + static_cast<std::size_t>(i);
  return 1 / (l_[diagonal] * l_[diagonal] * std::fabs(m_[diagonal]));
}

double DenseBlock::least_pivot() const noexcept {
  double least = 1;
  for (std::int32_t i = 0; i < count(); ++i) least = std::min(least, pivot_share(i));
  return least;
}

std::int32_t DenseBlock::factorise(JobRunner& jobs) {
  const std::int32_t failed = negative_ > 0 ? factorise_signed() : factorise_positive(jobs);
  if (failed < 0 && negative_ == 0 && border_ > 0) factorise_border();
  return failed;
}

void DenseBlock::factorise_border() {
  m_inverse_n_.assign(n_.begin(), n_.end());
  solve(m_inverse_n_.data(), static_cast<std::int32_t>(border_));
  for (std::size_t p = 0; p < border_; ++p) {
    for (std::size_t q = 0; q < border_; ++q) {
      double& sum = schur_[p * border_ + q];
      sum = -corner_[p * border_ + q];
      for (std::size_t i = 0; i < ids_.size(); ++i) sum += n_[i * border_ + p] * m_inverse_n_[i * border_ + q];
    }
  }
}

// Solves the dense system for several channels. `fixed` is the number of channels if the compiler knows it, else 0.
template <std::size_t fixed>
void DenseBlock::solve_channels(double* x, std::size_t channels) const noexcept {
  const std::int32_t k = count();
  const std::size_t m = fixed > 0 ? fixed : channels;
  for (std::int32_t i = 0; i < k; ++i) {
    const double* l = l_.data() + row(i);
    double* xi = x + static_cast<std::size_t>(i) * m;
    for (std::int32_t j = 0; j < i; ++j) {
      for (std::size_t c = 0; c < m; ++c) xi[c] -= l[j] * x[static_cast<std::size_t>(j) * m + c];
    }
    for (std::size_t c = 0; c < m; ++c) xi[c] *= l[i];
  }
  for (std::int32_t i = 0; negative_ > 0 && i < k; ++i) {
    for (std::size_t c = 0; c < m; ++c) x[static_cast<std::size_t>(i) * m + c] *= sign_[static_cast<std::size_t>(i)];
  }
  for (std::int32_t i = k - 1; i >= 0; --i) {
    const double* l = l_.data() + row(i);
    double* xi = x + static_cast<std::size_t>(i) * m;
    for (std::size_t c = 0; c < m; ++c) xi[c] *= l[i];
    for (std::int32_t j = 0; j < i; ++j) {
      for (std::size_t c = 0; c < m; ++c) x[static_cast<std::size_t>(j) * m + c] -= l[j] * xi[c];
    }
  }
}

void DenseBlock::solve(double* x, std::int32_t channels) const noexcept {
  switch (channels) {
    case 1:
      return solve_channels<1>(x, 1);
    case 2:
      return solve_channels<2>(x, 2);
    case 3:
      return solve_channels<3>(x, 3);
    default:
      return solve_channels<0>(x, at(channels));
  }
}

void DenseBlock::solve_bordered(double* x, std::int32_t channels, const double* total, double* nu) const noexcept {
  solve(x, channels);
  const std::size_t m = at(channels), k = ids_.size();
  for (std::size_t c = 0; c < m; ++c) {
    double right[most_border] = {total ? total[c] : 0.0, 0.0};
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t p = 0; p < border_; ++p) right[p] += n_[i * border_ + p] * x[i * m + c];
    }
    double own[most_border] = {};
    if (border_ == 1) {
      own[0] = right[0] / schur_[0];
    } else if (border_ == 2) {
      // Cramer's rule, written by hand: two unknowns per channel, in the loop over channels.
      const double determinant = schur_[0] * schur_[3] - schur_[1] * schur_[2];
      own[0] = (schur_[3] * right[0] - schur_[1] * right[1]) / determinant;
      own[1] = (schur_[0] * right[1] - schur_[2] * right[0]) / determinant;
    }
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t p = 0; p < border_; ++p) x[i * m + c] -= own[p] * m_inverse_n_[i * border_ + p];
    }
    for (std::size_t p = 0; p < border_; ++p) nu[p * m + c] = own[p];
  }
}

}  // namespace hf_inner::solve
