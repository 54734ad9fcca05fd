// How well poses keep the lengths of edges, beside converged as-rigid-as-possible iterations of the full mesh:
//   hf_pose_lengths [--bands N] [--groups N] [--iterations N] [--steps N] [--smooth] [MESH ...]
// Handles are discs of 0.05 of the box at three places far from each other. The second one moves by 0.28 of the box and
// turns by 57 degrees, in 30 frames. --steps: full-mesh steps of the refined rows. --smooth: the
// oracle with smooth rotations too. Without a mesh: a plane and a tube.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "assets/shapes.h"
#include "common/mesh_file.h"
#include "support/arap_oracle.h"
#include "unit/deform/cases.h"

namespace {

using namespace deform_test;

constexpr int handle_count = 3, frames = 30;
constexpr double radius = 0.05;         // of a handle, over the box
constexpr double most_near = 1.1;       // an edge within 10 % of its length
constexpr int most_iterations = 600;    // of the oracle
constexpr int smooth_iterations = 400;  // of the oracle with smooth rotations

struct Options {
  hf_inner::PoseOptions pose;
  std::uint32_t iterations = 10;
  std::uint32_t steps = 1;
  std::vector<double> smoothness;
  bool from_last = false;  // the steps of the refined rows go on from frame to frame
  int more = 0;            // such frames after the drag
};

struct Row {
  double energy = 0, near = 0, longest = 0, dihedral = 0, volume = 0;
};

double box_of(const hf_test::PlainMesh& mesh, std::vector<Vec3>& points) {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3) {
    const Vec3 p{mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]};
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    points.push_back(p);
  }
  return hf_inner::norm(high - low);
}

// The highest vertex, then each time the one farthest from those before.
std::vector<Vec3> far_places(const std::vector<Vec3>& points) {
  std::size_t next = 0;
  for (std::size_t v = 0; v < points.size(); ++v) next = points[v].y > points[next].y ? v : next;
  std::vector<Vec3> places;
  std::vector<double> near(points.size(), 1e300);
  for (int i = 0; i < handle_count; ++i) {
    places.push_back(points[next]);
    for (std::size_t v = 0; v < points.size(); ++v)
      near[v] = std::min(near[v], hf_inner::norm(points[v] - places.back()));
    for (std::size_t v = 0; v < points.size(); ++v) next = near[v] > near[next] ? v : next;
  }
  return places;
}

Case make_case(const std::string& name, hf_test::PlainMesh mesh) {
  Case c;
  c.name = name;
  std::vector<Vec3> points;
  const double box = box_of(mesh, points);
  for (const Vec3 place : far_places(points))
    c.regions.push_back([=](Vec3 p) { return hf_inner::norm(p - place) < radius * box; });
  c.motion = [=](std::size_t handle, double t, Vec3) {
    if (handle != 1) return hf_inner::HandleTransform{};
    const Vec3 axis{1, 2, 0.5};
    return hf_inner::HandleTransform{about((1 / hf_inner::norm(axis)) * axis, t), (box * t) * Vec3{0.1, 0.25, -0.1}};
  };
  c.mesh = std::move(mesh);
  return c;
}

Row row_of(const hf_inner::Core& core, const std::vector<Vec3>& x) {
  const Quality q = measure(core, x);
  return {q.energy, q.near_share, q.edge_max, q.dihedral_p99, q.volume};
}

void print(const std::string& name, const char* method, const Row& r, double unit) {
  std::printf("%-28s %-12s E/Eo %6.3f  within 10 %% %6.2f  longest %5.2f  dihedral 99 %% %5.1f  volume %5.1f\n",
              name.c_str(), method, r.energy / unit, r.near, r.longest, r.dihedral, r.volume);
  std::fflush(stdout);
}

double total_area(const hf_inner::Core& core) {
  double sum = 0;
  for (const double a : core.areas) sum += a;
  return sum;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace

int main(int count, char** arguments) {
  Options options;
  std::vector<Case> cases;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    const auto number = [&] { return i + 1 < count ? static_cast<std::uint32_t>(std::atoi(arguments[++i])) : 0; };
    if (word == "--bands")
      options.pose.band_count = number();
    else if (word == "--groups")
      options.pose.group_count = number();
    else if (word == "--iterations")
      options.iterations = number();
    else if (word == "--steps")
      options.steps = number();
    else if (word == "--from-last")
      options.from_last = true;
    else if (word == "--more")
      options.more = static_cast<int>(number());
    else if (word == "--smooth")
      options.smoothness = {3e-5, 1e-4, 3e-4, 1e-3};
    else {
      const samples::SurfaceMesh surface = samples::read_mesh_file(word);
      hf_test::PlainMesh mesh;
      for (const glm::dvec3& p : surface.positions) mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
      mesh.triangles = surface.triangles;
      cases.push_back(make_case(word.substr(word.find_last_of('/') + 1), std::move(mesh)));
    }
  }
  if (cases.empty()) {
    cases.push_back(make_case("plane", plain(samples::bumpy_plane(80, 80))));
    cases.push_back(make_case("tube", plain(samples::cylinder(48, 120))));
  }
  std::vector<double> energy[2], near[2], longest[2], dihedral[2];
  for (const Case& c : cases) {
    Dragged d = drag(c, options.pose, frames, options.iterations);
    const std::vector<Vec3> smooth = positions(d.report);
    std::vector<Vec3> refined = smooth;
    hf_inner::DeformRequest request;
    request.iteration_count = 1, request.refine = options.steps;
    refined = positions(d.pose->deform(request));
    if (options.from_last) {
      Dragged e = set_up(c, options.pose, 1);
      e.pose->deform({});
      hf_inner::DeformRequest q;
      q.iteration_count = options.iterations, q.refine = options.steps, q.refine_from_last = true;
      for (int frame = 1; frame <= frames; ++frame) {
        move_to(c, e, static_cast<double>(frame) / frames);
        refined = positions(e.pose->deform(q));
      }
      for (int frame = 0; frame < options.more; ++frame) refined = positions(e.pose->deform(q));
    }

    hf_inner::CoreOptions own_edges;
    own_edges.operator_kind = hf_inner::OperatorKind::cotangent;
    const auto cotangents = hf_test::make_core(c.mesh, 1, own_edges);
    std::vector<uint8_t> fixed(static_cast<size_t>(d.core->size()), 0);
    for (const auto& region : c.regions) {
      for (const int32_t v : select(*d.core, region)) fixed[static_cast<size_t>(v)] = 1;
    }
    // components that no handle holds stay
    std::vector<uint8_t> held(static_cast<size_t>(d.core->mesh.component_count()), 0);
    for (size_t v = 0; v < fixed.size(); ++v) held[static_cast<size_t>(d.core->mesh.component[v])] |= fixed[v];
    for (size_t v = 0; v < fixed.size(); ++v) fixed[v] |= !held[static_cast<size_t>(d.core->mesh.component[v])];
    const std::vector<Vec3> p = rest(*d.core);
    const auto given = [&](const std::vector<Vec3>& x) {
      std::vector<Vec3> out;
      for (const Vec3& q : x) out.push_back(d.core->mesh.to_given(q));
      return out;
    };
    std::vector<Vec3> x;
    for (const Vec3& q : smooth) x.push_back(d.core->mesh.to_inner(q));
    hf_test::ArapOracle oracle(*cotangents, fixed);
    oracle.converge(x, most_iterations, [&](const std::vector<Vec3>& y) { return arap_energy(*d.core, p, given(y)); });
    const Row arap = row_of(*d.core, given(x));
    print(c.name, "ARAP", arap, arap.energy);
    for (const double share : options.smoothness) {
      std::vector<Vec3> y;
      for (const Vec3& q : smooth) y.push_back(d.core->mesh.to_inner(q));
      hf_test::ArapOracle other(*cotangents, fixed);
      other.set_smoothness(share * total_area(*d.core));
      for (int i = 0; i < smooth_iterations; ++i) other.iterate(y);
      char name[24];
      std::snprintf(name, sizeof name, "ARAP + %g", share);
      print("", name, row_of(*d.core, given(y)), arap.energy);
    }
    const Row ours[2] = {row_of(*d.core, smooth), row_of(*d.core, refined)};
    print("", "smooth", ours[0], arap.energy);
    print("", "refined", ours[1], arap.energy);
    for (int i = 0; i < 2; ++i) {
      energy[i].push_back(ours[i].energy / arap.energy), near[i].push_back(arap.near - ours[i].near);
      longest[i].push_back(ours[i].longest / arap.longest), dihedral[i].push_back(ours[i].dihedral / arap.dihedral);
    }
  }
  const char* names[2] = {"smooth", "refined"};
  for (int i = 0; i < 2; ++i) {
    std::printf("median %-8s E/Eo %.3f  points below ARAP %.2f  longest over ARAP's %.3f  dihedral over ARAP's %.2f\n",
                names[i], median_of(energy[i]), median_of(near[i]), median_of(longest[i]), median_of(dihedral[i]));
  }
  return 0;
}
