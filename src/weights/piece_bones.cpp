#include "weights/piece_bones.h"

#include <algorithm>
#include <tuple>

#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

constexpr std::size_t directions = 26;  // to the sides, edges and corners of a cube
constexpr std::size_t places_a_bone = 1 + bone_places;

Vec3 place_on(const BoneSegment& s, std::size_t place) noexcept {
  return place == 0 ? s.head : s.head + ((static_cast<double>(place) - 0.5) / bone_places) * (s.tail - s.head);
}

// The search of one thread for the pieces around a point.
class Around {
 public:
  // tree: of the boxes of the pieces.
  Around(const mesh::SkinShape& skin, const Vector<mesh::ItemBox>& boxes, const mesh::BoxTree& tree, Memory& memory)
      : skin_(skin), boxes_(boxes), tree_(tree), near_(&memory), count_(&memory), hit_(&memory) {
    for (int i = 0; i < 27; ++i) {
      if (i == 13) continue;  // the middle of the cube
      const Vec3 corner{i % 3 - 1 + piece_tilt[0], i / 3 % 3 - 1 + piece_tilt[1], i / 9 - 1 + piece_tilt[2]};
      way_[i - (i > 13)] = unit_vector(corner);
    }
  }
  // Appends the pieces that enough of the rays meet, ascending. From outside a box at most 17 rays meet it.
  void find(const Vec3& p, Vector<Index>& out) {
    static_assert(around_rays > 17, "pieces whose boxes do not contain the point are not tried");
    near_.clear();
    double length = 0;  // that leaves the boxes
    tree_.near(
        p, [] { return 0.0; },
        [&](Index piece) {
          const mesh::ItemBox& box = boxes_[at(piece)];
          near_.push_back(piece);
          length = std::max(length, 1.01 * norm(box.high - box.low));
        });
    std::sort(near_.begin(), near_.end());
    count_.assign(near_.size(), 0);
    std::size_t most = 0;
    for (std::size_t ray = 0; ray < directions && !near_.empty(); ++ray) {
      if (most + directions - ray < around_rays) return;
      skin_.pieces_along(p, p + length * way_[ray], hit_);
      for (const Index piece : hit_) {
        const auto place = std::lower_bound(near_.begin(), near_.end(), piece);
        if (place == near_.end() || *place != piece) continue;
        most = std::max(most, ++count_[static_cast<std::size_t>(place - near_.begin())]);
      }
    }
    for (std::size_t i = 0; i < near_.size(); ++i) {
      if (count_[i] >= around_rays) out.push_back(near_[i]);
    }
  }

 private:
  const mesh::SkinShape& skin_;
  const Vector<mesh::ItemBox>& boxes_;
  const mesh::BoxTree& tree_;
  Vec3 way_[directions];
  Vector<Index> near_;
  Vector<std::size_t> count_;  // of rays that meet each of near_
  Vector<Index> hit_;
};

struct Entry {
  Index piece, bone, segment, place;
};

}  // namespace

Vector<mesh::ItemBox> piece_boxes(const mesh::Mesh& mesh, Memory& memory) {
  Vector<mesh::ItemBox> out(at(mesh.component_count()), &memory);
  Vector<std::uint8_t> seen(out.size(), 0, &memory);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t c = at(mesh.component[at(v)]);
    if (!seen[c]) {
      out[c] = mesh::ItemBox::of(mesh.positions[at(v)]);
      seen[c] = 1;
    }
    out[c].take(mesh.positions[at(v)]);
  }
  return out;
}

PieceBones find_piece_bones(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const Vector<BoneSegment>& segments,
                            Memory& memory, JobRunner& jobs) {
  const std::size_t places = segments.size() * places_a_bone;
  const Vector<mesh::ItemBox> boxes = piece_boxes(mesh, memory);
  const mesh::BoxTree tree(boxes, memory);
  Vector<Vector<Index>> around(places, Vector<Index>(&memory), &memory);
  for_ranges(jobs, places, place_piece, [&](std::size_t begin, std::size_t end) {
    Around search(skin, boxes, tree, memory);
    for (std::size_t i = begin; i < end; ++i)
      search.find(place_on(segments[i / places_a_bone], i % places_a_bone), around[i]);
  });
  Vector<Entry> entries(&memory);
  for (std::size_t i = 0; i < places; ++i) {
    const std::size_t s = i / places_a_bone;
    for (const Index piece : around[i])
      entries.push_back({piece, segments[s].bone, static_cast<Index>(s), static_cast<Index>(i % places_a_bone)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.piece, a.bone, a.segment, a.place) < std::tie(b.piece, b.bone, b.segment, b.place);
  });
  PieceBones out(memory);
  out.start.assign(at(mesh.component_count()) + 1, 0);
  for (std::size_t i = 0; i < entries.size();) {
    const Entry& first = entries[i];
    HeldBone held{first.bone, 0, 0, false, segments[at(first.segment)].head};
    while (i < entries.size() && entries[i].piece == first.piece && entries[i].bone == first.bone) {
      const Index segment = entries[i].segment;
      Index inside = 0;
      for (; i < entries.size() && entries[i].piece == first.piece && entries[i].segment == segment; ++i)
        entries[i].place == 0 ? held.has_head = true : (++inside, false);
      const BoneSegment& s = segments[at(segment)];
      const double share = static_cast<double>(inside) / bone_places;
      held.share = std::max(held.share, share);
      held.length += share * norm(s.tail - s.head);
    }
    ++out.start[at(first.piece) + 1];
    out.bones.push_back(held);
  }
  for (std::size_t c = 1; c < out.start.size(); ++c) out.start[c] += out.start[c - 1];
  return out;
}

}  // namespace hf_inner::weights
