#include "weights/piece_bones.h"

#include <algorithm>
#include <tuple>

#include "weights/constants.h"

namespace hf_inner {
namespace {

constexpr int directions = 26;  // to the sides, edges and corners of a cube
constexpr std::size_t places_a_bone = 1 + bone_places;

Vec3 place_on(const BoneSegment& s, std::size_t place) noexcept {
  return place == 0 ? s.head : s.head + ((static_cast<double>(place) - 0.5) / bone_places) * (s.tail - s.head);
}

// The search of one thread for the islands around a point.
class Around {
 public:
  Around(const SkinShape& skin, Memory& memory) : skin_(skin), hit_(&memory), all_(&memory) {
    for (int i = 0; i < 27; ++i) {
      if (i == 13) continue;  // the middle of the cube
      const Vec3 corner{i % 3 - 1 + piece_tilt[0], i / 3 % 3 - 1 + piece_tilt[1], i / 9 - 1 + piece_tilt[2]};
      way_[i - (i > 13)] = ray_length * unit_vector(corner);
    }
  }
  // Appends the islands that enough of the rays meet, ascending.
  void find(const Vec3& p, Vector<Index>& out) {
    all_.clear();
    for (const Vec3& way : way_) {
      skin_.islands_along(p, p + way, hit_);
      all_.insert(all_.end(), hit_.begin(), hit_.end());
    }
    std::sort(all_.begin(), all_.end());
    for (std::size_t i = 0; i < all_.size();) {
      std::size_t end = i;
      while (end < all_.size() && all_[end] == all_[i]) ++end;
      if (end - i >= around_rays) out.push_back(all_[i]);
      i = end;
    }
  }

 private:
  const SkinShape& skin_;
  Vec3 way_[directions];
  Vector<Index> hit_, all_;
};

struct Entry {
  Index island, bone, segment, place;
};

}  // namespace

PieceBones find_piece_bones(const Mesh& mesh, const SkinShape& skin, const Vector<BoneSegment>& segments,
                            Memory& memory, JobRunner& jobs) {
  const std::size_t places = segments.size() * places_a_bone;
  Vector<Vector<Index>> around(places, Vector<Index>(&memory), &memory);
  for_ranges(jobs, places, place_piece, [&](std::size_t begin, std::size_t end) {
    Around search(skin, memory);
    for (std::size_t i = begin; i < end; ++i)
      search.find(place_on(segments[i / places_a_bone], i % places_a_bone), around[i]);
  });
  Vector<Entry> entries(&memory);
  for (std::size_t i = 0; i < places; ++i) {
    const std::size_t s = i / places_a_bone;
    for (const Index island : around[i])
      entries.push_back({island, segments[s].bone, static_cast<Index>(s), static_cast<Index>(i % places_a_bone)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.island, a.bone, a.segment, a.place) < std::tie(b.island, b.bone, b.segment, b.place);
  });
  PieceBones out(memory);
  out.start.assign(at(mesh.component_count()) + 1, 0);
  for (std::size_t i = 0; i < entries.size();) {
    const Entry& first = entries[i];
    HeldBone held{first.bone, 0, 0, false, segments[at(first.segment)].head};
    while (i < entries.size() && entries[i].island == first.island && entries[i].bone == first.bone) {
      const Index segment = entries[i].segment;
      Index inside = 0;
      for (; i < entries.size() && entries[i].island == first.island && entries[i].segment == segment; ++i)
        entries[i].place == 0 ? held.has_head = true : (++inside, false);
      const BoneSegment& s = segments[at(segment)];
      const double share = static_cast<double>(inside) / bone_places;
      held.share = std::max(held.share, share), held.length += share * norm(s.tail - s.head);
    }
    ++out.start[at(first.island) + 1];
    out.bones.push_back(held);
  }
  for (std::size_t c = 1; c < out.start.size(); ++c) out.start[c] += out.start[c - 1];
  return out;
}

}  // namespace hf_inner
