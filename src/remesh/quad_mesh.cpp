#include "remesh/quad_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/error.h"
#include "remesh/constants.h"

namespace hf_inner {
namespace {

constexpr std::int32_t none = -1;

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

// Returns the sum of the squared cosines of a quad's angles, with a cost for reflex corners. It is 0 for rectangles.
double badness(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p[4] = {a, b, c, d};
  const Vec3 normal = cross(c - a, d - b);
  const double size = norm(normal);
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 x = p[(k + 1) % 4] - p[k], y = p[(k + 3) % 4] - p[k];
    const double lengths = norm(x) * norm(y);
    if (!(lengths > 0)) return degenerate_cost;
    const double cosine = dot(x, y) / lengths;
    sum += cosine * cosine;
    if (size > 0 && dot(cross(x, y), normal) <= 0) sum += reflex_cost;
  }
  return sum;
}

class Splitter {
 public:
  Splitter(const FluxSurface& surface, const QuadMesh& in, QuadMesh& out, Memory& memory)
      : surface_(surface), in_(in), out_(out), edges_(&memory), rest_(memory) {
    for (std::int32_t f = 0; f < in.face_count(); ++f) {
      for (std::int32_t k = 0; k < in.size(f); ++k) edges_.insert(edge_key(at(f, k), at(f, (k + 1) % in.size(f))));
    }
  }

  void split(std::int32_t f, std::int32_t critical) {
    const std::int32_t size = in_.size(f);
    if (critical != none && size >= 6 && size % 2 == 0) return around_centre(f, critical);
    rest_.clear();
    for (std::int32_t k = 0; k < size; ++k) rest_.push_back(at(f, k));
    while (rest_.size() > 4) {
      const std::int32_t n = rest_.size();
      std::int32_t best = none;
      double least = 0;
      for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t a = rest_[i], b = rest_[(i + 1) % n], c = rest_[(i + 2) % n], d = rest_[(i + 3) % n];
        if (edges_.count(edge_key(a, d))) continue;
        double cost = quad_cost(a, b, c, d);
        if (n == 6) cost += quad_cost(d, rest_[(i + 4) % n], rest_[(i + 5) % n], a);
        if (best == none || cost < least) best = i, least = cost;
      }
      if (best == none) break;  // all its diagonals are edges of other faces, so the polygon stays whole
      const std::int32_t a = rest_[best], b = rest_[(best + 1) % n], c = rest_[(best + 2) % n],
                         d = rest_[(best + 3) % n];
      edges_.insert(edge_key(a, d));
      face({a, b, c, d});
      Table<std::int32_t> kept(*static_cast<Memory*>(edges_.get_allocator().resource()));
      for (std::int32_t i = 3; i <= n; ++i) kept.push_back(rest_[(best + i) % n]);
      rest_.swap(kept);
    }
    for (const std::int32_t v : rest_) out_.corner.push_back(v);
    out_.face_start.push_back(out_.corner.size());
  }

 private:
  std::int32_t at(std::int32_t f, std::int32_t k) const { return in_.corner[in_.face_start[f] + k]; }
  double quad_cost(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    return badness(out_.position[a], out_.position[b], out_.position[c], out_.position[d]);
  }
  void face(std::initializer_list<std::int32_t> corners) {
    for (const std::int32_t v : corners) out_.corner.push_back(v);
    out_.face_start.push_back(out_.corner.size());
  }

  void around_centre(std::int32_t f, std::int32_t critical) {
    std::int32_t h = surface_.out[critical];
    while (!surface_.is_real(h)) h = surface_.turn_left(h);
    SurfacePoint point;
    point.triangle = h / 3, point.weight[h % 3] = 1;
    const std::int32_t c = out_.add_vertex(point, surface_.position[critical], QuadMesh::site, false, 1);
    const std::int32_t size = in_.size(f);
    double cost[2] = {0, 0};
    for (std::int32_t first = 0; first < 2; ++first)
      for (std::int32_t k = first; k < size + first; k += 2)
        cost[first] += quad_cost(c, at(f, k % size), at(f, (k + 1) % size), at(f, (k + 2) % size));
    const std::int32_t first = cost[1] < cost[0] ? 1 : 0;
    for (std::int32_t k = first; k < size + first; k += 2)
      face({c, at(f, k % size), at(f, (k + 1) % size), at(f, (k + 2) % size)});
  }

  const FluxSurface& surface_;
  const QuadMesh& in_;
  QuadMesh& out_;
  std::pmr::unordered_set<std::uint64_t> edges_;
  Table<std::int32_t> rest_;
};

}  // namespace

std::int32_t QuadMesh::quad_count() const noexcept {
  std::int32_t count = 0;
  for (std::int32_t f = 0; f < face_count(); ++f) count += size(f) == 4;
  return count;
}

VertexFans::VertexFans(const QuadMesh& mesh, Memory& memory) : start(memory), face(memory) {
  start.assign(mesh.position.size() + 1, 0);
  for (const std::int32_t v : mesh.corner) ++start[v + 1];
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) start[v + 1] += start[v];
  face.assign(mesh.corner.size(), 0);
  Table<std::int32_t> fill = start;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    for (std::int32_t k = mesh.face_start[f]; k < mesh.face_start[f + 1]; ++k) face[fill[mesh.corner[k]]++] = f;
}

void grow_marks(const QuadMesh& mesh, std::int32_t rings, Table<std::uint8_t>& marked) {
  Table<std::uint8_t> before = marked;
  for (std::int32_t ring = 0; ring < rings; ++ring, before = marked)
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t *first = mesh.corner.data() + mesh.face_start[f], *last = first + mesh.size(f);
      if (std::any_of(first, last, [&](std::int32_t v) { return before[v] != 0; }))
        for (const std::int32_t* c = first; c < last; ++c) marked[*c] = 1;
    }
}

Vec3 position_of(const FluxSurface& surface, const SurfacePoint& point) noexcept {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p = p + point.weight[k] * surface.position[surface.tail[3 * point.triangle + k]];
  return p;
}

QuadMesh make_polygons(const FluxField& field, const ArcGraph& graph, const RingMesh& rings,
                       Table<std::int32_t>& centre, Memory& memory) {
  const FluxSurface& surface = field.surface();
  const Table<RingNode>& nodes = rings.nodes;
  QuadMesh out(memory);
  for (std::int32_t n = 0; n < nodes.size(); ++n) {
    const SurfacePoint& at = rings.location[n];
    out.add_vertex(at, position_of(surface, at), QuadMesh::free, rings.rings[nodes[n].ring].border, 1);
  }
  out.face_start.push_back(0);
  auto target = [&](std::int32_t n, std::int32_t way) {
    const RingNode& node = nodes[n];
    return way == 0 ? node.next : way == 1 ? node.up : way == 2 ? node.previous : node.down;
  };
  Table<std::uint8_t> seen(4 * nodes.size(), 0, memory);
  for (std::int32_t start = 0; start < 4 * nodes.size(); ++start) {
    if (seen[start] || target(start / 4, start % 4) == none) continue;
    std::int32_t critical = none;
    bool one_ring = true;
    for (std::int32_t half = start; !seen[half];) {
      seen[half] = 1;
      const std::int32_t n = half / 4, way = half % 4;
      out.corner.push_back(n);
      const std::int32_t r = nodes[n].ring, arc = rings.rings[r].arc;
      if (way == 0 && r + 1 == rings.ring_start[arc + 1]) critical = graph.arcs[arc].upper;
      if (way == 2 && r == rings.ring_start[arc]) critical = graph.arcs[arc].lower;
      one_ring &= way % 2 == 0;
      const std::int32_t to = target(n, way);
      std::int32_t turn = (way + 2 + 3) % 4;
      while (target(to, turn) == none) turn = (turn + 3) % 4;
      half = 4 * to + turn;
    }
    if (one_ring && critical != none && surface.is_apex(critical)) {  // a border of the surface
      while (out.corner.size() > out.face_start.back()) out.corner.pop_back();
      continue;
    }
    out.face_start.push_back(out.corner.size());
    // Polygons with at least 6 corners at a site, or 8 at a saddle, get a centre vertex. Smaller ones are split by
    // diagonals.
    const std::int32_t size = out.size(out.face_count() - 1);
    centre.push_back(critical != none && (one_ring ? size >= 6 : size >= 8) && !surface.is_apex(critical) ? critical
                                                                                                          : none);
  }
  return out;
}

QuadMesh split_polygons(const FluxSurface& surface, const QuadMesh& in, const Table<std::int32_t>& centre,
                        Memory& memory) {
  QuadMesh out(memory);
  out.location = in.location, out.position = in.position, out.pinned = in.pinned, out.border = in.border;
  out.scale = in.scale;
  out.face_start.push_back(0);
  Splitter splitter(surface, in, out, memory);
  Table<std::uint8_t> taken(surface.vertex_count(), 0, memory);
  for (std::int32_t f = 0; f < in.face_count(); ++f) {
    std::int32_t c = centre[f];
    if (c != none && taken[c]) c = none;
    if (c != none) taken[c] = 1;
    splitter.split(f, c);
  }
  return out;
}

void check_quads(const QuadMesh& mesh, std::int32_t euler_characteristic, Memory& memory) {
  // Half-edges are listed at the lower end of their edge. There a stamp on the other end says which were seen.
  const std::int32_t vertices = mesh.position.size();
  const auto each = [&](auto&& visit) {
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      const std::int32_t size = mesh.size(f), *c = mesh.corner.data() + mesh.face_start[f];
      for (std::int32_t k = 0; k < size; ++k) visit(c[k], c[(k + 1) % size]);
    }
  };
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t *c = mesh.corner.data() + mesh.face_start[f], *last = c + mesh.size(f);
    for (const std::int32_t* v = c; v != last; ++v) {
      if (std::find(c, v, *v) != v)
        fail(HF_ERROR_INTERNAL, static_cast<std::uint32_t>(*v), "face %d has vertex %d twice", f, *v);
    }
  }
  Table<std::int32_t> start(vertices + 1, 0, memory);
  each([&](std::int32_t a, std::int32_t b) { ++start[std::min(a, b) + 1]; });
  for (std::int32_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  Table<std::int32_t> end = start, other(start[vertices], 0, memory);  // ~ for a half-edge that ends at the lower end
  each([&](std::int32_t a, std::int32_t b) { other[end[std::min(a, b)]++] = a < b ? b : ~a; });
  Table<std::int32_t> away(vertices, none, memory), back(vertices, none, memory);
  std::int64_t edges = 0;
  for (std::int32_t v = 0; v < vertices; ++v) {
    for (std::int32_t i = start[v]; i < start[v + 1]; ++i) {
      const bool comes = other[i] < 0;
      const std::int32_t w = comes ? ~other[i] : other[i];
      edges += away[w] != v && back[w] != v;
      std::int32_t& stamp = (comes ? back : away)[w];
      if (stamp == v)
        fail(HF_ERROR_INTERNAL, static_cast<std::uint32_t>(comes ? w : v), "edge %d -> %d is in two faces",
             comes ? w : v, comes ? v : w);
      stamp = v;
    }
  }
  const std::int64_t found = std::int64_t{mesh.position.size()} - edges + mesh.face_count();
  if (found != euler_characteristic)
    fail(HF_ERROR_INTERNAL, HF_NO_INDEX,
         "the polygons have Euler characteristic %lld, the surface %d: a face is no disc",
         static_cast<long long>(found), euler_characteristic);
}

}  // namespace hf_inner
