#include "weights/informants.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "mesh/orientation.h"
#include "weights/constants.h"
#include "weights/piece_bones.h"

namespace hf_inner::weights {
namespace {

struct Found {
  Index bone[most_informants];
  double distance = 0;
  std::int32_t count = 0;
};

struct Candidate {
  Index bone;
  double distance;  // as it counts
  Vec3 place;       // on the bone
};

Vector<mesh::ItemBox> segment_boxes(const Vector<BoneSegment>& segments, Memory& memory) {
  Vector<mesh::ItemBox> boxes(&memory);
  for (const BoneSegment& s : segments) {
    mesh::ItemBox box = mesh::ItemBox::of(s.head);
    box.take(s.tail);
    boxes.push_back(box);
  }
  return boxes;
}

// The search of one thread. It keeps its list of candidates between vertices.
class Search {
 public:
  Search(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const Vector<BoneSegment>& segments,
         const mesh::BoxTree& tree, Memory& memory)
      : mesh_(mesh), skin_(skin), segments_(segments), tree_(tree), candidates_(&memory) {}

  // Whether a vertex faces the bone that is nearest to it.
  bool faces_nearest(Index v) const {
    const Vec3 p = mesh_.positions[at(v)];
    double best = HUGE_VAL;
    Vec3 nearest;
    tree_.near(
        p, [&] { return best; },
        [&](Index i) {
          const Vec3 away = p - mesh::nearest_on_segment(p, segments_[at(i)].head, segments_[at(i)].tail);
          if (!(dot(away, away) < best)) return;
          best = dot(away, away);
          nearest = away;
        });
    return dot(nearest, skin_.normals()[at(v)]) < 0;
  }

  // The nearest bones of a vertex; none if it does not see them. has_front: a bone in front of the vertex counts as
  // farther than one behind it.
  Found find(Index v, bool has_front, bool see_through) {
    const Vec3 p = mesh_.positions[at(v)], normal = skin_.normals()[at(v)];
    candidates_.clear();
    double best = HUGE_VAL;
    // A distance counts as at least its length times 2 / (1 + facing_excess).
    constexpr double bound = 0.5 * (1 + facing_excess);
    const auto reach = [&] {
      const double plain = best * equal_distance * bound;
      return plain * plain;
    };
    tree_.near(p, reach, [&](Index i) {
      const Vec3 place = mesh::nearest_on_segment(p, segments_[at(i)].head, segments_[at(i)].tail);
      const Vec3 away = p - place;
      const double length = norm(away);
      const double turned = length > 0 ? dot(away, normal) / length : 1.0;
      const double cosine = has_front ? turned : std::fabs(turned);
      const double distance = length / (0.5 * (cosine + facing_excess));
      if (distance > best * equal_distance) return;
      best = std::min(best, distance);
      candidates_.push_back({segments_[at(i)].bone, distance, place});
    });
    return seen(v, p, best, see_through);
  }

 private:
  Found seen(Index v, const Vec3& p, double best, bool see_through) {
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.bone != b.bone ? a.bone < b.bone : a.distance < b.distance;
    });
    Found out;
    out.distance = best;
    for (const Candidate& candidate : candidates_) {
      if (candidate.distance > best * equal_distance || out.count == most_informants) continue;
      if (out.count > 0 && out.bone[out.count - 1] == candidate.bone) continue;
      if (!see_through && skin_.crosses(p, candidate.place, mesh_.component[at(v)], v, false)) continue;
      out.bone[out.count++] = candidate.bone;
    }
    return out;
  }

  const mesh::Mesh& mesh_;
  const mesh::SkinShape& skin_;
  const Vector<BoneSegment>& segments_;
  const mesh::BoxTree& tree_;
  Vector<Candidate> candidates_;
};

// By piece: 0 where an open surface faces its bones. It has no inside, so its front says nothing.
template <class MakeSearch>
Vector<std::uint8_t> find_fronts(const mesh::Mesh& mesh, const MakeSearch& make_search, Memory& memory,
                                 JobRunner& jobs) {
  const std::size_t n = at(mesh.vertex_count());
  const Vector<double> openness = mesh::component_openness(mesh, memory);
  Vector<std::uint8_t> faces(n, 0, &memory), out(openness.size(), 1, &memory);
  for_ranges(jobs, n, vertex_piece, [&](std::size_t begin, std::size_t end) {
    const Search search = make_search();
    for (std::size_t v = begin; v < end; ++v) {
      if (openness[at(mesh.component[v])] > solid_openness) faces[v] = search.faces_nearest(static_cast<Index>(v));
    }
  });
  Vector<double> all(out.size(), 0, &memory), facing(out.size(), 0, &memory);
  for (std::size_t v = 0; v < n; ++v) {
    all[at(mesh.component[v])] += 1;
    facing[at(mesh.component[v])] += faces[v];
  }
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = facing[c] < front_share * all[c];
  return out;
}

// Among pieces with none of their bones in sight, keeps the pieces that use them unseen. Small pieces do not: they get
// the weights of other pieces, if those have weights.
void keep_askers(const mesh::Mesh& mesh, bool others_see, Vector<std::uint8_t>& blind, Memory& memory) {
  const Vector<mesh::ItemBox> boxes = piece_boxes(mesh, memory);
  Vector<std::uint8_t> large(blind.size(), 0, &memory);
  for (std::size_t c = 0; c < blind.size(); ++c)
    large[c] = blind[c] && norm(boxes[c].high - boxes[c].low) >= rigid_size;
  if (others_see || std::find(large.begin(), large.end(), 1) != large.end()) blind = std::move(large);
}

}  // namespace

Informants find_informants(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const Vector<BoneSegment>& segments,
                           Memory& memory, JobRunner& jobs) {
  const std::size_t n = at(mesh.vertex_count());
  const mesh::BoxTree tree(segment_boxes(segments, memory), memory);
  const auto make_search = [&] { return Search(mesh, skin, segments, tree, memory); };
  const Vector<std::uint8_t> has_front = find_fronts(mesh, make_search, memory, jobs);
  Vector<Found> found(n, &memory);
  Vector<std::uint8_t> asks(has_front.size(), 1, &memory);  // by piece
  const auto ask = [&](bool see_through) {
    for_ranges(jobs, n, vertex_piece, [&](std::size_t begin, std::size_t end) {
      Search search = make_search();
      for (std::size_t v = begin; v < end; ++v) {
        const std::size_t c = at(mesh.component[v]);
        if (asks[c]) found[v] = search.find(static_cast<Index>(v), has_front[c], see_through);
      }
    });
  };
  ask(false);
  for (std::size_t v = 0; v < n; ++v) {
    if (found[v].count > 0) asks[at(mesh.component[v])] = 0;
  }
  Informants out(memory);
  if (std::find(asks.begin(), asks.end(), 1) != asks.end()) {
    keep_askers(mesh, std::find(asks.begin(), asks.end(), 0) != asks.end(), asks, memory);
    out.blind = std::find(asks.begin(), asks.end(), 1) != asks.end();
    ask(true);
  }
  out.screening.assign(n, 0.0);
  out.by_piece.assign(at(mesh.component_count()), 0);
  out.start.reserve(n + 1);
  out.start.push_back(0);
  for (std::size_t v = 0; v < n; ++v) {
    const Found& f = found[v];
    out.bone.insert(out.bone.end(), f.bone, f.bone + f.count);
    out.start.push_back(static_cast<Index>(out.bone.size()));
    if (f.count == 0) continue;
    ++out.informed;
    ++out.by_piece[at(mesh.component[v])];
    const double d = std::max(f.distance, least_distance);
    out.screening[v] = screening_strength * f.count / (d * d);
  }
  return out;
}

}  // namespace hf_inner::weights
