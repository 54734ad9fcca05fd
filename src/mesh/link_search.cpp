#include "mesh/link_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/link_constants.h"
#include "mesh/nearest_triangle.h"
#include "mesh/union_find.h"

namespace hf_inner {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Contact {
  Index vertex, triangle;
  double distance, cost;  // cost: with the difference of skin weights
};

// Contacts of the vertices of one piece with another piece.
struct PairSide {
  explicit PairSide(Memory& memory) : contacts(&memory) {}
  Vector<Contact> contacts;
};

struct Pair {
  Index a, b;
  double gap;       // lower bound of the distance: that of the boxes, or the range searched in vain
  double cost;      // of the nearest contact; unbounded: not found yet
  double distance;  // of the same
  bool in_tree = false;
};

class LinkSearch {
 public:
  LinkSearch(const Mesh& mesh, const Vector<double>& areas, const LinkOptions& options, Memory& memory, JobRunner* jobs,
             Links& out)
      : mesh_(mesh),
        areas_(areas),
        options_(options),
        memory_(memory),
        jobs_(jobs),
        out_(out),
        pieces_(at(mesh.component_count())),
        group_(&memory),
        tree_(mesh.positions, mesh.corners, group_of_triangles(), mesh.component_count(), memory),
        start_(pieces_ + 1, 0, &memory),
        vertex_(mesh.positions.size(), &memory),
        area_(pieces_, 0.0, &memory),
        forced_(pieces_, 0, &memory),
        sheet_(pieces_, 0, &memory),
        pairs_(&memory),
        sides_(&memory),
        pairs_of_(pieces_, &memory) {}

  void run() {
    list_pieces();
    list_pairs();
    find_sheets();
    poll();
    search_near();
    poll();
    grow_tree();
    find_light();
    poll();
    link_pairs();
    link_light();
  }

 private:
  Span<const Index> group_of_triangles() {
    group_.reserve(at(mesh_.triangle_count()));
    for (Index t = 0; t < mesh_.triangle_count(); ++t) group_.push_back(mesh_.component[at(mesh_.triangle(t)[0])]);
    return group_;
  }
  void list_pieces();
  void list_pairs();
  void search_near();
  void search_pair(Pair& pair, PairSide* sides, double range) const;
  void search_side(Index from, Index to, double range, double depth, PairSide& side) const;
  bool is_sheet(Index piece) const;
  void find_sheets();
  void grow_tree();
  void find_light();
  void link_pairs();
  void link_light();
  void link_spread(const Vector<Contact>& contacts, std::size_t most, double spacing, bool in_tree);
  void link_side(const Pair& pair, const PairSide& side);
  void add_link(const Contact& contact, bool in_tree);
  Span<const Index> vertices_of(Index piece) const noexcept {
    return {vertex_.data() + start_[at(piece)], at(start_[at(piece) + 1] - start_[at(piece)])};
  }
  std::uint32_t tag_of(Index piece) const {
    const Index first = vertex_[at(start_[at(piece)])];
    return options_.tags.empty() ? 0 : options_.tags[at(mesh_.given_of_inner[at(first)])];
  }
  bool smaller(Index a, Index b) const noexcept {
    return area_[at(a)] != area_[at(b)] ? area_[at(a)] < area_[at(b)] : a > b;
  }
  bool has_sheet(const Pair& pair) const noexcept { return sheet_[at(pair.a)] || sheet_[at(pair.b)]; }
  Index other_of(std::size_t pair, Index piece) const noexcept {
    return pairs_[pair].a == piece ? pairs_[pair].b : pairs_[pair].a;
  }

  const Mesh& mesh_;
  const Vector<double>& areas_;
  const LinkOptions& options_;
  Memory& memory_;
  JobRunner* jobs_;
  Links& out_;
  const std::size_t pieces_;
  Vector<Index> group_;  // piece by triangle
  NearestTriangle tree_;
  Vector<Index> start_, vertex_;  // the vertices of piece p: vertex_[start_[p] .. start_[p + 1])
  Vector<double> area_;           // by piece
  Vector<std::uint8_t> forced_;   // by piece: 1 light, 2 heavy
  Vector<std::uint8_t> sheet_;    // by piece: 1 if it lies over a larger piece
  Vector<Pair> pairs_;
  Vector<PairSide> sides_;                // two of every pair: of a, and of b
  Vector<Vector<std::size_t>> pairs_of_;  // by piece
  double whole_area_ = 0;
};

void LinkSearch::list_pieces() {
  for (const Index p : mesh_.component) ++start_[at(p) + 1];
  for (std::size_t p = 0; p < pieces_; ++p) start_[p + 1] += start_[p];
  Vector<Index> next(start_.begin(), start_.end() - 1, &memory_);
  for (std::size_t v = 0; v < mesh_.component.size(); ++v) {
    const std::size_t p = at(mesh_.component[v]);
    vertex_[at(next[p]++)] = static_cast<Index>(v);
    area_[p] += areas_[v], whole_area_ += areas_[v];
  }
  for (const Index v : options_.light) forced_[at(mesh_.component[at(v)])] = 1;
  for (const Index v : options_.heavy) forced_[at(mesh_.component[at(v)])] = 2;
}

// Lists the pairs of pieces whose boxes are near. Each piece keeps its nearest ones.
void LinkSearch::list_pairs() {
  struct Near {
    double gap, centres;
    Index other;
    bool operator<(const Near& o) const noexcept {
      return gap != o.gap ? gap < o.gap : centres != o.centres ? centres < o.centres : other < o.other;
    }
  };
  const double range = std::max({options_.distance, touching, overlay_reach * options_.overlay});
  Vector<Vector<Near>> near(pieces_, &memory_);
  Vector<Index> order(&memory_);
  Vector<NearestTriangle::Box> box(&memory_);
  for (std::size_t p = 0; p < pieces_; ++p) {
    order.push_back(static_cast<Index>(p)), box.push_back(tree_.box(static_cast<Index>(p)));
  }
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return box[at(a)].low.x != box[at(b)].low.x ? box[at(a)].low.x < box[at(b)].low.x : a < b;
  });
  const auto keep = [&](Index piece, const Near& found) {
    Vector<Near>& list = near[at(piece)];
    if (list.size() == pairs_a_piece) {
      if (!(found < list.front())) return;
      std::pop_heap(list.begin(), list.end()), list.pop_back();
    }
    list.push_back(found), std::push_heap(list.begin(), list.end());
  };
  for (std::size_t i = 0; i < pieces_; ++i) {
    const Index a = order[i];
    for (std::size_t j = i + 1; j < pieces_ && box[at(order[j])].low.x <= box[at(a)].high.x + range; ++j) {
      const Index b = order[j];
      const double gap = squared_distance(box[at(a)], box[at(b)]);
      if (gap > range * range || tag_of(a) != tag_of(b)) continue;
      const Vec3 between = box[at(a)].low + box[at(a)].high - box[at(b)].low - box[at(b)].high;
      keep(a, {gap, dot(between, between), b}), keep(b, {gap, dot(between, between), a});
    }
    if (i % 256 == 0) poll();
  }
  for (std::size_t p = 0; p < pieces_; ++p) {
    for (const Near& found : near[p]) {
      const Index a = std::min(static_cast<Index>(p), found.other), b = std::max(static_cast<Index>(p), found.other);
      pairs_.push_back({a, b, std::sqrt(found.gap), unbounded, unbounded});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  pairs_.erase(
      std::unique(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) { return x.a == y.a && x.b == y.b; }),
      pairs_.end());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    pairs_of_[at(pairs_[i].a)].push_back(i), pairs_of_[at(pairs_[i].b)].push_back(i);
    sides_.emplace_back(memory_), sides_.emplace_back(memory_);
  }
}

// Finds the contacts of piece `from` with piece `to` within a range. depth: contacts that cost this much more than the
// cheapest are left out.
void LinkSearch::search_side(Index from, Index to, double range, double depth, PairSide& side) const {
  const NearestTriangle::Box box = tree_.box(to);
  double reach = range;
  Index hint = -1;  // consecutive vertices are near each other
  for (const Index v : vertices_of(from)) {
    const Vec3 p = mesh_.positions[at(v)];
    if (!(squared_distance(p, box) < reach * reach)) continue;
    const NearestTriangle::Found found = tree_.find_in(to, p, reach * reach, hint);
    if (found.triangle < 0) continue;
    hint = found.triangle;
    Contact contact{v, found.triangle, std::sqrt(found.squared), 0};
    contact.cost = contact.distance;
    if (options_.skin.influence_count > 0) {
      double share[3];
      tree_.weights(p, found.triangle, share);
      contact.cost += skin_distance * difference(options_.skin, mesh_, v, mesh_.triangle(found.triangle), share);
    }
    side.contacts.push_back(contact);
    reach = std::min(reach, contact.cost + depth);
  }
}

// Searches both sides of a pair.
void LinkSearch::search_pair(Pair& pair, PairSide* sides, double range) const {
  pair.cost = pair.distance = unbounded;
  for (int k = 0; k < 2; ++k) {
    sides[k].contacts.clear();
    search_side(k == 0 ? pair.a : pair.b, k == 0 ? pair.b : pair.a, range, contact_depth, sides[k]);
    for (const Contact& contact : sides[k].contacts) {
      pair.cost = std::min(pair.cost, contact.cost), pair.distance = std::min(pair.distance, contact.distance);
    }
  }
  pair.gap = std::max(pair.gap, range);
}

void LinkSearch::search_near() {
  for_each(jobs_, static_cast<std::uint32_t>(pairs_.size()), [&](std::uint32_t i) {
    if (pairs_[i].gap < near_range && !has_sheet(pairs_[i]))
      search_pair(pairs_[i], &sides_[2 * std::size_t{i}], near_range);
  });
}

// Tells whether a piece lies over larger pieces, by some of its vertices.
bool LinkSearch::is_sheet(Index piece) const {
  if (forced_[at(piece)] != 0) return forced_[at(piece)] == 1;
  if (!(options_.overlay > 0) || !(area_[at(piece)] < light_area * whole_area_)) return false;
  const Span<const Index> all = vertices_of(piece);
  const std::size_t step = (all.size() + sheet_samples - 1) / sheet_samples;
  const double range = overlay_reach * options_.overlay;
  double whole = 0, near_any = 0, most = 0;
  Vector<double> nearest((all.size() + step - 1) / step, unbounded, &memory_);
  for (std::size_t i = 0; i < all.size(); i += step) whole += areas_[at(all[i])];
  for (const std::size_t pair : pairs_of_[at(piece)]) {
    const Index other = other_of(pair, piece);
    if (!smaller(piece, other)) continue;
    const NearestTriangle::Box box = tree_.box(other);
    double covered = 0;
    for (std::size_t i = 0; i < all.size(); i += step) {
      const Vec3 p = mesh_.positions[at(all[i])];
      // Once a vertex is near some piece, only the overlay distance matters.
      const double reach = nearest[i / step] < unbounded ? options_.overlay : range;
      if (!(squared_distance(p, box) < reach * reach)) continue;
      const NearestTriangle::Found found = tree_.find_in(other, p, reach * reach);
      if (found.triangle < 0) continue;
      nearest[i / step] = 0;
      if (found.squared <= options_.overlay * options_.overlay) covered += areas_[at(all[i])];
    }
    most = std::max(most, covered);
  }
  for (std::size_t i = 0; i < all.size(); i += step)
    near_any += nearest[i / step] < unbounded ? areas_[at(all[i])] : 0.0;
  return most >= light_cover * whole && near_any >= light_near * whole;
}

void LinkSearch::find_sheets() {
  for_each(jobs_, static_cast<std::uint32_t>(pieces_),
           [&](std::uint32_t p) { sheet_[p] = is_sheet(static_cast<Index>(p)); });
}

// Unites the nearest pieces first (Kruskal's algorithm). A pair is searched when no other pair can be nearer.
void LinkSearch::grow_tree() {
  struct Entry {
    double cost;
    std::size_t pair;
    bool operator<(const Entry& o) const noexcept {  // the nearest on top of the heap
      return cost != o.cost ? cost > o.cost : pair > o.pair;
    }
  };
  const auto entry_of = [&](std::size_t i) {
    const Pair& pair = pairs_[i];
    // Most sheets touch what they lie over, so that one search finds the tree's edge.
    const bool sheet = has_sheet(pair);
    const double guess = pair.gap + (sheet ? touching : 0);
    return Entry{(sheet ? sheet_detour : 0) + (pair.cost < unbounded ? pair.cost : guess), i};
  };
  UnionFind sets(pieces_, memory_);
  Vector<Entry> heap(&memory_);
  for (std::size_t i = 0; i < pairs_.size(); ++i) heap.push_back(entry_of(i));
  std::make_heap(heap.begin(), heap.end());
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const Entry entry = heap.back();
    heap.pop_back();
    Pair& pair = pairs_[entry.pair];
    if (sets.find(pair.a) == sets.find(pair.b)) continue;
    if (pair.cost < unbounded) {
      if (pair.distance <= options_.distance) pair.in_tree = sets.unite(pair.a, pair.b);
    } else if (pair.gap < options_.distance) {
      search_pair(pair, &sides_[2 * entry.pair], pair.gap < near_range ? near_range : options_.distance);
      if (pair.cost < unbounded || pair.gap < options_.distance)
        heap.push_back(entry_of(entry.pair)), std::push_heap(heap.begin(), heap.end());
    }
  }
}

// Sheets that are leaves of the tree are light, again and again. Others hold pieces together.
void LinkSearch::find_light() {
  Vector<Index> degree(pieces_, 0, &memory_), leaves(&memory_);
  for (const Pair& pair : pairs_) {
    if (pair.in_tree) ++degree[at(pair.a)], ++degree[at(pair.b)];
  }
  for (std::size_t p = 0; p < pieces_; ++p) {
    if (forced_[p] == 1) out_.light[p] = 1;
    if (sheet_[p] && degree[p] == 1) leaves.push_back(static_cast<Index>(p));
  }
  while (!leaves.empty()) {
    const Index p = leaves.back();
    leaves.pop_back();
    if (degree[at(p)] != 1) continue;  // the last of its group
    out_.light[at(p)] = 1, degree[at(p)] = 0;
    for (const std::size_t i : pairs_of_[at(p)]) {
      const Index other = other_of(i, p);
      if (pairs_[i].in_tree && degree[at(other)] > 0 && --degree[at(other)] == 1 && sheet_[at(other)])
        leaves.push_back(other);
    }
  }
}

void LinkSearch::add_link(const Contact& contact, bool in_tree) {
  Link link;
  link.vertex = contact.vertex, link.tree = in_tree;
  double share[3], sum = 0;
  tree_.weights(mesh_.positions[at(contact.vertex)], contact.triangle, share);
  for (double& s : share) s = s < least_share ? 0 : s, sum += s;
  for (std::size_t k = 0; k < 3; ++k) {
    if (share[k] > 0) link.share[k] = share[k] / sum, link.corner[k] = mesh_.triangle(contact.triangle)[k];
  }
  link.length = rest_length(link, mesh_);
  out_.links.push_back(link);
}

// Links contacts, the nearest first, then each as far as possible from those before: links_a_side of them, and more up
// to `most` while they are at least `spacing` apart.
void LinkSearch::link_spread(const Vector<Contact>& contacts, std::size_t most, double spacing, bool in_tree) {
  if (contacts.empty()) return;
  Vector<double> apart(contacts.size(), unbounded, &memory_);
  std::size_t next = 0;
  for (std::size_t i = 1; i < contacts.size(); ++i) next = contacts[i].cost < contacts[next].cost ? i : next;
  for (std::size_t count = 0; count < most && apart[next] > (count < links_a_side ? 0 : spacing); ++count) {
    add_link(contacts[next], in_tree);
    const Vec3 p = mesh_.positions[at(contacts[next].vertex)];
    for (std::size_t i = 0; i < contacts.size(); ++i)
      apart[i] = std::min(apart[i], norm(mesh_.positions[at(contacts[i].vertex)] - p));
    apart[next] = 0;
    next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
  }
}

void LinkSearch::link_side(const Pair& pair, const PairSide& side) {
  Vector<Contact> near(&memory_);
  for (const Contact& contact : side.contacts) {
    if (contact.cost <= pair.cost + contact_depth) near.push_back(contact);
  }
  link_spread(near, pair.in_tree ? links_a_side : links_a_side / 2, unbounded, pair.in_tree);
}

void LinkSearch::link_pairs() {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Pair& pair = pairs_[i];
    if (out_.light[at(pair.a)] || out_.light[at(pair.b)]) continue;
    if (!(pair.cost < unbounded) && pair.gap < near_range)
      search_pair(pair, &sides_[2 * i], near_range);  // a sheet, not light
    const bool alike = pair.cost - pair.distance <= skin_difference * skin_distance;
    const bool touches = pair.distance <= (alike ? touching : crossing_pieces);
    if (!pair.in_tree && !touches) continue;
    if (pair.in_tree) out_.longest_tree_link = std::max(out_.longest_tree_link, pair.distance);
    link_side(pair, sides_[2 * i]), link_side(pair, sides_[2 * i + 1]);
  }
}

// Links vertices of every light piece to the nearest points of larger pieces, or of its neighbour in the tree if there
// is no such point.
void LinkSearch::link_light() {
  Vector<Contact> best(mesh_.positions.size(), {Mesh::none, Mesh::none, unbounded, unbounded}, &memory_);
  Vector<Contact> found(&memory_);
  for (std::size_t p = 0; p < pieces_; ++p) {
    if (!out_.light[p]) continue;
    const double range = forced_[p] == 1 ? options_.distance : overlay_reach * options_.overlay;
    for (const std::size_t i : pairs_of_[p]) {
      const Index other = other_of(i, static_cast<Index>(p));
      if (out_.light[at(other)] && !smaller(static_cast<Index>(p), other)) continue;
      PairSide side(memory_);
      search_side(static_cast<Index>(p), other, range, unbounded, side);
      for (const Contact& contact : side.contacts) {
        if (contact.cost < best[at(contact.vertex)].cost) best[at(contact.vertex)] = contact;
      }
    }
    found.clear();
    for (const Index v : vertices_of(static_cast<Index>(p))) {
      if (best[at(v)].vertex != Mesh::none) found.push_back(best[at(v)]);
    }
    link_spread(found, found.size(), light_spacing, true);
    for (const std::size_t i : pairs_of_[p]) {
      if (!found.empty() || !pairs_[i].in_tree) continue;
      link_side(pairs_[i], sides_[2 * i]), link_side(pairs_[i], sides_[2 * i + 1]);
    }
  }
}

}  // namespace

void search_links(const Mesh& mesh, const Vector<double>& areas, const LinkOptions& options, Memory& memory,
                  JobRunner* jobs, Links& out) {
  if (mesh.component_count() > most_linked_pieces)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%d pieces; at most %d are linked automatically, so give a list of links",
         mesh.component_count(), most_linked_pieces);
  LinkSearch(mesh, areas, options, memory, jobs, out).run();
}

}  // namespace hf_inner
