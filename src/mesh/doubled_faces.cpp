#include "mesh/doubled_faces.h"

#include <algorithm>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/kept_faces.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {
namespace {

// Odd number that mixes corners into a hash: 2^64 over the golden ratio. No result depends on it.
constexpr std::uint64_t hash_factor = 0x9e3779b97f4a7c15u;

using FaceCorners = Span<const Index>;

// The original of each face: the first face with its corners, which can be itself.
struct First {
  Index face;
  bool mirrored;
};

bool is_odd(const Index* v) noexcept { return (v[0] > v[1]) != ((v[1] > v[2]) != (v[0] > v[2])); }

// Triangles are sorted into buckets by the smallest corner and compared inside a bucket.
Vector<First> first_triangles(const Mesh& mesh, std::size_t vertex_count, Memory& memory) {
  struct Key {
    Index middle, largest, triangle;
    bool operator<(const Key& o) const noexcept {
      if (middle != o.middle) return middle < o.middle;
      return largest != o.largest ? largest < o.largest : triangle < o.triangle;
    }
  };
  Vector<First> first(&memory);
  Vector<Index> start(vertex_count + 1, 0, &memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* v = mesh.triangle(t);
    ++start[at(std::min({v[0], v[1], v[2]})) + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  Buffer<Key> keys(memory, at(mesh.triangle_count()));
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Index* v = mesh.triangle(t);
    const Index least = std::min({v[0], v[1], v[2]}), most = std::max({v[0], v[1], v[2]});
    const Index middle = std::max(std::min(v[0], v[1]), std::min(std::max(v[0], v[1]), v[2]));
    keys[at(start[at(least)]++)] = {middle, most, t};
  }
  std::size_t begin = 0;  // start[v] is now the end of the triangles with smallest corner v
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::size_t end = at(start[v]);
    std::sort(keys.data() + begin, keys.data() + end);
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Key &own = keys[i], &before = keys[i - 1];
      if (own.middle != before.middle || own.largest != before.largest) continue;
      if (first.empty()) {
        first.resize(at(mesh.triangle_count()));
        for (Index t = 0; t < mesh.triangle_count(); ++t) first[at(t)] = {t, false};
      }
      const Index kept = first[at(before.triangle)].face;
      first[at(own.triangle)] = {kept, is_odd(mesh.triangle(own.triangle)) != is_odd(mesh.triangle(kept))};
    }
    begin = end;
  }
  return first;
}

// Where the smallest rotation of the corners begins, in the order of their numbers. step: 1, or -1 for the order
// backwards from the last corner. Both candidates i and j skip items that the other one has shown to be larger.
struct Around {
  FaceCorners corner;
  bool backwards;
  std::size_t begin = 0;
  Index operator()(std::size_t k) const noexcept {
    const std::size_t n = corner.size(), place = (begin + k) % n;
    return corner[backwards ? n - 1 - place : place];
  }
};
Around smallest_rotation(FaceCorners corner, bool backwards) noexcept {
  const Around from{corner, backwards};
  const std::size_t n = corner.size();
  std::size_t i = 0, j = 1, same = 0;
  while (i < n && j < n && same < n) {
    const Index a = from(i + same), b = from(j + same);
    if (a == b) {
      ++same;
      continue;
    }
    (a > b ? i : j) += same + 1;
    if (i == j) ++j;
    same = 0;
  }
  return {corner, backwards, std::min(i, j)};
}
bool is_less(const Around& a, const Around& b) noexcept {
  for (std::size_t k = 0; k < a.corner.size(); ++k) {
    if (a(k) != b(k)) return a(k) < b(k);
  }
  return false;
}

// Every face gets the smallest of its rotations in both directions. Faces are sorted by a hash of it. Faces of one hash
// are then compared.
Vector<First> first_faces(const Faces& faces, Memory& memory) {
  struct Key {
    std::uint64_t hash;
    Index face;
  };
  Vector<Index> canonical(faces.corner.size(), &memory);
  Vector<std::uint8_t> backwards(at(faces.count()), &memory);
  Vector<Key> keys(at(faces.count()), &memory);
  const auto corners = [&](Index f) {
    return FaceCorners(canonical.data() + faces.corner_start[at(f)],
                       at(faces.corner_start[at(f) + 1] - faces.corner_start[at(f)]));
  };
  for (Index f = 0; f < faces.count(); ++f) {
    const FaceCorners own = faces.corners_of(f);
    const Around ahead = smallest_rotation(own, false), back = smallest_rotation(own, true);
    backwards[at(f)] = is_less(back, ahead);
    const Around& best = backwards[at(f)] ? back : ahead;
    std::uint64_t hash = own.size();
    for (std::size_t k = 0; k < own.size(); ++k) {
      canonical[at(faces.corner_start[at(f)]) + k] = best(k);
      hash = (hash ^ static_cast<std::uint64_t>(best(k))) * hash_factor;
      hash ^= hash >> 32;
    }
    keys[at(f)] = {hash, f};
  }
  const auto compare = [&](const Key& a, const Key& b) {
    if (a.hash != b.hash) return a.hash < b.hash ? -1 : 1;
    const FaceCorners x = corners(a.face), y = corners(b.face);
    if (std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end())) return -1;
    return std::equal(x.begin(), x.end(), y.begin(), y.end()) ? 0 : 1;
  };
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    const int order = compare(a, b);
    return order != 0 ? order < 0 : a.face < b.face;
  });
  Vector<First> first(&memory);
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (compare(keys[i - 1], keys[i]) != 0) continue;
    if (first.empty()) {
      first.resize(keys.size());
      for (Index f = 0; f < faces.count(); ++f) first[at(f)] = {f, false};
    }
    const Index kept = first[at(keys[i - 1].face)].face, own = keys[i].face;
    first[at(own)] = {kept, backwards[at(own)] != backwards[at(kept)]};
  }
  return first;
}

void append_doubled(const Mesh& mesh, Index face, Index given, bool mirrored, SharedVector<Mesh::Doubled>& out) {
  for (Index t = triangles_begin(mesh, face); t < triangles_begin(mesh, face + 1); ++t) {
    const Index* v = mesh.triangle(t);
    out.push_back({given, {v[0], v[1], v[2]}, mirrored});
  }
}

}  // namespace

void set_doubled_aside(Mesh& mesh, std::size_t vertex_count, Memory& memory) {
  const bool of_faces = !mesh.faces.empty();
  const Vector<First> first = of_faces ? first_faces(mesh.faces, memory) : first_triangles(mesh, vertex_count, memory);
  if (first.empty()) return;
  poll();
  Vector<std::uint8_t> kept(first.size(), 0, &memory);
  for (std::size_t f = 0; f < first.size(); ++f) kept[f] = first[f].face == static_cast<Index>(f);
  const Vector<Index> number = kept_numbers(kept, mesh, memory);
  Index face = 0;
  for (std::size_t given = 0; given < mesh.triangle_of_given.size(); ++given) {
    if (mesh.triangle_of_given[given] == Mesh::none) continue;
    const First own = first[at(face)];
    if (own.face != face) {
      append_doubled(mesh, face, static_cast<Index>(given), own.mirrored, mesh.doubled);
      ++mesh.report.duplicate_triangle_count;
    }
    mesh.triangle_of_given[given] = number[at(own.face)];
    ++face;
  }
  keep_faces(kept, mesh);
}

namespace {

// By face: whether it is to be turned round. Faces of one side keep their direction. Faces of two sides follow most of
// their neighbours of one side. Without such neighbours they follow a decided one. An edge of more than two faces
// passes nothing on.
class Turning {
 public:
  Turning(const Mesh& mesh, const Topology& topology, Vector<std::uint8_t> two_sided, Memory& memory)
      : turned(two_sided.size(), 0, &memory),
        mesh_(mesh),
        topology_(topology),
        two_sided_(std::move(two_sided)),
        seen_(two_sided_.size(), 0, &memory),
        face_of_(at(mesh.triangle_count()), 0, &memory),
        edge_of_(mesh.corners.size(), 0, &memory),
        queue_(&memory) {
    for (std::size_t f = 0; f < seen_.size(); ++f) {
      for (Index t = triangles_begin(mesh, static_cast<Index>(f)); t < triangles_begin(mesh, static_cast<Index>(f) + 1);
           ++t)
        face_of_[at(t)] = static_cast<Index>(f);
    }
    for (Index e = 0; e < topology.edge_count(); ++e) {
      for (Index i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i)
        edge_of_[at(topology.corner(i))] = e;
    }
  }
  void run() {
    for (std::size_t f = 0; f < seen_.size(); ++f) {
      if (!two_sided_[f]) take(static_cast<Index>(f));
    }
    for (std::size_t f = 0; f < seen_.size(); ++f) {
      const int votes = two_sided_[f] ? votes_of(static_cast<Index>(f)) : 0;
      if (votes == 0) continue;
      turned[f] = votes > 0;
      take(static_cast<Index>(f));
    }
    spread();
    for (std::size_t f = 0; f < seen_.size(); ++f) {
      if (seen_[f]) continue;
      take(static_cast<Index>(f));
      spread();
    }
  }
  Index face_of(Index triangle) const noexcept { return face_of_[at(triangle)]; }

  Vector<std::uint8_t> turned;

 private:
  void take(Index face) {
    seen_[at(face)] = 1;
    queue_.push_back(face);
  }
  void spread() {
    for (; next_ < queue_.size(); ++next_) {
      const Index face = queue_[next_];
      for (Index c = 3 * triangles_begin(mesh_, face); c < 3 * triangles_begin(mesh_, face + 1); ++c)
        pass_on(face, edge_of_[at(c)]);
    }
  }
  // The face beyond an edge, or none. same: both run through the edge in one direction.
  Index beyond(Index face, Index edge, bool& same) const noexcept {
    const Index begin = topology_.edge_triangle_start[at(edge)];
    if (topology_.edge_triangle_start[at(edge) + 1] - begin != 2) return Mesh::none;
    same = topology_.forward(begin) == topology_.forward(begin + 1);
    const Index a = face_of(topology_.triangle(begin));
    return a == face ? face_of(topology_.triangle(begin + 1)) : a;
  }
  // How many more neighbours of one side want a face turned round than do not.
  int votes_of(Index face) const noexcept {
    int votes = 0;
    for (Index c = 3 * triangles_begin(mesh_, face); c < 3 * triangles_begin(mesh_, face + 1); ++c) {
      bool same = false;
      const Index other = beyond(face, edge_of_[at(c)], same);
      if (other != Mesh::none && other != face && !two_sided_[at(other)]) votes += same ? 1 : -1;
    }
    return votes;
  }
  void pass_on(Index face, Index edge) {
    bool same = false;
    const Index other = beyond(face, edge, same);
    if (other == Mesh::none || seen_[at(other)]) return;
    turned[at(other)] = same != (turned[at(face)] != 0);
    take(other);
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const Vector<std::uint8_t> two_sided_;
  Vector<std::uint8_t> seen_;
  Vector<Index> face_of_, edge_of_;
  Vector<Index> queue_;
  std::size_t next_ = 0;
};

void turn_round(Index face, Mesh& mesh) {
  for (Index t = triangles_begin(mesh, face); t < triangles_begin(mesh, face + 1); ++t)
    std::swap(mesh.corners[3 * at(t) + 1], mesh.corners[3 * at(t) + 2]);
  if (mesh.faces.empty()) return;
  const auto begin = mesh.faces.corner.begin();
  std::reverse(begin + mesh.faces.corner_start[at(face)] + 1, begin + mesh.faces.corner_start[at(face) + 1]);
}

// Calls visit(given triangle or face, given vertex) for every corner of the caller.
template <class Visit>
void each_given_corner(const MeshInput& input, Visit&& visit) {
  for (std::uint32_t t = 0; t < input.triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) visit(t, input.triangles.get(t, k));
  }
  input.faces.each([&](std::uint32_t f, std::int64_t start, std::int64_t size) {
    for (std::int64_t k = 0; k < size; ++k) visit(f, input.faces.corner(start + k));
  });
}

// A copy of a vertex is turned if all its usable faces run against the kept ones.
void find_turned(const MeshInput& input, Mesh& mesh, Memory& memory) {
  Vector<std::uint8_t> against(mesh.triangle_of_given.size(), 0, &memory);
  for (const Mesh::Doubled& entry : mesh.doubled) against[at(entry.given)] = entry.mirrored;
  Vector<std::uint8_t> along(input.vertex_count, 0, &memory), turned(input.vertex_count, 0, &memory);
  each_given_corner(input, [&](std::uint32_t face, std::uint32_t v) {
    if (mesh.triangle_of_given[face] != Mesh::none) (against[face] ? turned : along)[v] = 1;
  });
  for (std::uint32_t v = 0; v < input.vertex_count; ++v) {
    if (turned[v] && !along[v] && mesh.inner_of_given[v] != Mesh::none) mesh.turned.push_back(static_cast<Index>(v));
  }
}

}  // namespace

void turn_two_sided(const MeshInput& input, Mesh& mesh, Memory& memory, JobRunner* jobs) {
  const auto is_mirrored = [](const Mesh::Doubled& entry) { return entry.mirrored; };
  if (std::none_of(mesh.doubled.begin(), mesh.doubled.end(), is_mirrored)) return;
  const std::size_t count = at(face_count(mesh));
  const Topology topology = Topology::make(mesh, memory, jobs);
  // By first triangle of a face: whether a mirrored face lies on it.
  Vector<std::uint8_t> covered(at(mesh.triangle_count()), 0, &memory), two_sided(count, 0, &memory);
  for (const Mesh::Doubled& entry : mesh.doubled) {
    if (entry.mirrored) covered[at(mesh.triangle_of_given[at(entry.given)])] = 1;
  }
  for (std::size_t f = 0; f < count; ++f) two_sided[f] = covered[at(triangles_begin(mesh, static_cast<Index>(f)))];
  Turning turning(mesh, topology, std::move(two_sided), memory);
  turning.run();
  poll();
  const auto is_turned = [&](Index given) {
    return turning.turned[at(turning.face_of(mesh.triangle_of_given[at(given)]))] != 0;
  };
  for (Mesh::Doubled& entry : mesh.doubled) entry.mirrored = entry.mirrored != is_turned(entry.given);
  for (std::size_t f = 0; f < count; ++f) {
    const Index face = static_cast<Index>(f);
    if (!turning.turned[f]) continue;
    const Index given = static_cast<Index>(mesh.given_of_triangle(triangles_begin(mesh, face)));
    append_doubled(mesh, face, given, true, mesh.doubled);
    turn_round(face, mesh);
  }
  // Ascending again. The triangles of one face stay together; their order does not matter.
  std::sort(mesh.doubled.begin(), mesh.doubled.end(), [](const Mesh::Doubled& a, const Mesh::Doubled& b) {
    return a.given != b.given ? a.given < b.given
                              : std::lexicographical_compare(a.corner, a.corner + 3, b.corner, b.corner + 3);
  });
  find_turned(input, mesh, memory);
}

}  // namespace hf_inner::mesh
