#include "remesh/relax.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/hypotenuse.h"
#include "remesh/constants.h"

namespace hf_inner::remesh {
namespace {

Vec3 triangle_normal(const FluxSurface& s, std::int32_t t) {
  return unit(cross(s.position[s.tail[3 * t + 1]] - s.position[s.tail[3 * t]],
                    s.position[s.tail[3 * t + 2]] - s.position[s.tail[3 * t]]));
}

// Proposes the corners of the best square for one quad. outward: the sum of the surface's normals at the quad's
// corners. A quad that is turned over against `outward` is turned back.
void propose(const QuadMesh& mesh, const std::int32_t* c, double edge_length, Vec3 outward, Vec3* out) {
  const Vec3 p[4] = {mesh.position[c[0]], mesh.position[c[1]], mesh.position[c[2]], mesh.position[c[3]]};
  const Vec3 middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  Vec3 normal = unit(cross(p[2] - p[0], p[3] - p[1]));
  if (dot(normal, outward) < 0) normal = -1.0 * normal;
  Vec3 x = p[0] - middle;
  x = unit(x - dot(x, normal) * normal);
  const Vec3 y = cross(normal, x);
  std::complex<double> r = 0;
  const std::complex<double> i(0, 1);
  std::complex<double> turn = 1;
  for (int k = 0; k < 4; ++k, turn *= -i) {
    const Vec3 q = p[k] - middle;
    r += 0.25 * std::complex<double>(dot(q, x), dot(q, y)) * turn;
  }
  const double size = hypotenuse(r.real(), r.imag());
  if (size > 0) r *= (1 - size_step) + size_step * (edge_length / std::sqrt(2.0)) / size;
  turn = 1;
  for (int k = 0; k < 4; ++k, turn *= i) {
    const std::complex<double> z = r * turn;
    out[k] = middle + z.real() * x + z.imag() * y;
  }
}

}  // namespace

SurfacePoint walk_surface(const FluxSurface& s, SurfacePoint at, Vec3 way) noexcept {
  double rest = norm(way);
  Vec3 direction = way;
  for (int step = 0; step < most_crossings && rest > 0; ++step) {
    const std::int32_t t = at.triangle;
    const Vec3 a = s.position[s.tail[3 * t]], b = s.position[s.tail[3 * t + 1]], c = s.position[s.tail[3 * t + 2]];
    const Vec3 n = cross(b - a, c - a);
    const double nn = dot(n, n);
    if (!(nn > 0)) return at;
    if (step == 0) {
      direction = direction - (dot(direction, n) / nn) * n;
      rest = norm(direction);
      if (!(rest > 0)) return at;
      direction = (1 / rest) * direction;
    }
    // How much the barycentric weights in the triangle change per unit of length along the walk.
    double rate[3];
    rate[0] = dot(cross(c - b, direction), n) / nn;
    rate[1] = dot(cross(a - c, direction), n) / nn;
    rate[2] = dot(cross(b - a, direction), n) / nn;
    double length = rest;
    int leaves = -1;
    for (int k = 0; k < 3; ++k) {
      if (rate[k] >= 0) continue;
      const double d = at.weight[k] / -rate[k];
      if (d < length) {
        length = d;
        leaves = k;
      }
    }
    for (int k = 0; k < 3; ++k) at.weight[k] = std::max(0.0, at.weight[k] + length * rate[k]);
    const double sum = at.weight[0] + at.weight[1] + at.weight[2];
    for (double& w : at.weight) w /= sum;
    rest -= length;
    if (leaves < 0) return at;
    // The walk along the surface crosses the edge opposite corner `leaves`.
    const std::int32_t h = 3 * t + (leaves + 1) % 3, twin = s.twin[h];
    if (!s.is_real(twin)) return at;  // a border
    at.weight[leaves] = 0;
    SurfacePoint beyond;
    beyond.triangle = twin / 3;
    beyond.weight[twin % 3] = at.weight[(leaves + 2) % 3];  // the twin's tail is the head of h
    beyond.weight[(twin % 3 + 1) % 3] = at.weight[(leaves + 1) % 3];
    const Vec3 edge = unit(s.position[s.head(h)] - s.position[s.tail[h]]);
    const Vec3 m = triangle_normal(s, beyond.triangle), own = unit(n);
    const double along = dot(direction, edge), across = dot(direction, cross(edge, own));
    const Vec3 turned = along * edge + across * cross(edge, m);
    at = beyond;
    direction = unit(turned);
  }
  return at;
}

void relax_quads(const FluxSurface& s, QuadMesh& mesh, const RelaxOptions& options, Memory& memory) {
  const std::int32_t n = mesh.position.size();
  Table<Vec3> sum(n, Vec3{}, memory), centres(n, Vec3{}, memory), old_position(memory);
  Table<SurfacePoint> old_location(memory);
  Table<double> count(n, 0.0, memory);
  Table<std::uint8_t> was_over(mesh.corner.size(), 0, memory), back(n, 0, memory), tangled(n, 0, memory);
  // Tells whether corner k of face f is turned over against the normal of the surface there.
  auto over = [&](std::int32_t f, std::int32_t k) {
    const std::int32_t* c = mesh.quad(f);
    const Vec3 p = mesh.position[c[k]], x = mesh.position[c[(k + 1) % 4]] - p, y = mesh.position[c[(k + 3) % 4]] - p;
    return dot(cross(x, y), triangle_normal(s, mesh.location[c[k]].triangle)) <= 0;
  };
  // The vertices that may move, and the faces around them.
  Table<std::int32_t> vertices(memory), faces(memory);
  for (std::int32_t v = 0; v < n; ++v)
    if (!options.moving || (*options.moving)[v]) vertices.push_back(v);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* c = mesh.quad(f);
    if (!options.moving || std::any_of(c, c + 4, [&](std::int32_t v) { return (*options.moving)[v] != 0; }))
      faces.push_back(f);
  }
  old_position = mesh.position;
  old_location = mesh.location;
  for (std::int32_t round = 0; round < options.rounds; ++round) {
    for (const std::int32_t v : vertices) {
      sum[v] = centres[v] = Vec3{};
      count[v] = 0;
      tangled[v] = 0;
    }
    for (const std::int32_t f : faces) {
      const std::int32_t* c = mesh.quad(f);
      for (std::int32_t k = 0; k < 4; ++k) was_over[4 * f + k] = over(f, k);
      Vec3 proposal[4];
      double scale = 0;
      Vec3 outward;
      for (int k = 0; k < 4; ++k) {
        scale += 0.25 * static_cast<double>(mesh.scale[c[k]]);
        outward = outward + triangle_normal(s, mesh.location[c[k]].triangle);
      }
      propose(mesh, c, options.edge_length * scale, outward, proposal);
      const Vec3 centre = 0.25 * (proposal[0] + proposal[1] + proposal[2] + proposal[3]);
      for (int k = 0; k < 4; ++k) {
        sum[c[k]] = sum[c[k]] + proposal[k];
        centres[c[k]] = centres[c[k]] + centre;
        count[c[k]] += 1;
        if (was_over[4 * f + k])
          for (int j = 0; j < 4; ++j) tangled[c[j]] = 1;
      }
    }
    for (const std::int32_t v : vertices) {
      old_position[v] = mesh.position[v];
      old_location[v] = mesh.location[v];
      if (mesh.pinned[v] || mesh.border[v] || count[v] == 0) continue;
      const Vec3 way = relax_step * ((1 / count[v]) * (tangled[v] ? centres[v] : sum[v]) - mesh.position[v]);
      mesh.location[v] = walk_surface(s, mesh.location[v], way);
      mesh.position[v] = position_of(s, mesh.location[v]);
    }
    // The vertices of a face with a newly turned corner move back, until there is no such face. Each pass moves at
    // least one vertex back, so the loop ends.
    for (bool any = true; any;) {
      any = false;
      for (const std::int32_t v : vertices) back[v] = 0;
      for (const std::int32_t f : faces) {
        for (std::int32_t k = 0; k < 4; ++k) {
          if (was_over[4 * f + k] || !over(f, k)) continue;
          any = true;
          for (std::int32_t j = 0; j < 4; ++j) back[mesh.quad(f)[j]] = 1;
        }
      }
      for (const std::int32_t v : vertices)
        if (back[v]) {
          mesh.position[v] = old_position[v];
          mesh.location[v] = old_location[v];
        }
    }
    report(static_cast<float>(round + 1) / static_cast<float>(options.rounds));
  }
}

}  // namespace hf_inner::remesh
