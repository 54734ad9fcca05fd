// Plays bytes as edits of a surface, and compares each one with a surface that is made afresh.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace edits {

// What play() did. An edit may be refused for a reason of the header, such as a cut that parts nothing.
struct Outcome {
  bool passed = true;
  std::string failure;
  unsigned done[9] = {}, refused = 0;  // done: by kind of call, as in Player::step
  double worst = 0;                    // largest difference of a field whose values span 1
  double distance = 0;                 // of exact distances
  unsigned poses = 0, poses_off = 0;   // compared, and further off than pose_tolerance
};

// Fields agree to this, whatever was edited: the must of a surface that can be edited.
constexpr double tolerance = 1e-9;
// Groups of a pose depend on the order of vertices, which patches change: of a body that is 6 long. A band that lies on
// a bound of its size counts on one surface and not on the other, so a few poses are off on meshes of 60 vertices: 1 of
// 50,000 when this was written, 1 of 200 with a fault in the bands.
constexpr double pose_tolerance = 1e-2, most_poses_off = 1e-3;

Outcome play(const std::uint8_t* bytes, std::size_t size);

}  // namespace edits
