#include "quads/symmetric.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "quads/numbers.h"
#include "quads/other_core.h"

namespace hf_inner::quads {
namespace {

// A vertex nearer to the plane than this share of its shortest edge is moved onto it. More moves more of the surface,
// less leaves thinner triangles at the cut.
// The value 0.02 does not change spot and a human. 0.1 changes the human's largest distance from 1.1 to 1.0 % of the
// box. Koala has 0.6 instead of 1.1 % with either, as rounding decides whole lines.
constexpr double snapped_share = 0.05;
// A surface whose mirror image is farther away than this share of the box is not symmetric: the plane is a mistake. A
// pose that is a little off, as of a scan, gets the shape of one side. Spot is 0.016 off.
constexpr double most_off = 0.05;
// A vertex of the quads at a border, no farther from the plane than this, lies on it. Borders keep their places to
// rounding.
constexpr double plane_tolerance = 1e-9;
// A new vertex of a row along the plane starts at this share of the way to the middle of its quad, and as far along the
// normal as the quad is large. It is then put on the surface. They need only be off the plane and apart. Boxes of three
// thicknesses with 20 to 1,000 quads are valid with it; no other value was tried.
constexpr double row_share = 0.35;
// A piece of less than so many quads is not trimmed: little would be left of it. A tongue of a larger piece goes, as a
// row along its whole cut would make narrow quads there.
constexpr Index small_piece = 24;
// Reported progress: the ends of the parts of the whole, not measured.
constexpr float compared = 0.02f, cut = 0.1f, made = 0.98f;

void check_symmetry(const surface::Core& core, const mesh::NearestTriangle& nearest, const mesh::MirrorPlane& plane) {
  Poller poller(64);
  Index worst = mesh::Mesh::none;
  double distance = most_off * most_off;
  for (Index v = 0; v < core.size(); ++v) {
    poller.due();
    const double squared = nearest.find(plane.reflect(core.mesh.positions[at(v)]), mesh::Mesh::none, distance).squared;
    if (squared > distance) {
      distance = squared;
      worst = v;
    }
  }
  if (worst == mesh::Mesh::none) return;
  const std::uint32_t given = static_cast<std::uint32_t>(core.mesh.given_of_inner[at(worst)]);
  fail(HF_ERROR_UNSUPPORTED, given,
       "the surface is not symmetric in symmetry_plane: the mirror image of vertex %u is %g away from it; %g is "
       "allowed",
       given, std::sqrt(distance) * core.mesh.scale, most_off * core.mesh.scale);
}

// Adds the mirror image, and finds all vertices on the surface. Two quads that share two edges, around a vertex on the
// plane, become one.
void add_image(const mesh::NearestTriangle& nearest, const mesh::MirrorPlane& plane,
               const remesh::Table<std::uint8_t>& on_plane, remesh::QuadMesh& mesh, Memory& memory) {
  const Index vertices = mesh.position.size(), faces = mesh.face_count();
  remesh::Table<std::int32_t> valence(vertices, 0, memory);
  for (const std::int32_t v : mesh.corner) ++valence[v];
  remesh::QuadMesh out(memory);
  remesh::Table<Index> number(vertices, none, memory), image(vertices, none, memory);
  remesh::Table<std::uint8_t> inside(vertices, 0, memory);  // by vertex: of two quads that become one
  for (Index i = 0; i < mesh.corner.size(); ++i) {
    const Index v = mesh.corner[i], before = mesh.corner[i % 4 == 0 ? i + 3 : i - 1],
                next = mesh.corner[i % 4 == 3 ? i - 3 : i + 1];
    inside[v] = valence[v] == 1 && on_plane[before] && on_plane[v] && on_plane[next];
  }
  Index hint = mesh::Mesh::none;
  Poller poller(64);
  const auto add_vertex = [&](Index v, Vec3 p) {
    poller.due();
    remesh::SurfacePoint point;
    point.triangle = hint = nearest.find(p, hint).triangle;
    nearest.weights(p, point.triangle, point.weight);
    return out.add_vertex(point, p, mesh.pinned[v], mesh.border[v] && !on_plane[v], mesh.scale[v]);
  };
  for (Index v = 0; v < vertices; ++v) {
    if (inside[v] || valence[v] == 0) continue;
    const Vec3 p = mesh.position[v];
    number[v] = image[v] = add_vertex(v, on_plane[v] ? p - plane.side(p) * plane.normal : p);
  }
  for (Index v = 0; v < vertices; ++v) {
    if (!on_plane[v] && valence[v] > 0) image[v] = add_vertex(v, plane.reflect(mesh.position[v]));
  }
  const auto add = [&](Index a, Index b, Index c, Index d) {
    for (const Index v : {a, b, c, d}) out.corner.push_back(v);
  };
  for (Index f = 0; f < faces; ++f) {
    const Index* c = &mesh.corner[4 * f];
    int own = none;
    for (int k = 0; k < 4; ++k) {
      if (inside[c[k]]) own = k;
    }
    if (own >= 0) {
      const Index a = c[(own + 1) % 4], b = c[(own + 2) % 4], d = c[(own + 3) % 4];
      add(number[a], number[b], number[d], image[b]);
    } else {
      add(number[c[0]], number[c[1]], number[c[2]], number[c[3]]);
      add(image[c[0]], image[c[3]], image[c[2]], image[c[1]]);
    }
  }
  mesh = std::move(out);
}

}  // namespace

HalfSurface HalfSurface::make(const surface::Core& core, const mesh::MirrorPlane& plane) {
  Memory& memory = *core.memory;
  const mesh::Mesh& mesh = core.mesh;
  const mesh::Topology& topology = core.topology();
  HalfSurface out(memory);
  Vector<double> height(&memory), shortest(at(core.size()), HUGE_VAL, &memory);
  for (const Vec3& p : mesh.positions) height.push_back(plane.side(p));
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const std::size_t a = at(topology.first(e)), b = at(topology.second(e));
    const double length = norm(mesh.positions[b] - mesh.positions[a]);
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  out.of_vertex.assign(at(core.size()), mesh::Mesh::none);
  out.of_edge.assign(at(topology.edge_count()), mesh::Mesh::none);
  for (std::size_t v = 0; v < height.size(); ++v) {
    if (std::fabs(height[v]) < snapped_share * shortest[v]) height[v] = 0;
  }
  const auto add = [&](Vec3 p, bool at_plane) {
    out.position.push_back(at_plane ? p - plane.side(p) * plane.normal : p);
    return static_cast<Index>(out.position.size()) - 1;
  };
  Poller poller;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    poller.due();
    const std::int32_t* c = mesh.triangle(t);
    if (std::none_of(c, c + 3, [&](Index v) { return height[at(v)] > 0; })) continue;
    Index corner[4];
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = c[k], w = c[(k + 1) % 3];
      const double a = height[at(v)], b = height[at(w)];
      if (a >= 0) {
        Index& half = out.of_vertex[at(v)];
        if (half == mesh::Mesh::none) half = add(mesh.positions[at(v)], a == 0);
        corner[count++] = half;
      }
      if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
        const double share = a / (a - b);
        Index& half = out.of_edge[at(topology.edge_between(v, w))];
        if (half == mesh::Mesh::none)
          half = add((1 - share) * mesh.positions[at(v)] + share * mesh.positions[at(w)], true);
        corner[count++] = half;
      }
    }
    // The shorter of the two diagonals cuts four corners.
    const auto between = [&](std::size_t i, std::size_t j) {
      return norm(out.position[at(corner[j])] - out.position[at(corner[i])]);
    };
    const std::size_t first = count == 4 && between(1, 3) < between(0, 2) ? 1 : 0;
    for (std::size_t i = 1; i + 1 < count; ++i) {
      for (const std::size_t k : {first, (first + i) % count, (first + i + 1) % count}) out.corner.push_back(corner[k]);
    }
  }
  return out;
}

Vec3 PlaceOnSurface::operator()(Vec3 p) const noexcept {
  const Index t = nearest.find(p).triangle;
  double weight[3];
  nearest.weights(p, t, weight);
  Vec3 out;
  for (int k = 0; k < 3; ++k) out = out + weight[k] * core.mesh.positions[at(core.mesh.triangle(t)[k])];
  return out;
}

namespace {

// The sides of quads with both ends on the plane.
struct PlaneSides {
  PlaneSides(const remesh::QuadMesh& mesh, const remesh::Table<std::uint8_t>& on_plane, Memory& memory)
      : at_border(memory), inner(memory) {
    const auto key = [&](Index i) {
      const Index a = mesh.corner[i], b = mesh.corner[i % 4 == 3 ? i - 3 : i + 1];
      if (!on_plane[a] || !on_plane[b]) return std::uint64_t{0};  // no edge: its ends differ
      return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
    };
    Vector<std::uint64_t> keys(&memory);
    for (Index i = 0; i < mesh.corner.size(); ++i) keys.push_back(key(i));
    std::sort(keys.begin(), keys.end());
    for (Index i = 0; i < mesh.corner.size(); ++i) {
      const std::uint64_t own = key(i);
      const auto found = std::lower_bound(keys.begin(), keys.end(), own);
      if (own) (found + 1 != keys.end() && found[1] == own ? inner : at_border).push_back(i);
    }
  }
  remesh::Table<Index> at_border, inner;  // the corners where they begin
};

// By quad: a number that quads of one piece share.
remesh::Table<Index> pieces_of(const remesh::QuadMesh& mesh, Memory& memory) {
  remesh::Table<Index> parent(mesh.position.size(), none, memory), out(memory);
  for (Index v = 0; v < parent.size(); ++v) parent[v] = v;
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (Index i = 0; i < mesh.corner.size(); ++i) parent[root(mesh.corner[i])] = root(mesh.corner[i / 4 * 4]);
  for (Index f = 0; f < mesh.face_count(); ++f) out.push_back(root(mesh.corner[4 * f]));
  return out;
}

// Moves the quads of the marked pieces off the plane, and puts a row of quads between.
void add_rows(remesh::QuadMesh& mesh, const remesh::Table<Index>& sides, remesh::Table<std::uint8_t>& on_plane,
              const remesh::Table<Index>& piece, const remesh::Table<std::uint8_t>& marked,
              const mesh::MirrorPlane& plane, const PlaceOnSurface& place, Memory& memory) {
  remesh::Table<Index> copy(mesh.position.size(), none, memory);
  const Index old = mesh.corner.size();
  for (const Index i : sides) {
    if (!marked[piece[i / 4]]) continue;
    const Index* c = &mesh.corner[i / 4 * 4];
    Vec3 middle;
    for (int k = 0; k < 4; ++k) middle = middle + 0.25 * mesh.position[c[k]];
    const Index ends[2] = {mesh.corner[i], mesh.corner[i % 4 == 3 ? i - 3 : i + 1]};
    for (const Index v : ends) {
      if (copy[v] != none) continue;
      const Vec3 way = middle - mesh.position[v];
      const Vec3 p = place(mesh.position[v] + row_share * way + norm(way) * plane.normal);
      copy[v] = mesh.add_vertex(mesh.location[v], p, remesh::QuadMesh::free, false, mesh.scale[v]);
      on_plane.push_back(0);
    }
    for (const Index v : {ends[0], ends[1], copy[ends[1]], copy[ends[0]]}) mesh.corner.push_back(v);
  }
  for (Index i = 0; i < old; ++i) {
    Index& v = mesh.corner[i];
    if (marked[piece[i / 4]] && copy[v] != none) v = copy[v];
  }
}

}  // namespace

void prepare_at_plane(remesh::QuadMesh& mesh, remesh::Table<std::uint8_t>& on_plane, const mesh::MirrorPlane& plane,
                      const PlaceOnSurface& place, std::int32_t& sides_on_plane, Memory& memory) {
  remesh::Table<Index> piece = pieces_of(mesh, memory);
  // By piece: its quads, and whether it gets a row.
  remesh::Table<Index> size(mesh.position.size(), 0, memory);
  remesh::Table<std::uint8_t> marked(mesh.position.size(), 0, memory);
  for (const Index number : piece) ++size[number];
  while (true) {
    const PlaneSides sides(mesh, on_plane, memory);
    for (const Index i : sides.inner) marked[piece[i / 4]] |= size[piece[i / 4]] < small_piece;
    remesh::Table<std::uint8_t> count(mesh.face_count(), 0, memory);
    for (const Index i : sides.at_border) ++count[i / 4];
    Index kept = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      marked[piece[f]] |= count[f] == 4;
      if (count[f] == 3 && !marked[piece[f]]) continue;
      std::copy(&mesh.corner[4 * f], &mesh.corner[4 * f] + 4, &mesh.corner[4 * kept]);
      piece[kept++] = piece[f];
    }
    if (kept == mesh.face_count()) {
      for (const Index i : sides.inner) marked[piece[i / 4]] = 1;
      sides_on_plane = sides.at_border.size();
      add_rows(mesh, sides.at_border, on_plane, piece, marked, plane, place, memory);
      return;
    }
    piece.resize(kept, none);
    mesh.corner.resize(4 * kept, none);
  }
}

HalfBase::HalfBase(const surface::Core& whole, const mesh::MirrorPlane& given)
    : plane(given), nearest(whole.mesh.positions, whole.mesh.corners, *whole.memory), half(*whole.memory) {
  {
    const ProgressRange part(0.0f, compared);
    check_symmetry(whole, nearest, plane);
  }
  const ProgressRange part(compared, cut);
  half = HalfSurface::make(whole, plane);
  if (half.corner.empty())
    fail(
        HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
        "no triangle lies on the side of symmetry_plane that its normal points to; turn the signs of all four numbers");
  core = core_like(whole, half.position, half.corner);
}

QuadResult make_symmetric_quads(const FieldQuadOptions& options, FieldQuadReport* report, QuadKeeper* kept) {
  const surface::Core& whole = *options.core;
  Memory& memory = *whole.memory;
  const mesh::MirrorPlane& plane = *options.plane;
  const double area = area_of(whole);
  const double length = options.faces > 0 ? std::sqrt(area / options.faces) : options.edge_length;
  check_expected(options, area);
  // One that fails stays unmade.
  std::shared_ptr<HalfBase> base = kept ? kept->half : nullptr;
  const auto same = [&](const mesh::MirrorPlane& other) {
    return norm(other.normal - plane.normal) == 0 && other.offset == plane.offset;
  };
  if (!base || !same(base->plane)) {
    if (kept) kept->half.reset();
    base = make_owner_in<HalfBase>(whole.memory, whole, plane);
    if (kept) kept->half = base;
  }
  const mesh::NearestTriangle& nearest = base->nearest;
  const HalfSurface& half = base->half;
  const mesh::Mesh& mesh = base->core->mesh;
  OtherOptions own(options, base->core, length);
  for (const QuadGuide& guide : options.guides) {
    const Index v = half.of_vertex[at(guide.vertex)];
    if (v != mesh::Mesh::none) own.add_guide(guide, v);
  }
  for (const Index e : options.crease_edges) {
    Index ends[2] = {half.of_vertex[at(whole.topology().first(e))], half.of_vertex[at(whole.topology().second(e))]};
    for (Index& end : ends) {
      if (end == mesh::Mesh::none) end = half.of_edge[at(e)];
    }
    if (ends[0] != mesh::Mesh::none && ends[1] != mesh::Mesh::none && ends[0] != ends[1])
      own.add_crease(ends[0], ends[1]);
  }
  for (const QuadPole& pole : options.poles) {
    if (plane.side(pole.place) >= 0) own.add_pole(pole);
  }
  FieldQuadOptions half_options = own.get();
  if (options.faces > 0) half_options.faces = std::max(1, (options.faces + 1) / 2);
  FieldQuadReport found;
  QuadResult result = [&] {
    const ProgressRange part(cut, made);
    return make_field_quads(half_options, &found, kept ? &base->kept : nullptr);
  }();
  remesh::Table<std::uint8_t> on_plane(memory);
  for (Index v = 0; v < result.mesh.position.size(); ++v) {
    Vec3& p = result.mesh.position[v];
    p = mesh.to_given(p);
    on_plane.push_back(result.mesh.border[v] && std::fabs(plane.side(p)) < plane_tolerance);
  }
  std::int32_t sides = 0;
  prepare_at_plane(result.mesh, on_plane, plane, PlaceOnSurface{whole, nearest}, sides, memory);
  // Vertices on the plane count once. Preparing keeps the Euler characteristic of the half.
  remesh::Table<std::uint8_t> shared(on_plane.size(), 0, memory);
  std::int32_t corners = 0;
  for (const Index v : result.mesh.corner) {
    corners += on_plane[v] && !shared[v];
    shared[v] = 1;
  }
  result.euler_characteristic = 2 * result.euler_characteristic - corners + sides;
  add_image(nearest, plane, on_plane, result.mesh, memory);
  remesh::check_quads(result.mesh, result.euler_characteristic, memory);
  found.edge_length *= mesh.scale;
  if (report) *report = found;
  hf_inner::report(1.0f);
  return result;
}

}  // namespace hf_inner::quads
