#include "solve/dependence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/index.h"

namespace hf_inner::solve {
namespace {

// A site depends on others if its weight vector is closer than this to what theirs span. A pivot of the dense system is
// about the square, in any order of the sites, and should not fall below pivot_floor (dense_block.cpp): the order would
// then decide. A larger number refuses points that lie close to, but not on, a line through other sites. At a tenth,
// the pivots are as small as pivot_floor.
constexpr double dependence = 1e-5;

struct Corner {
  Index vertex, row;
};

Index root_of(Vector<Index>& parent, Index i) noexcept {
  while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
  return i;
}

// The distances of every vector to what all others span, by L of the factorisation W = L Q: their inverse squares are
// the diagonal of (L L')^-1. Returns the last row that is closer than `dependence`, or -1.
Index last_close(const Vector<double>& l, std::size_t count, Memory& memory) {
  Vector<double> column(count, 0.0, &memory), inverse_square(count, 0.0, &memory);
  for (std::size_t i = 0; i < count; ++i) {
    // column i of the inverse of L
    for (std::size_t r = i; r < count; ++r) {
      double sum = r == i ? 1.0 : 0.0;
      for (std::size_t j = i; j < r; ++j) sum -= l[r * count + j] * column[j];
      column[r] = sum / l[r * count + r];
      inverse_square[i] += column[r] * column[r];
    }
  }
  for (std::size_t i = count; i-- > 0;)
    if (!(inverse_square[i] * dependence * dependence < 1)) return static_cast<Index>(i);
  return -1;
}

// Returns a site of `rows` whose weight vector depends on the vectors of the others, or -1. It is the first that
// depends on the sites before it, else the last that depends on all others. So the order does not decide whether there
// is one. It orthogonalises every vector twice (Gram-Schmidt).
Index dependent_row(Span<const HardSite> sites, Span<const Index> rows, const Vector<Index>& columns, Memory& memory) {
  const std::size_t width = columns.size();
  const std::size_t count = rows.size();
  Vector<double> basis(count * width, 0.0, &memory), l(count * count, 0.0, &memory);
  for (std::size_t i = 0; i < count; ++i) {
    const Site& site = *sites[at(rows[i])].site;
    double* row = basis.data() + i * width;
    for (int k = 0; k < 3; ++k) {
      const auto it = std::lower_bound(columns.begin(), columns.end(), site.vertex[k]);
      if (site.vertex[k] >= 0) row[it - columns.begin()] = site.weight[k];
    }
    for (int turn = 0; turn < 2; ++turn) {
      for (std::size_t j = 0; j < i; ++j) {
        const double* other = basis.data() + j * width;
        const double share = std::inner_product(row, row + width, other, 0.0);
        l[i * count + j] += share;
        for (std::size_t c = 0; c < width; ++c) row[c] -= share * other[c];
      }
    }
    const double length = std::sqrt(std::inner_product(row, row + width, row, 0.0));
    // A site's weights sum to 1, so their vector had a length of at least 1 / sqrt(3) before it was orthogonalised.
    if (!(length > dependence)) return rows[i];
    l[i * count + i] = length;
    for (std::size_t c = 0; c < width; ++c) row[c] /= length;
  }
  const Index close = last_close(l, count, memory);
  return close < 0 ? -1 : rows[at(close)];
}

}  // namespace

Index dependent_site(Span<const HardSite> sites, Memory& memory) {
  Vector<Corner> corners(&memory);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (const Index v : sites[i].site->vertex)
      if (v >= 0) corners.push_back({v, static_cast<Index>(i)});
  }
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.row < b.row;
  });
  Vector<Index> parent(sites.size(), 0, &memory);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i].vertex == corners[i - 1].vertex)
      parent[at(root_of(parent, corners[i].row))] = root_of(parent, corners[i - 1].row);
  }
  // By group of sites with common vertices: 1 if a site in it has a small pivot. A site alone depends on none.
  Vector<std::uint8_t> suspect(sites.size(), 0, &memory);
  Vector<Index> size(sites.size(), 0, &memory);
  for (std::size_t i = 0; i < sites.size(); ++i) ++size[at(root_of(parent, static_cast<Index>(i)))];
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Index root = root_of(parent, static_cast<Index>(i));
    if (sites[i].suspect && size[at(root)] > 1) suspect[at(root)] = 1;
  }
  Vector<Index> rows(&memory), columns(&memory);
  for (std::size_t group = 0; group < sites.size(); ++group) {
    if (!suspect[group]) continue;
    rows.clear();
    columns.clear();
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (root_of(parent, static_cast<Index>(i)) == static_cast<Index>(group)) rows.push_back(static_cast<Index>(i));
    }
    for (const Index i : rows) {
      for (const Index v : sites[at(i)].site->vertex)
        if (v >= 0) columns.push_back(v);
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const Index lost = dependent_row(sites, {rows.data(), rows.size()}, columns, memory);
    if (lost >= 0) return sites[at(lost)].slot;
  }
  return -1;
}

}  // namespace hf_inner::solve
