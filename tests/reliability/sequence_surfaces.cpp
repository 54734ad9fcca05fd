// The calls of a sequence on surfaces: several solvers and poses share one, it is picked, and destroyed before them.
#include <cmath>

#include "sequence_play.h"

namespace sequences {

// Makes another solver on the surface of this branch. It has no sites, whatever the first holds.
void Player::share() {
  auto made = std::make_unique<Branch>(setting_);
  surface_of(here());
  made->surface = here().surface;
  const hf_solver_desc d = solver_desc();
  expect(HF_OK, hf_create(made->surface->handle, &d, &made->solver), "hf_create on a shared surface");
  compare(*made);
  if (branches_.size() == 3) return;
  branches_.push_back(std::move(made));
  active_ = branches_.size() - 1;
}

// Destroys the surface of all its solvers. They still work; the handle is invalid.
void Player::drop_surface() {
  if (!here().surface) return;
  const hf_surface gone = here().surface->handle;
  for (const auto& branch : branches_) {
    if (branch->surface && branch->surface->handle == gone && branch.get() != &here()) branch->surface.reset();
  }
  here().surface.reset();
  hf_solver none = nullptr;
  expect(HF_ERROR_INVALID_OBJECT, hf_create(gone, nullptr, &none), "hf_create on a destroyed surface");
  hold(none == nullptr, "a refused hf_create gave a handle");
}

// Picks a vertex by its position, and a triangle by a ray at an inner point.
void Player::pick() {
  const hf_surface surface = surface_of(here()).handle;
  const Surface& s = *surface_;
  const auto corner = [&](std::uint32_t v, std::size_t k) { return double{s.positions[std::size_t{3} * v + k]}; };
  const std::uint32_t v = bytes_.take() % s.vertex_count();
  const double point[3] = {corner(v, 0), corner(v, 1), corner(v, 2)};
  std::uint32_t nearest = HF_NO_INDEX;
  double distance = -1;
  expect(HF_OK, hf_surface_find_vertex(surface, point, nullptr, &nearest, &distance), "hf_surface_find_vertex");
  hold(nearest < s.vertex_count() && s.inner[nearest] >= 0, "the nearest vertex is in no triangle");
  double right = HUGE_VAL;
  for (std::uint32_t w = 0; w < s.vertex_count(); ++w) {
    const double apart = std::hypot(corner(w, 0) - point[0], corner(w, 1) - point[1], corner(w, 2) - point[2]);
    if (s.inner[w] >= 0) right = std::fmin(right, apart);
  }
  hold(std::fabs(distance - right) <= 1e-9 * (1 + right), "hf_surface_find_vertex: another distance");

  const std::uint32_t t = bytes_.take() % s.triangle_count();
  if (!s.usable(t)) return;
  const std::uint32_t* const corners = &s.triangles[std::size_t{3} * t];
  double origin[3], along[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double target = 0.5 * corner(corners[0], k) + 0.25 * corner(corners[1], k) + 0.25 * corner(corners[2], k);
    along[k] = 0.3 + 0.5 * static_cast<double>((t + k) % 3);
    origin[k] = target - 8 * along[k];
  }
  hf_hit hit = HF_INIT(hf_hit);
  expect(HF_OK, hf_surface_cast_ray(surface, origin, along, nullptr, &hit), "hf_surface_cast_ray");
  hold(hit.found == 1 && hit.triangle < s.triangle_count(), "a ray at a triangle hits nothing");
  hold(hit.distance <= 8 + 1e-6, "a ray passes the triangle it was aimed at");
  for (std::size_t k = 0; k < 3; ++k) {
    double there = 0;
    for (std::size_t i = 0; i < 3; ++i)
      there += hit.place.barycentrics[i] * corner(s.triangles[std::size_t{3} * hit.triangle + i], k);
    hold(std::fabs(there - hit.position[k]) <= 1e-6, "barycentrics and position of a hit differ");
    hold(std::fabs(origin[k] + hit.distance * along[k] - there) <= 1e-6, "a hit is off its ray");
  }
}

// A pose with one handle: the identity keeps every vertex, a translation moves its component and nothing else.
void Player::pose() {
  const hf_surface surface = surface_of(here()).handle;
  const Surface& s = *surface_;
  const std::uint32_t v = bytes_.take() % s.vertex_count();
  if (s.inner[v] < 0) return;
  const auto component = [&](std::uint32_t w) {
    return s.inner[w] < 0 ? -1 : s.component[static_cast<std::size_t>(s.inner[w])];
  };
  struct Owner {
    hf_pose pose = nullptr;
    ~Owner() { hf_pose_destroy(pose); }
  } owner;
  expect(HF_OK, hf_pose_create(surface, nullptr, &owner.pose), "hf_pose_create");
  if (bytes_.take() % 2) drop_surface();
  const std::uint32_t one = 1;
  std::uint32_t handle = 0;
  hf_handles_desc region = HF_INIT(hf_handles_desc);
  region.handle_count = 1;
  region.region_counts = &one;
  region.region_vertices = &v;
  expect(HF_OK, hf_pose_add_handles(owner.pose, &region, &handle), "hf_pose_add_handles");
  std::vector<float> posed(s.positions.size());
  for (const float by : {0.0f, 0.5f}) {
    const hf_transform moved = {{0, 0, 0, 1}, {by, -by, 2.0 * by}};
    expect(HF_OK, hf_pose_set_transform(owner.pose, handle, &moved), "hf_pose_set_transform");
    expect(HF_OK, hf_deform(owner.pose, posed.data(), nullptr), "hf_deform");
    for (std::uint32_t w = 0; w < s.vertex_count(); ++w) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double shift = component(w) == component(v) ? moved.translation[k] : 0;
        const std::size_t i = std::size_t{3} * w + k;
        hold(std::fabs(posed[i] - s.positions[i] - shift) <= 1e-4, "a pose with one handle bends the surface");
      }
    }
  }
}

}  // namespace sequences
