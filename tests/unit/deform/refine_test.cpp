// The full-mesh step against the normal equations of its energy, written out here.
#include <gtest/gtest.h>

#include "cases.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

// use(w, neighbour) for the ring of a vertex in the triangulation of the operator.
template <class Use>
void for_operator_ring(const hf_inner::surface::Core& core, std::int32_t v, Use&& use) {
  const hf_inner::SymmetricMatrix& k = core.laplacian;
  for (std::int32_t e = k.column_start[v]; e < k.column_start[v + 1]; ++e) {
    if (k.row[e] != v) use(-k.value[e], k.row[e]);
  }
}

// The rotation of every ring in x against the rest p; vertices of handles have those of their handles.
std::vector<Quaternion> operator_rotations(const hf_inner::surface::Core& core, const std::vector<std::int32_t>& owner,
                                           const std::vector<Quaternion>& turn, const std::vector<Vec3>& p,
                                           const std::vector<Vec3>& x) {
  std::vector<Quaternion> out;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    Mat3 s;
    for_operator_ring(core, v, [&](double w, std::int32_t u) { add_outer(s, w, x[v] - x[u], p[v] - p[u]); });
    out.push_back(owner[v] < 0 ? best_rotation(s, {}) : turn[owner[v]]);
  }
  return out;
}

double operator_energy(const hf_inner::surface::Core& core, const std::vector<Quaternion>& rotation,
                       const std::vector<Vec3>& p, const std::vector<Vec3>& x) {
  double sum = 0;
  for (std::int32_t v = 0; v < core.size(); ++v) {
    for_operator_ring(core, v, [&](double w, std::int32_t u) {
      const Vec3 d = x[v] - x[u] - rotate(rotation[v], p[v] - p[u]);
      sum += w * dot(d, d);
    });
  }
  return sum;
}

TEST(Refine, OneStepLeadsToTheMinimumForItsRotationsOnObtuseTrianglesToo) {
  // sheared until every second corner is beyond 150 degrees: many cotangents of its own edges are negative
  Case c = plane_lift(41);
  for (std::size_t k = 0; k < c.mesh.positions.size(); k += 3) c.mesh.positions[k] += 2 * c.mesh.positions[k + 2];
  c.regions = {[](Vec3 p) { return std::max(std::fabs(p.x - 2 * p.z), std::fabs(p.z)) > 0.9; },
               [](Vec3 p) { return std::hypot(p.x - 2 * p.z, p.z) < 0.2; }};
  c.motion = [](std::size_t, double t, Vec3) { return HandleTransform{about({1, 0, 0}, 0.5 * t), {0, 0.6 * t, 0}}; };
  Dragged d = drag(c, {}, 10, 5);
  while (d.pose->deform({false, 100, false}).iteration_count > 0) continue;  // later frames start from the same pose
  const std::vector<Vec3> before = positions(d.pose->deform({}));
  DeformRequest request;
  request.iteration_count = 1;
  request.refine = true;
  const std::vector<Vec3> after = positions(d.pose->deform(request));
  std::vector<std::int32_t> owner(static_cast<std::size_t>(d.core->size()), -1);
  std::vector<Quaternion> turn;
  for (std::size_t h = 0; h < c.regions.size(); ++h) {
    for (const std::int32_t v : select(*d.core, c.regions[h])) owner[v] = static_cast<std::int32_t>(h);
    turn.push_back(h == 0 ? Quaternion() : c.motion(h, 1, Vec3()).rotation);
  }
  const std::vector<Vec3> p = rest(*d.core);
  const std::vector<Quaternion> start = operator_rotations(*d.core, owner, turn, p, before),
                                end = operator_rotations(*d.core, owner, turn, p, after);
  const double plain = operator_energy(*d.core, start, p, before), refined = operator_energy(*d.core, end, p, after);
  std::printf("obtuse triangles: energy %.5f, refined %.5f\n", plain, refined);
  EXPECT_LT(refined, 0.8 * plain);
  // for the rotations of the start the step leads to the minimum: no force is left on a free vertex
  double largest = 0;
  for (std::int32_t v = 0; v < d.core->size(); ++v) {
    if (owner[v] >= 0) continue;
    Vec3 force;
    for_operator_ring(*d.core, v, [&](double w, std::int32_t u) {
      const Vec3 edge = p[v] - p[u], wished = 0.5 * (rotate(start[v], edge) + rotate(start[u], edge));
      force = force + w * (after[v] - after[u] - wished);
    });
    largest = std::max(largest, norm(force));
  }
  EXPECT_LT(largest, 1e-10 * d.core->mesh.scale);
}

// ---- steps that go on from the last frame's surface ----

DeformRequest steps(std::uint32_t count, bool from_last) {
  DeformRequest request;
  request.refine = count;
  request.refine_from_last = from_last;
  return request;
}

Case bent_tube() {
  Case c = cylinder_bend(90, 4, 40);
  const auto bend = c.motion;
  c.motion = [=](std::size_t handle, double t, Vec3 middle) {
    if (handle == 0) return HandleTransform{};
    HandleTransform moved = bend(handle, t, middle);
    moved.rotation = moved.rotation * about({0, 1, 0}, 0.8 * t);
    return moved;
  };
  return c;
}

Dragged drag_with(const Case& c, const DeformRequest& request, int frames, std::uint32_t threads = 1) {
  Dragged d = set_up(c, {}, threads);
  for (int frame = 0; frame <= frames; ++frame) {
    move_to(c, d, static_cast<double>(frame) / frames);
    d.report = d.pose->deform(request);
  }
  return d;
}

double energy_of(const Dragged& d, const std::vector<Vec3>& x) { return arap_energy(*d.core, rest(*d.core), x); }

// The smallest energy that steps of their own find from the blended pose.
double least_energy(Dragged& d) {
  double least = 1e300;
  for (int k = 0; k < 3; ++k) least = std::min(least, energy_of(d, positions(d.pose->deform(steps(64, false)))));
  return least;
}

TEST(RefineFromLast, OneStepAFrameKeepsLengthsInADragAsManyStepsDo) {
  const Case c = bent_tube();
  Dragged one = drag_with(c, steps(1, false), 30), follows = drag_with(c, steps(1, true), 30);
  const double plain = energy_of(one, positions(one.report)), followed = energy_of(follows, positions(follows.report)),
               eight = energy_of(one, positions(one.pose->deform(steps(8, false)))), least = least_energy(one);
  std::printf("energy over the least: one step %.4f, eight %.4f, one from the last frame %.4f\n", plain / least,
              eight / least, followed / least);
  EXPECT_LT(followed, 1.1 * eight);
  EXPECT_LT(followed - least, 0.5 * (plain - least));
}

TEST(RefineFromLast, StandsStillAtTheMinimum) {
  const Case c = bent_tube();
  Dragged d = drag_with(c, steps(1, true), 10);
  std::vector<Vec3> last, now;
  for (int frame = 0; frame < 300; ++frame) {
    last.swap(now);
    now = positions(d.pose->deform(steps(1, true)));
  }
  EXPECT_LT(largest_distance(last, now), 1e-4 * d.core->mesh.scale);
  Dragged other = drag_with(c, steps(1, false), 10);
  EXPECT_LT(energy_of(d, now), 1.001 * least_energy(other));
  // the handles are where their transforms put them
  for (std::size_t h = 0; h < c.regions.size(); ++h) {
    const Vec3 middle = d.pose->handle(d.handles[h]).centroid;
    const HandleTransform m = c.motion(h, 1, middle);
    double off = 0;
    for (const std::int32_t v : select(*d.core, c.regions[h])) {
      const Vec3 p = d.core->mesh.to_given(d.core->mesh.positions[v]);
      off = std::max(off, norm(now[v] - (rotate(normalised(m.rotation), p - middle) + middle + m.translation)));
    }
    EXPECT_LT(off, 1e-12 * d.core->mesh.scale);
  }
}

TEST(RefineFromLast, TurnsWithThePose) {
  // both handles turn together by half a turn in few frames: a correction in the frame of the world would be wrong
  Case c = bent_tube();
  const auto bend = c.motion;
  c.motion = [=](std::size_t handle, double t, Vec3 middle) {
    const HandleTransform bent = bend(handle, 1, middle);
    const Quaternion turn = about({0.36, 0.48, 0.8}, 3 * t);
    const Vec3 moved = rotate(turn, middle + bent.translation) - middle;
    return HandleTransform{turn * normalised(bent.rotation), moved};
  };
  Dragged d = set_up(c, {}, 1);
  move_to(c, d, 0);
  for (int frame = 0; frame < 200; ++frame) d.pose->deform(steps(1, true));
  const double before = energy_of(d, positions(d.pose->deform(steps(1, true))));
  double worst = 0;
  for (int frame = 1; frame <= 12; ++frame) {
    for (std::size_t i = 0; i < 2; ++i)  // move_to() leaves the first one
      place(*d.pose, d.handles[i], c.motion(i, frame / 12.0, d.pose->handle(d.handles[i]).centroid));
    worst = std::max(worst, energy_of(d, positions(d.pose->deform(steps(1, true)))));
  }
  std::printf("turned by 172 degrees: energy at most %.5f of that before\n", worst / before);
  EXPECT_LT(worst, 1.001 * before);
}

TEST(RefineFromLast, RestartsClonesAndThreadsGiveTheirBits) {
  const Case c = bent_tube();
  Dragged d = drag_with(c, steps(2, true), 6), two = drag_with(c, steps(2, true), 6, 2);
  EXPECT_EQ(largest_distance(positions(d.report), positions(two.report)), 0);
  const std::shared_ptr<Pose> copy = d.pose->clone();
  EXPECT_EQ(largest_distance(positions(copy->deform(steps(1, true))), positions(d.pose->deform(steps(1, true)))), 0);
  DeformRequest again = steps(1, true);
  again.restart = true;
  Dragged fresh = set_up(c, {}, 1);
  move_to(c, fresh, 1);
  EXPECT_EQ(largest_distance(positions(d.pose->deform(again)), positions(fresh.pose->deform(steps(1, true)))), 0);
  // a frame without it forgets
  d.pose->deform(steps(1, false));
  const std::shared_ptr<Pose> forgot = d.pose->clone();
  again.restart = false;
  const std::vector<Vec3> plain = positions(d.pose->deform(steps(1, false)));
  EXPECT_EQ(largest_distance(positions(forgot->deform(again)), plain), 0);
}

TEST(RefineFromLast, HandlesAddedAndRemovedKeepTheSurface) {
  const Case c = bent_tube();
  Dragged d = drag_with(c, steps(1, true), 30);
  for (int frame = 0; frame < 300; ++frame) d.report = d.pose->deform(steps(1, true));
  const std::vector<Vec3> before = positions(d.report);
  const std::vector<std::int32_t> middle = select(*d.core, [](Vec3 p) { return norm(p - Vec3{0.5, 3, 0}) < 0.35; });
  const std::uint32_t start[] = {0, static_cast<std::uint32_t>(middle.size())};
  std::uint32_t number = 0;
  d.pose->add_handles({start, 2}, {middle.data(), middle.size()}, {&number, 1}, {true});
  const std::vector<Vec3> placed = positions(d.pose->deform(steps(1, true)));
  EXPECT_LT(largest_distance(before, placed), 1e-6 * d.core->mesh.scale);  // corrections are in single precision
  EXPECT_LT(largest_distance(placed, positions(d.pose->deform(steps(1, true)))), 1e-6 * d.core->mesh.scale);
  d.pose->remove_handles({&number, 1});
  const std::vector<Vec3> removed = positions(d.pose->deform(steps(1, true)));
  EXPECT_LT(largest_distance(before, removed), 1e-4 * d.core->mesh.scale);
}

}  // namespace
