// What an animal is before it has triangles: joints with rest positions, flesh (blobs on bones), chart groups, coat
// colours and how it walks. One function per species fills a Design; creature.cpp turns it into a Creature.
#ifndef HF_SAMPLES_ASSETS_CREATURE_DESIGN_H
#define HF_SAMPLES_ASSETS_CREATURE_DESIGN_H

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "creature.h"
#include "gait.h"
#include "implicit.h"

namespace samples {

// A part of the skin that gets its own pair of UV charts, one on each side of its bones along `axis`.
struct ChartGroup {
  std::vector<uint32_t> joints;
  dvec3 axis{1, 0, 0};
};

struct Design {
  std::string name;
  std::vector<Joint> joints;
  std::vector<dvec3> rest;  // world positions of the joints
  ImplicitBody body;
  std::vector<ChartGroup> groups;
  std::function<dvec3(const dvec3& point, const dvec3& normal)> color;  // linear rgb
  std::vector<Clip> clips;

  uint32_t joint(const std::string& name) const;
  const dvec3& at(const std::string& name) const { return rest[joint(name)]; }

  // Adds a joint at a world position; parent "" for the root.
  uint32_t add_joint(const std::string& name, const std::string& parent, const dvec3& position);
  // The same joint left and right: names get _L (+x) and _R; a parent that exists with the suffix is taken with it.
  void add_pair(const std::string& name, const std::string& parent, const dvec3& left_position);

  // Adds flesh to a joint. detail scales the edge length there.
  void flesh(const std::string& joint, Blob blob, double detail = 1);
  // Flesh left and mirrored; joint names as in add_pair, or one joint in the middle.
  void flesh_pair(const std::string& joint, const Blob& left_blob, double detail = 1);

  // One chart group of the named joints; pairs make a group left and one right.
  void chart(const std::vector<std::string>& joints, const dvec3& axis = {1, 0, 0});
  void chart_pair(const std::vector<std::string>& joints, const dvec3& left_axis = {1, 0, 0});
};

Design design_horse();
Design design_bull();
Design design_biped();

}  // namespace samples

#endif
