// Implements hf/weights.h: skin weights from bones.
#include <algorithm>
#include <cmath>

#include "capi/objects.h"
#include "hf/weights.h"
#include "mesh/places.h"
#include "weights/weights.h"

namespace hf_inner::capi {
namespace {

struct WeightsObject final : Object {
  static constexpr Kind kind_of = Kind::weights;
  WeightsObject(std::shared_ptr<const SkinSurface> surface, std::int32_t influences, const Bones& bones)
      : Object(kind_of), memory(surface->core->memory), weights(std::move(surface), influences, bones) {}
  WeightsObject(const WeightsObject& other) : Object(kind_of), memory(other.memory), weights(other.weights) {}
  std::shared_ptr<Memory> memory;  // outlives what follows
  Weights weights;
};

constexpr std::uint32_t most_bones = 1u << 20;  // bounds the memory of a runaway host; rigs have some hundred
constexpr std::uint32_t u16_bones = 1u << 16;   // numbers that 16 bits hold

Vec3 read_bone_point(const double* points, std::uint32_t i, const char* name) {
  const double* p = points + 3 * std::size_t{i};
  if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    fail(HF_ERROR_NON_FINITE, i, "%s: the point of bone %u is not finite", name, i);
  return {p[0], p[1], p[2]};
}

// Scaled to length 1; a vector without length stays zero.
Vec3 direction_of(const Vec3& p) noexcept {
  const double most = std::max(std::max(std::fabs(p.x), std::fabs(p.y)), std::fabs(p.z));
  if (!(most > 0)) return {};
  const Vec3 q{p.x / most, p.y / most, p.z / most};
  return (1 / norm(q)) * q;
}

// Refuses parents in a circle: a walk from every bone up, which ends where an earlier walk was.
void check_parents(const Bones& bones, Memory& memory) {
  Vector<Index> walk(bones.head.size(), -1, &memory);
  for (Index b = 0; b < bones.count(); ++b) {
    for (Index up = b; up >= 0 && walk[at(up)] < 0; up = bones.parent[at(up)]) {
      walk[at(up)] = b;
      const Index next = bones.parent[at(up)];
      if (next >= 0 && walk[at(next)] == b)
        fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(next), "bone %d is an ancestor of itself", next);
    }
  }
}

void read_bones(const hf_bones_desc& desc, Bones& bones, Memory& memory) {
  require_list(desc.bone_count, desc.heads, "bone_count", "heads");
  if (desc.bone_count > most_bones)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "bone_count is %u; the limit is %u", desc.bone_count, most_bones);
  if (desc.tails && desc.axes) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "tails and axes are both set; set one");
  bones.has_tails = desc.tails != nullptr;
  for (std::uint32_t b = 0; b < desc.bone_count; ++b) {
    bones.head.push_back(read_bone_point(desc.heads, b, "heads"));
    if (desc.tails) bones.tail.push_back(read_bone_point(desc.tails, b, "tails"));
    if (desc.axes) bones.axis.push_back(direction_of(read_bone_point(desc.axes, b, "axes")));
    const std::uint32_t parent = desc.parents ? desc.parents[b] : HF_NO_INDEX;
    if (parent != HF_NO_INDEX && parent >= desc.bone_count)
      fail(HF_ERROR_OUT_OF_RANGE, b, "the parent of bone %u is %u, but there are %u bones", b, parent, desc.bone_count);
    bones.parent.push_back(parent == HF_NO_INDEX ? -1 : static_cast<Index>(parent));
    const std::int32_t deforms = desc.deforms ? desc.deforms[b] : 1;
    if (deforms != 0 && deforms != 1)
      fail(HF_ERROR_INVALID_ARGUMENT, b, "deforms of bone %u is %d; it must be 0 or 1", b, deforms);
    bones.deforms.push_back(static_cast<std::uint8_t>(deforms));
  }
  check_parents(bones, memory);
}

// By new bone the number it had before, -1 for a new one; empty: the same numbers.
Vector<Index> read_sources(const hf_bones_desc& desc, std::uint32_t before, Memory& memory) {
  Vector<Index> sources(&memory);
  Vector<std::uint8_t> named(before, 0, &memory);
  for (std::uint32_t b = 0; desc.sources && b < desc.bone_count; ++b) {
    const std::uint32_t source = desc.sources[b];
    if (source == HF_NO_INDEX) {
      sources.push_back(-1);
      continue;
    }
    if (source >= before)
      fail(HF_ERROR_OUT_OF_RANGE, b, "the source of bone %u is %u, but there were %u bones", b, source, before);
    if (named[source]) fail(HF_ERROR_DUPLICATE_SITE, b, "the source %u of bone %u is named twice", source, b);
    named[source] = 1;
    sources.push_back(static_cast<Index>(source));
  }
  return sources;
}

Site read_place(const Mesh& mesh, const hf_pins_desc& desc, std::uint32_t i) {
  if (desc.vertices) return Site::at_vertex(mesh, usable_vertex(mesh, desc.vertices[i], i, "vertices"));
  const double* weights = desc.barycentrics + 3 * std::size_t{i};
  const SurfacePlace place = place_in_triangle(mesh, desc.triangles[i], weights, i);
  Site site;
  int used = 0;
  for (int k = 0; k < 3; ++k) {
    if (weights[k] > 0) site.vertex[used] = place.vertex[k], site.weight[used++] = weights[k];
  }
  if (used == 1) site.weight[0] = 1;
  site.component = mesh.component[at(place.vertex[0])];
  return site;
}

void read_pin_weights(const hf_pins_desc& desc, std::uint32_t i, std::uint32_t bones, Pins& pins) {
  double sum = 0;
  const std::size_t first = pins.share.size();
  for (std::uint32_t k = 0; k < desc.joint_count; ++k) {
    const std::size_t entry = std::size_t{i} * desc.joint_count + k;
    const std::uint32_t joint = desc.joints[entry];
    const double weight = static_cast<double>(desc.weights[entry]);
    if (joint >= bones)
      fail(HF_ERROR_OUT_OF_RANGE, i, "joint %u of pin %u is bone %u, but there are %u bones", k, i, joint, bones);
    if (!std::isfinite(weight)) fail(HF_ERROR_NON_FINITE, i, "weight %u of pin %u is not finite", k, i);
    if (weight < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "weight %u of pin %u is %g; it must not be negative", k, i, weight);
    if (!(weight > 0)) continue;
    sum += weight;
    // A bone named twice counts once, with both weights.
    std::size_t there = first;
    while (there < pins.bone.size() && pins.bone[there] != static_cast<Index>(joint)) ++there;
    if (there < pins.bone.size()) {
      pins.share[there] += weight;
    } else {
      pins.bone.push_back(static_cast<Index>(joint)), pins.share.push_back(weight);
    }
  }
  if (!(sum > 0)) fail(HF_ERROR_INVALID_ARGUMENT, i, "the weights of pin %u are all 0; one must be above 0", i);
  for (std::size_t k = first; k < pins.share.size(); ++k) pins.share[k] /= sum;
  pins.start.push_back(static_cast<Index>(pins.bone.size()));
}

void read_pins(const hf_pins_desc& desc, const Mesh& mesh, std::uint32_t bones, Pins& pins) {
  if (desc.pin_count == 0) return;
  if (desc.vertices && desc.triangles)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "vertices and triangles are both set; set one");
  require_either(desc.vertices, desc.triangles, "vertices and triangles");
  if (desc.triangles) require(desc.barycentrics, "barycentrics");
  require(desc.joints, "joints"), require(desc.weights, "weights");
  if (desc.joint_count < 1 || desc.joint_count > most_influences)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "joint_count is %u; it must be 1 to %d", desc.joint_count,
         most_influences);
  if (desc.pin_count > mesh.report.vertex_count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "pin_count is %u; the mesh has %u vertices", desc.pin_count,
         mesh.report.vertex_count);
  for (std::uint32_t i = 0; i < desc.pin_count; ++i) {
    pins.places.push_back(read_place(mesh, desc, i));
    const double radius = desc.radii ? desc.radii[i] : 0.0;
    if (!std::isfinite(radius)) fail(HF_ERROR_NON_FINITE, i, "the radius of pin %u is not finite", i);
    if (radius < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "the radius of pin %u is %g; it must not be negative", i, radius);
    pins.radius.push_back(radius / mesh.scale);
    read_pin_weights(desc, i, bones, pins);
  }
}

std::uint32_t bone_count(const WeightsObject& object) {
  return static_cast<std::uint32_t>(object.weights.state().inputs->bones.head.size());
}

// The weights of locks by inner vertex, in the order of `bones`.
void read_locks(const Mesh& mesh, std::uint32_t count, const float* values, Vector<float>& out) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t given = given_vertex(mesh, v);
    for (std::uint32_t i = 0; i < count; ++i) {
      const float value = values[std::size_t{given} * count + i];
      if (!std::isfinite(value)) fail(HF_ERROR_NON_FINITE, given, "value %u of vertex %u is not finite", i, given);
      if (value < 0 || value > 1)
        fail(HF_ERROR_INVALID_ARGUMENT, given, "value %u of vertex %u is %g; it must be 0 to 1", i, given,
             static_cast<double>(value));
      out.push_back(value);
    }
  }
}

// The flags of a bone with the proposal. A bone that no vertex needs and that is a point, a copy or outside is a
// helper.
std::uint32_t flags_of(std::uint32_t faults) noexcept {
  const bool odd = (faults & (bone_no_length | bone_coincident | bone_outside)) != 0;
  return odd && (faults & bone_informs_none) ? faults | HF_BONE_HELPER : faults;
}

template <class Work>
hf_result change(const char* function, hf_weights handle, Work&& work) {
  return guarded(function, [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    const Changing changing(*object);
    work(*object);
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_weights_create(hf_surface handle, const hf_bones_desc* given, uint32_t weight_count,
                            hf_weights* out_weights) {
  return create("hf_weights_create", out_weights, "out_weights", [&] {
    const auto surface = mesh_surface(handle, "skin weights");
    const hf_bones_desc desc = read_struct(given, "bones");
    if (weight_count != 0 && weight_count != 4 && weight_count != 8)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "weight_count is %u; it must be 4 or 8, or 0 for 4", weight_count);
    if (desc.sources)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "sources is set, but there were no bones before; set it to NULL");
    Bones bones(*surface->memory);
    read_bones(desc, bones, *surface->memory);
    return with_progress(desc.progress, [&] {
      const auto core = surface->surface.core(FieldKind::harmonic);
      return make_owner_in<WeightsObject>(core->memory, make_owner_in<SkinSurface>(core->memory, core),
                                          weight_count == 8 ? 8 : 4, bones);
    });
  });
}

hf_result hf_weights_clone(hf_weights handle, hf_weights* out_weights) {
  return clone_object<WeightsObject>("hf_weights_clone", handle, "weights", out_weights, "out_weights");
}

void hf_weights_destroy(hf_weights weights) { destroy<WeightsObject>(weights); }

hf_result hf_weights_set_bones(hf_weights handle, const hf_bones_desc* given) {
  return change("hf_weights_set_bones", handle, [&](WeightsObject& object) {
    const hf_bones_desc desc = read_struct(given, "bones");
    Bones bones(*object.memory);
    read_bones(desc, bones, *object.memory);
    const Vector<Index> sources = read_sources(desc, bone_count(object), *object.memory);
    with_progress(desc.progress, [&] { object.weights.set_bones(bones, sources); });
  });
}

hf_result hf_weights_set_pins(hf_weights handle, const hf_pins_desc* given) {
  return change("hf_weights_set_pins", handle, [&](WeightsObject& object) {
    const hf_pins_desc desc = read_struct(given, "pins");
    require_zero(desc.reserved);
    Pins pins(*object.memory);
    read_pins(desc, object.weights.surface().core->mesh, bone_count(object), pins);
    with_progress(desc.progress, [&] { object.weights.set_pins(pins); });
  });
}

hf_result hf_weights_set_locks(hf_weights handle, uint32_t lock_count, const uint32_t* bones, const float* values) {
  return change("hf_weights_set_locks", handle, [&](WeightsObject& object) {
    const std::uint32_t count = bone_count(object);
    if (lock_count > count)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "lock_count is %u, but there are %u bones", lock_count, count);
    if (lock_count > 0) require(bones, "bones");
    Vector<Index> locked(object.memory.get());
    Vector<std::uint8_t> named(count, 0, object.memory.get());
    for (std::uint32_t i = 0; i < lock_count; ++i) {
      if (bones[i] >= count)
        fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of bones is %u, but there are %u bones", i, bones[i], count);
      if (named[bones[i]]) fail(HF_ERROR_DUPLICATE_SITE, i, "entry %u of bones names bone %u again", i, bones[i]);
      named[bones[i]] = 1;
      locked.push_back(static_cast<Index>(bones[i]));
    }
    Vector<float> given(object.memory.get());
    if (values && lock_count > 0) read_locks(object.weights.surface().core->mesh, lock_count, values, given);
    object.weights.set_locks(locked, given.empty() ? nullptr : given.data());
  });
}

hf_result hf_weights_get(hf_weights handle, hf_weights_out* inout) {
  return guarded("hf_weights_get", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    hf_weights_out out = read_struct(inout, "inout_weights");
    const Reading reading(*object);
    const Mesh& mesh = object->weights.surface().core->mesh;
    const WeightState& state = object->weights.state();
    const std::size_t k = static_cast<std::size_t>(object->weights.influences());
    out.vertex_count = mesh.report.vertex_count, out.weight_count = static_cast<std::uint32_t>(k);
    write_struct(inout, out);
    check_capacity(out.joints || out.joints_u16 || out.weights || out.origins, out.vertex_capacity, out.vertex_count,
                   "vertex_capacity");
    if (out.joints_u16 && bone_count(*object) > u16_bones)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u bones do not fit 16 bits; use joints", bone_count(*object));
    std::size_t isolated = 0;
    for (std::size_t v = 0; v < out.vertex_count; ++v) {
      const bool loose = mesh.inner_of_given[v] == Mesh::none;
      const std::size_t inner = at(loose ? state.nearest_of_isolated[isolated++] : mesh.inner_of_given[v]);
      for (std::size_t i = 0; i < k; ++i) {
        const std::uint32_t joint = state.joints[inner * k + i];
        if (out.joints) out.joints[v * k + i] = joint;
        if (out.joints_u16) out.joints_u16[v * k + i] = static_cast<std::uint16_t>(joint);
        if (out.weights) out.weights[v * k + i] = state.weights[inner * k + i];
      }
      if (out.origins) out.origins[v] = static_cast<std::uint8_t>(loose ? Origin::isolated : state.origin[inner]);
    }
  });
}

hf_result hf_weights_get_bones(hf_weights handle, uint32_t capacity, uint32_t* out_flags, uint32_t* out_vertex_counts,
                               uint32_t* out_count) {
  return guarded("hf_weights_get_bones", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    if (!out_flags && !out_vertex_counts) require(out_count, "out_flags, out_vertex_counts and out_count");
    const Reading reading(*object);
    const Solution& solution = *object->weights.state().solution;
    write_count(out_count, solution.faults.size());
    check_capacity(out_flags || out_vertex_counts, capacity, solution.faults.size(), "capacity");
    for (std::size_t b = 0; b < solution.faults.size(); ++b) {
      if (out_flags) out_flags[b] = flags_of(solution.faults[b]);
      if (out_vertex_counts) out_vertex_counts[b] = solution.informs[b];
    }
  });
}

hf_result hf_weights_get_info(hf_weights handle, hf_weights_info* out_info) {
  return guarded("hf_weights_get_info", [&] {
    const auto object = get<WeightsObject>(handle, "weights");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    const WeightState& state = object->weights.state();
    const WeightCounts& counts = state.counts;
    hf_weights_info info{};
    info.vertex_count = object->weights.surface().core->mesh.report.vertex_count;
    info.bone_count = bone_count(*object), info.pin_count = static_cast<std::uint32_t>(state.inputs->pins.count());
    info.lock_count = state.inputs->locks ? static_cast<std::uint32_t>(state.inputs->locks->bones.size()) : 0;
    info.informed_count = counts.by_origin[HF_WEIGHTS_INFORMED],
    info.solved_count = counts.by_origin[HF_WEIGHTS_SOLVED];
    info.pinned_count = counts.by_origin[HF_WEIGHTS_PINNED], info.carried_count = counts.by_origin[HF_WEIGHTS_CARRIED];
    info.rigid_count = counts.by_origin[HF_WEIGHTS_RIGID], info.isolated_count = counts.by_origin[HF_WEIGHTS_ISOLATED];
    info.carried_island_count = counts.islands_carried + counts.islands_rigid;
    info.rigid_island_count = counts.islands_rigid;
    info.blind = counts.blind;
    for (const std::uint32_t faults : state.solution->faults) {
      const std::uint32_t flags = flags_of(faults);
      info.no_length_count += (flags & HF_BONE_NO_LENGTH) != 0,
          info.coincident_count += (flags & HF_BONE_COINCIDENT) != 0;
      info.informs_none_count += (flags & HF_BONE_INFORMS_NONE) != 0;
      info.outside_count += (flags & HF_BONE_OUTSIDE) != 0, info.helper_count += (flags & HF_BONE_HELPER) != 0;
    }
    info.factorisation_count = counts.factorisations, info.path_solve_count = counts.path_solves;
    write_struct(out_info, info);
  });
}

hf_result hf_weights_record(hf_weights weights) {
  return change("hf_weights_record", weights, [](WeightsObject& object) { object.weights.record(); });
}

hf_result hf_weights_undo(hf_weights weights) {
  return change("hf_weights_undo", weights, [](WeightsObject& object) { object.weights.undo(); });
}

hf_result hf_weights_redo(hf_weights weights) {
  return change("hf_weights_redo", weights, [](WeightsObject& object) { object.weights.redo(); });
}

}  // extern "C"
