#include "weights/mirror.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

// The part of a vertex: it keeps its weights, takes mirrored ones, or takes the mean of both.
enum class Role : std::uint8_t { keeps, takes, means };

Role role_of(MirrorTo to, double side) noexcept {
  if (to == MirrorTo::both || std::fabs(side) <= mirror_seam) return Role::means;
  return (side > 0) == (to == MirrorTo::negative) ? Role::keeps : Role::takes;
}

void count_misses(const Vector<Match>& matches, MirroredWeights& out) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < matches.size(); ++v) {
    if (matches[v].triangle < 0) continue;
    const double off = std::sqrt(matches[v].squared);
    out.mean_off += off;
    ++count;
    if (out.worst < 0 || off > out.worst_off) {
      out.worst_off = off;
      out.worst = static_cast<Index>(v);
    }
  }
  if (count > 0) out.mean_off /= static_cast<double>(count);
}

}  // namespace

BoneMisses bone_misses(const BonePairs& pairs, double scale) noexcept {
  BoneMisses out;
  std::uint32_t paired = 0;
  for (std::size_t b = 0; b < pairs.by.size(); ++b) {
    ++out.by[static_cast<std::size_t>(pairs.by[b])];
    if (pairs.by[b] == PairedBy::none) continue;
    const double off = scale * pairs.off[b];
    ++paired;
    out.mean += off;
    if (out.worst_joint == HF_NO_INDEX || off > out.worst) {
      out.worst_joint = static_cast<std::uint32_t>(b);
      out.worst = off;
    }
  }
  if (paired > 0) out.mean /= paired;
  return out;
}

MirroredWeights mirror_weights(const SkinSurface& surface, const GivenWeights& given, const MirrorBones& bones,
                               const MirrorOptions& options, const surface::Surface* whose) {
  const std::shared_ptr<const surface::Core>& core = surface.core;
  Memory& memory = *core->memory;
  const mesh::Mesh& mesh = core->mesh;
  MirroredWeights out(memory);
  if (options.has_plane) {
    out.plane = options.plane;
  } else if (!plane_of_bones(bones.heads, bones.partner, out.plane, memory)) {
    out.plane = plane_of_surface(*core, memory);
  }
  out.pairs = pair_bones(bones.heads, bones.partner, bones.given, out.plane, memory);
  Vector<Role> role(&memory);
  for (const Vec3& p : mesh.positions) role.push_back(role_of(options.to, out.plane.side(p)));

  const auto gives = [&](Index v) { return role[at(v)] != Role::takes; };
  const WeightRows rows = read_rows(mesh, given, gives, memory);
  const WeightedShape shape(mesh, surface.skin, rows, memory);
  if (shape.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no vertex of the side to copy from has a weight above 0");
  const auto probe = [&](Index v, Probe& to) {
    if (role[at(v)] == Role::keeps) return false;
    to = {out.plane.reflect(mesh.positions[at(v)]), out.plane.turn(surface.skin.normals()[at(v)])};
    return true;
  };
  const Vector<Match> nearest = find_matches(shape, *core, options.carry, true, probe);
  const Vector<Match> matches = find_matches(shape, *core, options.carry, false, probe);
  count_misses(nearest, out);

  Fill fill(core, memory, whose);
  fill.origin.assign(at(mesh.vertex_count()), Origin::matched);
  const auto add_own = [&](Index v) {
    for (const Share& share : rows.of(v)) fill.known.add(share.bone, share.weight);
  };
  const auto add_turned = [&](WeightRows& to, Index bone, double share) {
    to.add(at(bone) < out.pairs.partner.size() ? out.pairs.partner[at(bone)] : bone, share);
  };
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Match& match = matches[at(v)];
    switch (role[at(v)]) {
      case Role::keeps:
        fill.origin[at(v)] = Origin::kept;
        add_own(v);
        break;
      case Role::takes:
        if (match.triangle >= 0)
          shape.add(match, [&](Index bone, double share) { add_turned(fill.known, bone, share); });
        break;
      case Role::means:
        add_own(v);
        if (options.to != MirrorTo::both) {
          for (const Share& share : rows.of(v)) add_turned(fill.known, share.bone, share.weight);
        } else if (match.triangle >= 0) {
          shape.add(match, [&](Index bone, double share) { add_turned(fill.known, bone, share); });
        } else {
          fill.origin[at(v)] = Origin::kept;
        }
        break;
    }
    fill.known.close();
  }
  const Vector<std::uint8_t> known = known_pieces(mesh, fill.known, memory);
  // Pieces without any weight on the side to copy from get the weights of the nearest points of that side.
  const Vector<Match> beside = find_matches(shape, *core, options.carry, true, [&](Index v, Probe& to) {
    to.place = mesh.positions[at(v)];
    return role[at(v)] == Role::keeps && !known[at(mesh.component[at(v)])];
  });
  WeightRows guessed(memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const bool there = beside[at(v)].triangle >= 0;
    const Match& match = there ? beside[at(v)] : nearest[at(v)];
    if (!known[at(mesh.component[at(v)])] && match.triangle >= 0) {
      shape.add(match, [&](Index bone, double share) {
        if (there) {
          guessed.add(bone, share);
        } else {
          add_turned(guessed, bone, share);
        }
      });
    }
    guessed.close();
  }
  out.filled = fill_weights(fill, guessed, options.carry.influences);
  return out;
}

}  // namespace hf_inner::weights
