// Whether the certificate tells the truth on any shape: about 300 cases with exact answers (exact_shapes.h), with
// sound, damaged and forged factors.
//
//   CERTIFICATE_WRONG_BUT_OK      fields off by more than ten tolerances that were certified
//   CERTIFICATE_RIGHT_BUT_REFUSED fields off by less than a tenth of it, of a sound factor, that were refused
//
// The quick form has shapes of at most 20,000 triangles, the long form of a million. --list prints every case.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>

#include "exact_shapes.h"
#include "hf/hf.h"
#include "report.h"
#include "support/arrays.h"
#include "support/peers.h"

using namespace reliability;

namespace {

enum class Factor { sound, damaged, forged };
const char* const factor_names[] = {"sound", "damaged", "forged"};

struct Counts {
  int cases = 0, wrong_but_ok = 0, right_but_refused = 0, unexpected = 0, found_out = 0;
  double worst_sound = 0;
};

hf_surface_desc desc_of(const ExactShape& shape) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(shape.positions.data(), shape.vertex_count());
  desc.triangles = HF_ARRAY(shape.triangles.data(), shape.triangles.size() / 3);
  desc.field_kind = shape.field_kind;
  return desc;
}

std::vector<unsigned char> saved(const ExactShape& shape) {
  hf_surface surface = nullptr;
  const hf_surface_desc desc = desc_of(shape);
  std::vector<unsigned char> bytes;
  std::size_t size = 0;
  if (hf_surface_create(&desc, &surface) != HF_OK) return bytes;
  hf_surface_save(surface, shape.field_kind, nullptr, 0, nullptr, &size);
  bytes.resize(size);
  hf_surface_save(surface, shape.field_kind, nullptr, size, bytes.data(), nullptr);
  hf_surface_destroy(surface);
  return bytes;
}

// One number per 64 in the last quarter of the bytes, times `scale`.
void damage(unsigned char* bytes, std::size_t size, double scale) {
  for (std::size_t i = (size / 4 * 3 + 7) / 8 * 8; i + 8 <= size; i += 512) {
    double number;
    std::memcpy(&number, bytes + i, sizeof number);
    number *= scale;
    if (std::isfinite(number)) std::memcpy(bytes + i, &number, sizeof number);
  }
}

// The numbers of the factor of a shape that is a little wider: a sound factor, of another operator.
void forge(unsigned char* bytes, std::size_t size, ExactShape shape, double wider) {
  for (std::size_t i = 0; i < shape.positions.size(); i += 3) shape.positions[i] *= wider;
  const std::vector<unsigned char> other = saved(shape);
  if (other.size() != size) return damage(bytes, size, wider);
  std::memcpy(bytes + size / 2, other.data() + size / 2, size - size / 2);
}

double error_of(const ExactShape& shape, const std::vector<double>& field) {
  double low = HUGE_VAL, high = -HUGE_VAL, worst = 0;
  for (const double value : shape.values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  for (std::size_t v = 0; v < field.size(); ++v) {
    const double error = std::fabs(field[v] - shape.exact[v]);
    worst = std::isfinite(error) ? std::max(worst, error) : HUGE_VAL;
  }
  return worst / (high - low);
}

void judge(const ExactShape& shape, Factor factor, std::int32_t engine, double scale, bool list, Counts& counts) {
  hf_surface_desc desc = desc_of(shape);
  hf_factor_desc borrowed = HF_INIT(hf_factor_desc);
  std::vector<unsigned char> block;
  unsigned char* bytes = nullptr;
  if (factor != Factor::sound) {
    const std::vector<unsigned char> right = saved(shape);
    block.resize(right.size() + HF_FACTOR_ALIGNMENT);
    bytes = block.data() + HF_FACTOR_ALIGNMENT - reinterpret_cast<std::uintptr_t>(block.data()) % HF_FACTOR_ALIGNMENT;
    std::memcpy(bytes, right.data(), right.size());
    borrowed.borrow = 1;
    borrowed.bytes = bytes;
    borrowed.byte_count = right.size();
    desc.saved_factor = &borrowed;
  }
  hf_surface surface = nullptr;
  hf_solver solver = nullptr;
  hf_solver_desc solver_desc = HF_INIT(hf_solver_desc);
  solver_desc.field_kind = shape.field_kind;
  ++counts.cases;
  const hf_result created = hf_surface_create(&desc, &surface);
  if (created != HF_OK || create_with(engine, surface, &solver_desc, &solver) != HF_OK) {
    // too long for the digits of double: a bi-harmonic surface may be refused
    counts.unexpected += shape.field_kind == HF_FIELD_HARMONIC || created != HF_ERROR_NOT_POSITIVE_DEFINITE;
    hf_surface_destroy(surface);
    return;
  }
  if (factor == Factor::damaged) damage(bytes, borrowed.byte_count, scale);
  if (factor == Factor::forged) forge(bytes, borrowed.byte_count, shape, scale);
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = static_cast<std::uint32_t>(shape.sites.size());
  sites.vertices = shape.sites.data();
  sites.values = shape.values.data();
  sites.stiffness = shape.stiffness.empty() ? nullptr : shape.stiffness.data();
  hf_result result = hf_add_sites(solver, &sites, nullptr);
  std::vector<double> field(shape.vertex_count());
  hf_certificate found = HF_INIT(hf_certificate);
  double error = HUGE_VAL;
  if (result == HF_OK) result = hf_solver_solve(solver, OUT(field.data()), nullptr);
  if (result == HF_OK) {
    error = error_of(shape, field);
    result = hf_solver_certify(solver, &found);
  }
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);

  const double tolerance = 1e-8;
  const bool wrong = result == HF_OK && !(error <= 10 * tolerance);
  const bool refused = factor == Factor::sound && result == HF_ERROR_INACCURATE && error < tolerance / 10;
  counts.wrong_but_ok += wrong;
  counts.right_but_refused += refused;
  counts.found_out += result == HF_ERROR_INACCURATE;
  // a wrong factor may lose the sites; a sound one answers
  counts.unexpected += factor == Factor::sound && result != HF_OK && result != HF_ERROR_INACCURATE;
  if (factor == Factor::sound && (shape.field_kind == HF_FIELD_HARMONIC || result == HF_OK))
    counts.worst_sound = std::max(counts.worst_sound, error);
  if (list || wrong || refused)
    std::printf("%s%zu triangles, engine %d, %s %g: error %.2g, estimate %.2g, %s%s\n", shape.name.c_str(),
                shape.triangles.size() / 3, engine, factor_names[static_cast<int>(factor)], scale, error,
                found.error_estimate, hf_result_get_name(result), wrong || refused ? "  <- WRONG" : "");
  std::fflush(stdout);
}

// Bi-harmonic fields around a vertex of more than 1,000 neighbours have one engine.
bool is_green_alone(const ExactShape& shape) {
  return shape.name == "bi-harmonic fan " && shape.triangles.size() > 3 * 1000;
}

// Shapes of about so many triangles.
std::vector<std::function<ExactShape()>> shapes_of(std::uint32_t n, unsigned seed) {
  const std::uint32_t root = std::max(2u, static_cast<std::uint32_t>(std::sqrt(n / 2.0)));
  std::vector<std::function<ExactShape()>> all = {
      [=] { return exact_chain(n, false, 0, seed); },
      [=] { return exact_chain(n, true, 0, seed); },
      [=] { return exact_chain(n, true, 1e-3, seed); },
      [=] { return exact_tube(std::max(2u, n / 24), 12, false, 0, seed); },
      [=] { return exact_tube(std::max(2u, n / 6), 3, true, 0, seed); },
      [=] { return exact_revolution(root, root + 1, 2, 0); },
      [=] { return exact_revolution(std::max(3u, n / 16), 8, 0.4 * std::max(3u, n / 16), 0); },
      [=] { return exact_revolution(root, root + 1, 2, 1e2); },
      [=] { return exact_fan(n, 0); },
      [=] { return exact_plane(root, root, 1, 1, 0); },
      [=] { return exact_plane(root, root, 1, 1e-3, 0); },
      [=] { return exact_plane(std::max(4u, n / 4), 2, 1, 1, 0); },
      [=] { return exact_islands(std::max(1u, n / 200), std::min(100u, n / 2)); },
  };
  // columns that grow by less than a half, and not beyond what positions tell apart
  if (root >= 8)
    for (const double finest : {1e-3, 1e-6, 1e-9})
      all.push_back([=] { return exact_plane(std::min(root, 300u), std::min(root, 300u), finest, 1, 0); });
  // The condition of a bi-harmonic field is the fourth power of the length: beyond 3,000 rings the digits of double do
  // not suffice. The certificate must say so, or the surface is refused.
  if (n >= 200) {
    all.push_back([=] { return exact_tube(std::max(8u, n / 24), 12, false, 1, seed); });
    all.push_back([=] { return exact_plane(std::min(root, 450u), std::min(root, 450u), 1, 1, 1); });
    all.push_back([=] { return exact_fan(std::min(n, 100000u), 1); });
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const bool full = report_full(argc, argv);
  bool list = false;
  for (int i = 1; i < argc; ++i) list = list || std::strcmp(argv[i], "--list") == 0;
  std::vector<std::uint32_t> sizes = {10, 100, 1000, 8000, 20000};
  if (full) {
    sizes.back() = 50000;
    sizes.push_back(300000);
    sizes.push_back(1000000);
  }
  Counts counts;
  for (const std::uint32_t n : sizes) {
    for (const auto& make : shapes_of(n, n)) {
      const ExactShape shape = make();
      judge(shape, Factor::sound, ENGINE_GREEN, 0, list, counts);
      if (n <= 8000 && !is_green_alone(shape)) judge(shape, Factor::sound, ENGINE_REFACTOR, 0, list, counts);
      // a small factor has few numbers to be wrong
      if (n < 1000 || n > 50000) continue;
      for (const double scale : {1 + 1e-4, 3.0}) judge(shape, Factor::damaged, ENGINE_GREEN, scale, list, counts);
      judge(shape, Factor::forged, ENGINE_GREEN, 1.001, list, counts);
      if (n <= 8000) judge(shape, Factor::forged, ENGINE_GREEN, 2, list, counts);
    }
  }
  if (full) {
    const ExactShape tube = exact_tube(100000, 3, true, HF_FIELD_HARMONIC, 1);
    for (const double scale : {1 + 1e-9, 1 + 1e-6, 1 + 1e-4, 3.0})
      judge(tube, Factor::damaged, ENGINE_GREEN, scale, list, counts);
    judge(tube, Factor::forged, ENGINE_GREEN, 1.001, list, counts);
  }
  report_at_least("CERTIFICATE_CASES", counts.cases, full ? 300 : 250);
  report_at_least("CERTIFICATE_FOUND_OUT", counts.found_out, 1);
  report_at_most("CERTIFICATE_WRONG_BUT_OK", counts.wrong_but_ok, 0);
  report_at_most("CERTIFICATE_RIGHT_BUT_REFUSED", counts.right_but_refused, 0);
  report_at_most("CERTIFICATE_UNEXPECTED", counts.unexpected, 0);
  report_at_most("CERTIFICATE_LARGEST_ERROR_OF_SOUND", counts.worst_sound, 1e-9);
  return report_status();
}
