#include "field/connection.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "field/vector_field.h"

namespace hf_inner::field {
namespace {

constexpr double pi = 3.141592653589793238462643383279502884;
// If the angles of a fan (radians), or a sum of unit directions, are smaller than these limits, they are mere rounding
// and give no direction. Larger limits would make more vertices irregular (without a single fan of triangles). Half and
// double change no bit of crosses on seven shapes.
constexpr double least_angle = 1e-9, least_sum = 1e-9;
// If 1 + cosine of two normals is below this number, they count as opposite. No smallest rotation exists between them.
// More would take folds for half turns. Half and double change no bit of crosses on seven shapes.
constexpr double opposite = 1e-12;

double wrapped(double angle) noexcept {
  const double turns = std::nearbyint(angle / (2 * pi));
  const double rest = angle - turns * 2 * pi;
  return rest > -pi ? rest : rest + 2 * pi;
}

double corner_angle(const mesh::Mesh& mesh, Index v, Index a, Index b) noexcept {
  const Vec3 p = mesh.positions[at(a)] - mesh.positions[at(v)], q = mesh.positions[at(b)] - mesh.positions[at(v)];
  return arc_tangent(norm(cross(p, q)), dot(p, q));
}

// A triangle at a vertex. Counter-clockwise, it lies between the neighbours `first` and `second`.
struct Corner {
  Index first, second;
  double angle;
};

// Describes the triangles around a vertex: whether they form one fan, whether it is closed, and the scale of its
// angles.
struct Fan {
  bool regular = false, closed = false;
  double scale = 1;
};

class FanMaker {
 public:
  FanMaker(const mesh::Mesh& mesh, const mesh::Topology& topology, Memory& memory)
      : mesh_(mesh),
        topology_(topology),
        start_(mesh.positions.size() + 1, 0, &memory),
        triangle_(mesh.corners.size(), &memory),
        corners_(&memory) {
    for (const Index v : mesh.corners) ++start_[at(v) + 1];
    for (std::size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
    Vector<Index> cursor(start_.begin(), start_.end() - 1, &memory);
    for (std::size_t c = 0; c < mesh.corners.size(); ++c)
      triangle_[at(cursor[at(mesh.corners[c])]++)] = static_cast<Index>(c / 3);
  }

  // Computes the angle of the edge to each neighbour of v and writes it to `angles`.
  Fan make(Index v, double* angles) {
    corners_.clear();
    for (Index i = start_[at(v)]; i < start_[at(v) + 1]; ++i) {
      const Index* t = mesh_.triangle(triangle_[at(i)]);
      const Index k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      corners_.push_back({t[(k + 1) % 3], t[(k + 2) % 3], corner_angle(mesh_, v, t[(k + 1) % 3], t[(k + 2) % 3])});
    }
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) { return a.first < b.first; });
    Fan fan;
    const auto repeated = [](const Corner& a, const Corner& b) { return a.first == b.first; };
    if (std::adjacent_find(corners_.begin(), corners_.end(), repeated) != corners_.end()) return fan;
    // A vertex on a border has an open fan of triangles. It starts at the neighbour where, counter-clockwise, no
    // triangle ends. Two such neighbours mean that there are two fans.
    const std::size_t neighbours = at(topology_.neighbour_start[at(v) + 1] - topology_.neighbour_start[at(v)]);
    if (neighbours != corners_.size() && neighbours != corners_.size() + 1) return fan;
    fan.closed = neighbours == corners_.size();
    Index here = corners_[0].first;
    if (!fan.closed) {
      ends_.assign(corners_.begin(), corners_.end());
      std::sort(ends_.begin(), ends_.end(), [](const Corner& a, const Corner& b) { return a.second < b.second; });
      for (const Corner& c : corners_) {
        const auto found = std::lower_bound(ends_.begin(), ends_.end(), c.first,
                                            [](const Corner& a, Index w) { return a.second < w; });
        if (found == ends_.end() || found->second != c.first) here = c.first;
      }
    }
    const Index start = here;
    double angle = 0;
    for (std::size_t steps = 0; steps < corners_.size(); ++steps) {
      const auto corner = std::lower_bound(corners_.begin(), corners_.end(), here,
                                           [](const Corner& a, Index w) { return a.first < w; });
      if (corner == corners_.end() || corner->first != here || (steps > 0 && here == start)) return fan;
      angles[place_of(v, here)] = angle;
      angle += corner->angle;
      here = corner->second;
    }
    if (fan.closed != (here == start) || !(angle > least_angle)) return fan;
    if (!fan.closed) angles[place_of(v, here)] = angle;
    fan.scale = fan.closed ? 2 * pi / angle : 1.0;
    for (std::size_t i = 0; i < neighbours; ++i) angles[i] *= fan.scale;
    fan.regular = true;
    return fan;
  }

 private:
  std::size_t place_of(Index v, Index neighbour) const noexcept {
    const auto begin = topology_.neighbour.begin() + topology_.neighbour_start[at(v)],
               end = topology_.neighbour.begin() + topology_.neighbour_start[at(v) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, neighbour) - begin);
  }
  const mesh::Mesh& mesh_;
  const mesh::Topology& topology_;
  Vector<Index> start_, triangle_;
  Vector<Corner> corners_, ends_{corners_.get_allocator()};
};

// Computes an orthonormal frame x, y of the plane with normal n.
void plane_of(Vec3 n, Vec3& x, Vec3& y) noexcept {
  const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
  const Vec3 least = ax <= ay && ax <= az ? Vec3{1, 0, 0} : ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  x = cross(least, n);
  x = (1 / norm(x)) * x;
  y = cross(n, x);
}

// Turns the vertex's frame in its tangent plane, so that the angles of the edges fit the projected edges best.
void fit_frame(const mesh::Mesh& mesh, const mesh::Topology& topology, Index v, const double* angles, Connection& out) {
  Vec3 &x = out.x[at(v)], &y = out.y[at(v)];
  std::complex<double> sum = 0;
  for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
    const Vec3 edge = mesh.positions[at(topology.neighbour[at(i)])] - mesh.positions[at(v)];
    const std::complex<double> seen(dot(edge, x), dot(edge, y));
    const double length = length_of(seen);
    if (length > 0) sum += seen / length * at_angle(1.0, -angles[i - topology.neighbour_start[at(v)]]);
  }
  if (!(length_of(sum) > least_sum)) return;
  sum /= length_of(sum);
  const Vec3 turned = sum.real() * x + sum.imag() * y;
  y = sum.real() * y - sum.imag() * x;
  x = turned;
}

}  // namespace

void check_angle(std::uint32_t position, double angle) {
  if (!std::isfinite(angle))
    fail(HF_ERROR_NON_FINITE, position, "entry %u of the list: the angle is not a finite number", position);
}

Vec3 carry(Vec3 vector, Vec3 from, Vec3 to) noexcept {
  const double cosine = dot(from, to);
  if (cosine < -1 + opposite) return -1.0 * vector;  // opposite planes: any half turn about a tangent axis
  const Vec3 axis = cross(from, to);
  return cosine * vector + cross(axis, vector) + (dot(axis, vector) / (1 + cosine)) * axis;
}

Connection Connection::make(const mesh::Mesh& mesh, const mesh::Topology& topology, Memory& memory) {
  Connection out(memory);
  const std::size_t n = mesh.positions.size();
  out.normal = vertex_normals(mesh, memory);
  out.x.resize(n);
  out.y.resize(n);
  out.regular.assign(n, 0);
  out.closed.assign(at(mesh.component_count()), 1);
  Vector<double> angle(topology.neighbour.size(), 0.0, &memory), scale(n, 1.0, &memory);
  FanMaker fans(mesh, topology, memory);
  Poller poller;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    poller.due();
    Vec3& normal = out.normal[at(v)];
    const double length = norm(normal);
    normal = length > 0 ? (1 / length) * normal : Vec3{0, 0, 1};
    plane_of(normal, out.x[at(v)], out.y[at(v)]);
    double* angles = angle.data() + topology.neighbour_start[at(v)];
    const Fan fan = length > 0 ? fans.make(v, angles) : Fan{};
    out.regular[at(v)] = fan.regular;
    out.irregular_count += !fan.regular;
    scale[at(v)] = fan.scale;
    if (!fan.regular || !fan.closed) out.closed[at(mesh.component[at(v)])] = 0;
    if (fan.regular) fit_frame(mesh, topology, v, angles, out);
  }

  out.rotation.resize(at(topology.edge_count()));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    poller.due();
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const Index w = topology.neighbour[at(i)], e = topology.neighbour_edge[at(i)];
      if (w < v) continue;  // v is the edge's first vertex
      if (out.regular[at(v)] && out.regular[at(w)]) {
        const auto begin = topology.neighbour.begin() + topology.neighbour_start[at(w)],
                   end = topology.neighbour.begin() + topology.neighbour_start[at(w) + 1];
        const double back =
            angle[static_cast<std::size_t>(std::lower_bound(begin, end, v) - topology.neighbour.begin())];
        out.rotation[at(e)] = wrapped(back + pi - angle[at(i)]);
      } else {
        out.rotation[at(e)] = angle_of(out.to_frame(w, carry(out.x[at(v)], out.normal[at(v)], out.normal[at(w)])));
      }
    }
  }

  // Returns the edge between two vertices. The curvature of triangles with irregular corners needs it.
  const auto edge_between = [&](Index v, Index w) {
    const auto begin = topology.neighbour.begin() + topology.neighbour_start[at(v)],
               end = topology.neighbour.begin() + topology.neighbour_start[at(v) + 1];
    return topology
        .neighbour_edge[static_cast<std::size_t>(std::lower_bound(begin, end, w) - topology.neighbour.begin())];
  };
  out.curvature.resize(at(mesh.triangle_count()));
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    poller.due();
    const Index* v = mesh.triangle(t);
    double sum = 0;
    if (out.regular[at(v[0])] && out.regular[at(v[1])] && out.regular[at(v[2])]) {
      for (int k = 0; k < 3; ++k) sum += scale[at(v[k])] * corner_angle(mesh, v[k], v[(k + 1) % 3], v[(k + 2) % 3]);
      out.curvature[at(t)] = sum - pi;
    } else {
      for (int k = 0; k < 3; ++k) {
        const Index from = v[k], to = v[(k + 1) % 3];
        sum += out.turn(topology, edge_between(from, to), to);
      }
      out.curvature[at(t)] = wrapped(sum);
    }
  }
  return out;
}

Vector<Index> edge_path(const mesh::Mesh& mesh, const mesh::Topology& topology, Index from, Index to, Memory& memory) {
  Vector<Index> path(&memory);
  if (from == to) return path;
  struct Reached {
    double distance;
    Index vertex, edge;
    bool operator<(const Reached& o) const noexcept {  // the nearest first in the heap
      return distance != o.distance ? distance > o.distance : vertex != o.vertex ? vertex > o.vertex : edge > o.edge;
    }
  };
  Vector<Index> by(mesh.positions.size(), mesh::Mesh::none, &memory);
  Vector<std::uint8_t> done(mesh.positions.size(), 0, &memory);
  Vector<Reached> heap(1, Reached{0, from, mesh::Mesh::none}, &memory);
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const Reached here = heap.back();
    heap.pop_back();
    if (done[at(here.vertex)]) continue;
    done[at(here.vertex)] = 1;
    by[at(here.vertex)] = here.edge;
    if (here.vertex == to) break;
    for (Index i = topology.neighbour_start[at(here.vertex)]; i < topology.neighbour_start[at(here.vertex) + 1]; ++i) {
      const Index w = topology.neighbour[at(i)];
      if (done[at(w)]) continue;
      heap.push_back({here.distance + norm(mesh.positions[at(w)] - mesh.positions[at(here.vertex)]), w,
                      topology.neighbour_edge[at(i)]});
      std::push_heap(heap.begin(), heap.end());
    }
  }
  for (Index v = to; v != from;) {
    const Index e = by[at(v)];
    path.push_back(e);
    v = topology.first(e) == v ? topology.second(e) : topology.first(e);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace hf_inner::field
