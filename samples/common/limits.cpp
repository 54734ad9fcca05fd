// See limits.h.
#include "common/limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace samples {
namespace {

// Operations let through per n^2; n is the smaller of vertices and triangles. A surface grows like n^1.5 and takes at
// most 1.8 where the floor below ends. A lattice of struts grows like n^2 and is the dearest sound mesh: 0.4 to 1.8,
// with a bi-harmonic field 3.8 to 17. Triangles at random take 170 to 3,000. Half refuses that lattice; twice lets a
// file of 1 MB that was made for it take 70 * 10^9 operations.
constexpr double work_of_square = 20;
// Small meshes may have any triangles: 4 * 10^9 operations are a fifth of a second, a full matrix of 2,300 unknowns.
// At most: the library's own default.
constexpr double least_work_gflop = 4, most_work_gflop = 100000;
// Memory of the surface and all that is made on it. The shared meshes take 0.4 to 2.0 KiB a vertex, lattices of 400,000
// vertices 4.6, and 19 with a bi-harmonic field. Half refuses larger ones; twice leaves the refusal to the work limit.
constexpr double least_memory_mib = 128, kib_of_vertex = 32;
// Matrices of whole numbers, for the square of the genus: a genus of 133 has 3,200 whole numbers, and with 20 KiB gets
// 345 MiB, of which it takes 300. Half refuses it. Triangles at random have a large genus, so the most is bounded.
constexpr double kib_of_genus_square = 20, most_for_genus = 2;
// What the desc can say.
constexpr double largest_limit = 4294967295.0;

// Set by the command line; 0: by the size of the mesh.
uint32_t given_work = 0, given_memory = 0;

uint32_t whole(double number) { return static_cast<uint32_t>(std::min(std::ceil(number), largest_limit)); }

// The n of the limits. Vertices that no triangle names do not raise it.
double size_of(const hf_surface_desc& desc) {
  const double vertices = desc.positions.count, triangles = desc.triangles.count;
  const double cut = desc.faces ? desc.faces->corners.count - 2.0 * desc.faces->sizes.count : 0;
  return std::min(vertices, std::max(triangles, cut));
}

// Triangles with the same corners count once.
double distinct_triangles(const hf_surface_desc& desc) {
  if (!desc.triangles.data) return desc.triangles.count;
  const uint32_t* const corners = static_cast<const uint32_t*>(desc.triangles.data);  // packed, as all programs have them
  std::vector<std::array<uint32_t, 3>> sorted(desc.triangles.count);
  for (size_t t = 0; t < sorted.size(); ++t) {
    std::copy_n(corners + 3 * t, 3, sorted[t].begin());
    std::sort(sorted[t].begin(), sorted[t].end());
  }
  std::sort(sorted.begin(), sorted.end());
  return static_cast<double>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

// Of a closed surface with these counts. Borders, pieces and copies of vertices make it less.
double genus_of(const hf_surface_desc& desc) {
  const auto genus = [&](double triangles) { return std::max(0.0, 0.5 * (0.5 * triangles - desc.positions.count) + 1); };
  return genus(desc.triangles.count) > 0 ? genus(distinct_triangles(desc)) : 0;
}

}  // namespace

bool take_limit(const std::string& option, const std::function<std::string()>& value) {
  const bool work = option == "--work-limit";
  if (!work && option != "--memory-limit") return false;
  const std::string text = value();
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(number >= 1 && number <= largest_limit))
    throw std::runtime_error(option + " takes a number from 1 to 4294967295, not \"" + text + "\"");
  (work ? given_work : given_memory) = whole(number);
  return true;
}

void limit_surface(hf_surface_desc& desc, uint32_t made) {
  // what is made of the mesh is factorised too
  const double n = size_of(desc) + made, work = 1e-9 * work_of_square * n * n;
  desc.work_limit_gflop = given_work ? given_work : whole(std::clamp(work, least_work_gflop, most_work_gflop));
  desc.memory_limit_mb = given_memory ? given_memory : whole(least_memory_mib + kib_of_vertex / 1024 * n);
}

void limit_quads(hf_surface_desc& desc, uint32_t faces) {
  limit_surface(desc, faces > 0 ? 2 * desc.positions.count + faces : 0);
  if (given_memory) return;
  const double limit = desc.memory_limit_mb, genus = genus_of(desc);
  desc.memory_limit_mb = whole(limit + std::min(kib_of_genus_square / 1024 * genus * genus, most_for_genus * limit));
}

std::string with_limit_option(const std::string& message) {
  const auto names = [&](const char* limit) { return message.find(limit) != std::string::npos; };
  if (names("work_limit_gflop")) return message + "; --work-limit N raises it to N * 10^9 operations";
  if (names("memory_limit_mb")) return message + "; --memory-limit N raises it to N MiB";
  return message;
}

}  // namespace samples
