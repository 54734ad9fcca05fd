#include "quads/grid_map.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/laplacian.h"

namespace hf_inner {
namespace {

using Complex = std::complex<double>;

// Coordinates stay below 2^29 units, so that orientations of triangles are exact in 64 bits.
constexpr int most_bits = 29;
// At least this many bits behind the point: 1 / 256 of an edge. With fewer, small triangles would lose their area.
constexpr int least_fraction = 8;
// At most this many bits behind the point. More would only lengthen the numbers.
constexpr int most_fraction = 20;
// A value this near to a whole number is one, but for rounding errors of a sum of whole numbers.
constexpr double whole_error = 1e-6;

}  // namespace

GridMapper::GridMapper(const FluxSurface& surface, const FaceCross& crosses, const Seams& seams,
                       Span<const Index> order, Memory& memory, JobRunner& jobs)
    : surface_(surface),
      crosses_(crosses),
      seams_(seams),
      memory_(memory),
      jobs_(jobs),
      order_(order),
      unknown_(memory),
      matrix_(memory),
      right_(&memory) {
  number();
  assemble();
  FactorOptions options;
  options.ordering = Ordering::natural;
  system_.emplace(matrix_, Factor::make(matrix_, {}, options, memory_, jobs_), memory_, jobs_);
  system_->set_right(right_);
}

void GridMapper::number() {
  unknown_.assign(surface_.vertex_count(), 0);
  Vector<std::int32_t> free(&memory_);
  for (std::int32_t v = 0; v < surface_.first_apex; ++v) {
    if (seams_.parameter[v] == Seams::free) free.push_back(v);
  }
  const auto place = [&](std::int32_t v) { return order_[at(surface_.mesh_vertex[v])]; };
  std::sort(free.begin(), free.end(),
            [&](std::int32_t a, std::int32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  free_count_ = static_cast<std::int32_t>(free.size());
  for (std::int32_t i = 0; i < free_count_; ++i) unknown_[free[at(i)]] = i;
  for (std::int32_t v = 0; v < surface_.first_apex; ++v) {
    if (seams_.parameter[v] >= 0) unknown_[v] = free_count_ + seams_.parameter[v];
  }
  for (std::size_t k = 0; k < seams_.fixed.size(); ++k)
    unknown_[seams_.fixed[k].vertex] = -1 - static_cast<std::int32_t>(k);
}

// Writes a variable as a sum of complex unknowns. Variables are vertices, and after them the offsets of the seams.
void GridMapper::expand(std::int32_t variable, SeamSum& out) const {
  out.clear();
  const SeamSum* sum = nullptr;
  if (variable < surface_.vertex_count()) {
    const std::int32_t number = unknown_[variable];
    if (number >= 0) {
      out.push_back({number, Complex(1, 0)});
      return;
    }
    sum = &seams_.fixed[at(-1 - number)].sum;
  } else {
    sum = &seams_.offsets[at(variable - surface_.vertex_count())];
  }
  for (const SeamTerm& term : *sum) out.push_back({free_count_ + term.parameter, term.factor});
}

void GridMapper::assemble() {
  const std::int32_t n = surface_.vertex_count(), variables = n + static_cast<std::int32_t>(seams_.offsets.size());
  const std::int32_t unknowns = free_count_ + seams_.parameter_count;
  // First in variables, of which a corner has two at most.
  Vector<Entry> entries(&memory_);
  entries.reserve(at(surface_.real_triangles) * 24);
  Vector<Complex> right(at(variables), Complex(0, 0), &memory_);
  Poller poller;
  for (std::int32_t t = 0; t < surface_.real_triangles; ++t) {
    poller.due();
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = surface_.position[surface_.tail[3 * t + k]];
    double cotangent[3];
    corner_cotangents(p, cotangent);
    for (int k = 0; k < 3; ++k) {
      const std::int32_t h = 3 * t + k, ends[2] = {FluxSurface::next(h), h};
      const double weight = cotangent[(k + 2) % 3] / 2;
      const Complex wish = crosses_.edge[h] * std::conj(seams_.direction[t]);
      SeamTerm terms[4] = {};
      int count = 0;
      for (int end = 0; end < 2; ++end) {
        const double sign = end == 0 ? 1 : -1;
        const std::int32_t corner = ends[end];
        terms[count++] = {surface_.tail[corner], quarter_turned(Complex(sign, 0), seams_.unit[corner])};
        if (seams_.offset[corner] >= 0) terms[count++] = {n + seams_.offset[corner], Complex(sign, 0)};
      }
      // Both corners on one side of one seam: the offsets cancel.
      if (count == 4 && terms[1].parameter == terms[3].parameter) terms[1] = terms[2], count = 2;
      for (int a = 0; a < count; ++a) {
        right[at(terms[a].parameter)] += weight * std::conj(terms[a].factor) * wish;
        for (int b = 0; b < count; ++b)
          entries.push_back(
              {terms[a].parameter, terms[b].parameter, weight * std::conj(terms[a].factor) * terms[b].factor});
      }
    }
  }
  const auto before = [](const Entry& a, const Entry& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  };
  const auto merge = [&](Vector<Entry>& list) {
    std::sort(list.begin(), list.end(), before);
    std::size_t count = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (count > 0 && list[count - 1].row == list[i].row && list[count - 1].column == list[i].column) {
        list[count - 1].value += list[i].value;
      } else {
        list[count++] = list[i];
      }
    }
    list.resize(count);
  };
  merge(entries);
  // Then in unknowns.
  Vector<Entry> final_entries(&memory_);
  final_entries.reserve(entries.size());
  SeamSum rows(&memory_), columns(&memory_);
  std::int32_t expanded = -1;
  for (const Entry& e : entries) {
    poller.due();
    if (e.column != expanded) expand(e.column, columns), expanded = e.column;
    expand(e.row, rows);
    for (const SeamTerm& a : rows) {
      for (const SeamTerm& b : columns)
        final_entries.push_back({a.parameter, b.parameter, std::conj(a.factor) * e.value * b.factor});
    }
  }
  merge(final_entries);
  right_.assign(2 * at(unknowns), 0.0);
  for (std::int32_t v = 0; v < variables; ++v) {
    if (v >= surface_.first_apex && v < n) continue;
    expand(v, rows);
    for (const SeamTerm& a : rows) {
      const Complex value = std::conj(a.factor) * right[at(v)];
      right_[2 * at(a.parameter)] += value.real(), right_[2 * at(a.parameter) + 1] += value.imag();
    }
  }
  // The complex number a + i b in row p and column q is the real block [a -b; b a].
  matrix_.column_start.assign(1, 0);
  std::size_t i = 0;
  for (std::int32_t q = 0; q < unknowns; ++q) {
    const std::size_t begin = i;
    while (i < final_entries.size() && final_entries[i].column == q) ++i;
    for (int part = 0; part < 2; ++part) {
      for (std::size_t j = begin; j < i; ++j) {
        const Entry& e = final_entries[j];
        const double a = e.value.real(), b = e.row == q ? 0.0 : e.value.imag();
        matrix_.row.push_back(2 * e.row), matrix_.row.push_back(2 * e.row + 1);
        matrix_.value.push_back(part == 0 ? a : -b), matrix_.value.push_back(part == 0 ? b : a);
      }
      matrix_.column_start.push_back(static_cast<std::int32_t>(matrix_.row.size()));
    }
  }
}

Vector<double> GridMapper::round(double edge_length, Vector<Index>* out_fixed, Vector<double>* out_values) {
  system_->set_scale(1 / edge_length);
  Vector<Index> open(&memory_);
  for (Index i = 2 * free_count_; i < matrix_.size(); ++i) open.push_back(i);
  Vector<double> values(open.size(), &memory_);
  while (!open.empty()) {
    poll();
    values.resize(open.size());
    system_->solve_at(open, values.data());
    std::size_t best = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double away = std::fabs(values[i] - std::nearbyint(values[i]));
      if (away < least) least = away, best = i;
    }
    const Index unknown = open[best];
    const double whole = std::nearbyint(values[best]);
    system_->fix(Span<const Index>(&unknown, 1), Span<const double>(&whole, 1));
    if (out_fixed) out_fixed->push_back(unknown), out_values->push_back(whole);
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(best));
  }
  Vector<double> x(at(matrix_.size()), &memory_);
  system_->solve(x.data());
  return x;
}

Complex GridMapper::value_of(const SeamSum& sum, Span<const double> x) const {
  Complex value = 0;
  for (const SeamTerm& term : sum) {
    const std::size_t i = 2 * at(free_count_ + term.parameter);
    value += term.factor * Complex(x[i], x[i + 1]);
  }
  return value;
}

GridMap GridMapper::make(double edge_length) {
  const Vector<double> x = round(edge_length, nullptr, nullptr);
  const std::int32_t n = surface_.vertex_count();
  Table<Complex> z(n, Complex(0, 0), memory_);
  Table<std::uint8_t> whole(n, 0, memory_);
  for (std::int32_t v = 0; v < surface_.first_apex; ++v) {
    const std::int32_t number = unknown_[v];
    if (number >= 0) {
      z[v] = Complex(x[2 * at(number)], x[2 * at(number) + 1]);
      whole[v] = number >= free_count_;
      continue;
    }
    const Seams::Fixed& fixed = seams_.fixed[at(-1 - number)];
    z[v] = value_of(fixed.sum, x), whole[v] = 1;
    const Complex near(std::nearbyint(z[v].real()), std::nearbyint(z[v].imag()));
    if (length_of(z[v] - near) > whole_error)
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a singularity of the crosses cannot lie on the grid");
    z[v] = near;
  }
  Vector<Complex> offset(seams_.offsets.size(), &memory_);
  double most = 1;
  for (std::size_t i = 0; i < offset.size(); ++i) {
    offset[i] = value_of(seams_.offsets[i], x);
    offset[i] = Complex(std::nearbyint(offset[i].real()), std::nearbyint(offset[i].imag()));
  }
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
  if (map.bits < least_fraction || !std::isfinite(most))
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the map of the surface to the plane is too large for its edge length");
  const auto fixed_point = [&](double value, bool is_whole) {
    if (is_whole) return static_cast<std::int64_t>(value) * (std::int64_t{1} << map.bits);
    return 2 * static_cast<std::int64_t>(std::floor(std::ldexp(value, map.bits - 1))) + 1;
  };
  map.u.assign(halves, 0), map.v.assign(halves, 0);
  for (std::int32_t h = 0; h < halves; ++h) {
    const std::int32_t v = surface_.tail[h];
    const std::int64_t a = fixed_point(z[v].real(), whole[v]), b = fixed_point(z[v].imag(), whole[v]);
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

}  // namespace hf_inner
