#include "weights/rigid_pieces.h"

#include <algorithm>

#include "mesh/orientation.h"
#include "mesh/union_find.h"
#include "weights/constants.h"
#include "weights/piece_bones.h"
#include "weights/piece_contacts.h"

namespace hf_inner::weights {
namespace {

// The data of a piece before a bone is chosen.
struct Shape {
  double area = 0;
  mesh::ItemBox box;
  bool solid = false;
};

// The largest smooth weights of a piece, as the mean over its area.
struct Mean {
  Index column[kept_shares];
  double share[kept_shares];
};

enum class Kind { other, robot, creature };

// The families of the bones that pieces hold: each belongs to the next one above that a piece holds. Without
// parents all are one family.
mesh::UnionFind bone_families(const Bones& bones, const Vector<std::uint8_t>& held, Memory& memory) {
  mesh::UnionFind out(held.size(), memory);
  const bool has_parents =
      std::any_of(bones.parent.begin(), bones.parent.end(), [](Index parent) { return parent >= 0; });
  constexpr Index unknown = -2;
  Vector<Index> above(held.size(), unknown, &memory);  // the next held one, -1 without one
  Index before = -1;
  for (Index b = 0; b < bones.count(); ++b) {
    if (!held[at(b)]) continue;
    Index top = has_parents ? bones.parent[at(b)] : before;
    while (top >= 0 && !held[at(top)] && above[at(top)] == unknown) top = bones.parent[at(top)];
    const Index found = top < 0 || held[at(top)] ? top : above[at(top)];
    for (Index i = bones.parent[at(b)]; has_parents && i != top; i = bones.parent[at(i)]) above[at(i)] = found;
    if (found >= 0) out.unite(b, found);
    before = b;
  }
  return out;
}

class RigidPieces {
 public:
  RigidPieces(const Solution& solution, const Bones& bones, const Vector<BoneSegment>& segments)
      : solution_(solution),
        core_(*solution.surface->core),
        mesh_(core_.mesh),
        memory_(*core_.memory),
        column(at(mesh_.component_count()), -1, &memory_),
        held_(find_piece_bones(mesh_, solution.surface->skin, segments, memory_, *core_.jobs)),
        bends_(find_bending(bones)),
        shapes_(column.size(), &memory_),
        waits_(column.size(), 0, &memory_),
        mean_(column.size(), &memory_) {}

  void run() {
    measure();
    kind_ = kind_of_surface();
    if (kind_ == Kind::other) return;
    choose_own();
    take_from_others();
  }

 private:
  const Solution& solution_;
  const surface::Core& core_;
  const mesh::Mesh& mesh_;
  Memory& memory_;

 public:
  Vector<Index> column;  // by piece

 private:
  bool robot() const noexcept { return kind_ == Kind::robot; }
  std::size_t width() const noexcept { return solution_.width(); }
  std::ptrdiff_t holds(std::size_t piece) const noexcept {
    const Span<const HeldBone> held = held_.of(static_cast<Index>(piece));
    return std::count_if(held.begin(), held.end(), is_held);
  }
  static bool is_held(const HeldBone& h) noexcept { return h.share >= held_share; }

  // Finds the pieces that bend: those that hold many bones, and those that hold a whole family of several, as an arm
  // of two bones does.
  Vector<std::uint8_t> find_bending(const Bones& bones) const {
    Vector<std::uint8_t> held(bones.head.size(), 0, &memory_), out(column.size(), 0, &memory_);
    for (const HeldBone& h : held_.bones) held[at(h.bone)] |= is_held(h);
    mesh::UnionFind families = bone_families(bones, held, memory_);
    Vector<Index> size(held.size(), 0, &memory_), own(held.size(), 0, &memory_);
    for (Index b = 0; b < bones.count(); ++b) size[at(families.find(b))] += held[at(b)];
    for (std::size_t c = 0; c < out.size(); ++c) {
      const Span<const HeldBone> here = held_.of(static_cast<Index>(c));
      out[c] = holds(c) >= bending_bones;
      for (const HeldBone& h : here) {
        const std::size_t family = at(families.find(h.bone));
        if (is_held(h) && ++own[family] == size[family] && size[family] > 1) out[c] = 1;
      }
      for (const HeldBone& h : here) own[at(families.find(h.bone))] = 0;
    }
    return out;
  }

  void measure() {
    const Vector<double> openness = mesh::component_openness(mesh_, memory_);
    const Vector<mesh::ItemBox> boxes = piece_boxes(mesh_, memory_);
    for (std::size_t c = 0; c < shapes_.size(); ++c) {
      shapes_[c].box = boxes[c];
      shapes_[c].solid = openness[c] <= solid_openness;
    }
    for (Index t = 0; t < mesh_.triangle_count(); ++t) {
      const Index* v = mesh_.triangle(t);
      const Vec3 a = mesh_.positions[at(v[0])];
      shapes_[at(mesh_.component[at(v[0])])].area +=
          norm(cross(mesh_.positions[at(v[1])] - a, mesh_.positions[at(v[2])] - a));
    }
  }

  double size(std::size_t piece) const noexcept { return norm(shapes_[piece].box.high - shapes_[piece].box.low); }
  bool may_be_worn(std::size_t piece) const noexcept { return holds(piece) == 0 && size(piece) < small_piece; }

  // Whether all pieces but one are small and hold no bone. That piece then keeps its own result: it bends.
  bool has_one_body() const noexcept {
    std::size_t bodies = 0;
    for (std::size_t c = 0; c < shapes_.size(); ++c) bodies += !may_be_worn(c);
    return bodies == 1;
  }

  // The kind of the surface: solid parts that hardly bend, or a body that bends with worn parts.
  Kind kind_of_surface() const {
    double bends = 0, solid = 0, all = 0;
    for (std::size_t c = 0; c < shapes_.size(); ++c) {
      const Shape& shape = shapes_[c];
      all += shape.area;
      if (bends_[c]) bends += shape.area;
      if (shape.solid) solid += shape.area;
    }
    if (bends >= robot_bends * all) return Kind::creature;
    if (solid < robot_solid * all) return Kind::other;
    return has_one_body() ? Kind::creature : Kind::robot;
  }

  // The column of the bone that a piece of a robot holds, or -1. mean: its smooth weights by column.
  Index own_column(std::size_t piece, const Vector<double>& mean) const {
    const mesh::ItemBox& box = shapes_[piece].box;
    const Vec3 middle = 0.5 * (box.low + box.high);
    const double near = joint_reach * norm(box.high - box.low);
    Index longest = -1, joint = -1;
    double length = 0;
    for (const HeldBone& held : held_.of(static_cast<Index>(piece))) {
      const Index c = solution_.column_of[at(held.bone)];
      if (c < 0) continue;
      if (held.share >= owned_share && held.length > length) {
        longest = c;
        length = held.length;
      }
      if (held.has_head && norm(held.head - middle) < near && (joint < 0 || mean[at(c)] > mean[at(joint)])) joint = c;
    }
    return longest >= 0 ? longest : joint;
  }

  // Gives pieces of a robot the bones that they hold, and marks the pieces that take one from others.
  void choose_own() {
    const std::size_t pieces = column.size();
    Vector<Index> start(pieces + 1, 0, &memory_), order(at(core_.size()), &memory_);
    for (const Index c : mesh_.component) ++start[at(c) + 1];
    for (std::size_t c = 0; c < pieces; ++c) start[c + 1] += start[c];
    Vector<Index> next(start.begin(), start.end() - 1, &memory_);
    for (Index v = 0; v < core_.size(); ++v) order[at(next[at(mesh_.component[at(v)])]++)] = v;
    Vector<double> mean(width(), &memory_);
    for (std::size_t c = 0; c < pieces; ++c) {
      const bool candidate = robot() ? !bends_[c] : may_be_worn(c);
      if (!candidate || solution_.informants.by_piece[c] == 0) continue;
      std::fill(mean.begin(), mean.end(), 0.0);
      double area = 0;
      for (Index i = start[c]; i < start[c + 1]; ++i) {
        const std::size_t v = at(order[at(i)]);
        area += core_.areas[v];
        for (std::size_t k = 0; k < width(); ++k) mean[k] += core_.areas[v] * solution_.field[v * width() + k];
      }
      if (!(area > 0)) continue;
      for (double& m : mean) m /= area;
      if (robot()) column[c] = own_column(c, mean);
      if (column[c] < 0) {
        waits_[c] = 1;
        keep_largest(mean, mean_[c]);
      }
    }
  }

  static void keep_largest(const Vector<double>& mean, Mean& out) {
    std::fill_n(out.column, kept_shares, -1);
    std::fill_n(out.share, kept_shares, 0.0);
    for (std::size_t k = 0; k < mean.size(); ++k) {
      double share = mean[k];
      Index place = static_cast<Index>(k);
      for (std::size_t i = 0; i < kept_shares; ++i) {
        if (share > out.share[i]) {
          std::swap(share, out.share[i]);
          std::swap(place, out.column[i]);
        }
      }
    }
  }

  // Pieces that wait take a bone one after the other, first the one that most touches others which do not wait. Where
  // none touches any, the largest is first.
  void take_from_others() {
    if (std::find(waits_.begin(), waits_.end(), 1) == waits_.end()) return;
    const PieceContacts contacts(core_, waits_, memory_);
    const std::size_t pieces = column.size();
    Vector<double> strength(pieces, 0.0, &memory_), sum(width(), &memory_);
    struct Open {
      double strength, area;
      Index piece;
      bool operator<(const Open& b) const noexcept {
        if (strength != b.strength) return strength < b.strength;
        return area != b.area ? area < b.area : piece > b.piece;
      }
    };
    Vector<Open> open(&memory_);
    const auto settle = [&](Index piece) {
      for (const Index i : contacts.to(piece)) {
        const PieceContact& contact = contacts.all[at(i)];
        if (!waits_[at(contact.piece)]) continue;
        strength[at(contact.piece)] += contact.strength;
        open.push_back({strength[at(contact.piece)], shapes_[at(contact.piece)].area, contact.piece});
        std::push_heap(open.begin(), open.end());
      }
    };
    for (std::size_t c = 0; c < pieces; ++c) {
      if (waits_[c]) {
        open.push_back({0, shapes_[c].area, static_cast<Index>(c)});
        std::push_heap(open.begin(), open.end());
      }
    }
    for (std::size_t c = 0; c < pieces; ++c) {
      if (!waits_[c] && solution_.informants.by_piece[c] > 0) settle(static_cast<Index>(c));
    }
    while (!open.empty()) {
      std::pop_heap(open.begin(), open.end());
      const Open next = open.back();
      open.pop_back();
      const std::size_t c = at(next.piece);
      if (!waits_[c] || next.strength != strength[c]) continue;
      column[c] = taken_column(c, contacts, strength[c], sum);
      waits_[c] = 0;
      settle(next.piece);
    }
  }

  // The column with the largest mean of the weights at contacts and of the piece's own.
  Index taken_column(std::size_t piece, const PieceContacts& contacts, double strength, Vector<double>& sum) const {
    std::fill(sum.begin(), sum.end(), 0.0);
    const double own = strength > 0 ? 0.5 : 1.0;
    for (std::size_t i = 0; i < kept_shares; ++i) {
      if (mean_[piece].column[i] >= 0) sum[at(mean_[piece].column[i])] += own * mean_[piece].share[i];
    }
    for (const Index i : contacts.from(static_cast<Index>(piece))) {
      const PieceContact& contact = contacts.all[at(i)];
      const std::size_t other = at(mesh_.component[at(contact.vertex)]);
      if (waits_[other] || solution_.informants.by_piece[other] == 0) continue;
      const double share = (1 - own) * contact.strength / strength;
      if (column[other] >= 0) {
        sum[at(column[other])] += share;
      } else {
        for (std::size_t k = 0; k < width(); ++k) sum[k] += share * solution_.field[at(contact.vertex) * width() + k];
      }
    }
    const double most = *std::max_element(sum.begin(), sum.end());
    // A piece that asks for one bone and touches another alone has equal sums. Contacts decide then, not rounding.
    const auto own_share = [&](std::size_t k) {
      const Mean& mean = mean_[piece];
      const Index* const found = std::find(mean.column, mean.column + kept_shares, static_cast<Index>(k));
      return found == mean.column + kept_shares ? 0.0 : mean.share[found - mean.column];
    };
    std::size_t best = sum.size();
    for (std::size_t k = 0; k < sum.size(); ++k) {
      if (sum[k] < most - equal_sums) continue;
      if (best == sum.size() || own_share(k) < own_share(best) - equal_sums) best = k;
    }
    return robot() || most >= clear_share ? static_cast<Index>(best) : -1;
  }

  PieceBones held_;
  Vector<std::uint8_t> bends_;  // by piece
  Vector<Shape> shapes_;
  Vector<std::uint8_t> waits_;  // by piece: it takes a bone from others
  Vector<Mean> mean_;           // by piece that waits
  Kind kind_ = Kind::other;
};

}  // namespace

Vector<Index> rigid_columns(const Solution& solution, const Bones& bones, const Vector<BoneSegment>& segments) {
  const mesh::Mesh& mesh = solution.surface->core->mesh;
  if (mesh.component_count() < 2)
    return Vector<Index>(at(mesh.component_count()), -1, solution.surface->core->memory.get());
  RigidPieces pieces(solution, bones, segments);
  pieces.run();
  return std::move(pieces.column);
}

}  // namespace hf_inner::weights
