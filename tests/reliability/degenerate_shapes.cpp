#include "degenerate_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "headed_blocks.h"

namespace reliability {
namespace {

DegenerateMesh sheet(std::string name, std::uint32_t n, double bump) {
  DegenerateMesh mesh;
  mesh.name = std::move(name);
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.positions.insert(mesh.positions.end(), {1.0 * i, 1.0 * j, bump * std::sin(1.3 * i) * std::cos(1.1 * j)});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, b, d, c});
    }
  }
  return mesh;
}

void append(DegenerateMesh& mesh, std::vector<double> positions, std::vector<std::uint32_t> triangles) {
  const std::uint32_t first = mesh.vertex_count();
  mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
  for (const std::uint32_t v : triangles) mesh.triangles.push_back(first + v);
}

DegenerateMesh renamed(DegenerateMesh mesh, const char* name) {
  mesh.name = name;
  return mesh;
}

// Every triangle again, turned over; with vertices of its own if asked for.
DegenerateMesh two_sided(DegenerateMesh mesh, const char* name, bool own_vertices) {
  const std::vector<std::uint32_t> front = mesh.triangles;
  const std::uint32_t shift = own_vertices ? mesh.vertex_count() : 0;
  if (own_vertices) {
    const std::vector<double> positions = mesh.positions;
    mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
  }
  for (std::size_t k = 0; k < front.size(); k += 3)
    mesh.triangles.insert(mesh.triangles.end(), {front[k] + shift, front[k + 2] + shift, front[k + 1] + shift});
  return renamed(std::move(mesh), name);
}

DegenerateMesh other_diagonals(DegenerateMesh mesh, const char* name) {
  const std::vector<std::uint32_t> front = mesh.triangles;
  for (std::size_t k = 0; k < front.size(); k += 6)
    mesh.triangles.insert(mesh.triangles.end(),
                          {front[k], front[k + 4], front[k + 1], front[k], front[k + 2], front[k + 4]});
  return renamed(std::move(mesh), name);
}

}  // namespace

std::vector<DegenerateMesh> degenerate_meshes() {
  std::vector<DegenerateMesh> meshes;
  DegenerateMesh triangle;
  triangle.name = "one triangle";
  triangle.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  triangle.triangles = {0, 1, 2};
  meshes.push_back(triangle);
  meshes.push_back(two_sided(triangle, "a two-sided triangle", false));
  const DegenerateMesh plain = sheet("a bumpy sheet", 7, 0.3), flat = sheet("a flat sheet", 6, 0);
  meshes.push_back(plain);
  meshes.push_back(flat);
  meshes.push_back(two_sided(plain, "a two-sided sheet", false));
  meshes.push_back(two_sided(plain, "a doubled sheet", true));
  meshes.push_back(two_sided(two_sided(flat, "", true), "a sheet of four layers", true));
  meshes.push_back(other_diagonals(plain, "a card of other diagonals"));
  DegenerateMesh pair = renamed(flat, "two components and a loose vertex");
  append(pair, {20, 0, 0, 21, 0, 0, 20, 1, 0, 21, 1, 0, 50, 50, 50}, {0, 1, 2, 1, 3, 2});
  meshes.push_back(pair);
  DegenerateMesh collapsed = renamed(plain, "collapsed triangles");  // two welded corners, one vertex twice, a needle
  append(collapsed, {0, 0, 0, 30, 0, 0, 31, 0, 0, 33, 0, 0}, {1, 2, 3, 0, 0, 1});
  collapsed.triangles.insert(collapsed.triangles.end(), {0, collapsed.vertex_count() - 4, 1, 3, 3, 5, 0, 9, 18});
  meshes.push_back(collapsed);
  DegenerateMesh lines = renamed(flat, "triangles on lines");  // two flaps, and one with a vertex of its own
  append(lines, {0.5, 0, 0}, {});
  lines.triangles.insert(lines.triangles.end(), {0, 7, 14, 7, 14, 28, 0, 1, lines.vertex_count() - 1});
  meshes.push_back(lines);
  DegenerateMesh pages = renamed(plain, "four pages on a spine");
  append(pages, {3, 3, 4, 4, 3, 4, 3, 5, 5, 4, 5, 5}, {0, 1, 2, 1, 3, 2});
  const std::uint32_t top = pages.vertex_count() - 4;
  pages.triangles.insert(pages.triangles.end(), {27, 28, top, 28, top + 1, top, 27, 28, top + 2, 28, top + 3, top + 2});
  meshes.push_back(pages);
  DegenerateMesh zero = renamed(plain, "edges of length zero");  // not welded
  zero.weld = HF_WELD_NONE;
  for (std::size_t v = 18; v < 27; ++v) {
    for (std::size_t k = 0; k < 3; ++k) zero.positions[3 * v + k] = zero.positions[54 + k];
  }
  meshes.push_back(zero);
  DegenerateMesh far_away = renamed(plain, "float positions far from 0");
  far_away.in_float = true;
  for (double& x : far_away.positions) x += 1e6;
  meshes.push_back(far_away);
  DegenerateMesh hourglass = triangle;
  hourglass.name = "two triangles at a vertex";
  append(hourglass, {-1, 0, 0, 0, -1, 0}, {});
  hourglass.triangles.insert(hourglass.triangles.end(), {0, 3, 4});
  meshes.push_back(hourglass);
  return meshes;
}

std::vector<DegenerateField> degenerate_fields(const DegenerateMesh& mesh) {
  const std::size_t n = mesh.vertex_count();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<DegenerateField> fields;
  const auto add = [&](const char* name, auto&& value) {
    fields.push_back({name, std::vector<double>(n)});
    for (std::size_t v = 0; v < n; ++v) fields.back().values[v] = value(v);
  };
  const auto x = [&](std::size_t v) { return mesh.positions[3 * v] - mesh.positions[0]; };
  add("zero", [](std::size_t) { return 0.0; });
  add("constant", [](std::size_t) { return -2.5; });
  add("piecewise constant", [&](std::size_t v) { return x(v) > 2.5 ? 1.0 : 0.0; });
  add("plateau", [&](std::size_t v) { return std::max(0.0, x(v) - 2.5); });
  add("flat but for a vertex", [&](std::size_t v) { return v == n / 2 ? 1.0 : 0.0; });
  add("linear", x);
  add("alternating", [](std::size_t v) { return v % 2 ? 1.0 : -1.0; });
  add("smallest numbers", [](std::size_t v) { return v % 3 ? 5e-324 : 0.0; });
  add("largest numbers", [](std::size_t v) { return v % 2 ? 1.7e308 : -1.7e308; });
  add("no values", [&](std::size_t) { return nan; });
  add("half without values", [&](std::size_t v) { return x(v) > 2.5 ? nan : x(v); });
  return fields;
}

namespace {

constexpr std::size_t head = 256;

void* allocate(void*, std::size_t size, std::size_t alignment) {
  const std::size_t before = (head + alignment - 1) / alignment * alignment;
  char* const block = static_cast<char*>(take_block(size + before, alignment));
  std::memset(block, 0x7E, before);
  return block + before;
}

void release(void*, void* block, std::size_t, std::size_t alignment) {
  give_block(static_cast<char*>(block) - (head + alignment - 1) / alignment * alignment);
}

}  // namespace

hf_allocator padded_allocator() { return {allocate, release, nullptr}; }

}  // namespace reliability
