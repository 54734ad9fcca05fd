// Pairs of hf_gltf/gltf.h.
#include "gltf/api_objects.h"
#include "gltf/json_file.h"
#include "gltf/suggest_pairs.h"
#include "hf/transfer.h"

namespace hf_gltf {
namespace {

void write_axes(const Axes& axes, float* out) {
  const glm::dvec3* rows[] = {&axes.right, &axes.up, &axes.forward};
  for (size_t r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) out[3 * r + static_cast<size_t>(c)] = static_cast<float>((*rows[r])[c]);
}

std::shared_ptr<PairsObject> pairs_of(const ModelObject& source, const ModelObject& target, const nlohmann::json& json,
                                      const char* what) {
  auto out = std::make_shared<PairsObject>();
  out->pairs = parse_pairs(json, what);
  if (!out->pairs.chains.empty())
    throw Failure(HF_ERROR_INVALID_ARGUMENT,
                  std::string(what) + ": chains: they name joints, and surfaces have none; take them away");
  const RegionFinder source_finder(source.model, source.mesh, out->pairs.source_axes),
      target_finder(target.model, target.mesh, out->pairs.target_axes);
  add_regions(out->pairs.pairs, source_finder, target_finder, out->source, out->target);
  out->source_diagonal = source_finder.diagonal();
  out->target_diagonal = target_finder.diagonal();
  const double given = out->pairs.settings.scale;
  out->scale =
      given > 0 ? given : leg_scale(know_body(source.model, source.mesh), know_body(target.model, target.mesh));
  out->confidence.assign(out->pairs.pairs.size(), 1.0);
  out->text = json.dump(2);
  return out;
}

void need_surfaces(const ModelObject& source, const ModelObject& target) {
  if (source.mesh.positions.empty()) throw Failure(HF_ERROR_EMPTY, "the source has no triangles", 0);
  if (target.mesh.positions.empty()) throw Failure(HF_ERROR_EMPTY, "the target has no triangles", 1);
}

std::vector<uint32_t> tips_of(const ModelObject& object, const uint32_t* tips, uint32_t count, const char* name) {
  if (count == 0) return {};
  need(tips, name);
  for (uint32_t i = 0; i < count; ++i)
    if (tips[i] >= object.mesh.vertex_count())
      throw Failure(HF_ERROR_OUT_OF_RANGE, std::string(name) + ": there is no vertex " + std::to_string(tips[i]), i);
  return {tips, tips + count};
}

const PairEntry& entry_of(const PairsObject& object, uint32_t index) {
  if (index >= object.pairs.pairs.size())
    throw Failure(HF_ERROR_OUT_OF_RANGE,
                  "pair " + std::to_string(index) + " of " + std::to_string(object.pairs.pairs.size()), index);
  return object.pairs.pairs[index];
}

void write_list(const std::vector<uint32_t>& from, uint32_t capacity, uint32_t* to, const char* name) {
  if (!to) return;
  if (capacity < from.size())
    throw Failure(HF_ERROR_TOO_SMALL, std::string(name) + " is " + std::to_string(capacity) + "; " +
                                          std::to_string(from.size()) + " are needed");
  std::copy(from.begin(), from.end(), to);
}

}  // namespace
}  // namespace hf_gltf

using namespace hf_gltf;

extern "C" {

hf_result hf_gltf_pairs_propose(hf_gltf_model source, hf_gltf_model target, const hf_gltf_propose_desc* desc,
                                hf_gltf_pairs* out_pairs) {
  return guarded(
      __func__,
      [&] {
        create(out_pairs, "out_pairs", [&] {
          const Reading<ModelObject> from(source, "source"), to(target, "target");
          hf_gltf_propose_desc given = HF_INIT(hf_gltf_propose_desc);
          if (desc) given = sized(desc, "desc");
          need_surfaces(*from, *to);
          const Suggestion suggestion = suggest_pairs(
              {from->model, from->mesh, tips_of(*from, given.source_tips, given.source_tip_count, "source_tips")},
              {to->model, to->mesh, tips_of(*to, given.target_tips, given.target_tip_count, "target_tips")});
          std::shared_ptr<PairsObject> out = pairs_of(*from, *to, suggestion.file, "the proposed pairs");
          for (size_t i = 0; i < suggestion.pairs.size(); ++i) out->confidence[i] = suggestion.pairs[i].confidence;
          return out;
        });
      },
      HF_ERROR_EMPTY);
}

hf_result hf_gltf_pairs_read(hf_gltf_model source, hf_gltf_model target, const char* text, uint64_t byte_count,
                             hf_gltf_pairs* out_pairs) {
  return guarded(__func__, [&] {
    create(out_pairs, "out_pairs", [&] {
      const Reading<ModelObject> from(source, "source"), to(target, "target");
      need(text, "text");
      need_surfaces(*from, *to);
      return pairs_of(*from, *to, parse_json(text, static_cast<size_t>(byte_count), "the pairs"), "the pairs");
    });
  });
}

void hf_gltf_pairs_destroy(hf_gltf_pairs pairs) { destroy<PairsObject>(pairs); }

hf_result hf_gltf_pairs_get_info(hf_gltf_pairs pairs, hf_gltf_pairs_info* out_info) {
  return guarded(__func__, [&] {
    const Reading<PairsObject> object(pairs, "pairs");
    hf_gltf_pairs_info& info = sized(out_info, "out_info");
    info.pair_count = static_cast<uint32_t>(object->pairs.pairs.size());
    write_axes(object->pairs.source_axes, info.source_axes);
    write_axes(object->pairs.target_axes, info.target_axes);
    info.scale = static_cast<float>(object->scale);
    info.ground = object->pairs.settings.ground ? HF_GROUND_KEEP : HF_GROUND_OFF;
  });
}

hf_result hf_gltf_pairs_get_pair(hf_gltf_pairs pairs, uint32_t index, hf_gltf_pair* out_pair) {
  return guarded(__func__, [&] {
    const Reading<PairsObject> object(pairs, "pairs");
    hf_gltf_pair& out = sized(out_pair, "out_pair");
    const PairEntry& entry = entry_of(*object, index);
    const Region &source = object->source[index], &target = object->target[index];
    out.flags = entry.flags();
    out.confidence = object->confidence[index];
    out.source_count = static_cast<uint32_t>(source.vertices.size());
    out.target_count = static_cast<uint32_t>(target.vertices.size());
    for (int c = 0; c < 3; ++c) {
      out.source_place[c] = source.seed[c];
      out.target_place[c] = target.seed[c];
    }
    out.source_radius = entry.source.front().radius * object->source_diagonal;
    out.target_radius = entry.target.front().radius * object->target_diagonal;
    copy_text(entry.name.c_str(), out.name, sizeof out.name);
  });
}

hf_result hf_gltf_pairs_get_regions(hf_gltf_pairs pairs, uint32_t index, uint32_t source_capacity,
                                    uint32_t* source_vertices, uint32_t target_capacity, uint32_t* target_vertices) {
  return guarded(__func__, [&] {
    const Reading<PairsObject> object(pairs, "pairs");
    entry_of(*object, index);
    write_list(object->source[index].vertices, source_capacity, source_vertices, "source_capacity");
    write_list(object->target[index].vertices, target_capacity, target_vertices, "target_capacity");
  });
}

hf_result hf_gltf_pairs_write(hf_gltf_pairs pairs, uint64_t capacity, char* text, uint64_t* out_count) {
  return guarded(__func__, [&] {
    const Reading<PairsObject> object(pairs, "pairs");
    need(out_count, "out_count");
    write_text(object->text, capacity, text, out_count);
  });
}

}  // extern "C"
