#include "mesh/place_reader.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"

namespace hf_inner::mesh {
namespace {

// Barycentric weights may sum to 1 within this. Three of single precision are off by at most 9e-8, so half and double
// accept them too. A larger bound would hide wrong ones. The test bad_sites_test reaches it with sums of 0.999 and
// 1.001.
constexpr double weight_sum_error = 1e-6;
// A place whose weight at a corner exceeds 1 minus this number becomes that vertex. A larger number would move places
// that the host put near a corner. Half and double change no bit on eight shapes with needles, loose pieces and a long
// ribbon.
constexpr double corner_share = 1e-12;

// So many points are compared with all triangles, and a dragged site allocates nothing. The tree pays from
// 40 points on: 52 ms on 217,800 triangles, where a point costs 1.2 ms without it.
constexpr std::uint32_t few_points = 32;

double check_weights(const double* weights, std::size_t position, const char* list) {
  const std::uint32_t index = static_cast<std::uint32_t>(position);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(weights[k]))
      fail(HF_ERROR_NON_FINITE, index, "entry %zu of %s: barycentric weight %d is not a finite number", position, list,
           k);
    if (weights[k] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of %s: barycentric weight %d is %g; weights must not be negative", position, list, k, weights[k]);
    sum += weights[k];
  }
  if (!(std::fabs(sum - 1) <= weight_sum_error))
    fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of %s: barycentric weights sum to %.9g; they must sum to 1",
         position, list, sum);
  return sum;
}

// Adds a corner. Corners that are one vertex add their weights.
void add_corner(SurfacePlace& place, std::int32_t vertex, double weight) noexcept {
  int k = 0;
  while (place.vertex[k] != Mesh::none && place.vertex[k] != vertex) ++k;
  place.vertex[k] = vertex;
  place.weight[k] += weight;
}

SurfacePlace snapped(const SurfacePlace& place) noexcept {
  for (int k = 0; k < 3; ++k) {
    if (place.weight[k] > 1 - corner_share) return SurfacePlace::at_vertex(place.vertex[k]);
  }
  return place;
}

}  // namespace

Places::Places(std::uint32_t n, const std::uint32_t* of_vertices, const hf_place* of_places, const double* in_space)
    : count(n), vertices(of_vertices), places(of_places), points(in_space) {
  if ((vertices != nullptr) + (places != nullptr) + (points != nullptr) > 1)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s and %s are both set; set one", vertices ? "vertices" : "places",
         vertices && places ? "places" : "points");
  if (!vertices && !places && !points)
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "vertices, places and points are all NULL; set one");
}

SurfacePlace read_place(const Mesh& mesh, const hf_place& given, std::size_t position, const char* list) {
  const std::uint32_t index = static_cast<std::uint32_t>(position);
  require_triangles(mesh, "a place between corners", index);
  if (given.reserved != 0)
    fail(HF_ERROR_INVALID_DESC, index, "entry %zu of %s: reserved is %u; set it to 0", position, list, given.reserved);
  const double sum = check_weights(given.barycentrics, position, list);
  SurfacePlace place;
  for (int k = 0; k < 3; ++k) {
    if (given.barycentrics[k] > 0)
      add_corner(place, usable_vertex(mesh, given.corners[k], position, list), given.barycentrics[k] / sum);
  }
  const std::int32_t component = mesh.component[static_cast<std::size_t>(place.vertex[0])];
  for (int k = 1; k < 3 && place.vertex[k] != Mesh::none; ++k) {
    if (mesh.component[static_cast<std::size_t>(place.vertex[k])] != component)
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of %s: its corners are in different components; name corners of one face", position, list);
  }
  return snapped(place);
}

PlaceReader::PlaceReader(const Mesh& mesh, const Places& given, Memory& memory) : mesh_(mesh), given_(given) {
  if (given.points && !mesh.is_graph() && given.count > few_points) tree_.emplace(mesh.positions, mesh.corners, memory);
}

Index PlaceReader::nearest(const Vec3& p) const noexcept {
  if (tree_) return tree_->find(p).triangle;
  const auto corner = [&](Index t, std::size_t k) -> const Vec3& { return mesh_.positions[at(mesh_.triangle(t)[k])]; };
  Index found = -1;
  double least = HUGE_VAL;
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    const Vec3 &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    ItemBox box = ItemBox::of(a);
    box.take(b);
    box.take(c);
    if (!(squared_distance(p, box) < least)) continue;
    const double squared = squared_to_triangle(p, a, b, c);
    if (squared < least) {
      least = squared;
      found = t;
    }
  }
  return found;
}

SurfacePlace PlaceReader::read(std::uint32_t i) const {
  if (given_.vertices) return SurfacePlace::at_vertex(usable_vertex(mesh_, given_.vertices[i], i, "vertices"));
  if (given_.places) return read_place(mesh_, given_.places[i], i, "places");
  require_triangles(mesh_, "a point in space", i);
  const Vec3 p = read_point_near(mesh_, given_.points + std::size_t{3} * i, "point", i);
  const Index t = nearest(p);
  const Index* const c = mesh_.triangle(t);
  double weight[3];
  squared_to_triangle(p, mesh_.positions[at(c[0])], mesh_.positions[at(c[1])], mesh_.positions[at(c[2])], weight);
  SurfacePlace place;
  for (int k = 0; k < 3; ++k) {
    if (weight[k] > 0) add_corner(place, mesh_.triangle(t)[k], weight[k]);
  }
  return snapped(place);
}

}  // namespace hf_inner::mesh
