// A sound body of the corpus and a changed copy of it. A change must change nothing: what hf finds on the copy, taken
// back to the body, is what it finds on the body.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace invariance {

using Vec = std::array<double, 3>;
constexpr std::uint32_t none = 0xFFFFFFFFu;

inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec& a);

// Welded, without isolated vertices; y is up. Positions are floats, so that float and double copies can have equal
// values.
struct Body {
  std::string name;
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  // Filled in by prepare().
  Vec low{}, high{};
  double diagonal = 0;
  std::uint32_t piece_count = 0;
  std::vector<std::uint32_t> piece;  // of every vertex
  std::vector<std::uint32_t> picks;  // ten vertices of the largest piece, far from one another
  double spacing = 0;                // smallest distance between two of them

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(points.size()); }
};

// Welds equal positions, rounds them to floats and leaves out what no triangle uses, so that the body is sound.
Body make_body(const std::string& name, const std::vector<double>& xyz, const std::vector<std::uint32_t>& triangles);

// Vertices of the largest piece within a distance of a pick, ascending.
std::vector<std::uint32_t> ball(const Body& body, std::uint32_t centre, double radius);

// How the arrays of a copy are handed over. All forms hold the same values.
enum class Form { floats, doubles, u16, strided, faces };

struct Copy {
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> origin;       // vertex of the body of every vertex here; none: added
  std::vector<std::uint32_t> origin_face;  // the same of triangles
  std::vector<std::uint32_t> first;        // the first vertex here of every vertex of the body
  std::vector<std::uint32_t> face;         // a triangle here of every triangle of the body
  std::array<Vec, 3> linear{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};  // rows; the body's frame to the copy's
  Vec shift{};
  double scale = 1;
  bool mirrored = false;
  std::uint32_t added_isolated = 0, added_pieces = 0, added_faces = 0, doubled_faces = 0;
  Form form = Form::doubles;
};

// A copy that is the body, in floats.
Copy plain_copy(const Body& body);

// Fills in first and face, after a change has set the rest.
void index_copy(const Body& body, Copy& copy);

// ---- the corpus ----

// full: all 40 bodies; else a few small ones. Bodies of ../shared that are not there are left out, with a message.
std::vector<Body> corpus(bool full);
// A body of any mesh file, made uneven as those of the corpus.
Body body_of_file(const std::string& file);

// ---- the changes ----

struct Change {
  const char* name;
  const char* what;                // one line for the table
  Copy (*make)(const Body& body);  // without points: there is no such copy of this body
};
const std::vector<Change>& changes();

// The body with x and -x exchanged, its triangles turned.
Copy mirrored(const Body& body);

}  // namespace invariance
