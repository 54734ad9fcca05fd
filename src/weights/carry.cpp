#include "weights/carry.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weights/constants.h"

namespace hf_inner::weights {

FilledWeights transfer_weights(const mesh::Mesh& source, const mesh::SkinShape& source_skin, const GivenWeights& given,
                               std::shared_ptr<const surface::Core> target, const MatchOptions& options,
                               const surface::Surface* surface) {
  Memory& memory = *target->memory;
  const mesh::Mesh& mesh = target->mesh;
  const WeightRows rows = read_rows(
      source, given, [](Index) { return true; }, memory);
  const WeightedShape shape(source, source_skin, rows, memory);
  if (shape.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no vertex of the source has a weight above 0");
  const mesh::SkinShape skin(mesh, memory);
  const auto clamped = [](double x) { return std::min(std::max(x, -farthest), farthest); };
  const auto probe = [&](Index v, Probe& out) {
    const Vec3 p = source.to_inner(mesh.to_given(mesh.positions[at(v)]));
    out = {{clamped(p.x), clamped(p.y), clamped(p.z)}, skin.normals()[at(v)]};
    return true;
  };
  Fill fill(std::move(target), memory, surface);
  fill.origin.assign(at(mesh.vertex_count()), Origin::matched);
  const auto take_rows = [&](const Vector<Match>& matches, WeightRows& out) {
    for (const Match& match : matches) {
      if (match.triangle >= 0) shape.add(match, [&](Index bone, double share) { out.add(bone, share); });
      out.close();
    }
  };
  take_rows(find_matches(shape, *fill.core, options, false, probe), fill.known);
  const Vector<std::uint8_t> known = known_pieces(mesh, fill.known, memory);
  const auto probe_rest = [&](Index v, Probe& out) { return !known[at(mesh.component[at(v)])] && probe(v, out); };
  WeightRows guessed(memory);
  take_rows(find_matches(shape, *fill.core, options, true, probe_rest), guessed);
  return fill_weights(fill, guessed, options.influences);
}

}  // namespace hf_inner::weights
