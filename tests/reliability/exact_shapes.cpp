#include "exact_shapes.h"

#include <cmath>
#include <random>

namespace reliability {
namespace {

using Real = long double;
const Real pi = 3.14159265358979323846264338327950288L;

std::uint32_t add_vertex(ExactShape& s, double x, double y, double z, double exact) {
  s.positions.insert(s.positions.end(), {x, y, z});
  s.exact.push_back(exact);
  return s.vertex_count() - 1;
}

void add_triangle(ExactShape& s, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  s.triangles.insert(s.triangles.end(), {a, b, c});
}

void add_site(ExactShape& s, std::uint32_t vertex, double value) {
  s.sites.push_back(vertex);
  s.values.push_back(value);
}

// Half of the cotangent at corner p of the triangle p q r.
Real half_cotangent(const ExactShape& s, std::uint32_t p, std::uint32_t q, std::uint32_t r) {
  Real a[3], b[3], dot = 0;
  for (int k = 0; k < 3; ++k) {
    a[k] = Real(s.positions[3 * q + k]) - s.positions[3 * p + k];
    b[k] = Real(s.positions[3 * r + k]) - s.positions[3 * p + k];
    dot += a[k] * b[k];
  }
  const Real x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  return dot / std::sqrt(x * x + y * y + z * z) / 2;
}

// Compliance of a soft site: stiffness is relative to the mean diagonal.
Real compliance(double stiffness, Real diagonal_sum, std::uint32_t vertices) {
  return stiffness > 0 ? vertices / (stiffness * diagonal_sum) : 0;
}

// Columns that grow from `finest` of the width to it.
std::vector<double> graded(std::uint32_t columns, double finest) {
  std::vector<double> x(columns + 1, 0.0);
  for (std::uint32_t i = 1; i <= columns; ++i)
    x[i] = finest >= 1 ? double(i) / columns : finest * std::pow(1 / finest, (i - 1.0) / (columns - 1.0));
  return x;
}

void add_grid(ExactShape& s, const std::vector<double>& x, const std::vector<double>& y, double aspect, double z,
              double low, double high) {
  const std::uint32_t base = s.vertex_count(), w = static_cast<std::uint32_t>(x.size());
  for (const double row : y) {
    for (const double column : x)
      add_vertex(s, column, row * aspect, z, static_cast<double>(low + (Real(high) - low) * column / x.back()));
  }
  for (std::uint32_t j = 0; j + 1 < y.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < w; ++i) {
      const std::uint32_t a = base + j * w + i;
      add_triangle(s, a, a + 1, a + w);
      add_triangle(s, a + 1, a + w + 1, a + w);
    }
  }
}

// x with -b x_(j-1) + (a + 2 b) x_j - b x_(j+1) = f_j around a ring: the answer to a unit force decays as e^(-k |j|).
std::vector<Real> ring_response(const std::vector<Real>& force, Real a, Real b) {
  const std::size_t n = force.size();
  // two recursions: (1 - r S)(1 - r S^-1) x = f r / b, S the shift, r + 1 / r = 2 + a / b
  const Real half = std::sqrt(a / b) / 2, r = std::exp(-2 * std::asinh(half)), whole = std::pow(r, Real(n));
  std::vector<Real> x(n), y(n);
  Real wrapped = 0;
  for (std::size_t j = 0; j < n; ++j) wrapped = r * wrapped + force[j] * r / b;
  Real carry = wrapped / (1 - whole);
  for (std::size_t j = 0; j < n; ++j) carry = y[j] = r * carry + force[j] * r / b;
  wrapped = 0;
  for (std::size_t j = n; j-- > 0;) wrapped = r * wrapped + y[j];
  carry = wrapped / (1 - whole);
  for (std::size_t j = n; j-- > 0;) carry = x[j] = r * carry + y[j];
  return x;
}

}  // namespace

ExactShape exact_chain(std::uint32_t triangles, bool random, double stiffness, unsigned seed) {
  ExactShape s;
  s.name = std::string(random ? "chain of any triangles " : "chain ") + (stiffness > 0 ? "soft " : "");
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> foot(0.1, 0.9), height(0.6, 2.0);
  std::uint32_t a = add_vertex(s, 0, 0, 0, 0);
  std::vector<Real> conductance(triangles), share(triangles);
  Real resistance = 0, diagonals = 0;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const double x = random ? foot(draw) : 0.0, y = random ? height(draw) : 1.0;
    const std::uint32_t b = add_vertex(s, t + 1.0, 0, 0, 0), c = add_vertex(s, t + x, y, 0, 0);
    add_triangle(s, a, b, c);
    const Real ab = half_cotangent(s, c, a, b), ac = half_cotangent(s, b, c, a), bc = half_cotangent(s, a, b, c);
    share[t] = bc / (ac + bc);
    conductance[t] = ab + ac * share[t];
    resistance += 1 / conductance[t];
    diagonals += 2 * (ab + ac + bc);
    a = b;
  }
  const Real soft = compliance(stiffness, diagonals, s.vertex_count()), flow = 1 / (resistance + 2 * soft);
  Real u = flow * soft;
  s.exact[0] = static_cast<double>(u);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const Real next = u + flow / conductance[t];
    s.exact[2 * t + 1] = static_cast<double>(next);
    s.exact[2 * t + 2] = static_cast<double>(u + share[t] * (next - u));
    u = next;
  }
  add_site(s, 0, 0);
  add_site(s, a, 1);
  if (stiffness > 0) s.stiffness.assign(2, stiffness);
  return s;
}

ExactShape exact_tube(std::uint32_t rings, std::uint32_t around, bool random, int field_kind, unsigned seed) {
  ExactShape s;
  s.name = field_kind ? "bi-harmonic tube " : "tube ";
  s.field_kind = field_kind;
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> step(0.3, 0.9);
  std::vector<double> z(rings, 0.0);
  for (std::uint32_t r = 1; r < rings; ++r) z[r] = z[r - 1] + (random ? step(draw) : 0.5);
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const Real turn = 2 * pi * k / around;
      add_vertex(s, static_cast<double>(std::cos(turn)), static_cast<double>(std::sin(turn)), z[r],
                 static_cast<double>(Real(z[r]) / z[rings - 1]));
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = r * around + k, b = r * around + (k + 1) % around;
      add_triangle(s, a, b, a + around);
      add_triangle(s, b, b + around, a + around);
    }
  }
  const std::uint32_t depth = field_kind ? 2 : 1;
  for (std::uint32_t v = 0; v < depth * around; ++v) add_site(s, v, s.exact[v]);
  for (std::uint32_t v = (rings - depth) * around; v < rings * around; ++v) add_site(s, v, s.exact[v]);
  return s;
}

ExactShape exact_revolution(std::uint32_t rings, std::uint32_t around, double length, double stiffness) {
  ExactShape s;
  s.name = std::string(length > 2 ? "body of revolution " : "sphere ") + (stiffness > 0 ? "soft " : "");
  const std::uint32_t south = add_vertex(s, 0, 0, -length / 2, 0);
  for (std::uint32_t r = 0; r < rings; ++r) {
    const Real t = pi * (r + 1) / (rings + 1), width = std::sin(t) * (1 + Real(0.3) * std::sin(3 * t) * (length > 2));
    for (std::uint32_t k = 0; k < around; ++k) {
      const Real turn = 2 * pi * k / around;
      add_vertex(s, static_cast<double>(width * std::cos(turn)), static_cast<double>(width * std::sin(turn)),
                 static_cast<double>(-length / 2 * std::cos(t)), 0);
    }
  }
  const std::uint32_t north = add_vertex(s, 0, 0, length / 2, 0);
  const auto at = [&](std::uint32_t ring, std::uint32_t k) { return 1 + ring * around + k % around; };
  for (std::uint32_t k = 0; k < around; ++k) {
    add_triangle(s, south, at(0, k + 1), at(0, k));
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      add_triangle(s, at(r, k), at(r, k + 1), at(r + 1, k));
      add_triangle(s, at(r, k + 1), at(r + 1, k + 1), at(r + 1, k));
    }
    add_triangle(s, north, at(rings - 1, k), at(rings - 1, k + 1));
  }
  // Rings have one value each. What flows between two rings are the energies of the triangles between them.
  std::vector<Real> resistance(rings + 1, 0);
  Real diagonals = 0;
  for (std::uint32_t r = 0; r <= rings; ++r) {
    Real sum = 0;
    const std::uint32_t low = r == 0 ? south : at(r - 1, 0), low_next = r == 0 ? south : at(r - 1, 1);
    const std::uint32_t high = r == rings ? north : at(r, 0), high_next = r == rings ? north : at(r, 1);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, bool a_low, bool b_low, bool c_low) {
      const Real bc = half_cotangent(s, a, b, c), ca = half_cotangent(s, b, c, a), ab = half_cotangent(s, c, a, b);
      if (a_low != b_low) sum += ab;
      if (b_low != c_low) sum += bc;
      if (c_low != a_low) sum += ca;
      diagonals += 2 * around * (ab + bc + ca);
    };
    if (low != low_next) add(low, low_next, high, true, true, false);
    if (high != high_next) add(low_next, high_next, high, true, false, false);
    resistance[r] = 1 / (around * sum);
  }
  const Real soft = compliance(stiffness, diagonals, s.vertex_count());
  Real whole = 2 * soft, u = 0;
  for (const Real r : resistance) whole += r;
  u = soft / whole;
  s.exact[south] = static_cast<double>(u);
  for (std::uint32_t r = 0; r <= rings; ++r) {
    u += resistance[r] / whole;
    for (std::uint32_t k = 0; r < rings && k < around; ++k) s.exact[at(r, k)] = static_cast<double>(u);
  }
  s.exact[north] = static_cast<double>(u);
  add_site(s, south, 0);
  add_site(s, north, 1);
  if (stiffness > 0) s.stiffness.assign(2, stiffness);
  return s;
}

ExactShape exact_fan(std::uint32_t triangles, int field_kind) {
  ExactShape s;
  s.name = field_kind ? "bi-harmonic fan " : "fan ";
  s.field_kind = field_kind;
  const std::uint32_t n = triangles / 4 * 4;
  add_vertex(s, 0, 0, 0, 0);
  for (std::uint32_t k = 0; k < n; ++k) {
    const Real turn = 2 * pi * k / n;
    add_vertex(s, static_cast<double>(std::cos(turn)), static_cast<double>(std::sin(turn)), 0, 0);
  }
  for (std::uint32_t k = 0; k < n; ++k) add_triangle(s, 0, 1 + k, 1 + (k + 1) % n);
  // The hub is 0 by symmetry. The rim is a ring of weights b, tied to the hub by a; 1 and -1 across it.
  const Real angle = 2 * pi / n, a = std::tan(angle / 2), b = 1 / (2 * std::tan(angle));
  std::vector<Real> force(n, 0);
  force[0] = 1;
  force[n / 2] = -1;
  // sites with 0 a quarter away change nothing: the field is 0 there by symmetry
  std::vector<Real> u = ring_response(force, a, b);
  if (field_kind) u = ring_response(u, a, b);
  for (std::uint32_t k = 0; k < n; ++k) s.exact[1 + k] = static_cast<double>(u[k] / u[0]);
  add_site(s, 0, 0);
  for (std::uint32_t k = 0; k < 4; ++k) add_site(s, 1 + k * (n / 4), k == 0 ? 1 : k == 2 ? -1 : 0);
  return s;
}

ExactShape exact_plane(std::uint32_t columns, std::uint32_t rows, double finest, double aspect, int field_kind) {
  ExactShape s;
  s.name = std::string(field_kind ? "bi-harmonic " : "") + (finest < 1            ? "graded plane "
                                                            : columns > 50 * rows ? "strip "
                                                                                  : "plane ");
  s.field_kind = field_kind;
  add_grid(s, graded(columns, finest), graded(rows, finest), aspect, 0, 0, 1);
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const bool side = i == 0 || i == columns;
      const bool near = i < 2 || j < 2 || i + 1 >= columns || j + 1 >= rows;
      const std::uint32_t v = j * (columns + 1) + i;
      if (field_kind ? near : side) add_site(s, v, s.exact[v]);
    }
  }
  return s;
}

ExactShape exact_islands(std::uint32_t islands, std::uint32_t columns) {
  ExactShape s;
  s.name = "islands ";
  for (std::uint32_t c = 0; c < islands; ++c) {
    const bool bare = c % 7 == 6;
    const double low = bare ? 0 : std::sin(1.0 + c), high = bare ? 0 : low + 1 + c % 3;
    const std::uint32_t first = s.vertex_count();
    add_grid(s, graded(columns, 1), graded(1, 1), 1.0 / columns, c, low, high);
    for (std::uint32_t j = 0; !bare && j < 2; ++j) {
      for (const std::uint32_t i : {0u, columns}) {
        const std::uint32_t v = first + j * (columns + 1) + i;
        s.exact[v] = i == 0 ? low : high;
        add_site(s, v, s.exact[v]);
      }
    }
  }
  return s;
}

}  // namespace reliability
