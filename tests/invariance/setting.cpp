#include "setting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace invariance {

void Measured::add(const std::string& what, std::vector<double> values, double scale) {
  for (double& v : values) v /= scale;
  rows.push_back({what, list, 1, std::move(values)});
}

void Measured::add_set(const std::string& what, std::size_t width, std::vector<double> values) {
  rows.push_back({what, set, width, std::move(values)});
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double entry_difference(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : infinity;
  return a == b ? 0 : std::abs(a - b);
}

// From every member of a to the nearest of b, the worst.
double one_sided(const Measured::Row& a, const Measured::Row& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.values.size(); i += a.width) {
    double nearest = infinity;
    for (std::size_t j = 0; j < b.values.size(); j += b.width) {
      double here = 0;
      for (std::size_t k = 0; k < a.width && here < nearest; ++k)
        here = std::max(here, entry_difference(a.values[i + k], b.values[j + k]));
      nearest = std::min(nearest, here);
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

double row_difference(const Measured::Row& a, const Measured::Row& b) {
  if (a.kind == Measured::set) return std::max(one_sided(a, b), one_sided(b, a));
  if (a.values.size() != b.values.size()) return infinity;
  double worst = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) worst = std::max(worst, entry_difference(a.values[i], b.values[i]));
  return worst;
}

// Rows of three numbers with a gap behind each, for Form::strided.
constexpr std::size_t gap = 5;

}  // namespace

double difference(const Measured& a, const Measured& b, std::string& where) {
  double worst = 0;
  for (std::size_t i = 0; i < std::max(a.rows.size(), b.rows.size()); ++i) {
    const bool both = i < a.rows.size() && i < b.rows.size() && a.rows[i].what == b.rows[i].what;
    const double here = both ? row_difference(a.rows[i], b.rows[i]) : infinity;
    if (here <= worst) continue;
    worst = here;
    where = both ? a.rows[i].what : "other rows";
  }
  return worst;
}

Setting::Setting(const Body& of, const Copy& made) : body(of), copy(made) {
  const std::size_t width = copy.form == Form::strided ? gap : 3;
  for (const Vec& p : copy.points) {
    for (std::size_t k = 0; k < width; ++k) doubles_.push_back(k < 3 ? p[k] : 777.0);
  }
  if (copy.form != Form::doubles) floats_.assign(doubles_.begin(), doubles_.end());
  for (const auto& t : copy.triangles) {
    for (std::size_t k = 0; k < width; ++k) corners_.push_back(k < 3 ? t[k] : none);
  }
  if (copy.form == Form::u16) short_corners_.assign(corners_.begin(), corners_.end());
  if (copy.form == Form::faces) sizes_.assign(copy.triangles.size(), 3);
  surface_ = make(HF_INIT(hf_surface_desc));
}

hf_surface_desc Setting::desc() const {
  hf_surface_desc d = HF_INIT(hf_surface_desc);
  if (copy.form == Form::doubles) {
    d.positions = HF_ARRAY(doubles_.data(), copy.points.size());
  } else {
    d.positions = HF_ARRAY(floats_.data(), copy.points.size());
  }
  const auto triangle_count = static_cast<std::uint32_t>(copy.triangles.size());
  if (copy.form == Form::faces) {
    faces_ = HF_INIT(hf_faces_desc);
    faces_.sizes = HF_ARRAY(sizes_.data(), triangle_count);
    faces_.corners = HF_ARRAY(corners_.data(), 3 * triangle_count);
    d.faces = &faces_;
    return d;
  }
  if (copy.form == Form::u16) {
    d.triangles = HF_ARRAY(short_corners_.data(), triangle_count);
  } else {
    d.triangles = HF_ARRAY(corners_.data(), triangle_count);
  }
  if (copy.form == Form::strided) {
    d.positions.stride = gap * sizeof(float);
    d.triangles.stride = gap * sizeof(std::uint32_t);
  }
  return d;
}

Surface Setting::make(const hf_surface_desc& options) const {
  hf_surface_desc d = desc();
  d.operator_kind = options.operator_kind;
  d.field_kind = options.field_kind;
  d.links = options.links;
  Surface out;
  ok(hf_surface_create(&d, out.out()));
  return out;
}

std::vector<std::uint32_t> Setting::vertices(const std::vector<std::uint32_t>& list) const {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t v : list) out.push_back(vertex(v));
  return out;
}

namespace {

Vec times(const std::array<Vec, 3>& m, const Vec& p) { return {dot(m[0], p), dot(m[1], p), dot(m[2], p)}; }

// The inverse of a rotation or reflection is its transpose.
Vec transposed_times(const std::array<Vec, 3>& m, const Vec& p) { return p[0] * m[0] + p[1] * m[1] + p[2] * m[2]; }

}  // namespace

Vec Setting::place(const Vec& p) const { return times(copy.linear, p) + copy.shift; }
Vec Setting::turn(const Vec& d) const { return (1 / copy.scale) * times(copy.linear, d); }
Vec Setting::back(const Vec& p) const {
  return (1 / (copy.scale * copy.scale)) * transposed_times(copy.linear, p - copy.shift);
}
Vec Setting::back_turn(const Vec& d) const { return (1 / copy.scale) * transposed_times(copy.linear, d); }

std::array<double, 16> Setting::motion(const std::array<Vec, 3>& rotation, const Vec& shift) const {
  const auto moved = [&](const Vec& p) { return place(times(rotation, back(p)) + shift); };
  const Vec origin = moved({0, 0, 0});
  std::array<double, 16> out{};
  for (int c = 0; c < 3; ++c) {
    Vec axis{};
    axis[c] = copy.scale;
    const Vec column = (1 / copy.scale) * (moved(axis) - origin);
    for (int r = 0; r < 3; ++r) out[4 * c + r] = column[r];
  }
  for (int r = 0; r < 3; ++r) out[12 + r] = origin[r];
  out[15] = 1;
  return out;
}

std::vector<double> Setting::spread(const std::vector<double>& values, double added) const {
  std::vector<double> out;
  for (const std::uint32_t v : copy.origin) out.push_back(v == none ? added : values[v]);
  return out;
}

void Setting::point(std::uint32_t triangle, const Vec& weights, std::uint32_t* corners, double* barycentrics) const {
  for (int k = 0; k < 3; ++k) {
    corners[k] = vertex(body.triangles[triangle][k]);
    barycentrics[k] = weights[k];
  }
}

std::vector<double> Setting::gather(const std::vector<double>& values, std::size_t width) const {
  std::vector<double> out;
  for (const std::uint32_t v : copy.first)
    out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(v * width),
               values.begin() + static_cast<std::ptrdiff_t>((v + 1) * width));
  return out;
}

std::vector<double> Setting::gather_places(const std::vector<double>& xyz) const {
  std::vector<double> out = gather(xyz, 3);
  for (std::size_t i = 0; i < out.size(); i += 3) {
    const Vec p = back({out[i], out[i + 1], out[i + 2]});
    std::copy(p.begin(), p.end(), out.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

std::vector<double> Setting::gather_directions(const std::vector<double>& xyz) const {
  std::vector<double> out = gather(xyz, 3);
  for (std::size_t i = 0; i < out.size(); i += 3) {
    const Vec d = back_turn({out[i], out[i + 1], out[i + 2]});
    std::copy(d.begin(), d.end(), out.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

}  // namespace invariance
