#include "mesh/link_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/link_constants.h"
#include "mesh/union_find.h"

namespace hf_inner::mesh {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
// Pieces whose neighbours are looked for between two looks at a cancel: 256 of 400 pieces take 0.2 ms. No link depends
// on it.
constexpr std::size_t pieces_per_poll = 256;

// A bound that contacts of this cost are below.
double least_above(double cost) noexcept { return cost * (1 + 4 * std::numeric_limits<double>::epsilon()); }

struct Pair {
  Index a, b;
  double gap;       // lower bound of the distance: between the boxes, or the range searched in vain
  double skin;      // lower bound of what skin weights add to the distance
  double cost;      // of the cheapest contact; unbounded: not found yet
  double distance;  // of the nearest
  bool in_tree = false;
  bool kin = false;  // their joints are parent and child
  Index steps = 0;   // between the joints of the cheapest contact
  double unlike() const noexcept { return (cost - distance) / std::max(1, steps); }
};

// Gives all weight to a corner that is near the point of these barycentrics.
void snap_to_corner(const Mesh& mesh, const Index* corner, double within, double* share) noexcept {
  Vec3 point;
  for (std::size_t k = 0; k < 3; ++k) point = point + share[k] * mesh.positions[at(corner[k])];
  double distance[3];
  for (std::size_t k = 0; k < 3; ++k) distance[k] = norm(mesh.positions[at(corner[k])] - point);
  const std::size_t nearest = static_cast<std::size_t>(std::min_element(distance, distance + 3) - distance);
  if (distance[nearest] > within) return;
  for (std::size_t k = 0; k < 3; ++k) share[k] = k == nearest ? 1 : 0;
}

class LinkSearch {
 public:
  LinkSearch(const Mesh& mesh, Span<const double> areas, const LinkOptions& options, const ContactSearch& contacts,
             Memory& memory, JobRunner* jobs, Links& out)
      : mesh_(mesh),
        areas_(areas),
        options_(options),
        memory_(memory),
        jobs_(jobs),
        out_(out),
        pieces_(at(mesh.component_count())),
        contacts_(contacts),
        area_(pieces_, 0.0, &memory),
        forced_(pieces_, 0, &memory),
        sheet_(pieces_, 0, &memory),
        pairs_(&memory),
        pairs_of_(pieces_, &memory) {}

  void run() {
    list_pieces();
    list_pairs();
    find_sheets();
    poll();
    measure_near();
    poll();
    grow_tree();
    find_light();
    poll();
    link_pairs();
    link_light();
  }

 private:
  void list_pieces();
  void list_pairs();
  void measure_near();
  void measure_pair(Pair& pair, double range) const;
  bool is_sheet(Index piece) const;
  void find_sheets();
  void grow_tree();
  void find_light();
  void link_pairs();
  void link_light();
  void find_below(Index piece, Vector<Contact>& best) const;
  void link_spread(const Vector<Contact>& contacts, std::size_t most, double spacing, bool in_tree, Vector<Link>& to);
  void link_hinge(Vector<Contact>* sides, bool in_tree);
  void link_pair(const Pair& pair);
  void list_open(const Pair& pair);
  double edge_length(const Link& link) const;
  void add_link(const Contact& contact, bool in_tree, Vector<Link>& to);
  std::uint32_t tag_of(Index piece) const {
    const Index first = contacts_.vertices_of(piece)[0];
    return options_.tags.empty() ? 0 : options_.tags[at(mesh_.given_of_inner[at(first)])];
  }
  bool smaller(Index a, Index b) const noexcept {
    return area_[at(a)] != area_[at(b)] ? area_[at(a)] < area_[at(b)] : a > b;
  }
  // Pieces of joints that are no neighbours never do.
  static bool may_touch(const Pair& pair) noexcept {
    return pair.gap < touching && (pair.kin || pair.skin <= skin_difference * skin_distance);
  }
  static bool is_kin(const Contact& contact) noexcept { return contact.steps <= 1; }
  bool is_light(Index vertex) const noexcept { return out_.light[at(mesh_.component[at(vertex)])] != 0; }
  bool has_sheet(const Pair& pair) const noexcept { return sheet_[at(pair.a)] || sheet_[at(pair.b)]; }
  Index other_of(std::size_t pair, Index piece) const noexcept {
    return pairs_[pair].a == piece ? pairs_[pair].b : pairs_[pair].a;
  }

  const Mesh& mesh_;
  Span<const double> areas_;
  const LinkOptions& options_;
  Memory& memory_;
  JobRunner* jobs_;
  Links& out_;
  const std::size_t pieces_;
  const ContactSearch& contacts_;
  Vector<double> area_;          // by piece
  Vector<std::uint8_t> forced_;  // by piece: 1 light, 2 heavy
  Vector<std::uint8_t> sheet_;   // by piece: 1 if it lies over a larger piece
  Vector<Pair> pairs_;
  Vector<Vector<std::size_t>> pairs_of_;  // by piece
};

void LinkSearch::list_pieces() {
  for (std::size_t v = 0; v < mesh_.component.size(); ++v) area_[at(mesh_.component[v])] += areas_[v];
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
  Vector<ItemBox> box(&memory_);
  for (std::size_t p = 0; p < pieces_; ++p) {
    order.push_back(static_cast<Index>(p));
    box.push_back(contacts_.box(static_cast<Index>(p)));
  }
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return box[at(a)].low.x != box[at(b)].low.x ? box[at(a)].low.x < box[at(b)].low.x : a < b;
  });
  const auto keep = [&](Index piece, const Near& found) {
    Vector<Near>& list = near[at(piece)];
    if (list.size() == pairs_a_piece) {
      if (!(found < list.front())) return;
      std::pop_heap(list.begin(), list.end());
      list.pop_back();
    }
    list.push_back(found);
    std::push_heap(list.begin(), list.end());
  };
  for (std::size_t i = 0; i < pieces_; ++i) {
    const Index a = order[i];
    for (std::size_t j = i + 1; j < pieces_ && box[at(order[j])].low.x <= box[at(a)].high.x + range; ++j) {
      const Index b = order[j];
      const double gap = squared_distance(box[at(a)], box[at(b)]);
      if (gap > range * range || tag_of(a) != tag_of(b)) continue;
      const Vec3 between = box[at(a)].low + box[at(a)].high - box[at(b)].low - box[at(b)].high;
      keep(a, {gap, dot(between, between), b});
      keep(b, {gap, dot(between, between), a});
    }
    if (i % pieces_per_poll == 0) poll();
  }
  for (std::size_t p = 0; p < pieces_; ++p) {
    for (const Near& found : near[p]) {
      const Index a = std::min(static_cast<Index>(p), found.other), b = std::max(static_cast<Index>(p), found.other);
      pairs_.push_back({a, b, std::sqrt(found.gap), 0, unbounded, unbounded});
    }
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  pairs_.erase(
      std::unique(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) { return x.a == y.a && x.b == y.b; }),
      pairs_.end());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    pairs_[i].skin = contacts_.least_skin_cost(pairs_[i].a, pairs_[i].b);
    pairs_[i].kin = contacts_.are_kin(pairs_[i].a, pairs_[i].b);
    pairs_of_[at(pairs_[i].a)].push_back(i);
    pairs_of_[at(pairs_[i].b)].push_back(i);
  }
}

// Finds the cost and the distance of a pair, if its pieces are nearer than range. Both sides share one bound, which
// falls to the cheapest contact.
void LinkSearch::measure_pair(Pair& pair, double range) const {
  Vector<Contact> found(&memory_);
  double reach = std::min(range, least_above(pair.cost - pair.skin));
  contacts_.find(pair.a, pair.b, 0, reach, found, SIZE_MAX);
  contacts_.find(pair.b, pair.a, 0, reach, found, SIZE_MAX);
  for (const Contact& contact : found) {
    if (contact.cost < pair.cost) pair.steps = contact.steps;
    pair.cost = std::min(pair.cost, contact.cost);
    pair.distance = std::min(pair.distance, contact.distance);
  }
  pair.gap = std::max(pair.gap, range);
}

void LinkSearch::measure_near() {
  for_each(jobs_, static_cast<std::uint32_t>(pairs_.size()), [&](std::uint32_t i) {
    if (may_touch(pairs_[i]) && !has_sheet(pairs_[i])) measure_pair(pairs_[i], touching);
  });
}

// Tells whether a piece lies over larger pieces, by some of its vertices. It ends as soon as the answer is known.
bool LinkSearch::is_sheet(Index piece) const {
  if (forced_[at(piece)] != 0) return forced_[at(piece)] == 1;
  if (!(options_.overlay > 0)) return false;
  const Span<const Index> all = contacts_.vertices_of(piece);
  const std::size_t step = (all.size() + sheet_samples - 1) / sheet_samples, count = (all.size() + step - 1) / step;
  const double range = overlay_reach * options_.overlay, overlay = options_.overlay * options_.overlay;
  struct Larger {
    Index piece;
    double covered;  // area of the samples within the overlay distance
  };
  Vector<Larger> larger(&memory_);
  for (const std::size_t pair : pairs_of_[at(piece)]) {
    const Index other = other_of(pair, piece);
    if (pairs_[pair].gap < range && smaller(piece, other)) larger.push_back({other, 0});
  }
  double whole = 0, seen = 0, off = 0, most = 0;
  for (std::size_t i = 0; i < count; ++i) whole += areas_[at(all[i * step])];
  // Far samples come early in this order, so that a piece that sticks out is known after few.
  for (std::size_t turn = 0; turn < sheet_turns; ++turn) {
    for (std::size_t i = turn; i < count; i += sheet_turns) {
      const Vec3 p = mesh_.positions[at(all[i * step])];
      const double area = areas_[at(all[i * step])];
      bool near = false;
      for (Larger& other : larger) {
        // Once the sample is near some piece, only the overlay distance matters, and only until a piece is covered.
        if (near && most >= light_cover * whole) break;
        Index triangle;
        const double within = near ? overlay : range * range;
        const double found = contacts_.nearest(other.piece, p, within, overlay, -1, triangle);
        if (triangle < 0) continue;
        near = true;
        if (found <= overlay) most = std::max(most, other.covered += area);
      }
      seen += area;
      off += near ? 0 : area;
      if (whole - off < light_near * whole || most + std::max(whole - seen, 0.0) < light_cover * whole) return false;
    }
  }
  return most >= light_cover * whole;
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
    // Most sheets touch the piece under them, so that one search finds the tree's edge.
    const bool sheet = has_sheet(pair);
    const double guess = pair.gap + std::max(pair.skin, sheet && pair.gap < touching ? touching : 0);
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
      // Most pairs are little farther apart than is known, so the range grows by steps.
      measure_pair(pair, std::min(pair.gap < touching ? touching : 2 * pair.gap, options_.distance));
      if (pair.cost < unbounded || pair.gap < options_.distance) {
        heap.push_back(entry_of(entry.pair));
        std::push_heap(heap.begin(), heap.end());
      }
    }
  }
}

// Sheets that are leaves of the tree are light, again and again. Others hold pieces together.
void LinkSearch::find_light() {
  Vector<Index> degree(pieces_, 0, &memory_), leaves(&memory_);
  for (const Pair& pair : pairs_) {
    if (pair.in_tree) {
      ++degree[at(pair.a)];
      ++degree[at(pair.b)];
    }
  }
  for (std::size_t p = 0; p < pieces_; ++p) {
    if (forced_[p] == 1) out_.light[p] = 1;
    if (sheet_[p] && degree[p] == 1) leaves.push_back(static_cast<Index>(p));
  }
  while (!leaves.empty()) {
    const Index p = leaves.back();
    leaves.pop_back();
    if (degree[at(p)] != 1) continue;  // the last of its group
    out_.light[at(p)] = 1;
    degree[at(p)] = 0;
    for (const std::size_t i : pairs_of_[at(p)]) {
      const Index other = other_of(i, p);
      if (pairs_[i].in_tree && degree[at(other)] > 0 && --degree[at(other)] == 1 && sheet_[at(other)])
        leaves.push_back(other);
    }
  }
}

// About the length of the edges where a link ends, the shorter of both ends; 0 for a light piece, which follows anyway.
double LinkSearch::edge_length(const Link& link) const {
  double area = is_light(link.vertex) ? 0 : areas_[at(link.vertex)];
  for (const Index corner : link.corner) {
    if (corner != Mesh::none) area = std::min(area, is_light(corner) ? 0 : areas_[at(corner)]);
  }
  return std::sqrt(area);
}

void LinkSearch::add_link(const Contact& contact, bool in_tree, Vector<Link>& to) {
  Link link;
  link.vertex = contact.vertex;
  link.tree = in_tree;
  double share[3], sum = 0;
  contacts_.weights(contact, share);
  snap_to_corner(mesh_, mesh_.triangle(contact.triangle),
                 is_light(link.vertex) ? light_corner_distance : corner_distance, share);
  for (double& s : share) {
    s = s < least_share ? 0 : s;
    sum += s;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (share[k] > 0) {
      link.share[k] = share[k] / sum;
      link.corner[k] = mesh_.triangle(contact.triangle)[k];
    }
  }
  link.length = rest_length(link, mesh_);
  double weight = std::max(1.0, edge_length(link) / spring_edge);
  // Vertices that move with the same joints are one body: it opens nowhere.
  if (options_.skin.influence_count > 0)
    weight *= 1 + rigid_weight * std::max(0.0, 1 - contact.unlike() / (skin_difference * skin_distance));
  link.weight = std::round(16 * weight) / 16;  // so that a list read back has the same bits
  to.push_back(link);
}

// Links contacts, the nearest first, then each as far as possible from those before: links_a_side of them, and more up
// to `most` while they are at least `spacing` apart.
void LinkSearch::link_spread(const Vector<Contact>& contacts, std::size_t most, double spacing, bool in_tree,
                             Vector<Link>& to) {
  if (contacts.empty()) return;
  Vector<double> apart(contacts.size(), unbounded, &memory_);  // squared
  std::size_t next = 0;
  for (std::size_t i = 1; i < contacts.size(); ++i) next = contacts[i].cost < contacts[next].cost ? i : next;
  for (std::size_t count = 0; count < most && apart[next] > (count < links_a_side ? 0 : spacing * spacing); ++count) {
    add_link(contacts[next], in_tree, to);
    const Vec3 p = mesh_.positions[at(contacts[next].vertex)];
    apart[next] = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Vec3 way = mesh_.positions[at(contacts[i].vertex)] - p;
      apart[i] = std::min(apart[i], dot(way, way));
    }
    next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
  }
}

// Links each side of a pair once, near the middle of the contact. Pieces of different joints turn about each other, and
// points near the axis move apart the least. The links are as stiff as all links of another pair together.
void LinkSearch::link_hinge(Vector<Contact>* sides, bool in_tree) {
  Vec3 middle;
  double sum = 0;
  for (int side = 0; side < 2; ++side) {
    for (const Contact& contact : sides[side]) {
      const double area = areas_[at(contact.vertex)];
      middle = middle + area * mesh_.positions[at(contact.vertex)];
      sum += area;
    }
  }
  if (sum > 0) middle = (1 / sum) * middle;
  const auto off = [&](const Contact& contact) { return norm(mesh_.positions[at(contact.vertex)] - middle); };
  const std::size_t before = out_.links.size();
  for (int side = 0; side < 2; ++side) {
    Vector<Contact>& near = sides[side];
    double least = unbounded;
    for (const Contact& contact : near) least = std::min(least, off(contact));
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](const Contact& contact) { return off(contact) > least + hinge_width; }),
               near.end());
    link_spread(near, 1, unbounded, in_tree, out_.links);
  }
  for (std::size_t i = before; i < out_.links.size(); ++i) out_.links[i].weight *= static_cast<double>(links_a_side);
}

// Links both sides of a pair, at contacts that cost little more than the cheapest. All vertices are tried where none of
// the candidates is a contact, so that a pair of the tree always gets a link.
void LinkSearch::link_pair(const Pair& pair) {
  Vector<Contact> sides[2] = {Vector<Contact>(&memory_), Vector<Contact>(&memory_)};
  // A joint of the skeleton holds all around: one point would draw a neck out to a spike.
  const bool joint = pair.steps == 1, hinge = !joint && pair.unlike() > skin_difference * skin_distance;
  const double depth = hinge ? hinge_depth : contact_depth;
  const auto is_far = [&](const Contact& contact) {
    return joint ? contact.steps > joint_steps || contact.distance > pair.distance + depth
                 : contact.cost > pair.cost + depth;
  };
  for (const std::size_t most : {link_candidates, std::size_t{SIZE_MAX}}) {
    for (int side = 0; side < 2; ++side) {
      Vector<Contact>& near = sides[side];
      near.clear();
      double reach = least_above(joint ? pair.distance + depth : pair.cost + depth - pair.skin);
      contacts_.find(side ? pair.b : pair.a, side ? pair.a : pair.b, unbounded, reach, near, most);
      near.erase(std::remove_if(near.begin(), near.end(), is_far), near.end());
    }
    if (sides[0].empty() && sides[1].empty()) continue;
    if (hinge) return link_hinge(sides, pair.in_tree);
    const std::size_t before = out_.links.size();
    for (const Vector<Contact>& near : sides)
      link_spread(near, pair.in_tree ? links_a_side : links_a_side / 2, unbounded, pair.in_tree, out_.links);
    for (std::size_t i = before; joint && i < out_.links.size(); ++i) out_.links[i].weight *= joint_stiffness;
    return;
  }
}

// Lists contacts of pieces that touch and are not linked, so that hf_surface_measure_gaps can measure them.
void LinkSearch::list_open(const Pair& pair) {
  for (int side = 0; side < 2; ++side) {
    Vector<Contact> near(&memory_);
    double reach = touching;
    contacts_.find(side ? pair.b : pair.a, side ? pair.a : pair.b, unbounded, reach, near, link_candidates);
    link_spread(near, links_a_side / 2, unbounded, false, out_.open);
  }
}

void LinkSearch::link_pairs() {
  for (Pair& pair : pairs_) {
    if (out_.light[at(pair.a)] || out_.light[at(pair.b)]) continue;
    if (!(pair.cost < unbounded) && may_touch(pair)) measure_pair(pair, touching);  // a sheet, not light
    const bool alike = pair.unlike() <= skin_difference * skin_distance, kin = pair.steps == 1;
    if (!pair.in_tree && !(pair.distance <= touching && (alike || kin))) {
      const bool near = pair.gap < touching || pair.distance <= touching;  // not measured, or measured
      if (!options_.skin.parents.empty() && near) list_open(pair);
      continue;
    }
    if (pair.in_tree) out_.longest_tree_link = std::max(out_.longest_tree_link, pair.distance);
    link_pair(pair);
  }
}

// Links vertices of every light piece to the nearest points of larger pieces, or of its neighbour in the tree if there
// is no such point.
void LinkSearch::link_light() {
  Vector<Contact> best(mesh_.positions.size(), {Mesh::none, Mesh::none, unbounded, unbounded}, &memory_);
  for_each(jobs_, static_cast<std::uint32_t>(pieces_), [&](std::uint32_t p) {
    if (out_.light[p]) find_below(static_cast<Index>(p), best);
  });
  Vector<Contact> found(&memory_);
  for (std::size_t p = 0; p < pieces_; ++p) {
    if (!out_.light[p]) continue;
    found.clear();
    for (const Index v : contacts_.vertices_of(static_cast<Index>(p))) {
      if (best[at(v)].vertex != Mesh::none) found.push_back(best[at(v)]);
    }
    // strangers only where the piece touches nothing else
    if (std::any_of(found.begin(), found.end(), is_kin))
      found.erase(std::remove_if(found.begin(), found.end(), [](const Contact& contact) { return !is_kin(contact); }),
                  found.end());
    double unlike = unbounded;
    for (const Contact& contact : found) unlike = std::min(unlike, contact.unlike());
    const bool hinge = unlike > skin_difference * skin_distance;
    link_spread(found, hinge ? light_hinge_links : found.size(), light_spacing, true, out_.links);
    for (const std::size_t i : pairs_of_[p]) {
      if (found.empty() && pairs_[i].in_tree) link_pair(pairs_[i]);
    }
  }
}

// Finds the cheapest contacts of a light piece. Its neighbour in the tree comes first: it bounds the other searches.
void LinkSearch::find_below(Index piece, Vector<Contact>& best) const {
  const double range = forced_[at(piece)] == 1 ? options_.distance : overlay_reach * options_.overlay;
  for (const bool in_tree : {true, false}) {
    for (const std::size_t i : pairs_of_[at(piece)]) {
      const Index other = other_of(i, piece);
      if (pairs_[i].in_tree != in_tree || (out_.light[at(other)] && !smaller(piece, other))) continue;
      contacts_.improve(piece, other, range, best);
    }
  }
}

}  // namespace

void search_links(const Mesh& mesh, Span<const double> areas, const LinkOptions& options, const ContactSearch& contacts,
                  Memory& memory, JobRunner* jobs, Links& out) {
  if (mesh.component_count() > most_linked_pieces)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%d pieces; at most %d are linked automatically, so give a list of links",
         mesh.component_count(), most_linked_pieces);
  LinkSearch(mesh, areas, options, contacts, memory, jobs, out).run();
}

}  // namespace hf_inner::mesh
