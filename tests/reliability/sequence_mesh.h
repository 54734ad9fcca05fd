// The small meshes of the sequence fuzzer and their operators, made from the definitions without the library. Welding
// is by position, weights are cotangents of corner angles, and K is L, L M^-1 L or L^2.
#pragma once
#include <cstddef>
#include <cstdint>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace sequences {

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Surface {
  std::string name;
  std::vector<float> positions;  // xyz as given
  std::vector<std::uint32_t> triangles;
  std::vector<int> inner;      // of a given vertex: its number after welding; -1 in no usable triangle
  std::vector<int> component;  // of an inner vertex, numbered by the smallest given vertex
  int inner_count = 0, component_count = 0;
  bool acute = false;  // no angle above 90 degrees: intrinsic Delaunay already, whatever is glued to what

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / 3); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(triangles.size() / 3); }
  bool usable(std::uint32_t triangle) const;
};

// All of them; the first four are acute.
const std::vector<Surface>& surfaces();

// The matrix K of an HF_OPERATOR_* and HF_FIELD_*. Stiffness is relative to the mean of |K_vv| of a component.
struct Operator {
  Eigen::MatrixXd matrix;
  std::vector<double> mean_diagonal;
};
Operator make_operator(const Surface& surface, int operator_kind, int field_kind);

}  // namespace sequences
