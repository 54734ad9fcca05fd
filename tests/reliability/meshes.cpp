// The bad-mesh table: meshes with one fault each, with every operator and kind of field. The library refuses them with
// the documented code, or gives a finite field. The field holds its sites and reproduces constants. With weights that
// are not negative it keeps to the range of its sites. Then come 1,000 random meshes, 50,000 in the long form. Their
// coordinates lie anywhere in the range of a float, and their fields may leave the range by 1e-4.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "hf/hf.h"
#include "report.h"
#include "support/arrays.h"

namespace {

struct Mesh {
  std::string name;
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  hf_result expected = HF_OK;
  std::uint32_t count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
  double* at(std::size_t v) { return positions.data() + 3 * v; }
};

Mesh sheet(std::uint32_t n) {
  Mesh m;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i)
      m.positions.insert(m.positions.end(), {double(i), double(j), 0.2 * std::sin(i + 2.0 * j)});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, c = a + n + 1;
      m.triangles.insert(m.triangles.end(), {a, a + 1, c + 1, a, c + 1, c});
    }
  }
  return m;
}

Mesh tube(std::uint32_t around, std::uint32_t rings) {
  Mesh m;
  for (std::uint32_t v = 0; v < around * rings; ++v) {
    const double turn = 6.283185307179586 * (v % around) / around;
    m.positions.insert(m.positions.end(), {std::cos(turn), double(v / around), std::sin(turn)});
  }
  for (std::uint32_t a = 0; a + around < around * rings; ++a) {
    const std::uint32_t b = a / around * around + (a + 1) % around;
    m.triangles.insert(m.triangles.end(), {a, a + around, b, b, a + around, b + around});
  }
  return m;
}

Mesh strip(double width) {  // two triangles
  Mesh m;
  m.positions = {0, 0, 0, 1, 0, 0, 0, width, 0, 1, width, 0};
  m.triangles = {0, 1, 2, 1, 3, 2};
  return m;
}
Mesh needle(double width) {
  Mesh m = strip(width);
  m.positions.resize(9);
  m.triangles.resize(3);
  return m;
}

void scale(Mesh& m, double x, double y, double z) {
  for (std::size_t v = 0; v < m.count(); ++v) {
    m.at(v)[0] *= x;
    m.at(v)[1] *= y;
    m.at(v)[2] *= z;
  }
}
void shift(Mesh& m, double by) {
  for (double& x : m.positions) x += by;
}
void append(Mesh& m, Mesh other, double dx) {
  const std::uint32_t first = m.count();
  for (std::size_t i = 0; i < other.positions.size(); ++i) m.positions.push_back(other.positions[i] + (i % 3 ? 0 : dx));
  for (const std::uint32_t v : other.triangles) m.triangles.push_back(first + v);
}

std::vector<Mesh> meshes() {
  std::vector<Mesh> all;
  const auto put = [&](const std::string& name, Mesh m, hf_result expected = HF_OK) {
    m.name = name;
    m.expected = expected;
    all.push_back(std::move(m));
  };
  // damaged glTF found these: the default operator did not factor
  for (const double width : {1e-3, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12, 1e-15, 1e-30, 1e-300}) {
    char text[32];
    std::snprintf(text, sizeof text, " of width %g", width);
    put("one needle" + std::string(text), needle(width));
    put("two needles" + std::string(text), strip(width));
  }
  // libFuzzer found this: one component has weights from 1e-34 to 1e34
  Mesh far;
  far.positions = {0, 0, 0, -1.0384593717069655e34, 0, 0, 0, 1, 0, -1.038467170729213e34, 0, 0, 0, 0, 1};
  far.triangles = {0, 1, 3, 1, 2, 4};
  put("two needles of 1e34", far);
  struct Change {
    const char* name;
    std::function<void(Mesh&)> make;
  };
  const Change changes[] = {
      {"as it is", [](Mesh&) {}},
      {"of size 1e-42", [](Mesh& m) { scale(m, 1e-42, 1e-42, 1e-42); }},
      {"of size 1e-150", [](Mesh& m) { scale(m, 1e-150, 1e-150, 1e-150); }},
      {"of size 1e30", [](Mesh& m) { scale(m, 1e30, 1e30, 1e30); }},
      {"of size 1e150", [](Mesh& m) { scale(m, 1e150, 1e150, 1e150); }},
      {"at 1e6", [](Mesh& m) { shift(m, 1e6); }},
      {"at 1e12", [](Mesh& m) { shift(m, 1e12); }},
      {"pressed to 1e-6", [](Mesh& m) { scale(m, 1, 1e-6, 1); }},
      {"pressed to 1e-12", [](Mesh& m) { scale(m, 1, 1e-12, 1); }},
      {"pressed to a line", [](Mesh& m) { scale(m, 0, 1, 0); }},
      {"drawn out 1e8 times", [](Mesh& m) { scale(m, 1e8, 1, 1); }},
      {"sheared",
       [](Mesh& m) {
         for (std::size_t v = 0; v < m.count(); ++v) m.at(v)[0] += 30 * m.at(v)[1];
       }},
      {"one vertex at 1e30", [](Mesh& m) { m.at(7)[1] = 1e30; }},
      {"one vertex at 1e-30 of a neighbour",
       [](Mesh& m) {
         for (int k = 0; k < 3; ++k) m.at(7)[k] = m.at(8)[k] + (k == 1 ? 1e-30 : 0);
       }},
      {"coincident vertices",
       [](Mesh& m) {
         for (int k = 0; k < 3; ++k) m.at(7)[k] = m.at(8)[k];
       }},
      {"every second vertex on its neighbour",
       [](Mesh& m) {
         for (std::size_t v = 1; v < m.count(); v += 2)
           for (int k = 0; k < 3; ++k) m.at(v)[k] = m.at(v - 1)[k];
       }},
      {"a vertex on an edge",
       [](Mesh& m) {
         for (int k = 0; k < 3; ++k) m.at(7)[k] = 0.5 * (m.at(6)[k] + m.at(8)[k]);
       }},
      {"every third triangle turned over",
       [](Mesh& m) {
         for (std::size_t t = 0; t < m.triangles.size(); t += 9) std::swap(m.triangles[t], m.triangles[t + 1]);
       }},
      {"all triangles twice",
       [](Mesh& m) {
         const std::vector<std::uint32_t> once = m.triangles;
         m.triangles.insert(m.triangles.end(), once.begin(), once.end());
       }},
      {"a triangle a hundred times",
       [](Mesh& m) {
         for (int i = 0; i < 100; ++i)
           m.triangles.insert(m.triangles.end(), {m.triangles[0], m.triangles[1], m.triangles[2]});
       }},
      {"a fin on every row",
       [](Mesh& m) {
         const std::uint32_t n = m.count();
         m.positions.insert(m.positions.end(), {3, 3, 9});
         for (std::uint32_t v = 0; v + 1 < n; v += 3) m.triangles.insert(m.triangles.end(), {v, v + 1, n});
       }},
      {"triangles of equal corners",
       [](Mesh& m) {
         for (std::uint32_t v = 0; v < 20; ++v) m.triangles.insert(m.triangles.end(), {v, v, v + 1});
       }},
      {"isolated vertices",
       [](Mesh& m) {
         for (int i = 0; i < 50; ++i) m.positions.insert(m.positions.end(), {double(i), 50, 50});
       }},
      {"an island of one triangle", [](Mesh& m) { append(m, needle(1), 100); }},
      {"an island of one needle", [](Mesh& m) { append(m, needle(1e-9), 100); }},
      {"an island 1e20 times smaller",
       [](Mesh& m) {
         Mesh tiny = sheet(2);
         scale(tiny, 1e-20, 1e-20, 1e-20);
         append(m, tiny, 0);
       }},
      {"every triangle alone",
       [](Mesh& m) {
         Mesh apart;
         for (std::size_t i = 0; i < m.triangles.size(); ++i) {
           const double* p = m.at(m.triangles[i]);
           for (int k = 0; k < 3; ++k) apart.positions.push_back(p[k] + 0.1 * double(i / 3));
           apart.triangles.push_back(static_cast<std::uint32_t>(i));
         }
         m = apart;
       }},
      {"joined at one vertex",
       [](Mesh& m) {
         const std::uint32_t n = m.count();
         append(m, m, 40);
         for (int k = 0; k < 3; ++k) m.at(n)[k] = m.at(0)[k];
       }},
  };
  for (const Change& change : changes) {
    for (const bool closed : {false, true}) {
      Mesh m = closed ? tube(6, 6) : sheet(5);
      change.make(m);
      // pressed to a line, every triangle has two equal corners
      const bool gone = std::string(change.name) == "pressed to a line";
      put(std::string(closed ? "tube " : "sheet ") + change.name, m, gone ? HF_ERROR_EMPTY : HF_OK);
    }
  }
  put(
      "no triangle",
      [] {
        Mesh m = sheet(2);
        m.triangles.clear();
        return m;
      }(),
      HF_ERROR_EMPTY);
  put(
      "one place",
      [] {
        Mesh m = sheet(2);
        scale(m, 0, 0, 0);
        return m;
      }(),
      HF_ERROR_EMPTY);
  put(
      "a corner outside",
      [] {
        Mesh m = sheet(2);
        m.triangles[5] = 9;
        return m;
      }(),
      HF_ERROR_OUT_OF_RANGE);
  put(
      "not a number",
      [] {
        Mesh m = sheet(2);
        m.positions[4] = std::nan("");
        return m;
      }(),
      HF_ERROR_NON_FINITE);
  put(
      "infinite",
      [] {
        Mesh m = sheet(2);
        m.positions[4] = HUGE_VAL;
        return m;
      }(),
      HF_ERROR_NON_FINITE);
  put(
      "wider than a double",
      [] {
        Mesh m = sheet(2);
        m.positions[0] = -1.7e308;
        m.positions[3] = 1.7e308;
        return m;
      }(),
      HF_ERROR_TOO_LARGE);
  return all;
}

// A sheet or a tube. Every coordinate, or one in 2, 4, ..., 32, is 0 or has any magnitude of a float.
Mesh of_any_magnitudes(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Mesh m = random() % 2 ? sheet(1 + random() % 4) : tube(3 + random() % 3, 2 + random() % 3);
  const std::uint64_t one_in = std::uint64_t{1} << random() % 6;
  for (double& x : m.positions) {
    if (random() % one_in) continue;
    const double magnitude = std::pow(10.0, -44 + 82 * double(random() >> 11) / double(1ull << 53));
    x = random() % 4 ? (random() % 2 ? magnitude : -magnitude) : 0;
  }
  m.name = "any magnitudes, number " + std::to_string(seed);
  return m;
}

// Solves with two sites, at the first and the last vertex of a component. Returns what is wrong, or nothing.
std::string check_field(hf_surface surface, hf_solver solver, const Mesh& m, double beyond, double far_value,
                        double near_value) {
  std::vector<std::uint32_t> component(m.count());
  if (hf_surface_get_components(surface, m.count(), component.data(), nullptr) != HF_OK)
    return "hf_surface_get_components failed";
  std::uint32_t first = HF_NO_INDEX, last = HF_NO_INDEX;
  for (std::uint32_t v = 0; v < m.count(); ++v) {
    if (component[v] == HF_NO_INDEX) continue;
    if (first == HF_NO_INDEX) first = v;
    bool apart = false;
    for (int k = 0; k < 3; ++k)
      apart = apart ||
              m.positions[3 * v + static_cast<std::size_t>(k)] != m.positions[3 * first + static_cast<std::size_t>(k)];
    if (component[v] == component[first] && apart) last = v;
  }
  const std::uint32_t places[2] = {first, last};
  const double values[2] = {near_value, far_value};
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = last == HF_NO_INDEX ? 1 : 2;
  sites.vertices = places;
  sites.values = values;
  std::uint32_t numbers[2];
  hf_result got = hf_add_sites(solver, &sites, numbers);
  if (got != HF_OK) return std::string("hf_add_sites: ") + hf_result_get_name(got);
  std::vector<double> field(m.count());
  got = hf_solver_solve(solver, OUT(field.data()), nullptr);
  if (got != HF_OK) return std::string("hf_solver_solve: ") + hf_result_get_name(got);
  const double low = std::fmin(near_value, far_value), high = std::fmax(near_value, far_value);
  for (std::uint32_t v = 0; v < m.count(); ++v) {
    if (!std::isfinite(field[v])) return "a value is not finite";
    if (component[v] != component[first]) continue;
    if (!(field[v] >= low - beyond && field[v] <= high + beyond)) return "a value of " + std::to_string(field[v]);
  }
  if (field[first] != near_value) return "a site does not hold its value";
  if (hf_remove_sites(solver, sites.site_count, numbers) != HF_OK) return "hf_remove_sites failed";
  return "";
}

hf_surface_desc surface_desc(const Mesh& m, int operator_kind, int field_kind) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(m.positions.data(), m.count());
  desc.triangles = HF_ARRAY(m.triangles.data(), m.triangles.size() / 3);
  static const std::uint32_t no_triangle[3] = {0, 0, 0};
  if (m.triangles.empty()) desc.triangles = HF_ARRAY(no_triangle, 0);
  desc.operator_kind = operator_kind;
  desc.field_kind = field_kind;
  return desc;
}

std::string check(const Mesh& m, int operator_kind, int field_kind, bool any_magnitudes = false) {
  hf_solver_desc wanted = HF_INIT(hf_solver_desc);
  wanted.field_kind = field_kind;
  hf_surface_desc desc = surface_desc(m, operator_kind, field_kind);
  hf_surface surface = nullptr;
  const hf_result got = hf_surface_create(&desc, &surface);
  if (got != m.expected && !(any_magnitudes && got == HF_ERROR_EMPTY)) {
    hf_surface_destroy(surface);
    return hf_result_get_name(got);
  }
  if (got != HF_OK) return surface == nullptr ? "" : "a refused hf_surface_create gave a handle";
  hf_solver solver = nullptr;
  if (hf_create(surface, &wanted, &solver) != HF_OK) {
    hf_surface_destroy(surface);
    return "hf_create failed";
  }
  // such weights span ten of the sixteen digits of a double
  const double rounding = any_magnitudes ? 1e-4 : 1e-9;
  const bool harmonic = field_kind == HF_FIELD_HARMONIC;
  std::string wrong =
      check_field(surface, solver, m, harmonic && operator_kind != HF_OPERATOR_COTANGENT ? rounding : 1e300, 1, 0);
  if (wrong.empty()) wrong = check_field(surface, solver, m, harmonic ? rounding : 1e300, 3, 3);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  return wrong;
}

// The field of three sites among the first `count` vertices. A surface is made and its factor saved; the field is that
// of a surface which loads it. The saved kind is the surface's own, or one made by the saving.
std::vector<double> loaded_field(const Mesh& m, std::uint32_t count, int operator_kind, int field_kind) {
  hf_surface_desc desc = surface_desc(m, operator_kind, operator_kind % 2 ? HF_FIELD_HARMONIC : field_kind);
  hf_surface made = nullptr, loaded = nullptr;
  hf_solver solver = nullptr;
  std::size_t size = 0;
  std::vector<double> field(m.count(), NAN);
  if (hf_surface_create(&desc, &made) == HF_OK &&
      hf_surface_save(made, field_kind, nullptr, 0, nullptr, &size) == HF_OK) {
    std::vector<unsigned char> bytes(size);
    hf_factor_desc saved = HF_INIT(hf_factor_desc);
    saved.bytes = bytes.data();
    saved.byte_count = size;
    desc.saved_factor = &saved;
    desc.field_kind = field_kind;
    const std::uint32_t places[] = {0, count / 2, count - 1};
    const double values[] = {0, 1, -1};
    hf_sites_desc sites = HF_INIT(hf_sites_desc);
    sites.site_count = 3;
    sites.vertices = places;
    sites.values = values;
    hf_solver_desc wanted = HF_INIT(hf_solver_desc);
    wanted.field_kind = field_kind;
    if (hf_surface_save(made, field_kind, nullptr, size, bytes.data(), nullptr) != HF_OK ||
        hf_surface_create(&desc, &loaded) != HF_OK || hf_create(loaded, &wanted, &solver) != HF_OK ||
        hf_add_sites(solver, &sites, nullptr) != HF_OK || hf_solver_solve(solver, OUT(field.data()), nullptr) != HF_OK)
      field.assign(m.count(), NAN);
  }
  hf_solver_destroy(solver);
  hf_surface_destroy(made);
  hf_surface_destroy(loaded);
  field.resize(count);
  return field;
}

// A sheet beside an island of two needles keeps its field: weights that do not factor change their own component only.
unsigned wrong_beside_islands() {
  const Mesh alone = sheet(8);
  unsigned wrong = 0;
  for (int kind = 0; kind < 12; ++kind) {
    const std::vector<double> right = loaded_field(alone, alone.count(), kind % 4, kind / 4);
    for (const double width : {1e-3, 1e-6, 1e-9, 1e-15, 1e-300}) {
      Mesh m = alone;
      append(m, strip(width), 40);
      const std::vector<double> field = loaded_field(m, alone.count(), kind % 4, kind / 4);
      double largest = 0;
      for (std::size_t v = 0; v < field.size(); ++v)
        largest = std::isfinite(field[v]) ? std::fmax(largest, std::fabs(field[v] - right[v])) : HUGE_VAL;
      if (largest <= 1e-7) continue;
      ++wrong;
      std::fprintf(stderr, "beside needles of width %g, operator %d, field %d: off by %g\n", width, kind % 4, kind / 4,
                   largest);
    }
  }
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned count = 0, wrong = 0;
  double slowest = 0;
  const auto every_kind = [&](const Mesh& m, bool any_magnitudes) {
    ++count;
    for (int operator_kind = 0; operator_kind < 4; ++operator_kind) {
      for (int field_kind = 0; field_kind < 3; ++field_kind) {
        const std::clock_t start = std::clock();
        const std::string what = check(m, operator_kind, field_kind, any_magnitudes);
        const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
        if (seconds > 1)
          std::fprintf(stderr, "%s, operator %d, field %d: %.1f s\n", m.name.c_str(), operator_kind, field_kind,
                       seconds);
        slowest = std::fmax(slowest, seconds);
        if (what.empty()) continue;
        if (++wrong <= 40)
          std::fprintf(stderr, "%s, operator %d, field %d: %s\n", m.name.c_str(), operator_kind, field_kind,
                       what.c_str());
      }
    }
  };
  for (const Mesh& m : meshes()) every_kind(m, false);
  report_at_least("meshes_tried", count, 60);
  report_at_most("meshes_wrong", wrong, 0);
  report_at_most("meshes_wrong_beside_islands", wrong_beside_islands(), 0);
  const unsigned random_count = report_full(argc, argv) ? 50000 : 1000;
  count = wrong = 0;
  for (unsigned i = 0; i < random_count; ++i) every_kind(of_any_magnitudes(i), true);
  report_at_least("meshes_random_tried", count, random_count);
  report_at_most("meshes_random_wrong", wrong, 0);
  report_at_most("meshes_slowest_s", slowest, 1);
  return report_status();
}
