// The classic test shapes of deformation and of sparse factorisation, as plain arrays. Deterministic: the same
// arguments give the same bits. All closed shapes are one manifold component with outward triangles and no duplicated
// vertices; plane() and bumpy_plane() have one border loop.
#ifndef HF_SAMPLES_ASSETS_SHAPES_H
#define HF_SAMPLES_ASSETS_SHAPES_H

#include <cstdint>
#include <vector>

namespace samples {

struct ShapeMesh {
  std::vector<double> positions;    // xyz
  std::vector<uint32_t> triangles;  // three indices each, counter-clockwise from outside
  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
  uint32_t triangle_count() const { return static_cast<uint32_t>(triangles.size() / 3); }
};

// Torus with exactly nu * nv vertices: nu around the hole (major radius), nv around the tube (minor radius). Vertices
// are moved within the surface by up to `jitter` of the grid spacing in each direction, quads split along the shorter
// diagonal. The family of the library's benchmarks: 42,230 = 205 x 206, 84,100 = 290 x 290, 173,056 = 416 x 416,
// 304,152 = 551 x 552. nu and nv at least 3, jitter in 0..0.45.
ShapeMesh jittered_torus(uint32_t nu, uint32_t nv, double jitter = 0.25, double major_radius = 1.0,
                         double minor_radius = 0.4, uint64_t seed = 1);

// Square [-1, 1]^2 in the plane y = 0 with columns x rows vertices, normal +y.
ShapeMesh plane(uint32_t columns, uint32_t rows);

// The same square with smooth bumps of height about 0.12.
ShapeMesh bumpy_plane(uint32_t columns, uint32_t rows);

// Unit sphere: an icosahedron whose faces are cut into frequency^2 triangles; 10 f^2 + 2 vertices.
ShapeMesh sphere(uint32_t frequency);

// Box of size x by y by z centred at the origin in x and z, standing on y = 0, with nx, ny, nz quads along the edges.
ShapeMesh box(double x, double y, double z, uint32_t nx, uint32_t ny, uint32_t nz);

// The twist and bend bar: 1 x 4 x 1, n quads across and 4 n along; n = 19 gives 6,500 vertices.
ShapeMesh bar(uint32_t n);

// Closed cylinder of radius 0.5 and height 4 standing on y = 0: 6 m vertices around, `rows` rings along, discs of m
// rings.
ShapeMesh cylinder(uint32_t m, uint32_t rows);

// A cactus: a trunk with two bent arms, genus 0, evenly meshed with `vertices` vertices: exactly up to 24,000, within
// 0.1 % beyond; 500 at least.
ShapeMesh cactus(uint32_t vertices);

// Uniform numbers from a counter: splitmix64 (Steele, Lea, Flood 2014) of seed and index, in [0, 1).
double hash_to_unit(uint64_t seed, uint64_t index);

}  // namespace samples

#endif
