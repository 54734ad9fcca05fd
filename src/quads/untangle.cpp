#include "quads/untangle.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/progress.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

// The figures are sums over 14 meshes at 5,000 quads: triangles that are turned over and have no two corners at one
// place. There are 675 before and 228 after. A mesh of 47 components has 165 of these.

// Rounds; each uses a new e and the vertices near triangles that are still turned over. Half leaves 245, double 223.
constexpr std::int32_t untangle_rounds = 4;
// Newton steps of a vertex in a round. Half leaves 241, double 230.
constexpr std::int32_t untangle_sweeps = 10;
// Vertices so many triangles away move too. 2 and 8 leave 228 and 234. With 2, a skull has 2.33 instead of 2.22 %
// irregular vertices; 8 takes longer.
constexpr std::int32_t untangle_rings = 4;
// Triangles below this determinant are spread out as well. Half leaves 226, double 230.
constexpr double untangle_least = 0.05;
// e is this share of the least determinant. Half leaves 216, double 233.
constexpr double untangle_share = 0.2;
// e is at least this. A tenth leaves 229, half 225, double 228.
constexpr double untangle_smallest = 1e-2;
// How often a step is halved that does not lower the energy. Half leaves 226, double 228.
constexpr std::int32_t untangle_halvings = 12;
// The least curvature of the energy, as a share of the largest. It keeps steps finite; no map came near it.
constexpr double least_curvature = 1e-9;

// The energy of a triangle of area 1, where the map is a x + b conj(x). It uses S = |a|^2 + |b|^2 and D = |a|^2 -
// |b|^2.
struct Bend {
  Bend(double s, double d, double e) noexcept : top(s + 1 + d * d), root(std::sqrt(e * e + d * d)) {
    chi = d > 0 ? 0.5 * (d + root) : 0.5 * e * e / (root - d);
  }
  double value() const noexcept { return top / chi; }
  double top, root, chi;
};

class Untangler {
 public:
  Untangler(const remesh::FluxSurface& surface, const FaceCross& crosses, const Seams& seams, double edge_length,
            Span<const Complex> offset, const remesh::Table<std::uint8_t>& whole, remesh::Table<Complex>& z,
            Memory& memory)
      : surface_(surface),
        crosses_(crosses),
        seams_(seams),
        edge_length_(edge_length),
        offset_(offset),
        whole_(whole),
        z_(z),
        memory_(memory) {}

  void run() {
    Vector<std::int32_t> near(&memory_);
    for (std::int32_t round = 0; round < untangle_rounds; ++round) {
      double least = 0;
      if (!gather(near, least)) return;
      const double e = std::max(untangle_smallest, -untangle_share * least);
      for (std::int32_t sweep = 0; sweep < untangle_sweeps; ++sweep) {
        poll();
        bool any = false;
        for (const std::int32_t v : near) any = move(v, e) || any;
        if (!any) break;
      }
    }
  }

 private:
  struct Jacobian {
    Complex a, b;
    double s() const noexcept { return std::norm(a) + std::norm(b); }
    double d() const noexcept { return std::norm(a) - std::norm(b); }
  };
  // A triangle in its frame, in edge lengths: its area, and the gradients of its corners' hat functions.
  struct Shape {
    double area = 0;
    Complex gradient[3];
  };
  Shape shape_of(std::int32_t t) const noexcept {
    Shape out;
    const Complex* e = crosses_.edge.data() + 3 * t;
    const double twice = e[0].real() * e[1].imag() - e[0].imag() * e[1].real();
    if (!(twice > 0)) return out;
    out.area = 0.5 * twice / (edge_length_ * edge_length_);
    for (int k = 0; k < 3; ++k) out.gradient[k] = quarter_turned(e[(k + 1) % 3], 1) * (edge_length_ / twice);
    return out;
  }
  Complex corner(std::int32_t h) const noexcept {
    const Complex turned = quarter_turned(z_[surface_.tail[h]], seams_.unit[h]);
    return seams_.offset[h] >= 0 ? turned + offset_[at(seams_.offset[h])] : turned;
  }
  Jacobian jacobian(std::int32_t t, const Shape& shape) const noexcept {
    Jacobian out;
    for (int k = 0; k < 3; ++k) {
      const Complex p = 0.5 * corner(3 * t + k);
      out.a += p * std::conj(shape.gradient[k]);
      out.b += p * shape.gradient[k];
    }
    return out;
  }

  // The vertices near triangles that are nearly turned over; least: the least determinant. Returns whether any triangle
  // is turned over.
  bool gather(Vector<std::int32_t>& near, double& least) const {
    remesh::Table<std::uint8_t> marked(surface_.vertex_count(), 0, memory_), next(memory_);
    bool any = false;
    for (std::int32_t t = 0; t < surface_.real_triangles; ++t) {
      const Shape shape = shape_of(t);
      if (!(shape.area > 0)) continue;
      const double d = jacobian(t, shape).d();
      least = std::min(least, d);
      any = any || !(d > 0);
      if (d >= untangle_least) continue;
      for (int k = 0; k < 3; ++k) marked[surface_.tail[3 * t + k]] = 1;
    }
    if (!any) return false;
    for (std::int32_t ring = 0; ring < untangle_rings; ++ring) {
      next = marked;
      for (std::int32_t t = 0; t < surface_.real_triangles; ++t) {
        const std::int32_t* c = surface_.tail.data() + 3 * t;
        if (marked[c[0]] || marked[c[1]] || marked[c[2]]) next[c[0]] = next[c[1]] = next[c[2]] = 1;
      }
      marked.swap(next);
    }
    near.clear();
    for (std::int32_t v = 0; v < surface_.first_apex; ++v) {
      if (marked[v] && !(whole_[2 * v] && whole_[2 * v + 1])) near.push_back(v);
    }
    return true;
  }

  template <class Use>
  void for_triangles(std::int32_t v, Use&& use) const {
    const std::int32_t first = surface_.out[v];
    std::int32_t h = first;
    do {
      if (surface_.is_real(h)) {
        const Shape shape = shape_of(h / 3);
        if (shape.area > 0) use(h, shape, jacobian(h / 3, shape));
      }
      h = surface_.turn_left(h);
    } while (h != first);
  }
  double energy(std::int32_t v, double e) const {
    double sum = 0;
    for_triangles(v, [&](std::int32_t, const Shape& shape, const Jacobian& j) {
      sum += shape.area * Bend(j.s(), j.d(), e).value();
    });
    return sum;
  }

  // Moves a vertex by a Newton step, or a part of it. Returns whether the energy fell.
  bool move(std::int32_t v, double e) {
    double before = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // energy, gradient, Hessian
    for_triangles(v, [&](std::int32_t h, const Shape& shape, const Jacobian& j) {
      const double d = j.d();
      const Bend f(j.s(), d, e);
      before += shape.area * f.value();
      const Complex g = shape.gradient[h % 3];
      const int back = -seams_.unit[h];
      const Complex ds = quarter_turned(j.a * g + j.b * std::conj(g), back),
                    dd = quarter_turned(j.a * g - j.b * std::conj(g), back);
      // With S quadratic and D linear in the corner: derivatives of f by S, D and both.
      const double slope = f.chi / f.root, bend = 0.5 * e * e / (f.root * f.root * f.root), inverse = 1 / f.chi;
      const double by_d = inverse * (2 * d - f.top * slope * inverse), by_sd = -slope * inverse * inverse;
      const double by_dd = inverse * (2 + inverse * (-4 * d * slope + f.top * (2 * slope * slope * inverse - bend)));
      x += shape.area * (inverse * ds.real() + by_d * dd.real());
      y += shape.area * (inverse * ds.imag() + by_d * dd.imag());
      const double n = std::norm(g) * inverse;
      xx += shape.area * (n + 2 * by_sd * ds.real() * dd.real() + by_dd * dd.real() * dd.real());
      yy += shape.area * (n + 2 * by_sd * ds.imag() * dd.imag() + by_dd * dd.imag() * dd.imag());
      xy += shape.area * (by_sd * (ds.real() * dd.imag() + ds.imag() * dd.real()) + by_dd * dd.real() * dd.imag());
    });
    Complex step;
    if (whole_[2 * v]) {
      step = {0, -y / std::fabs(yy)};
    } else if (whole_[2 * v + 1]) {
      step = {-x / std::fabs(xx), 0};
    } else {
      // A direction of negative curvature counts as one of positive curvature.
      const double half = 0.5 * (xx - yy), radius = std::sqrt(half * half + xy * xy), mean = 0.5 * (xx + yy);
      const double low = mean - radius, wanted = std::max(std::fabs(low), least_curvature * (mean + radius));
      xx += wanted - low;
      yy += wanted - low;
      const double determinant = xx * yy - xy * xy;
      step = {(xy * y - yy * x) / determinant, (xy * x - xx * y) / determinant};
    }
    if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) return false;
    const Complex from = z_[v];
    for (std::int32_t i = 0; i < untangle_halvings; ++i, step *= 0.5) {
      z_[v] = from + step;
      if (energy(v, e) < before) return true;
    }
    z_[v] = from;
    return false;
  }

  const remesh::FluxSurface& surface_;
  const FaceCross& crosses_;
  const Seams& seams_;
  double edge_length_;
  Span<const Complex> offset_;
  const remesh::Table<std::uint8_t>& whole_;
  remesh::Table<Complex>& z_;
  Memory& memory_;
};

}  // namespace

void untangle(const remesh::FluxSurface& surface, const FaceCross& crosses, const Seams& seams, double edge_length,
              Span<const Complex> offset, const remesh::Table<std::uint8_t>& whole, remesh::Table<Complex>& z,
              Memory& memory) {
  Untangler(surface, crosses, seams, edge_length, offset, whole, z, memory).run();
}

}  // namespace hf_inner::quads
