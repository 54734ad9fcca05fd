#include "mesh/touching.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/link_constants.h"
#include "mesh/nearest_triangle.h"

namespace hf_inner::mesh {
namespace {

// A pair of pieces: vertices of the first touch the second.
struct Side {
  Index from, to;
  bool operator<(const Side& o) const noexcept { return from != o.from ? from < o.from : to < o.to; }
  bool operator==(const Side& o) const noexcept { return from == o.from && to == o.to; }
};

Vector<Side> linked_sides(const Links& links, Memory& memory) {
  Vector<Side> sides(&memory);
  for (const Link& link : links.links) {
    for (const Index corner : link.corner) {
      if (corner == Mesh::none) continue;
      const Index a = links.piece[at(link.vertex)], b = links.piece[at(corner)];
      if (a != b) sides.insert(sides.end(), {{a, b}, {b, a}});
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

// Positions beyond this would overflow in squared distances.
constexpr double largest_position = 1e150;

Vector<Vec3> posed_places(const Mesh& mesh, const ConstRows& posed, Memory& memory) {
  Vector<Vec3> places(mesh.positions.size(), &memory);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t v = at(mesh.given_of_inner[i]);
    Vec3& p = places[i];
    p = (1 / mesh.scale) * Vec3{posed.get(v, 0), posed.get(v, 1), posed.get(v, 2)};
    const auto is_near = [](double x) { return std::fabs(x) <= largest_position; };
    if (is_near(p.x) && is_near(p.y) && is_near(p.z)) continue;
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
      fail(HF_ERROR_TOO_LARGE, static_cast<std::uint32_t>(v),
           "vertex %zu is too far away: give positions in the unit of the surface", v);
    fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v), "the position of vertex %zu is not finite", v);
  }
  return places;
}

}  // namespace

void find_touching(const ContactSearch& contacts, Memory& memory, JobRunner* jobs, Links& out) {
  const Vector<Side> sides = linked_sides(out, memory);
  Vector<Vector<Touch>> lists(sides.size(), &memory);
  for_each(jobs, static_cast<std::uint32_t>(sides.size()), [&](std::uint32_t i) {
    Vector<Contact> found(&memory);
    double reach = touching;
    contacts.find(sides[i].from, sides[i].to, HUGE_VAL, reach, found, SIZE_MAX);
    for (const Contact& contact : found)
      if (contact.steps <= 1) lists[i].push_back({contact.vertex, contact.triangle, contact.distance});
  });
  poll();
  for (const Vector<Touch>& list : lists) out.touching.insert(out.touching.end(), list.begin(), list.end());
}

void keep_touching(const Links& from, const Mesh& mesh, Memory& memory, Links& out) {
  const Vector<Side> sides = linked_sides(out, memory);
  for (const Touch& touch : from.touching) {
    const Side side{from.piece[at(touch.vertex)], from.piece[at(mesh.triangle(touch.triangle)[0])]};
    if (std::binary_search(sides.begin(), sides.end(), side)) out.touching.push_back(touch);
  }
}

Opening measure_opening(const Mesh& mesh, const Links& links, const ConstRows& posed, Memory& memory) {
  Opening out;
  if (links.touching.empty()) return out;
  const Vector<Vec3> places = posed_places(mesh, posed, memory);
  // The place of the point that a vertex touched.
  const auto touched = [&](const Touch& touch) {
    const Index* const c = mesh.triangle(touch.triangle);
    double share[3];
    squared_to_triangle(mesh.positions[at(touch.vertex)], mesh.positions[at(c[0])], mesh.positions[at(c[1])],
                        mesh.positions[at(c[2])], share);
    return share[0] * places[at(c[0])] + share[1] * places[at(c[1])] + share[2] * places[at(c[2])];
  };
  // How far each left that point. It opens by no more.
  struct Left {
    double by;
    std::size_t touch;
    bool operator<(const Left& o) const noexcept { return by != o.by ? by > o.by : touch < o.touch; }
  };
  Vector<Left> left(&memory);
  for (std::size_t i = 0; i < links.touching.size(); ++i) {
    const Touch& touch = links.touching[i];
    const Vec3 apart = places[at(touch.vertex)] - touched(touch);
    const double by = norm(apart) - touch.length;
    if (by > 0) left.push_back({by, i});
  }
  if (left.empty()) return out;
  std::sort(left.begin(), left.end());
  Vector<Index> piece(&memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) piece.push_back(links.piece[at(mesh.triangle(t)[0])]);
  const BoxTree tree(triangle_boxes(places, mesh.corners, memory), piece, static_cast<Index>(links.light.size()),
                     memory);
  // Returns the distance of a point from a piece, or something below `enough` if it is below that.
  const auto distance = [&](const Vec3& p, Index to, double most, double enough) {
    double nearest = most * most;
    tree.near(
        to, p, [&] { return nearest <= enough * enough ? -1.0 : nearest; },
        [&](Index t) {
          const Index* const c = mesh.triangle(t);
          nearest = std::min(nearest, squared_to_triangle(p, places[at(c[0])], places[at(c[1])], places[at(c[2])]));
        });
    return std::sqrt(nearest);
  };
  double worst = 0;
  for (const Left& one : left) {
    if (one.by <= worst) break;
    const Touch& touch = links.touching[one.touch];
    const double enough = worst + touch.length;
    double apart = distance(places[at(touch.vertex)], piece[at(touch.triangle)], one.by + touch.length, enough);
    if (apart > enough) apart = distance(touched(touch), links.piece[at(touch.vertex)], apart, enough);
    if (apart <= enough) continue;
    worst = apart - touch.length;
    out.vertex = touch.vertex;
  }
  out.worst = mesh.scale * worst;
  return out;
}

}  // namespace hf_inner::mesh
