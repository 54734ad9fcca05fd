// Cuts one face into triangles, by a rule that depends neither on its first corner nor on its orientation.
//
// A quad is cut along its Delaunay diagonal; of two equal ones along that at the vertex of lowest number. A larger face
// loses its roundest ear, until a triangle is left. Cost: O(1) for a quad, O(n^2) for n corners, and more where many
// corners are reflex.
#pragma once
#include "mesh/mesh.h"

namespace hf_inner {

class FaceCutter {
 public:
  explicit FaceCutter(Memory& memory)
      : triangles(&memory), order_(&memory), point_(&memory), key_(&memory), reflex_(&memory), ears_(&memory) {}

  // Cuts the face with these corners: vertex numbers and positions, at least three, neighbours different.
  void cut(Span<const std::int32_t> vertices, Span<const Vec3> positions);

  Vector<std::int32_t> triangles;  // out: positions in `vertices`, three per triangle, in the face's orientation
  bool second_cut = false;         // out: a quad that is not planar, whose other diagonal cuts it as well
  double bend = 0;                 // out: largest distance of a corner from the mean plane, in diameters

 private:
  struct Ear {
    std::int32_t before, after;
    double cost;           // infinite: the corner cannot be cut off
    std::int32_t blocker;  // the reflex corner inside the ear, or -1
  };
  void put_in_order(Span<const std::int32_t> vertices, Span<const Vec3> positions);
  void measure();
  void cut_quad();
  void cut_ears();
  void find_ear(std::int32_t corner) noexcept;
  void free_from(std::int32_t blocker) noexcept;
  std::int32_t reflex_inside(std::int32_t a, std::int32_t b, std::int32_t c) const noexcept;
  double side(std::int32_t a, std::int32_t b, std::int32_t c) const noexcept;
  void add(std::int32_t a, std::int32_t b, std::int32_t c);

  // Corners in canonical order: the lowest vertex number first, then its lower neighbour.
  Vector<std::int32_t> order_;
  Vector<Vec3> point_;
  Vector<std::int32_t> key_;
  Vector<std::uint8_t> reflex_;
  Vector<Ear> ears_;
  bool reversed_ = false;
  Vec3 normal_;        // twice the face's vector area
  double square_ = 0;  // its squared length
};

}  // namespace hf_inner
