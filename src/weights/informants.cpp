#include "weights/informants.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "weights/constants.h"

namespace hf_inner {
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

Vector<ItemBox> segment_boxes(const Vector<BoneSegment>& segments, Memory& memory) {
  Vector<ItemBox> boxes(&memory);
  for (const BoneSegment& s : segments) {
    ItemBox box = ItemBox::of(s.head);
    box.take(s.tail);
    boxes.push_back(box);
  }
  return boxes;
}

// The search of one thread. It keeps its list of candidates between vertices.
class Search {
 public:
  Search(const Mesh& mesh, const SkinShape& skin, const Vector<BoneSegment>& segments, const BoxTree& tree,
         Memory& memory)
      : mesh_(mesh), skin_(skin), segments_(segments), tree_(tree), candidates_(&memory) {}

  // The nearest bones of a vertex; none if it does not see them.
  Found find(Index v, bool see_through) {
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
      const Vec3 place = nearest_on_segment(p, segments_[at(i)].head, segments_[at(i)].tail);
      const Vec3 away = p - place;
      const double length = norm(away);
      const double cosine = length > 0 ? dot(away, normal) / length : 1.0;
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

  const Mesh& mesh_;
  const SkinShape& skin_;
  const Vector<BoneSegment>& segments_;
  const BoxTree& tree_;
  Vector<Candidate> candidates_;
};

}  // namespace

Informants find_informants(const Mesh& mesh, const SkinShape& skin, const Vector<BoneSegment>& segments, Memory& memory,
                           JobRunner& jobs) {
  const std::size_t n = at(mesh.vertex_count());
  const BoxTree tree(segment_boxes(segments, memory), memory);
  Vector<Found> found(n, &memory);
  Informants out(memory);
  for (const bool see_through : {false, true}) {
    out.blind = see_through;
    for_ranges(jobs, n, vertex_piece, [&](std::size_t begin, std::size_t end) {
      Search search(mesh, skin, segments, tree, memory);
      for (std::size_t v = begin; v < end; ++v) found[v] = search.find(static_cast<Index>(v), see_through);
    });
    if (std::any_of(found.begin(), found.end(), [](const Found& f) { return f.count > 0; })) break;
  }
  out.screening.assign(n, 0.0);
  out.by_island.assign(at(mesh.component_count()), 0);
  out.start.reserve(n + 1);
  out.start.push_back(0);
  for (std::size_t v = 0; v < n; ++v) {
    const Found& f = found[v];
    out.bone.insert(out.bone.end(), f.bone, f.bone + f.count);
    out.start.push_back(static_cast<Index>(out.bone.size()));
    if (f.count == 0) continue;
    ++out.informed;
    ++out.by_island[at(mesh.component[v])];
    const double d = std::max(f.distance, least_distance);
    out.screening[v] = screening_strength * f.count / (d * d);
  }
  return out;
}

}  // namespace hf_inner
