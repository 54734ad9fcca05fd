// Shapes whose harmonic or bi-harmonic fields are known exactly, with the sites and the answer, for certificate.cpp.
//
// The answers come from theory, in long double, and share no code with the library: resistances in series, linear
// functions on flat shapes, exponentials on a ring.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace reliability {

struct ExactShape {
  std::string name;
  std::int32_t field_kind = 0;
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> sites;
  std::vector<double> values;
  std::vector<double> stiffness;  // empty: all hard
  std::vector<double> exact;      // by vertex
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
};

// Right triangles, or any with no obtuse angle, each joined to the next at a vertex; sites at both ends.
ExactShape exact_chain(std::uint32_t triangles, bool random, double stiffness, unsigned seed);
// Rings of equal polygons at given or random heights, open at both ends; the ends are sites. Bi-harmonic: two rings.
ExactShape exact_tube(std::uint32_t rings, std::uint32_t around, bool random, int field_kind, unsigned seed);
// A closed surface of revolution, sites at the poles: a sphere, or a long body of changing width.
ExactShape exact_revolution(std::uint32_t rings, std::uint32_t around, double length, double stiffness);
// Triangles around a vertex, with sites at the hub and four places of the rim.
ExactShape exact_fan(std::uint32_t triangles, int field_kind);
// A rectangle whose columns and rows grow from `finest` to 1 (1: all equal); sites on two sides. Bi-harmonic: around.
ExactShape exact_plane(std::uint32_t columns, std::uint32_t rows, double finest, double aspect, int field_kind);
// Many strips beside one another, each with values of its own; every seventh has no site, and the field is 0 there.
ExactShape exact_islands(std::uint32_t islands, std::uint32_t columns);

}  // namespace reliability
