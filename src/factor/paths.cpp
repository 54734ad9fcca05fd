// Solves elimination paths: Y = G^-1 P W for sparse columns of W. A column is non-zero only on the elimination-tree
// paths of its entries (Gilbert & Peierls 1988; Schreiber 1982), so a group of neighbouring sites touches a few hundred
// supernodes.
//
// The sites of a group are sorted by their first row, so the active sites of every supernode are one range. They lie
// along the vector lanes. Cost: the number of entries of all paths. One group is one job. The number of sites alone
// decides the groups.
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "base/error.h"
#include "factor/supernodal_factor.h"

namespace hf_inner::factor {
namespace {

// Spare numbers behind the last entries of the elimination paths: vectors are padded and may read or write them.
constexpr std::int32_t lane_slack = 64;
// Length of a row of path products: the sites of a group, plus numbers that a padded vector may touch.
constexpr std::int32_t gram_stride = PathGroup::capacity + 16;

const PathBlocks& blocks_of(const PathGroup& group) noexcept { return static_cast<const PathBlocks&>(group); }

// Lists the supernodes on the elimination paths of a group of sites; their places are set later.
// slot[s]: index of the block of supernode s, or -1 if there is none.
void collect_blocks(const Symbolic& symbolic, const SparseColumns& columns, Span<const std::int32_t> members,
                    Vector<PathBlock>& blocks, std::int32_t* slot) {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(members.size()); ++i) {
    for (std::int32_t e = columns.start[members[i]]; e < columns.start[members[i] + 1]; ++e) {
      for (std::int32_t s = symbolic.supernode[symbolic.position[columns.row[e]]]; s >= 0; s = symbolic.parent[s]) {
        if (slot[s] < 0) {
          slot[s] = static_cast<std::int32_t>(blocks.size());
          blocks.push_back({s, i, 1, 0, 0});
          continue;
        }
        PathBlock& block = blocks[slot[s]];
        if (block.low + block.used == i + 1) break;  // the rest of the site's elimination path is already marked
        block.used = i + 1 - block.low;
      }
    }
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const PathBlock& a, const PathBlock& b) { return a.supernode < b.supernode; });
}

std::shared_ptr<const PathGroup> solve_group(const SupernodalFactor& factor, const SparseColumns& columns,
                                             Span<const std::int32_t> members, Memory& memory) {
  const Symbolic& symbolic = factor.symbolic();
  std::shared_ptr<PathBlocks> group = make_shared_in<PathBlocks>(memory);
  group->sites = static_cast<std::int32_t>(members.size());
  Buffer<std::int32_t> slot(memory, static_cast<std::size_t>(symbolic.supernodes));
  std::fill(slot.begin(), slot.end(), -1);
  Vector<PathBlock> blocks(&memory);
  collect_blocks(symbolic, columns, members, blocks, slot.data());
  // Sets the places of the blocks in memory. Site i of a row lies at place_of[row] + i.
  Buffer<std::int64_t> place_of(memory, static_cast<std::size_t>(symbolic.size));
  std::int64_t total = 0;
  std::int32_t longest = 0;
  for (PathBlock& block : blocks) {
    block.lanes = block.used == 1 ? 1 : (block.used + 7) & ~7;
    block.at = total;
    for (std::int32_t row = symbolic.first[block.supernode]; row < symbolic.first[block.supernode + 1];
         ++row, total += block.lanes) {
      place_of[row] = total - block.low;
    }
    total = (total + 7) & ~std::int64_t{7};
    longest = std::max(longest, symbolic.below(block.supernode));
  }
  group->blocks.allocate(memory, blocks.size());
  std::copy(blocks.begin(), blocks.end(), group->blocks.begin());
  group->values.allocate(memory, static_cast<std::size_t>(total + lane_slack));
  double* values = group->values.data();
  std::memset(values, 0, group->values.size() * sizeof(double));
  for (std::int32_t i = 0; i < group->sites; ++i) {
    for (std::int32_t e = columns.start[members[i]]; e < columns.start[members[i] + 1]; ++e) {
      values[place_of[symbolic.position[columns.row[e]]] + i] += columns.value[e];
    }
  }
  Buffer<std::int64_t> target(memory, static_cast<std::size_t>(longest));
  const Kernels& kernels = factor.kernels();
  for (const PathBlock& block : blocks) {
    const std::int32_t s = block.supernode;
    const bool narrow = symbolic.columns(s) <= narrow_columns;  // stored inverted: its rows come first
    if (!narrow) kernels.path_triangle(factor.triangle(s), symbolic.columns(s), values + block.at, block.lanes);
    const std::int32_t* rows = symbolic.row_list(s);
    const std::int32_t count = symbolic.below(s);
    for (std::int32_t k = 0; k < count; ++k) target[k] = place_of[rows[k]] + block.low;
    kernels.path_rows(factor.below(s), count, symbolic.columns(s), values + block.at, block.lanes, values,
                      target.data());
    if (narrow) kernels.path_triangle(factor.triangle(s), symbolic.columns(s), values + block.at, block.lanes);
  }
  return group;
}

void require_in_range(const SparseColumns& columns, std::int32_t size) {
  for (const std::int32_t row : columns.row) {
    if (row < 0 || row >= size)
      fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(row), "row %d of a site lies outside the %d unknowns", row,
           size);
  }
}

}  // namespace

void SupernodalFactor::solve_paths(const SparseColumns& columns, Memory& memory, JobRunner& jobs,
                                   Vector<std::shared_ptr<const PathGroup>>& out_groups, Span<std::int32_t> out_group,
                                   Span<std::int32_t> out_column) const {
  out_groups.clear();
  const std::int32_t count = columns.count();
  if (count == 0) return;
  require_in_range(columns, size());
  // Sorts the sites by their first row in factor order.
  Buffer<std::int32_t> members(memory, static_cast<std::size_t>(count));
  Buffer<std::int32_t> key(memory, static_cast<std::size_t>(count));
  for (std::int32_t i = 0; i < count; ++i) {
    members[i] = i;
    key[i] = INT32_MAX;
    for (std::int32_t e = columns.start[i]; e < columns.start[i + 1]; ++e)
      key[i] = std::min(key[i], symbolic().position[columns.row[e]]);
  }
  std::sort(members.begin(), members.end(),
            [&](std::int32_t a, std::int32_t b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
  // Sites are grouped in multiples of 8, the width of a vector. The number of groups is even where possible, so that
  // two threads have the same work.
  const std::int32_t lanes = (count + 7) / 8;
  std::int32_t groups = (count + PathGroup::capacity - 1) / PathGroup::capacity;
  if (groups % 2 == 1 && groups < lanes) ++groups;
  const auto begin_of = [&](std::int32_t g) {
    return std::min(count, 8 * static_cast<std::int32_t>(static_cast<std::int64_t>(g) * lanes / groups));
  };
  Vector<std::shared_ptr<const PathGroup>> made(static_cast<std::size_t>(groups), nullptr, &memory);
  jobs.for_each(static_cast<std::uint32_t>(groups), [&](std::uint32_t g) {
    const std::int32_t begin = begin_of(static_cast<std::int32_t>(g)), end = begin_of(static_cast<std::int32_t>(g) + 1);
    made[g] = solve_group(*this, columns, {members.data() + begin, static_cast<std::size_t>(end - begin)}, memory);
  });
  for (std::int32_t g = 0; g < groups; ++g) {
    for (std::int32_t k = begin_of(g); k < begin_of(g + 1); ++k) {
      out_group[members[k]] = g;
      out_column[members[k]] = k - begin_of(g);
    }
  }
  out_groups.assign(made.begin(), made.end());
}

void SupernodalFactor::gram(const PathGroup& a, const PathGroup& b, double* gram, std::int32_t ld) const {
  const PathBlocks& left = blocks_of(a);
  const PathBlocks& right = blocks_of(b);
  alignas(64) double tile[PathGroup::capacity * gram_stride];
  std::fill(tile, tile + PathGroup::capacity * gram_stride, 0.0);
  std::size_t i = 0, j = 0;
  while (i < left.blocks.size() && j < right.blocks.size()) {
    const PathBlock& p = left.blocks[i];
    const PathBlock& q = right.blocks[j];
    if (p.supernode < q.supernode) {
      ++i;
    } else if (q.supernode < p.supernode) {
      ++j;
    } else {
      kernels().gram(left.values.data() + p.at, p.lanes, p.used, right.values.data() + q.at, q.lanes, q.used,
                     symbolic().columns(p.supernode), tile + p.low * gram_stride + q.low, gram_stride);
      ++i;
      ++j;
    }
  }
  for (std::int32_t r = 0; r < left.sites; ++r) {
    for (std::int32_t c = 0; c < right.sites; ++c)
      gram[static_cast<std::int64_t>(r) * ld + c] = tile[r * gram_stride + c];
  }
}

namespace {

// target += sum_i x[i] factor[i], row by row, for `count` rows of m numbers. The number of channels is known when it is
// compiled, so a row stays in registers. It takes its terms in the order of sites.
template <std::int32_t m>
void add_rows(const double* x, std::int32_t stride, std::int32_t used, const double* factor, std::int32_t count,
              double* target) noexcept {
  for (std::int32_t j = 0; j < count; ++j, x += stride, target += m) {
    double sum[m];
    std::copy_n(target, m, sum);
    for (std::int32_t i = 0; i < used; ++i) {
      for (std::int32_t c = 0; c < m; ++c) sum[c] += x[i] * factor[i * m + c];
    }
    std::copy_n(sum, m, target);
  }
}

// out[i] += sum over rows of x[i] source, in the order of rows.
template <std::int32_t m>
void add_products(const double* x, std::int32_t stride, std::int32_t used, const double* source, std::int32_t count,
                  double* out) noexcept {
  for (std::int32_t j = 0; j < count; ++j, x += stride, source += m) {
    for (std::int32_t i = 0; i < used; ++i) {
      for (std::int32_t c = 0; c < m; ++c) out[i * m + c] += x[i] * source[c];
    }
  }
}

// Calls use(std::integral_constant<std::int32_t, m>) for m = channels, the three of a place and the eight of a block.
// Returns false for others.
template <class Use>
bool with_channels(std::int32_t channels, Use&& use) {
  switch (channels) {
    case 3:
      return use(std::integral_constant<std::int32_t, 3>()), true;
    case 8:
      return use(std::integral_constant<std::int32_t, 8>()), true;
    default:
      return false;
  }
}

}  // namespace

void SupernodalFactor::combine(const PathGroup& group, const double* lambda, std::int32_t channels, double* z) const {
  const PathBlocks& paths = blocks_of(group);
  for (const PathBlock& block : paths.blocks) {
    const double* x = paths.values.data() + block.at;
    const double* factor = lambda + static_cast<std::int64_t>(block.low) * channels;
    double* target = z + static_cast<std::int64_t>(symbolic().first[block.supernode]) * channels;
    const std::int32_t columns = symbolic().columns(block.supernode);
    const bool done = with_channels(
        channels, [&](auto m) { add_rows<decltype(m)::value>(x, block.lanes, block.used, factor, columns, target); });
    if (done) continue;
    for (std::int32_t j = 0; j < columns; ++j, x += block.lanes, target += channels) {
      if (channels == 1) {
        double sum = 0;
        for (std::int32_t i = 0; i < block.used; ++i) sum += x[i] * factor[i];
        target[0] += sum;
        continue;
      }
      for (std::int32_t i = 0; i < block.used; ++i) {
        for (std::int32_t c = 0; c < channels; ++c) target[c] += x[i] * factor[i * channels + c];
      }
    }
  }
}

void SupernodalFactor::clear(const PathGroup& group, std::int32_t channels, double* z) const {
  for (const PathBlock& block : blocks_of(group).blocks) {
    const std::int64_t first = symbolic().first[block.supernode], last = symbolic().first[block.supernode + 1];
    std::fill(z + first * channels, z + last * channels, 0.0);
  }
}

void SupernodalFactor::project(const PathGroup& group, const double* z, std::int32_t channels, double* out) const {
  const PathBlocks& paths = blocks_of(group);
  std::fill(out, out + static_cast<std::int64_t>(paths.sites) * channels, 0.0);
  for (const PathBlock& block : paths.blocks) {
    const double* x = paths.values.data() + block.at;
    const double* source = z + static_cast<std::int64_t>(symbolic().first[block.supernode]) * channels;
    double* target = out + static_cast<std::int64_t>(block.low) * channels;
    const std::int32_t columns = symbolic().columns(block.supernode);
    const bool done = with_channels(channels, [&](auto m) {
      add_products<decltype(m)::value>(x, block.lanes, block.used, source, columns, target);
    });
    if (done) continue;
    for (std::int32_t j = 0; j < columns; ++j, x += block.lanes, source += channels) {
      for (std::int32_t i = 0; i < block.used; ++i) {
        for (std::int32_t c = 0; c < channels; ++c) target[i * channels + c] += x[i] * source[c];
      }
    }
  }
}

}  // namespace hf_inner::factor
