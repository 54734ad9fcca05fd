// Cuts one face into triangles, by a rule that depends neither on its first corner nor on its orientation.
//
// A quad is cut along its Delaunay diagonal; of two equal ones along that at the vertex of lowest number. A larger face
// loses its roundest ear, until a triangle is left (Meisters 1975). Cost: O(1) for a quad, O(n log n) for a face of n
// corners that do not lie in the way of each other's ears. A face of 60,000 corners takes 0.03 to 0.2 s.
#pragma once
#include "mesh/corner_tree.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

class FaceCutter {
 public:
  explicit FaceCutter(Memory& memory)
      : triangles(&memory),
        order_(&memory),
        point_(&memory),
        key_(&memory),
        ears_(&memory),
        reflex_(&memory),
        costs_(&memory),
        tree_(memory) {}

  // Cuts the face with these corners: vertex numbers and positions, at least three, neighbours different.
  void cut(Span<const std::int32_t> vertices, Span<const Vec3> positions);

  Vector<std::int32_t> triangles;  // out: positions in `vertices`, three per triangle, in the face's orientation
  bool second_cut = false;         // out: a quad that is not planar, whose other diagonal cuts it as well
  double bend = 0;                 // out: largest distance of a corner from the mean plane, in diameters

 private:
  struct Ear {
    std::int32_t before, after;
    std::int32_t reflex = -1;             // its place in reflex_, or -1
    std::int32_t blocker = -1;            // a reflex corner inside the ear, or -1
    std::int32_t blocked = -1;            // the first of the ears that this corner blocks
    std::int32_t former = -1, next = -1;  // in the list of its blocker
  };
  // The data of a reflex corner that a search for the corners inside an ear reads.
  struct Reflex {
    Vec3 point;
    std::int32_t key, corner;
  };
  void put_in_order(Span<const std::int32_t> vertices, Span<const Vec3> positions);
  void measure();
  void cut_quad();
  void cut_ears();
  void find_ear(std::int32_t corner) noexcept;
  void free_from(std::int32_t blocker) noexcept;
  void set_reflex(std::int32_t corner, bool reflex) noexcept;
  void set_blocker(std::int32_t corner, std::int32_t blocker) noexcept;
  void set_cost(std::int32_t corner, double cost) noexcept;
  std::int32_t reflex_inside(std::int32_t a, std::int32_t b, std::int32_t c) const noexcept;
  double side(std::int32_t a, std::int32_t b, std::int32_t c) const noexcept;
  void add(std::int32_t a, std::int32_t b, std::int32_t c);

  // Corners in canonical order: the lowest vertex number first, then its lower neighbour.
  Vector<std::int32_t> order_;
  Vector<Vec3> point_;
  Vector<std::int32_t> key_;
  Vector<Ear> ears_;
  Vector<Reflex> reflex_;  // in no order
  // The costs of the ears as a tournament: a node above two others holds the corner of the lower cost, of equal ones
  // the lower corner. Corner i stands at leaves_ + i, the winner at 1.
  struct Cost {
    double cost;
    std::int32_t corner;
  };
  Vector<Cost> costs_;
  std::size_t leaves_ = 0;
  CornerTree tree_;  // the reflex corners of a face of many corners
  bool in_tree_ = false;
  bool reversed_ = false;
  Vec3 normal_;        // twice the face's vector area
  double square_ = 0;  // its squared length
};

}  // namespace hf_inner::mesh
