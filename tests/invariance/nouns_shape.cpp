// Poses, proposals, regions, detail and skin weights.
#include <algorithm>
#include <cmath>

#include "setting.h"
#include "support/arrays.h"
#include "support/peers.h"

namespace invariance {
namespace {

using Matrix = std::array<Vec, 3>;
const Matrix identity{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};

// By 50 degrees about a skew axis.
Matrix bend() {
  const double x = 0.6, z = 0.8, c = 0.64278760968653932, s = 0.76604444311897803, k = 1 - c;
  return {Vec{c + x * x * k, -z * s, x * z * k}, Vec{z * s, c, -x * s}, Vec{z * x * k, x * s, c + z * z * k}};
}

// A rigid motion about a place of the body.
std::array<double, 16> motion_about(const Setting& s, const Matrix& m, const Vec& centre, const Vec& shift) {
  const Vec turned{dot(m[0], centre), dot(m[1], centre), dot(m[2], centre)};
  return s.motion(m, centre - turned + shift);
}

using Pose = Owned<hf_pose, hf_pose_destroy>;

std::uint32_t add_handle(const Setting& s, hf_pose pose, std::size_t pick, std::uint32_t layer) {
  const std::vector<std::uint32_t> region = s.vertices(ball(s.body, s.body.picks[pick], 0.3 * s.body.spacing));
  const auto size = static_cast<std::uint32_t>(region.size());
  hf_handles_desc d = HF_INIT(hf_handles_desc);
  d.handle_count = 1;
  d.region_counts = &size;
  d.region_vertices = region.data();
  d.layer = layer;
  std::uint32_t handle = 0;
  ok(hf_pose_add_handles(pose, &d, &handle));
  return handle;
}

void move_handle(const Setting& s, hf_pose pose, std::uint32_t handle, std::size_t pick, const Matrix& m, double lift) {
  const Vec centre = s.body.points[s.body.picks[pick]];
  const std::array<double, 16> matrix = motion_about(s, m, centre, lift * s.body.diagonal * Vec{0.3, 1, 0.2});
  ok(hf_pose_set_matrices(pose, 1, &handle, matrix.data()));
}

// Three handles: one stays, one turns, one is lifted.
Pose pose_of(const Setting& s, std::int32_t mode) {
  Pose pose;
  ok(create_pose_with(mode, s.surface(), nullptr, pose.out()));
  add_handle(s, pose, 0, 0);
  move_handle(s, pose, add_handle(s, pose, 1, 0), 1, bend(), 0.05);
  move_handle(s, pose, add_handle(s, pose, 2, 0), 2, identity, 0.1);
  return pose;
}

void add_deformed(Measured& out, const Setting& s, hf_pose pose, std::int32_t refine) {
  std::vector<double> posed(3 * s.copy.points.size());
  std::vector<float> normals(posed.size());
  hf_deform_desc d = HF_INIT(hf_deform_desc);
  d.positions = ROWS_OUT(posed.data());
  d.normals = ROWS_OUT(normals.data());
  d.restart = 1;
  d.refine = refine;
  ok(hf_pose_deform(pose, &d, nullptr));
  out.add("positions", s.gather_places(posed), s.body.diagonal);
}

}  // namespace

Measured measure_pose(const Setting& s) {
  Measured out;
  const Pose pose = pose_of(s, POSE_SMOOTH);
  add_deformed(out, s, pose, 0);
  std::vector<float> field(s.copy.points.size());
  ok(hf_pose_get_field(pose, 1, OUT(field.data())));
  out.add("field of a handle", s.gather({field.begin(), field.end()}));
  return out;
}

Measured measure_refined_pose(const Setting& s) {
  Measured out;
  add_deformed(out, s, pose_of(s, POSE_SMOOTH), 8);
  return out;
}

Measured measure_paper_pose(const Setting& s) {
  Measured out;
  add_deformed(out, s, pose_of(s, POSE_PAPER), 0);
  return out;
}

Measured measure_layers(const Setting& s) {
  Measured out;
  const Pose pose = pose_of(s, POSE_SMOOTH);
  move_handle(s, pose, add_handle(s, pose, 3, 1), 3, bend(), 0.05);
  add_deformed(out, s, pose, 0);
  return out;
}

Measured measure_proposals(const Setting& s) {
  const Vec up = s.turn({0, 1, 0});
  hf_handle_proposals_desc d = HF_INIT(hf_handle_proposals_desc);
  std::copy(up.begin(), up.end(), d.up);
  std::uint32_t count = 0;
  ok(hf_surface_propose_handles(s.surface(), &d, 0, nullptr, &count));
  std::vector<hf_handle_proposal> found(count);
  ok(hf_surface_propose_handles(s.surface(), &d, count, found.data(), &count));
  std::vector<double> members;
  for (const hf_handle_proposal& p : found) {
    const Vec at = (1 / s.body.diagonal) * s.back({p.position[0], p.position[1], p.position[2]});
    members.insert(members.end(), {at[0], at[1], at[2], s.back_size(p.radius) / s.body.diagonal,
                                   static_cast<double>(p.reason), static_cast<double>(p.pinned)});
  }
  Measured out;
  out.count("proposals", count);
  out.add_set("proposals", 6, members);
  return out;
}

// ---- regions ----

namespace {

using Region = Owned<hf_region, hf_region_destroy>;

Region region_of(const Setting& s, std::size_t pick, std::int32_t base) {
  hf_region_desc d = HF_INIT(hf_region_desc);
  d.base = base;
  Region region;
  ok(hf_region_create(s.surface(), &d, region.out()));
  const std::vector<std::uint32_t> inside = s.vertices(ball(s.body, s.body.picks[pick], 0.6 * s.body.spacing));
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = static_cast<std::uint32_t>(inside.size());
  edit.add_vertices = inside.data();
  ok(hf_region_edit(region, &edit));
  return region;
}

template <class Morph, class Handle>
void add_morphed(Measured& out, const Setting& s, Morph morph, Handle handle, const std::string& name) {
  std::vector<double> xyz(3 * s.copy.points.size());
  hf_morph_desc d = HF_INIT(hf_morph_desc);
  d.weight = 1;
  d.positions = ROWS_OUT(xyz.data());
  ok(morph(handle, &d));
  out.add(name, s.gather_places(xyz), s.body.diagonal);
}

}  // namespace

Measured measure_region(const Setting& s) {
  Measured out;
  for (const std::int32_t base : {HF_BASE_MEMBRANE, HF_BASE_THIN_PLATE}) {
    const Region region = region_of(s, 1, base);
    add_morphed(out, s, hf_region_morph, static_cast<hf_region>(region),
                base == HF_BASE_MEMBRANE ? "membrane" : "thin plate");
    hf_region_info info = HF_INIT(hf_region_info);
    ok(hf_region_get_info(region, &info));
    const double unit = s.size(s.body.diagonal);
    out.add("areas", {info.area, info.base_area}, unit * unit);
    out.add("counts", {double(info.vertex_count), double(info.rim_count), double(info.site_count)});
  }
  return out;
}

Measured measure_detail(const Setting& s) {
  const Region source = region_of(s, 1, HF_BASE_DEFAULT), target = region_of(s, 2, HF_BASE_DEFAULT);
  // the rims are joined at the vertices nearest to the first pick
  const auto start = [&](hf_region region) {
    std::uint32_t count = 0;
    ok(hf_region_get_vertices(region, HF_REGION_RIM, 0, nullptr, &count));
    std::vector<std::uint32_t> rim(count);
    ok(hf_region_get_vertices(region, HF_REGION_RIM, count, rim.data(), &count));
    const Vec from = s.body.points[s.body.picks[0]];
    return *std::min_element(rim.begin(), rim.end(), [&](std::uint32_t a, std::uint32_t b) {
      return length(s.body.points[s.origin(a)] - from) < length(s.body.points[s.origin(b)] - from);
    });
  };
  const std::uint32_t a = start(source), b = start(target);
  hf_detail_desc d = HF_INIT(hf_detail_desc);
  d.pair_count = 1;
  d.source_vertices = &a;
  d.target_vertices = &b;
  Owned<hf_detail, hf_detail_destroy> detail;
  ok(hf_detail_create(source, target, &d, detail.out()));
  Measured out;
  add_morphed(out, s, hf_detail_morph, static_cast<hf_detail>(detail), "detail");
  return out;
}

}  // namespace invariance
