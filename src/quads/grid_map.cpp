#include "quads/grid_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/laplacian.h"
#include "quads/numbers.h"
#include "quads/untangle.h"

namespace hf_inner::quads {
namespace {

// Coordinates stay below 2^29 units, so that orientations of triangles are exact in 64 bits. Half and double change no
// map of up to 2^8 edges, as most_fraction bounds its bits.
constexpr int most_bits = 29;
// At least this many bits behind the point: 1 / 256 of an edge. With fewer, small triangles would lose their area. It
// refuses maps of more than 2^21 edges across; no run came near. With 16 it would refuse more than 2^13.
constexpr int least_fraction = 8;
// At most this many bits behind the point. More would only lengthen the numbers. With 10 and 26, up to 8 of 15 runs
// change, by 1 % on average: places are rounded elsewhere.
constexpr int most_fraction = 20;
// Triangles with larger cotangents are widened first, else the matrix can lose its definiteness. It does so with 1e8 on
// a box that is pressed to a millionth (reliability_shapes), and not with 1e7. Half and double mend it too.
constexpr double most_cotangent = 1e6;
// A value this near to a whole number is a sum of whole numbers with rounding errors. With 1e-9 and 1e-3 none of 15
// runs changes or is refused.
constexpr double whole_error = 1e-6;
// The inverse at the open unknowns is updated for so many steps of rounding at once. More go through memory less often,
// but each step goes through the columns of those before. With 16 and 64 a mesh with 3,180 unknowns takes as long.
constexpr std::size_t at_once = 32;

// At most this many lines of features are whole numbers. If there are more, quads follow the shortest only where the
// crosses lead. All whole numbers are rounded in one dense block. A comb of 65,000 corners has 12,195 lines. It took 24
// s and 1.9 GB for 800 quads. It takes 2.6 s with 2,048 and 1.9 s with 1,024, beside other work. With creases of 20
// degrees, five of 42 meshes have more, at most 4,565, mostly of one edge.
constexpr std::int32_t most_lines = 1024;

[[noreturn]] void fail_too_large() {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the map of the surface to the plane is too large for its edge length");
}

// Holds unknowns one after the other, with the inverse at those that are open: after unknown b is held, the inverse
// loses c_b c_b^T / c_bb. The columns c_b of a few steps are kept, and the inverse is updated for all of them at once,
// so it goes through the caches once for many steps. Only the lower triangle of the inverse is kept (lower_row).
class OpenInverse {
 public:
  OpenInverse(const Vector<double>& inverse, std::size_t side, Memory& memory)
      : c_(inverse.begin(), inverse.end(), &memory),
        side_(side),
        count_(side),
        steps_(&memory),
        place_(side, &memory),
        columns_(at_once * side, 0.0, &memory) {
    for (std::size_t i = 0; i < side; ++i) place_[i] = static_cast<std::int32_t>(i);
  }
  std::size_t count() const noexcept { return count_; }  // of rows, with those held since the last update
  std::int32_t unknown(std::size_t row) const noexcept { return place_[row]; }

  // Holds the unknown of a row. Returns its column, by row, before it was held.
  const double* hold(std::size_t row) {
    double* out = &columns_[steps_.size() * side_];
    for (std::size_t i = 0; i < count_; ++i) out[i] = i < row ? c_[lower_row(row) + i] : c_[lower_row(i) + row];
    subtract_held(row, count_, out);
    steps_.push_back(row);
    return out;
  }
  bool is_full() const noexcept { return steps_.size() == at_once; }

  // Updates the inverse and removes the rows that are held. Rows keep their order.
  void update() {
    Vector<std::uint8_t> held(count_, 0, place_.get_allocator());
    for (const std::size_t row : steps_) held[row] = 1;
    std::size_t rows = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (held[i]) continue;
      poll();
      double* row = &c_[lower_row(i)];
      subtract_held(i, i + 1, row);
      double* to = &c_[lower_row(rows)];
      std::size_t columns = 0;
      for (std::size_t j = 0; j <= i; ++j) {
        if (!held[j]) to[columns++] = row[j];
      }
      place_[rows++] = place_[i];
    }
    count_ = rows;
    steps_.clear();
  }

 private:
  // Subtracts the shares of the held columns in a row, in their order. Four at once are loaded and stored once.
  void subtract_held(std::size_t row, std::size_t count, double* out) const noexcept {
    const auto column = [&](std::size_t k) { return &columns_[k * side_]; };
    const auto share = [&](std::size_t k) { return column(k)[row] / column(k)[steps_[k]]; };
    std::size_t k = 0;
    for (; k + 4 <= steps_.size(); k += 4) {
      const double *a = column(k), *b = column(k + 1), *c = column(k + 2), *d = column(k + 3);
      const double p = share(k), q = share(k + 1), r = share(k + 2), s = share(k + 3);
      for (std::size_t i = 0; i < count; ++i) out[i] = out[i] - p * a[i] - q * b[i] - r * c[i] - s * d[i];
    }
    for (; k < steps_.size(); ++k) {
      const double *a = column(k), p = share(k);
      for (std::size_t i = 0; i < count; ++i) out[i] -= p * a[i];
    }
  }

  Vector<double> c_;
  std::size_t side_, count_;
  Vector<std::size_t> steps_;  // rows that are held since the last update
  Vector<std::int32_t> place_;
  Vector<double> columns_;
};

// Entries of a square matrix, put into columns in any order. Entries of one place are summed in the order in which they
// are put, so that every compiler comes to the same bits.
template <class Value>
class EntryColumns {
 public:
  struct Entry {
    std::int32_t row;
    Value value;
  };
  EntryColumns(std::int32_t size, Memory& memory)
      : start_(size + 1, 0, memory), cursor_(memory), place_(size, -1, memory), entries_(&memory) {}

  // First every entry is counted, then as many are put.
  void count(std::int32_t column, std::int32_t entries) { start_[column + 1] += entries; }
  void begin() {
    for (std::int32_t c = 0; c < size(); ++c) start_[c + 1] += start_[c];
    cursor_ = start_;
    poll();
    entries_.resize(at(start_[size()]));
  }
  void put(std::int32_t row, std::int32_t column, Value value) { entries_[at(cursor_[column]++)] = {row, value}; }

  // Sums the entries that are put at one place. Rows have no order.
  void sum() {
    Poller poller;
    std::int32_t out = 0;
    for (std::int32_t c = 0; c < size(); ++c) {
      poller.due();
      const std::int32_t first = out;
      for (std::int32_t i = start_[c]; i < cursor_[c]; ++i) {
        const Entry entry = entries_[at(i)];
        std::int32_t& place = place_[entry.row];
        if (place >= first) {
          entries_[at(place)].value += entry.value;
        } else {
          place = out;
          entries_[at(out++)] = entry;
        }
      }
      start_[c] = first;
    }
    start_[size()] = out;
    entries_.resize(at(out));
  }
  std::int32_t size() const noexcept { return start_.size() - 1; }
  std::int32_t start(std::int32_t column) const noexcept { return start_[column]; }
  const Entry& operator[](std::int32_t i) const noexcept { return entries_[at(i)]; }

 private:
  remesh::Table<std::int32_t> start_, cursor_;
  remesh::Table<std::int32_t> place_;  // by row: its entry in the last column that has it
  Vector<Entry> entries_;
};

}  // namespace

GridMapper::GridMapper(const remesh::FluxSurface& surface, const FaceCross& crosses, const Seams& seams,
                       const remesh::Table<std::uint8_t>& features, Span<const Index> order, Memory& memory,
                       JobRunner& jobs)
    : surface_(surface),
      crosses_(crosses),
      seams_(seams),
      memory_(memory),
      jobs_(jobs),
      order_(order),
      unknown_(memory),
      sums_(&memory),
      of_parameter_(memory),
      of_line_(memory),
      matrix_(memory),
      right_(&memory),
      inverse_(&memory),
      made_(&memory) {
  number(features);
  assemble();
  factor::FactorOptions options;
  options.ordering = factor::Ordering::natural;
  system_.emplace(matrix_, factor::Factor::make(matrix_, {}, options, memory_, jobs_), memory_, jobs_);
  system_->set_right(right_);
}

// Replaces the numbers of parameters by the numbers of unknowns.
RealSum GridMapper::in_unknowns(RealSum sum) const {
  for (RealTerm& term : sum) term.number = of_parameter_[term.number];
  return sum;
}

// Removes the edges of the shortest lines if there are too many lines. Returns whether any is gone.
bool GridMapper::keep_longest(FeatureLines& lines, Vector<std::int32_t>& edges) const {
  remesh::Table<double> length(lines.line_count(), 0, memory_);
  Vector<std::int32_t> used(&memory_);
  for (const std::int32_t h : edges) {
    const std::int32_t line = lines.line_of(h, crosses_.edge[h]);
    if (line < 0) continue;
    if (length[line] == 0) used.push_back(line);
    length[line] += field::length_of(crosses_.edge[h]);
  }
  if (used.size() <= at(most_lines)) return false;
  std::nth_element(used.begin(), used.begin() + most_lines, used.end(), [&](std::int32_t a, std::int32_t b) {
    return length[a] != length[b] ? length[a] > length[b] : a < b;
  });
  for (std::size_t i = at(most_lines); i < used.size(); ++i) length[used[i]] = -1;
  const auto is_short = [&](std::int32_t h) {
    const std::int32_t line = lines.line_of(h, crosses_.edge[h]);
    return line >= 0 && length[line] < 0;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), is_short), edges.end());
  return true;
}

void GridMapper::number(const remesh::Table<std::uint8_t>& features) {
  const std::int32_t n = surface_.vertex_count();
  std::optional<FeatureLines> found_lines(std::in_place, surface_, seams_, memory_);
  Vector<std::int32_t> edges(&memory_);
  for (std::int32_t h = 0; h < 3 * surface_.real_triangles; ++h) {
    const std::int32_t g = surface_.twin[h];
    if (features[h] && (!surface_.is_real(g) || h < g)) edges.push_back(h);
  }
  for (const std::int32_t h : edges) found_lines->add(h, crosses_.edge[h]);
  const std::size_t all_edges = edges.size();
  if (keep_longest(*found_lines, edges)) {
    found_lines.emplace(surface_, seams_, memory_);
    for (const std::int32_t h : edges) found_lines->add(h, crosses_.edge[h]);
  }
  FeatureLines& lines = *found_lines;
  left_out_ = lines.left_out() + static_cast<std::int32_t>(all_edges - edges.size());
  Vector<std::int32_t> free(&memory_);
  for (std::int32_t v = 0; v < surface_.first_apex; ++v) {
    for (int part = 0; part < 2; ++part) {
      if (seams_.parameter[v] == Seams::free && !lines.has(v, part)) free.push_back(2 * v + part);
    }
  }
  const auto place = [&](std::int32_t x) { return order_[at(surface_.mesh_vertex[x / 2])]; };
  Poller poller;
  std::sort(free.begin(), free.end(), [&](std::int32_t a, std::int32_t b) {
    poller.due();
    return place(a) != place(b) ? place(a) < place(b) : a < b;
  });
  unknown_.assign(2 * (n + static_cast<std::int32_t>(seams_.offsets.size())), 0);
  free_count_ = static_cast<std::int32_t>(free.size());
  for (std::int32_t i = 0; i < free_count_; ++i) unknown_[free[at(i)]] = i;
  std::int32_t count = free_count_;
  of_parameter_.assign(2 * seams_.parameter_count, -1);
  of_line_.assign(lines.line_count(), -1);
  for (std::int32_t p = 0; p < of_parameter_.size(); ++p) {
    if (!lines.is_solved(p)) of_parameter_[p] = count++;
  }
  const auto keep = [&](std::int32_t variable, RealSum sum) {
    unknown_[variable] = -1 - static_cast<std::int32_t>(sums_.size());
    sums_.push_back(std::move(sum));
  };
  for (std::int32_t v = 0; v < surface_.first_apex; ++v) {
    for (int part = 0; part < 2; ++part) {
      if (seams_.parameter[v] == Seams::free && !lines.has(v, part)) continue;
      // A vertex that is a sum of parameters gets a place here, if it has none yet.
      FeatureLines::Place found = lines.place(v, part);
      lines.reduce(found.sum);
      RealSum sum = in_unknowns(std::move(found.sum));
      if (found.line >= 0) {
        std::int32_t& line = of_line_[found.line];
        if (line < 0) line = count++;
        add_to(sum, RealSum(1, RealTerm{line, found.sign}, &memory_), 1);
      }
      keep(2 * v + part, std::move(sum));
    }
  }
  for (std::size_t i = 0; i < seams_.offsets.size(); ++i) {
    for (int part = 0; part < 2; ++part) {
      RealSum sum = part_of(seams_.offsets[i], part, memory_);
      lines.reduce(sum);
      keep(2 * (n + static_cast<std::int32_t>(i)) + part, in_unknowns(std::move(sum)));
    }
  }
  right_.assign(at(count), 0.0);
}

Span<const RealTerm> GridMapper::expand(std::int32_t variable, int part, RealTerm& single) const {
  const std::int32_t number = unknown_[2 * variable + part];
  if (number < 0) return sums_[at(-1 - number)];
  single = {number, 1.0};
  return {&single, 1};
}

void GridMapper::assemble() {
  const std::int32_t n = surface_.vertex_count(), variables = n + static_cast<std::int32_t>(seams_.offsets.size());
  // First in variables, of which a corner has two at most.
  EntryColumns<Complex> sums(variables, memory_);
  Vector<Complex> right(at(variables), Complex(0, 0), &memory_);
  Poller poller;
  double cotangent[3] = {};
  // The first pass counts.
  for (const bool counting : {true, false}) {
    if (!counting) sums.begin();
    for (std::int32_t h = 0; h < 3 * surface_.real_triangles; ++h) {
      poller.due();
      const std::int32_t t = h / 3, ends[2] = {remesh::FluxSurface::next(h), h};
      SeamTerm terms[4] = {};
      int count = 0;
      for (int end = 0; end < 2; ++end) {
        const double sign = end == 0 ? 1 : -1;
        const std::int32_t corner = ends[end];
        terms[count++] = {surface_.tail[corner], quarter_turned(Complex(sign, 0), seams_.unit[corner])};
        if (seams_.offset[corner] >= 0) terms[count++] = {n + seams_.offset[corner], Complex(sign, 0)};
      }
      // Both corners on one side of one seam: the offsets cancel.
      if (count == 4 && terms[1].parameter == terms[3].parameter) {
        terms[1] = terms[2];
        count = 2;
      }
      if (counting) {
        for (int a = 0; a < count; ++a) sums.count(terms[a].parameter, count);
        continue;
      }
      if (h % 3 == 0) {
        Vec3 p[3];
        for (int k = 0; k < 3; ++k) p[k] = surface_.position[surface_.tail[h + k]];
        mesh::corner_cotangents(p, cotangent);
        if (std::max({std::fabs(cotangent[0]), std::fabs(cotangent[1]), std::fabs(cotangent[2])}) > most_cotangent)
          mesh::widened_cotangents(p, cotangent);
        if (!crosses_.importance.empty()) {
          for (double& c : cotangent) c *= crosses_.importance[t];
        }
      }
      const double weight = cotangent[(h + 2) % 3] / 2;
      const Complex wish = crosses_.edge[h] * std::conj(seams_.direction[t]);
      for (int a = 0; a < count; ++a) {
        const Complex factor = weight * std::conj(terms[a].factor);
        right[at(terms[a].parameter)] += factor * wish;
        for (int b = 0; b < count; ++b) sums.put(terms[a].parameter, terms[b].parameter, factor * terms[b].factor);
      }
    }
  }
  sums.sum();
  // Then in unknowns. The complex number a + i b is the real block [a -b; b a].
  const std::int32_t size = static_cast<std::int32_t>(right_.size());
  RealTerm single_row, single_column;
  // Those that must be whole are joined by sums with many terms, so their block is dense.
  const std::int32_t wholes = size - free_count_;
  Vector<double> dense(at(wholes) * at(wholes), 0.0, &memory_);
  EntryColumns<double> real(size, memory_);
  for (const bool counting : {true, false}) {
    if (!counting) real.begin();
    for (std::int32_t column = 0; column < variables; ++column) {
      for (std::int32_t i = sums.start(column); i < sums.start(column + 1); ++i) {
        poller.due();
        const std::int32_t row = sums[i].row;
        const double a = sums[i].value.real(), b = row == column ? 0.0 : sums[i].value.imag();
        const double block[2][2] = {{a, -b}, {b, a}};
        for (int k = 0; k < 4; ++k) {
          if (block[k % 2][k / 2] == 0) continue;  // most blocks are diagonal
          for (const RealTerm& y : expand(column, k / 2, single_column)) {
            for (const RealTerm& x : expand(row, k % 2, single_row)) {
              const double value = x.factor * block[k % 2][k / 2] * y.factor;
              if (x.number >= free_count_ && y.number >= free_count_) {
                if (!counting) dense[at(y.number - free_count_) * at(wholes) + at(x.number - free_count_)] += value;
              } else if (counting) {
                real.count(y.number, 1);
              } else {
                real.put(x.number, y.number, value);
              }
            }
          }
        }
      }
    }
  }
  real.sum();
  for (std::int32_t v = 0; v < variables; ++v) {
    if (v >= surface_.first_apex && v < n) continue;
    for (int part = 0; part < 2; ++part) {
      const double value = part == 0 ? right[at(v)].real() : right[at(v)].imag();
      for (const RealTerm& x : expand(v, part, single_row)) right_[at(x.number)] += x.factor * value;
    }
  }
  // Columns one after the other, put as rows, are sorted. The matrix is symmetric.
  Vector<std::int32_t>& start = matrix_.column_start;
  start.assign(at(size) + 1, 0);
  const auto has = [&](std::int32_t x, std::int32_t y) {
    return dense[at(y) * at(wholes) + at(x)] != 0 || dense[at(x) * at(wholes) + at(y)] != 0;
  };
  for (std::int32_t i = 0; i < real.start(size); ++i) ++start[at(real[i].row) + 1];
  for (std::int32_t y = 0; y < wholes; ++y) {
    for (std::int32_t x = 0; x < wholes; ++x) start[at(free_count_ + y) + 1] += has(x, y);
  }
  for (std::int32_t c = 0; c < size; ++c) start[at(c) + 1] += start[at(c)];
  Vector<std::int32_t> cursor(start.begin(), start.end(), &memory_);
  matrix_.row.resize(at(start[at(size)]));
  matrix_.value.resize(matrix_.row.size());
  const auto put = [&](std::int32_t row, std::int32_t column, double value) {
    const std::size_t i = at(cursor[at(column)]++);
    matrix_.row[i] = row;
    matrix_.value[i] = value;
  };
  for (std::int32_t c = 0; c < size; ++c) {
    poller.due();
    for (std::int32_t i = real.start(c); i < real.start(c + 1); ++i) put(c, real[i].row, real[i].value);
    for (std::int32_t x = 0; c >= free_count_ && x < wholes; ++x) {
      const std::int32_t y = c - free_count_;
      if (has(x, y)) put(c, free_count_ + x, dense[at(x) * at(wholes) + at(y)]);
    }
  }
}

Vector<double> GridMapper::round(double edge_length, Vector<Index>* out_fixed, Vector<double>* out_values) {
  system_->set_scale(1 / edge_length);
  Vector<Index> open(&memory_), fixed(&memory_);
  for (Index i = free_count_; i < matrix_.size(); ++i) open.push_back(i);
  if (inverse_.empty()) inverse_ = system_->inverse_at(open);
  const std::size_t side = open.size();
  Vector<double> x(side, &memory_), values(&memory_);
  system_->solve_at(open, x.data());
  Vector<double> whole(side, std::numeric_limits<double>::quiet_NaN(), &memory_);
  OpenInverse c(inverse_, side, memory_);
  while (fixed.size() < side) {
    poll();
    std::size_t best = 0;
    double least = HUGE_VAL;
    for (std::size_t row = 0; row < c.count(); ++row) {
      const std::size_t i = at(c.unknown(row));
      const double away = std::fabs(x[i] - std::nearbyint(x[i]));
      if (std::isnan(whole[i]) && away < least) {
        least = away;
        best = row;
      }
    }
    const std::size_t chosen = at(c.unknown(best));
    whole[chosen] = std::nearbyint(x[chosen]);
    if (!std::isfinite(whole[chosen])) fail_too_large();
    fixed.push_back(open[chosen]);
    values.push_back(whole[chosen]);
    const double* column = c.hold(best);
    const double by = (whole[chosen] - x[chosen]) / column[best];
    for (std::size_t row = 0; row < c.count(); ++row) x[at(c.unknown(row))] += by * column[row];
    if (c.is_full()) c.update();
  }
  if (!fixed.empty()) system_->fix(fixed, values);
  if (out_fixed) {
    *out_fixed = fixed;
    *out_values = values;
  }
  Vector<double> all(at(matrix_.size()), &memory_);
  system_->solve(all.data());
  return all;
}

GridMap GridMapper::make(double edge_length, bool untangled) {
  if (made_.empty() || made_length_ != edge_length) {
    made_.clear();
    made_ = round(edge_length, nullptr, nullptr);
    made_length_ = edge_length;
  }
  const Vector<double>& x = made_;
  const std::int32_t n = surface_.vertex_count();
  // Returns the value of a real variable, and whether it is a whole number.
  const auto value_of = [&](std::int32_t variable, int part, bool& whole) {
    const std::int32_t number = unknown_[2 * variable + part];
    whole = number < 0;
    if (!whole) return x[at(number)];
    double value = 0;
    for (const RealTerm& term : sums_[at(-1 - number)]) value += term.factor * x[at(term.number)];
    const double near = std::nearbyint(value);
    if (!(std::fabs(value - near) <= whole_error))
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a singularity of the crosses cannot lie on the grid");
    return near;
  };
  remesh::Table<Complex> z(n, Complex(0, 0), memory_);
  remesh::Table<std::uint8_t> whole(2 * n, 0, memory_);
  bool is_whole = false;
  const auto read = [&](std::int32_t variable, std::uint8_t* flags) {
    double parts[2];
    for (int part = 0; part < 2; ++part) {
      parts[part] = value_of(variable, part, is_whole);
      if (flags) flags[part] = is_whole;
    }
    return Complex(parts[0], parts[1]);
  };
  for (std::int32_t v = 0; v < surface_.first_apex; ++v) z[v] = read(v, &whole[2 * v]);
  Vector<Complex> offset(seams_.offsets.size(), &memory_);
  for (std::size_t i = 0; i < offset.size(); ++i) offset[i] = read(n + static_cast<std::int32_t>(i), nullptr);
  if (untangled) untangle(surface_, crosses_, seams_, edge_length, offset, whole, z, memory_);
  double most = 1;
  const auto corner = [&](std::int32_t h) {
    const Complex turned = quarter_turned(z[surface_.tail[h]], seams_.unit[h]);
    return seams_.offset[h] >= 0 ? turned + offset[at(seams_.offset[h])] : turned;
  };
  const std::int32_t halves = 3 * surface_.real_triangles;
  for (std::int32_t h = 0; h < halves; ++h) {
    const Complex c = corner(h), own = z[surface_.tail[h]];
    most = std::max({most, std::fabs(c.real()), std::fabs(c.imag()), std::fabs(own.real()), std::fabs(own.imag())});
  }
  GridMap map(memory_);
  map.roundings = static_cast<std::int32_t>(system_->fixed_count());
  int whole_bits = 1;
  while (whole_bits < most_bits && std::ldexp(1.0, whole_bits) < most + 2) ++whole_bits;
  map.bits = std::min(most_bits - whole_bits, most_fraction);
  if (map.bits < least_fraction || !std::isfinite(most)) fail_too_large();
  const auto fixed_point = [&](double value, bool exact) {
    if (exact) return static_cast<std::int64_t>(value) * (std::int64_t{1} << map.bits);
    return 2 * static_cast<std::int64_t>(std::floor(std::ldexp(value, map.bits - 1))) + 1;
  };
  map.u.assign(halves, 0);
  map.v.assign(halves, 0);
  for (std::int32_t h = 0; h < halves; ++h) {
    const std::int32_t v = surface_.tail[h];
    const std::int64_t a = fixed_point(z[v].real(), whole[2 * v] != 0),
                       b = fixed_point(z[v].imag(), whole[2 * v + 1] != 0);
    const int k = seams_.unit[h] & 3;
    map.u[h] = k == 0 ? a : k == 1 ? -b : k == 2 ? -a : b;
    map.v[h] = k == 0 ? b : k == 1 ? a : k == 2 ? -b : -a;
    if (seams_.offset[h] < 0) continue;
    map.u[h] += fixed_point(offset[at(seams_.offset[h])].real(), true);
    map.v[h] += fixed_point(offset[at(seams_.offset[h])].imag(), true);
  }
  for (std::int32_t t = 0; t < surface_.real_triangles; ++t) {
    const std::int32_t h = 3 * t;
    const std::int64_t area =
        (map.u[h + 1] - map.u[h]) * (map.v[h + 2] - map.v[h]) - (map.u[h + 2] - map.u[h]) * (map.v[h + 1] - map.v[h]);
    map.turned_over += area <= 0;
  }
  return map;
}

void GridMapper::release() noexcept {
  system_.reset();
  Vector<double>(right_.get_allocator()).swap(right_);
  Vector<double>(inverse_.get_allocator()).swap(inverse_);
  Vector<double>(made_.get_allocator()).swap(made_);
  matrix_ = SymmetricMatrix(memory_);
}

}  // namespace hf_inner::quads
