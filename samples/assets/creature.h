// Animated, skinned creatures made from nothing but numbers: the library's own sample assets.
//
//   Creature horse = make_creature("horse", 20000);
//
// Each creature is one closed skin of genus 0 with UV charts. Vertices are stored once per chart they touch, so the
// mesh falls apart as stored and becomes one piece again when bit-equal positions are welded, like game assets do.
// Units: metres; Y up; the rest pose looks along +Z and stands on y = 0. Left is +X. Deterministic to the bit.
// Cost: 3 to 5 s for 300,000 vertices on one core. Failure: std::runtime_error (unknown name, count out of range).
#ifndef HF_SAMPLES_ASSETS_CREATURE_H
#define HF_SAMPLES_ASSETS_CREATURE_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "shapes.h"

namespace samples {

struct Joint {
  std::string name;
  int32_t parent = -1;                  // parents stand before their children
  std::array<double, 3> translation{};  // rest pose, relative to the parent; rest rotations are identity
};

// Keys of one joint; empty arrays mean "stays as in the rest pose". Interpolation is linear (rotations: slerp).
struct JointKeys {
  std::vector<float> rotations;     // x y z w per time
  std::vector<float> translations;  // xyz per time
};

struct Clip {
  std::string name;
  double speed = 0;          // metres per second the ground moves backwards under a walk on the spot
  std::vector<float> times;  // seconds, from 0; the pose at the last time equals the first
  std::vector<JointKeys> joints;
  double duration() const { return times.empty() ? 0.0 : double(times.back()); }
};

struct Creature {
  std::string name;
  // per stored vertex
  std::vector<float> positions, normals;        // xyz
  std::vector<float> texcoords;                 // uv, v downwards as in glTF
  std::vector<float> colors;                    // rgb, linear
  std::vector<std::array<uint16_t, 4>> joints;  // unused entries have weight 0
  std::vector<std::array<float, 4>> weights;    // sum to 1
  std::vector<uint32_t> triangles;
  // per stored vertex: its vertex on the closed surface
  std::vector<uint32_t> surface_vertex;
  uint32_t surface_vertex_count = 0;
  uint32_t chart_count = 0;
  std::array<float, 3> base_color{1, 1, 1};

  std::vector<Joint> skeleton;
  std::vector<Clip> clips;

  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
};

// "horse" (slender, long legs), "bull" (stocky, short legs and neck, big head), "biped".
std::vector<std::string> creature_names();

// `vertices` counts vertices of the closed surface, 500..2,000,000; stored vertices are some per cent more because of
// the seams. The surface has exactly (levels 0) or up to 0.01 % off that many.
Creature make_creature(const std::string& name, uint32_t vertices);

// The closed surface, one vertex per surface_vertex.
ShapeMesh welded_surface(const Creature& creature);

// Index of a clip or joint; throws when there is none of that name.
uint32_t find_clip(const Creature& creature, const std::string& name);
uint32_t find_joint(const Creature& creature, const std::string& name);

// World matrix of every joint, 16 numbers each, column-major. Without a clip: the rest pose. Time wraps around.
std::vector<double> rest_pose(const Creature& creature);
std::vector<double> clip_pose(const Creature& creature, const Clip& clip, double time);

// Linear blend skinning of the stored vertices with world matrices from above; xyz per stored vertex.
std::vector<double> skin_positions(const Creature& creature, const std::vector<double>& world);

// FNV-1a over every array of the creature, for determinism tests.
uint64_t creature_hash(const Creature& creature);

}  // namespace samples

#endif
