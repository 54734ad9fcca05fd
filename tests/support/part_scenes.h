// Characters of parts: cloth over a joint, eyes and teeth, hair, armour and a sword, a rider on a horse. parts_test
// poses them; hf_link_pictures draws them.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/parts.h"

namespace hf_test {

struct PartScene {
  PlainMesh mesh;
  std::uint32_t body = 0;  // its vertices come first
  std::array<double, 3> turned{}, held{}, pivot{};
  double radius = 0;                // of both handles
  std::vector<std::uint32_t> tags;  // by vertex; empty: none
};

// A limb along x that bends at its middle.
inline PartScene limb() {
  PartScene scene;
  scene.mesh = tube(
      60, 20, 0, 2, 0, 0, [](double s) { return 0.12 - 0.04 * s; }, true);
  scene.body = scene.mesh.vertex_count();
  scene.turned = {2, 0, 0};
  scene.held = {0, 0, 0};
  scene.pivot = {1, 0, 0};
  scene.radius = 0.25;
  return scene;
}

// A sleeve over an elbow, or a trouser leg over a knee.
inline PartScene cloth() {
  PartScene scene = limb();
  const double first = 0.5, last = 1.6;
  const auto radius = [&](double s) { return 0.12 - 0.04 * (first + s * (last - first)) / 2 + 0.015; };
  append(scene.mesh, tube(33, 22, first, last, 0, 0, radius, false), 0);
  return scene;
}

// A head that turns on a body, both of one piece, along x: the head is the end of it.
inline PartScene bust() {
  PartScene scene;
  const auto radius = [](double s) {
    const double head = s > 0.6 ? std::sqrt(std::max(0.0, 1 - std::pow((s - 0.8) / 0.2, 2))) : 0;
    return std::max(0.3 * head, s < 0.5 ? 0.35 : 0.12);
  };
  scene.mesh = tube(80, 32, 0, 2, 0, 0, radius, true);
  scene.body = scene.mesh.vertex_count();
  scene.turned = {2, 0, 0};
  scene.held = {0, 0, 0};
  scene.pivot = {1.2, 0, 0};
  scene.radius = 0.3;
  return scene;
}

inline PartScene eyes_and_teeth() {
  PartScene scene = bust();
  for (const double side : {-0.1, 0.1}) append(scene.mesh, ball(5, 0.05, {1.65, side, 0.27}), 0);
  for (int i = 0; i < 6; ++i) {  // two rows of three, half in the skin
    const double y = -0.06 + 0.05 * (i % 3), x = i < 3 ? 1.50 : 1.46;
    append(scene.mesh, box(2, {0.03, 0.04, 0.03}, {x, y, 0.255}), 0);
  }
  return scene;
}

inline PartScene hair_cards() {
  PartScene scene = bust();
  for (int i = 0; i < 6; ++i) {  // strips from the crown towards the back, off the skin at their ends
    PlainMesh card = grid(8, 2, 0.05);
    const double angle = 0.4 * i - 1.0;
    for (std::size_t v = 0; v < card.vertex_count(); ++v) {
      double* p = &card.positions[3 * v];
      const double along = p[0], across = p[1] - 0.05, x = 1.78 - along;
      const double skin = 0.3 * std::sqrt(std::max(0.0, 1 - std::pow((x - 1.6) / 0.4, 2)));
      const double r = skin + 0.01 + 0.05 * along, a = angle + across / 0.3;
      p[0] = x;
      p[1] = r * std::sin(a);
      p[2] = -r * std::cos(a);
    }
    append(scene.mesh, card, 0);
  }
  return scene;
}

constexpr std::uint32_t plate_vertices = 11 * 7;

// A plate on the limb, and a sword through its end, last.
inline PartScene armour_and_sword() {
  PartScene scene = limb();
  PlainMesh plate = grid(10, 6, 0.04);
  for (std::size_t v = 0; v < plate.vertex_count(); ++v) {
    double* p = &plate.positions[3 * v];
    const double x = 1.2 + p[0], r = 0.12 - 0.02 * x + 0.012, a = (p[1] - 0.12) / 0.12;
    p[0] = x;
    p[1] = r * std::sin(a);
    p[2] = r * std::cos(a);
  }
  append(scene.mesh, plate, 0);
  append(scene.mesh, box(6, {0.04, 1.2, 0.04}, {1.85, -0.3, 0.06}), 0);
  return scene;
}

// The horse is the body. The rider has another tag, with what the rider holds.
inline PartScene rider() {
  PartScene scene;
  scene.mesh = tube(
      40, 24, 0, 2, 0, 0, [](double) { return 0.3; }, true);
  scene.body = scene.mesh.vertex_count();
  append(scene.mesh, box(6, {0.3, 0.3, 1}, {0.85, -0.15, 0.295}), 0);
  append(scene.mesh, box(3, {0.1, 0.1, 0.1}, {1.15, -0.05, 1}), 0);
  scene.turned = {1, 0, 0.295};
  scene.held = {1, 0, 1.295};
  scene.pivot = {1, 0, 0.8};
  scene.radius = 0.2;
  scene.tags.assign(scene.mesh.vertex_count(), 2);
  std::fill(scene.tags.begin(), scene.tags.begin() + scene.body, 1u);
  return scene;
}

}  // namespace hf_test
