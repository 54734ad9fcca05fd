// The meshes of the player of shapes: eight bodies of 30 to 130 vertices, and damage by bytes.
#include <algorithm>

#include "shape_play.h"

namespace shapes {
namespace {

constexpr double turn = 6.283185307179586;

// A grid of nu x nv vertices at place(u, v); closed in u, and in v where asked.
template <class Place>
void add_grid(Mesh& mesh, std::uint32_t nu, std::uint32_t nv, bool closed_u, bool closed_v, Place&& place) {
  const std::uint32_t base = mesh.vertex_count();
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      for (const double p : place(i, j)) mesh.positions.push_back(static_cast<float>(p));
    }
  }
  for (std::uint32_t i = 0; i + (closed_u ? 0 : 1) < nu; ++i) {
    for (std::uint32_t j = 0; j + (closed_v ? 0 : 1) < nv; ++j) {
      const std::uint32_t a = base + i * nv + j, b = base + (i + 1) % nu * nv + j,
                          c = base + (i + 1) % nu * nv + (j + 1) % nv, d = base + i * nv + (j + 1) % nv;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  }
}
using Point = std::array<double, 3>;

// A ball of rings between two poles, stretched to half axes a, b, c around (x, 0, 0).
void add_ball(Mesh& mesh, double x, double a, double b, double c) {
  const std::uint32_t around = 8, rings = 6, base = mesh.vertex_count();
  add_grid(mesh, around, rings, true, false, [&](std::uint32_t i, std::uint32_t j) {
    const double u = turn * i / around, v = turn * (j + 1) / (2 * (rings + 1));
    return Point{x + a * std::sin(v) * std::cos(u), b * std::sin(v) * std::sin(u), -c * std::cos(v)};
  });
  const std::uint32_t low = mesh.vertex_count(), high = low + 1;
  for (const double p : {x, 0.0, -c, x, 0.0, c}) mesh.positions.push_back(static_cast<float>(p));
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t here = base + i * rings, next = base + (i + 1) % around * rings;
    mesh.triangles.insert(mesh.triangles.end(), {low, next, here, high, here + rings - 1, next + rings - 1});
  }
}

// A box of n x n x n cells, shifted along x: a grid of each side, welded by its equal positions.
void add_box(Mesh& mesh, std::uint32_t n, double dx) {
  for (int side = 0; side < 6; ++side) {
    add_grid(mesh, n + 1, n + 1, false, false, [&](std::uint32_t i, std::uint32_t j) {
      Point p;
      const std::size_t k = static_cast<std::size_t>(side / 2), front = static_cast<std::size_t>(side % 2);
      p[k] = front ? 1 : -1;
      p[(k + 1 + (1 - front)) % 3] = 2.0 * i / n - 1;
      p[(k + 2 - (1 - front)) % 3] = 2.0 * j / n - 1;
      p[0] += dx;
      return p;
    });
  }
}

Mesh body(unsigned which) {
  Mesh mesh;
  switch (which % 8) {
    case 0:
      add_ball(mesh, 0, 1, 1, 1);
      break;
    case 1:  // a limb, thin at its end
      add_grid(mesh, 8, 10, true, false, [](std::uint32_t i, std::uint32_t j) {
        const double r = 1.02 - 0.11 * j;
        return Point{0.6 * j, r * std::cos(turn * i / 8), r * std::sin(turn * i / 8)};
      });
      break;
    case 2:
      add_grid(mesh, 12, 7, true, true, [](std::uint32_t i, std::uint32_t j) {
        const double u = turn * i / 12, v = turn * j / 7, r = 2 + 0.8 * std::cos(v);
        return Point{r * std::cos(u), r * std::sin(u), 0.8 * std::sin(v)};
      });
      break;
    case 3:
      add_box(mesh, 3, 0);
      break;
    case 4:  // a sheet that waves
      add_grid(mesh, 7, 8, false, false, [](std::uint32_t i, std::uint32_t j) {
        return Point{0.5 * i, 0.5 * j, 0.3 * std::sin(1.3 * i) + 0.2 * std::cos(0.9 * j)};
      });
      break;
    case 5:  // pieces that touch, and a small one inside
      add_ball(mesh, 0, 1, 1, 1);
      add_ball(mesh, 1.95, 1, 0.6, 0.4);
      add_ball(mesh, -0.5, 0.2, 0.2, 0.2);
      break;
    case 6:  // a body with a thin plate on it
      add_box(mesh, 2, 0);
      add_grid(mesh, 5, 5, false, false, [](std::uint32_t i, std::uint32_t j) {
        return Point{1.0 + 0.5 * i, 0.4 * j - 0.8, 0.02 * (j % 2)};
      });
      break;
    case 7:  // a Moebius band
      add_grid(mesh, 14, 3, false, false, [](std::uint32_t i, std::uint32_t j) {
        const double u = turn * i / 14, w = 0.5 * (j - 1.0);
        const double r = 2 + w * std::cos(u / 2);
        return Point{r * std::cos(u), r * std::sin(u), w * std::sin(u / 2)};
      });
      for (std::uint32_t j = 0; j < 2; ++j) {  // the last row meets the first one, turned over
        const std::uint32_t a = 13 * 3 + j, d = a + 1, b = 2 - j, c = b - 1;
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      }
      break;
  }
  return mesh;
}

}  // namespace

// One byte for the body, one for the number of changes, and two or three for each change.
Mesh Player::take_mesh() {
  Mesh mesh = body(bytes_.take());
  const double amounts[] = {0.1, -0.2, 0.5, -1, 1e-3, 1e-7, 3, 40};
  const unsigned b = bytes_.take();
  // one mesh in two is sound
  for (unsigned i = 0, count = b % 2 ? 1 + b / 2 % 7 : 0; i < count; ++i) {
    const unsigned what = bytes_.take(), a = bytes_.take();
    const std::size_t v = a % mesh.vertex_count(), t = a % (mesh.triangles.size() / 3);
    switch (what % 8) {
      case 0:  // an axis is stretched
        for (std::size_t p = what / 8 % 3; p < mesh.positions.size(); p += 3)
          mesh.positions[p] *= static_cast<float>(std::fabs(amounts[a % 8]) * 2);
        break;
      case 1:  // a triangle is turned over
        std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
        break;
      case 2:  // a triangle is gone
        if (mesh.triangles.size() > 3)
          mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t),
                               mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * t + 3));
        break;
      case 3:  // a corner goes to another vertex
        mesh.triangles[3 * t + what / 8 % 3] = bytes_.take() % mesh.vertex_count();
        break;
      default:  // a vertex moves
        mesh.positions[3 * v + what / 8 % 3] += static_cast<float>(amounts[bytes_.take() % 8]);
    }
  }
  return mesh;
}

}  // namespace shapes
