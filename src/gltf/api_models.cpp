// Models and clips of hf_gltf/gltf.h.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gltf/animate.h"
#include "gltf/api_arguments.h"
#include "gltf/api_objects.h"
#include "gltf/clip_binding.h"
#include "gltf/file_name.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/key_reduce.h"
#include "gltf/rig_fit.h"
#include "gltf/skin_write.h"

namespace hf_gltf {
namespace {

bool has_triangles(const Model& model) {
  return std::any_of(model.nodes.begin(), model.nodes.end(), [&](const Node& node) {
    if (node.mesh < 0) return false;
    const std::vector<Primitive>& primitives = model.meshes[static_cast<size_t>(node.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(), [](const Primitive& primitive) {
      return primitive.topology == Topology::triangles && !primitive.indices.empty();
    });
  });
}

std::shared_ptr<ModelObject> object_of(Model model) {
  auto out = std::make_shared<ModelObject>();
  out->model = std::move(model);
  if (has_triangles(out->model)) out->mesh = flatten(out->model);
  return out;
}

void need_surface(const ModelObject& object) {
  if (object.mesh.positions.empty()) throw Failure(HF_ERROR_EMPTY, "the model has no triangles");
}

// Positions of one frame as the C++ side takes them.
std::vector<double> frame_of(const double* positions, size_t vertices, size_t frame) {
  return {positions + 3 * vertices * frame, positions + 3 * vertices * (frame + 1)};
}

void write_positions(const std::vector<glm::dvec3>& from, double* to) {
  for (size_t v = 0; v < from.size(); ++v)
    for (int c = 0; c < 3; ++c) to[3 * v + static_cast<size_t>(c)] = from[v][c];
}

// 8 joints and weights of a vertex of the surface. A joint is a node. A mesh without a skin hangs on its node.
void write_influences(const ModelObject& object, uint16_t* joints, float* weights) {
  const size_t count = object.model.nodes.size();
  if (joints && count > 65536)
    throw Failure(HF_ERROR_TOO_LARGE, std::to_string(count) + " joints; joints holds numbers below 65536");
  const size_t total = size_t{8} * object.mesh.positions.size();
  if (joints) std::fill(joints, joints + total, uint16_t{0});
  if (weights) std::fill(weights, weights + total, 0.0f);
  for (const FlatPart& part : object.mesh.parts) {
    const int skin = object.model.nodes[static_cast<size_t>(part.node)].skin;
    const Primitive& primitive =
        object.model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    const bool skinned = skin >= 0 && !primitive.influences.empty();
    for (size_t v = 0; v < part.vertex_count; ++v) {
      const size_t at = 8 * (part.first_vertex + v);
      if (!skinned) {
        if (joints) joints[at] = static_cast<uint16_t>(part.node);
        if (weights) weights[at] = 1;
        continue;
      }
      const std::vector<int>& nodes = object.model.skins[static_cast<size_t>(skin)].joints;
      const Influences& from = primitive.influences[v];
      for (size_t i = 0; i < 8; ++i) {
        if (joints && from.weights[i] > 0) joints[at + i] = static_cast<uint16_t>(nodes[from.joints[i]]);
        if (weights) weights[at + i] = from.weights[i];
      }
    }
  }
}

Model read_model(const hf_gltf_read_desc& desc) {
  const std::string name = desc.file ? desc.file : "the model";
  if (desc.bytes) {
    if (desc.byte_count > ReadLimits().max_file_bytes)
      throw Failure(HF_ERROR_TOO_LARGE, name + " has " + std::to_string(desc.byte_count) + " bytes; the limit is " +
                                            std::to_string(ReadLimits().max_file_bytes));
    const auto* bytes = static_cast<const uint8_t*>(desc.bytes);
    return read_gltf_bytes({bytes, bytes + desc.byte_count}, name);
  }
  if (!desc.file) throw Failure(HF_ERROR_NULL_POINTER, "bytes and file are both NULL");
  return read_gltf(file_named(name));
}

}  // namespace
}  // namespace hf_gltf

using namespace hf_gltf;

extern "C" {

hf_result hf_gltf_error_get_detail(hf_error_detail* out_detail) {
  if (!out_detail) return HF_ERROR_NULL_POINTER;
  *out_detail = last_detail();
  return HF_OK;
}

hf_result hf_gltf_model_read(const hf_gltf_read_desc* desc, hf_gltf_model* out_model) {
  return guarded(__func__,
                 [&] { create(out_model, "out_model", [&] { return object_of(read_model(sized(desc, "desc"))); }); });
}

hf_result hf_gltf_model_create(const hf_gltf_mesh_desc* desc, hf_gltf_model* out_model) {
  return guarded(__func__, [&] {
    create(out_model, "out_model", [&] {
      const hf_gltf_mesh_desc& mesh = sized(desc, "desc");
      if (mesh.vertex_count == 0 || mesh.triangle_count == 0)
        throw Failure(HF_ERROR_EMPTY, "there are no vertices or no triangles");
      need(mesh.positions, "positions");
      need(mesh.triangles, "triangles");
      std::vector<glm::dvec3> positions(mesh.vertex_count);
      for (size_t v = 0; v < positions.size(); ++v) {
        const double* p = mesh.positions + 3 * v;
        constexpr double most = std::numeric_limits<float>::max();  // what a file can hold
        if (!(std::abs(p[0]) <= most && std::abs(p[1]) <= most && std::abs(p[2]) <= most))
          throw Failure(HF_ERROR_NON_FINITE, "vertex " + std::to_string(v) + " is not finite",
                        static_cast<uint32_t>(v));
        positions[v] = {p[0], p[1], p[2]};
      }
      const size_t corners = size_t{3} * mesh.triangle_count;
      for (size_t i = 0; i < corners; ++i)
        if (mesh.triangles[i] >= mesh.vertex_count)
          throw Failure(HF_ERROR_OUT_OF_RANGE,
                        "triangle " + std::to_string(i / 3) + " names vertex " + std::to_string(mesh.triangles[i]),
                        static_cast<uint32_t>(i / 3));
      return object_of(
          make_model(mesh.name ? mesh.name : "mesh", positions, {mesh.triangles, mesh.triangles + corners}));
    });
  });
}

void hf_gltf_model_destroy(hf_gltf_model model) { destroy<ModelObject>(model); }

hf_result hf_gltf_model_get_info(hf_gltf_model model, hf_gltf_model_info* out_info) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    hf_gltf_model_info& info = sized(out_info, "out_info");
    const Model& of = object->model;
    info.vertex_count = object->mesh.vertex_count();
    info.triangle_count = object->mesh.triangle_count();
    info.clip_count = static_cast<uint32_t>(of.animations.size());
    info.joint_count = static_cast<uint32_t>(of.nodes.size());
    info.note_count = static_cast<uint32_t>(of.notes.size() + of.warnings.size());
    info.has_skin = has_skin(of);
    info.name_byte_count = static_cast<uint32_t>(joint_names(of).size() + 1);
  });
}

hf_result hf_gltf_model_get_note(hf_gltf_model model, uint32_t index, uint32_t capacity, char* text) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    const std::vector<std::string>&warnings = object->model.warnings, &notes = object->model.notes;
    const size_t at = numbered(index, warnings.size() + notes.size(), "note");
    need(text, "text");
    if (capacity == 0) throw Failure(HF_ERROR_TOO_SMALL, "capacity is 0");
    copy_text((at < warnings.size() ? warnings[at] : notes[at - warnings.size()]).c_str(), text, capacity);
  });
}

hf_result hf_gltf_model_get_surface(hf_gltf_model model, const hf_gltf_surface* out_surface) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    const hf_gltf_surface& out = sized(out_surface, "out_surface");
    need_surface(*object);
    write_influences(*object, out.joints, out.weights);
    if (out.positions) write_positions(object->mesh.positions, out.positions);
    if (out.triangles) std::copy(object->mesh.triangles.begin(), object->mesh.triangles.end(), out.triangles);
  });
}

hf_result hf_gltf_model_set_positions(hf_gltf_model model, const double* positions) {
  return guarded(__func__, [&] {
    const Changing<ModelObject> object(model, "model");
    need_surface(*object);
    need(positions, "positions");
    const size_t count = object->mesh.positions.size();
    need_finite(positions, 3 * count, 3, "vertex");
    Model changed = object->model;
    scatter(changed, object->mesh, to_points(frame_of(positions, count, 0)));
    FlatMesh mesh = flatten(changed);
    std::swap(object->model, changed);
    std::swap(object->mesh, mesh);
  });
}

hf_result hf_gltf_model_write(hf_gltf_model model, int32_t format, uint64_t capacity, void* bytes,
                              uint64_t* out_count) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    need(out_count, "out_count");
    if (format != HF_GLTF_GLB && format != HF_GLTF_TEXT)
      throw Failure(HF_ERROR_INVALID_ARGUMENT, "format is " + std::to_string(format) + "; take an HF_GLTF_ value");
    write_text(gltf_bytes(object->model, format == HF_GLTF_GLB), capacity, bytes, out_count);
  });
}

hf_result hf_gltf_model_save(hf_gltf_model model, const char* file) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    need(file, "file");
    write_gltf(object->model, file_named(file));
  });
}

hf_result hf_gltf_model_get_clip(hf_gltf_model model, uint32_t clip, hf_gltf_clip_info* out_info) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    hf_gltf_clip_info& info = sized(out_info, "out_info");
    const Animation& of = object->model.animations[numbered(clip, object->model.animations.size(), "clip")];
    info.key_count = static_cast<uint32_t>(key_count(of));
    info.duration = clip_duration(of);
    copy_text(of.name.c_str(), info.name, sizeof info.name);
  });
}

hf_result hf_gltf_model_pose(hf_gltf_model model, uint32_t clip, double time, double* positions) {
  return guarded(__func__, [&] {
    const Reading<ModelObject> object(model, "model");
    const size_t at = numbered(clip, object->model.animations.size(), "clip");
    need_surface(*object);
    need(positions, "positions");
    need_finite(&time, 1, 1, "time");
    write_positions(posed_positions(object->model, object->mesh, object->model.animations[at], time), positions);
  });
}

hf_result hf_gltf_model_add_clip(hf_gltf_model model, const hf_gltf_frames_desc* desc, hf_gltf_fit_info* out_info) {
  return guarded(__func__, [&] {
    const Changing<ModelObject> object(model, "model");
    const hf_gltf_frames_desc& given = sized(desc, "desc");
    if (out_info) sized(out_info, "out_info");
    need_surface(*object);
    need(given.positions, "positions");
    if (!has_skin(object->model))
      throw Failure(HF_ERROR_UNSUPPORTED, "the model has no skin; hf_gltf_model_create_skinned makes one");
    const std::vector<double> times = times_of(given.times, given.frame_count);
    const size_t vertices = object->mesh.positions.size(), frames = given.frame_count;
    need_finite(given.positions, 3 * vertices * frames, 3 * vertices, "frame");
    if (given.firm) need_finite(given.firm, vertices * frames, vertices, "firm: frame");
    std::vector<std::vector<double>> wanted;
    for (size_t f = 0; f < frames; ++f) wanted.push_back(frame_of(given.positions, vertices, f));
    const RigFit rig(object->model, object->mesh);
    // The caller does not say where the ground is. glTF has y up, so it is where the frames are lowest.
    const std::vector<uint8_t>& loose = object->mesh.loose;
    double lowest = std::numeric_limits<double>::infinity();
    for (size_t v = 0; v < vertices * frames; ++v)
      if (!loose[v % vertices]) lowest = std::min(lowest, given.positions[3 * v + 1]);
    const RigGround ground = {{0, 1, 0}, std::vector<double>(frames, lowest), {}};
    const auto firm = [&](size_t f) -> std::vector<double> {
      if (!given.firm) return {};
      return {given.firm + vertices * f, given.firm + vertices * (f + 1)};
    };
    const std::vector<RigPose> poses = rig.fit_all(times, wanted, firm, &ground);
    const auto count =
        static_cast<double>(std::count(loose.begin(), loose.end(), 0) * static_cast<std::ptrdiff_t>(frames));
    double sum = 0, most = 0;
    for (size_t f = 0; f < frames; ++f) {
      const std::vector<glm::dvec3> got = posed_positions(object->model, object->mesh, rig.whole(poses[f]));
      for (size_t v = 0; v < vertices; ++v) {
        if (loose[v]) continue;
        const double* to = wanted[f].data() + 3 * v;
        const double off = glm::distance(got[v], glm::dvec3(to[0], to[1], to[2]));
        sum += off * off;
        most = std::max(most, off);
      }
    }
    insert_clip(object->model, 0, rig.clip(given.name ? given.name : "", times, poses));
    if (!out_info) return;
    out_info->joint_count = static_cast<uint32_t>(rig.turning());
    out_info->rms = std::sqrt(sum / count);
    out_info->max = most;
  });
}

hf_result hf_gltf_model_create_skinned(hf_gltf_model model, const hf_gltf_skin_desc* desc, hf_gltf_model* out_model) {
  return guarded(__func__, [&] {
    create(out_model, "out_model", [&] {
      const Reading<ModelObject> object(model, "model");
      const hf_gltf_skin_desc& given = sized(desc, "desc");
      need_surface(*object);
      need(given.pivots, "pivots");
      need(given.joints, "joints");
      need(given.weights, "weights");
      need(given.rotations, "rotations");
      need(given.translations, "translations");
      SkinDescription skin;
      SkinClip clip;
      clip.name = given.name ? given.name : "";
      clip.times = times_of(given.times, given.frame_count);
      const size_t joints = given.joint_count;
      for (size_t j = 0; j < joints; ++j) {
        const double* p = given.pivots + 3 * j;
        skin.joints.push_back({"joint_" + std::to_string(j), {p[0], p[1], p[2]}});
      }
      for (size_t i = 0; i < joints * given.frame_count; ++i) {
        const double *q = given.rotations + 4 * i, *t = given.translations + 3 * i;
        const glm::dquat rotation(q[3], q[0], q[1], q[2]);
        clip.rotations.push_back(rotation);
        clip.translations.push_back(glm::dvec3(t[0], t[1], t[2]) - rotation * skin.joints[i % joints].pivot);
      }
      skin.influences_per_vertex = given.influence_count;
      const size_t influences = object->mesh.positions.size() * given.influence_count;
      skin.vertex_joints.assign(given.joints, given.joints + influences);
      skin.vertex_weights.assign(given.weights, given.weights + influences);
      skin.clips.push_back(std::move(clip));
      Model made = skin_model(object->model, object->mesh, skin);
      keep_carried(object->model, made);
      check_model(made);
      return object_of(std::move(made));
    });
  });
}

hf_result hf_gltf_model_add_clips_of(hf_gltf_model model, hf_gltf_model other, uint32_t* out_joint_count) {
  return guarded(__func__, [&] {
    const Changing<ModelObject> object(model, "model");
    const Reading<ModelObject> clips(other, "other");
    BoundClips bound = bind_clips(object->model, clips->model, "all");
    std::swap(object->model, bound.model);
    if (out_joint_count) *out_joint_count = static_cast<uint32_t>(bound.joints);
  });
}

hf_result hf_gltf_model_remove_keys(hf_gltf_model model, uint32_t clip, double tolerance, double* out_distance) {
  return guarded(__func__, [&] {
    const Changing<ModelObject> object(model, "model");
    const size_t at = numbered(clip, object->model.animations.size(), "clip");
    need_surface(*object);
    if (!std::isfinite(tolerance) || tolerance < 0)
      throw Failure(HF_ERROR_INVALID_ARGUMENT, "tolerance must be a length, 0 or more");
    Animation reduced = object->model.animations[at];
    const double distance = reduce_keys(object->model, object->mesh, reduced, tolerance);
    std::swap(object->model.animations[at], reduced);
    if (out_distance) *out_distance = distance;
  });
}

}  // extern "C"
