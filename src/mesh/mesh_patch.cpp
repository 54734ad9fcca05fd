#include "mesh/mesh_patch.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "mesh/places.h"

namespace hf_inner::mesh {
namespace {

// The corners of a triangle in ascending order.
struct Corners {
  explicit Corners(const Index* v, std::uint32_t position = HF_NO_INDEX) : corner{v[0], v[1], v[2]}, added(position) {
    std::sort(corner, corner + 3);
  }
  bool operator<(const Corners& o) const noexcept {
    return std::lexicographical_compare(corner, corner + 3, o.corner, o.corner + 3);
  }
  Index corner[3];
  std::uint32_t added;  // position among the new triangles; HF_NO_INDEX: it was there
};

class MeshPatcher {
 public:
  MeshPatcher(const Mesh& before, const Topology* topology, const MeshPatch& patch, Memory& memory, JobRunner* jobs)
      : before_(before),
        topology_(topology),
        jobs_(jobs),
        patch_(patch),
        memory_(memory),
        out_(memory),
        gone_(at(before.triangle_count()), 0, &memory),
        touched_(before.positions.size(), 0, &memory),
        around_(&memory),
        added_(&memory),
        given_(&memory),
        cut_(&memory),
        cut_corners_(&memory),
        copies_(&memory),
        copied_(&memory),
        doubled_(&memory),
        slots_(&memory),
        moved_(&memory) {}

  PatchedMesh make() {
    list_doubled();
    read_removed();
    read_added();
    read_cuts();
    find_around();
    number_vertices();
    refuse_doubled();
    put_vertices();
    put_triangles();
    put_components(before_, slots_, out_, memory_);
    count();
    return std::move(out_);
  }

 private:
  static constexpr std::uint8_t is_cut = 2;  // in gone_; a removed triangle has 1
  static constexpr std::uint8_t held = 2;    // in touched_: a triangle holds it
  static constexpr Index first_copy = -2;    // corners of cut triangles: -2 - i for the i-th copy

  void list_doubled() {
    for (const Mesh::Doubled& one : before_.doubled) doubled_.push_back(Corners(one.corner));
    std::sort(doubled_.begin(), doubled_.end());
  }
  bool is_doubled(Index t) const noexcept {
    return std::binary_search(doubled_.begin(), doubled_.end(), Corners(before_.triangle(t)));
  }
  // The corners of a triangle that changes are touched.
  void touch(Index t) {
    const Index* const v = before_.triangle(t);
    for (int k = 0; k < 3; ++k) touched_[at(v[k])] = 1;
  }

  void read_removed() {
    for (std::uint32_t i = 0; i < patch_.removed.size(); ++i) {
      const std::uint32_t given = patch_.removed[i];
      if (given >= before_.report.triangle_count)
        fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of removed_triangles is %u; the surface has %u triangles", i, given,
             before_.report.triangle_count);
      const Index t = before_.triangle_of_given[given];
      if (t == Mesh::none)
        fail(HF_ERROR_NOT_FOUND, i, "entry %u of removed_triangles: triangle %u has no area or was removed before", i,
             given);
      if (is_doubled(t))
        fail(HF_ERROR_UNSUPPORTED, i,
             "entry %u of removed_triangles: triangle %u lies on another one; leave one of them out of the mesh", i,
             given);
      touch(t);
      if (gone_[at(t)])
        fail(HF_ERROR_CONFLICT, i, "entry %u of removed_triangles: triangle %u is listed twice", i, given);
      gone_[at(t)] = 1;
      ++removed_;
    }
  }

  // Turns the corners of new triangles into inner vertices before, or -2 - p with p the place in given_.
  void read_added() {
    const std::uint32_t old = before_.report.vertex_count;
    const std::size_t count = old + patch_.positions.size() + patch_.cuts.size(),
                      triangles = patch_.triangles.size() / 3;
    if (count > most_elements || before_.report.triangle_count + triangles > most_elements)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%zu vertices and %zu triangles; at most %u are supported", count,
           before_.report.triangle_count + triangles, most_elements);
    for (std::size_t v = 0; v < patch_.positions.size(); ++v) {
      const Vec3 p = patch_.positions[v];
      (void)read_point_near(before_, &p.x, "new vertex", static_cast<std::uint32_t>(v));
    }
    added_.assign(patch_.triangles.begin(), patch_.triangles.end());
    for (std::size_t c = 0; c < added_.size(); ++c) {
      const auto given = static_cast<std::uint32_t>(added_[c]);
      if (given >= old + patch_.positions.size())
        fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(c / 3),
             "new triangle %zu: corner %zu is vertex %u, but there are %zu vertices with the new ones", c / 3, c % 3,
             given, old + patch_.positions.size());
      if (given >= old || before_.inner_of_given[given] == Mesh::none) given_.push_back(static_cast<Index>(given));
    }
    std::sort(given_.begin(), given_.end());
    given_.erase(std::unique(given_.begin(), given_.end()), given_.end());
    for (std::size_t c = 0; c < added_.size(); ++c) {
      const auto there = std::lower_bound(given_.begin(), given_.end(), added_[c]);
      if (there != given_.end() && *there == added_[c]) {
        added_[c] = -2 - static_cast<Index>(there - given_.begin());
      } else {
        added_[c] = before_.inner_of_given[at(added_[c])];
        touched_[at(added_[c])] = 1;
      }
    }
    for (std::size_t t = 0; t < triangles; ++t) {
      const Index* const v = &added_[3 * t];
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
        fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(t),
             "new triangle %zu has two equal corners, or corners that are welded", t);
    }
  }

  // A triangle that is cut has its new corners in cut_corners_.
  void read_cuts() {
    for (const Mesh::CutCorner& cut : patch_.cuts) {
      const Index t = before_.triangle_of_given[at(cut.triangle)];
      if (is_doubled(t))
        fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
             "the cut gives a corner of triangle %d a copy of vertex %d, and the triangle lies on another one; leave "
             "one of them out of the mesh",
             cut.triangle, cut.copied);
      touch(t);
      gone_[at(t)] = is_cut;
      cut_.push_back(t);
      if (copied_.empty() || copies_.back() != cut.vertex) {
        copies_.push_back(cut.vertex);
        copied_.push_back(before_.inner_of_given[at(cut.copied)]);
      }
    }
    std::sort(cut_.begin(), cut_.end());
    cut_.erase(std::unique(cut_.begin(), cut_.end()), cut_.end());
    for (const Index t : cut_) cut_corners_.insert(cut_corners_.end(), before_.triangle(t), before_.triangle(t) + 3);
    for (const Mesh::CutCorner& cut : patch_.cuts) {
      const Index t = before_.triangle_of_given[at(cut.triangle)];
      const auto there = std::lower_bound(cut_.begin(), cut_.end(), t);
      cut_corners_[3 * static_cast<std::size_t>(there - cut_.begin()) + at(cut.corner)] =
          first_copy -
          static_cast<Index>(std::lower_bound(copies_.begin(), copies_.end(), cut.vertex) - copies_.begin());
    }
  }

  // The triangles that stay and have a touched corner, and the vertices that go: touched ones that no triangle holds.
  void find_around() {
    if (topology_) {
      for (std::size_t v = 0; v < touched_.size(); ++v)
        if (touched_[v]) topology_->triangles_at(static_cast<Index>(v), around_);
      std::sort(around_.begin(), around_.end());
      around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
      around_.erase(std::remove_if(around_.begin(), around_.end(), [&](Index t) { return gone_[at(t)] != 0; }),
                    around_.end());
    }
    const Index* v = before_.corners.data();
    for (Index t = 0; !topology_ && t < before_.triangle_count(); ++t, v += 3) {
      if ((touched_[at(v[0])] | touched_[at(v[1])] | touched_[at(v[2])]) != 0 && !gone_[at(t)]) around_.push_back(t);
    }
    Vector<Index> corners(&memory_);
    for (const Index t : around_) corners.insert(corners.end(), before_.triangle(t), before_.triangle(t) + 3);
    for (const Vector<Index>* list : {&corners, &added_, &cut_corners_}) {
      for (const Index u : *list)
        if (u >= 0 && touched_[at(u)] != 0) touched_[at(u)] = held;
    }
    for (std::size_t u = 0; u < touched_.size(); ++u)
      if (touched_[u] == 1) out_.went.push_back(static_cast<Index>(u));
  }

  // New vertices take the numbers of those that went. If fewer come than go, all get new numbers.
  void number_vertices() {
    const Index count = before_.vertex_count();
    const std::size_t coming = given_.size() + copies_.size(), going = out_.went.size();
    for (std::size_t i = 0; i < coming; ++i)
      slots_.push_back(i < going ? out_.went[i] : count + static_cast<Index>(i - going));
    if (coming < going) {
      out_.number.resize(at(count));
      Index next = 0;
      auto went = out_.went.begin();
      for (Index v = 0; v < count; ++v) {
        const bool goes = went != out_.went.end() && *went == v;
        if (goes) ++went;
        out_.number[at(v)] = goes ? Mesh::none : next++;
      }
      for (std::size_t i = 0; i < coming; ++i) slots_[i] = next++;
    }
    for (std::size_t u = 0; u < touched_.size(); ++u)
      if (touched_[u] == held) out_.touched.push_back(number_of(static_cast<Index>(u)));
    out_.touched.insert(out_.touched.end(), slots_.begin(), slots_.end());
    std::sort(out_.touched.begin(), out_.touched.end());
    for (Index& v : added_) v = v >= 0 ? number_of(v) : slots_[at(-2 - v)];
    for (Index& v : cut_corners_) v = v >= 0 ? number_of(v) : slots_[given_.size() + at(first_copy - v)];
  }
  // The number of a vertex that stays.
  Index number_of(Index v) const noexcept { return out_.number.empty() ? v : out_.number[at(v)]; }

  // Whether an isolated vertex of the mesh before comes in.
  bool takes_isolated() const noexcept { return !given_.empty() && at(given_.front()) < before_.inner_of_given.size(); }

  // Copies the large arrays on all threads, or shares them, with room for new vertices and triangles.
  void copy_arrays() {
    Mesh& mesh = out_.mesh;
    const auto copy = [](const auto& from, std::size_t size, auto& to) {
      to.reserve(std::max(size, from.size()));
      to.assign(from.begin(), from.end());
      to.resize(size);
    };
    const std::size_t vertices = before_.positions.size() - out_.went.size() + slots_.size();
    const std::size_t given = before_.inner_of_given.size() + patch_.positions.size() + copies_.size();
    const std::size_t triangles =
        std::max(before_.corners.size(), before_.corners.size() + added_.size() - 3 * removed_);
    const bool grows = out_.went.empty();  // numbers and places of the others stay
    for_each(jobs_, 3, [&](std::uint32_t i) {
      if (i == 0) {
        copy(before_.corners, triangles, mesh.corners);
      } else if (i == 1 && (removed_ > 0 || !added_.empty())) {
        copy(before_.triangle_of_given, before_.triangle_of_given.size() + added_.size() / 3, mesh.triangle_of_given);
      } else if (i == 2 && !grows) {
        copy(before_.positions, vertices, mesh.positions);
        copy(before_.given_of_inner, vertices, mesh.given_of_inner);
      } else if (i == 2) {
        mesh.positions = before_.positions.grown(vertices, memory_);
        mesh.given_of_inner = before_.given_of_inner.grown(vertices, memory_);
      }
    });
    if (removed_ == 0 && added_.empty()) mesh.triangle_of_given = before_.triangle_of_given;  // shared
    if (grows && !takes_isolated())
      mesh.inner_of_given = before_.inner_of_given.grown(given, memory_);
    else
      copy(before_.inner_of_given, given, mesh.inner_of_given);
  }

  void put_vertices() {
    Mesh& mesh = out_.mesh;
    mesh.report = before_.report;
    mesh.centre = before_.centre;
    mesh.scale = before_.scale;
    mesh.numbering = out_.number.empty() ? before_.numbering : make_shared_in<char>(memory_, '\0');
    copy_arrays();
    for (std::size_t v = 0; v < out_.number.size(); ++v) {
      const Index to = out_.number[v];
      if (to == Mesh::none) continue;
      mesh.positions[at(to)] = before_.positions[v];
      mesh.given_of_inner[at(to)] = before_.given_of_inner[v];
    }
    put_isolated();
    mesh.returned.assign(before_.returned.begin(), before_.returned.end());
    mesh.returned.append(given_.begin(), std::lower_bound(given_.begin(), given_.end(),
                                                          static_cast<Index>(before_.report.vertex_count)));
    std::sort(mesh.returned.begin(), mesh.returned.end());
    for (std::size_t i = 0; i < copies_.size(); ++i) {
      const Index v = slots_[given_.size() + i];
      mesh.positions[at(v)] = before_.positions[at(copied_[i])];
      mesh.given_of_inner[at(v)] = copies_[i];
      mesh.inner_of_given[at(copies_[i])] = v;
    }
    for (const Index g : before_.turned)
      if (mesh.inner_of_given[at(g)] != Mesh::none) mesh.turned.push_back(g);
  }

  // Vertices that went are isolated; those that a new triangle takes are isolated no more.
  void put_isolated() {
    Mesh& mesh = out_.mesh;
    const std::size_t old = before_.report.vertex_count;
    Vector<Mesh::Isolated> isolated(&memory_);
    auto known = before_.isolated.begin();
    for (std::size_t g = 0; (!out_.went.empty() || !out_.number.empty()) && g < old; ++g) {
      Index& v = mesh.inner_of_given[g];
      if (v == Mesh::none) {
        isolated.push_back(*known++);
      } else if (touched_[at(v)] == 1) {
        isolated.push_back({static_cast<Index>(g), before_.to_given(before_.positions[at(v)])});
        v = Mesh::none;
      } else {
        v = number_of(v);
      }
    }
    isolated.insert(isolated.end(), known, before_.isolated.end());
    for (std::size_t i = 0; i < patch_.positions.size(); ++i) {
      mesh.inner_of_given[old + i] = Mesh::none;
      isolated.push_back({static_cast<Index>(old + i), patch_.positions[i]});
    }
    std::size_t taken = 0;
    for (const Mesh::Isolated& one : isolated) {
      if (taken == given_.size() || given_[taken] != one.given) {
        mesh.isolated.push_back(one);
        continue;
      }
      const Index v = slots_[taken++];
      mesh.positions[at(v)] = mesh.to_inner(one.position);
      mesh.given_of_inner[at(v)] = one.given;
      mesh.inner_of_given[at(one.given)] = v;
    }
  }

  // New triangles take the numbers of triangles that went. The last triangles fill the holes that are left.
  void put_triangles() {
    Mesh& mesh = out_.mesh;
    const std::size_t old = before_.corners.size() / 3, given = before_.triangle_of_given.size();
    const std::size_t coming = added_.size() / 3;
    Vector<Index> holes(&memory_);
    for (std::size_t t = 0; t < old; ++t)
      if (gone_[t] == 1) holes.push_back(static_cast<Index>(t));
    if (old + coming == holes.size())
      fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the edit removes every triangle; nothing is left of the surface");
    const std::size_t count = old + coming - holes.size();
    for (std::size_t c = 0; !out_.number.empty() && c < 3 * old; ++c) mesh.corners[c] = number_of(mesh.corners[c]);
    for (const std::uint32_t g : patch_.removed) mesh.triangle_of_given[g] = Mesh::none;
    Vector<Mesh::Refilled> refilled(&memory_);
    const auto put = [&](std::size_t t, const Index* corners, std::size_t g) {
      std::copy_n(corners, 3, mesh.corners.data() + 3 * t);
      mesh.triangle_of_given[g] = static_cast<Index>(t);
      refilled.push_back({static_cast<Index>(t), static_cast<Index>(g)});
    };
    for (std::size_t i = 0; i < cut_.size(); ++i)
      std::copy_n(&cut_corners_[3 * i], 3, mesh.corners.data() + 3 * at(cut_[i]));
    for (std::size_t i = 0; i < coming; ++i)
      put(i < holes.size() ? at(holes[i]) : old + i - holes.size(), &added_[3 * i], given + i);
    std::size_t last = old, left = coming;
    while (left < holes.size() && at(holes[left]) < count) {
      while (gone_[--last] == 1) continue;
      Index corners[3];
      std::copy_n(mesh.corners.data() + 3 * last, 3, corners);
      put(at(holes[left++]), corners, before_.given_of_triangle(static_cast<Index>(last)));
      moved_.push_back({static_cast<Index>(last), holes[left - 1]});
    }
    mesh.corners.resize(3 * count);
    put_refilled(std::move(refilled));
    mesh.cuts.assign(before_.cuts.begin(), before_.cuts.end());
    mesh.cuts.append(patch_.cuts.begin(), patch_.cuts.end());
    for (Mesh::Doubled one : before_.doubled) {
      for (Index& v : one.corner) v = number_of(v);
      mesh.doubled.push_back(one);
    }
    list_around();
  }

  // Later numbers replace earlier ones, and triangles that went are listed no more.
  void put_refilled(Vector<Mesh::Refilled>&& fresh) {
    Mesh& mesh = out_.mesh;
    std::sort(fresh.begin(), fresh.end(), [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
    auto next = fresh.begin();
    for (const Mesh::Refilled& one : before_.refilled) {
      for (; next != fresh.end() && next->triangle < one.triangle; ++next) mesh.refilled.push_back(*next);
      const bool stays = mesh.triangle_of_given[at(one.given)] == one.triangle;
      if (stays) mesh.refilled.push_back(one);
    }
    for (; next != fresh.end(); ++next) mesh.refilled.push_back(*next);
  }

  void list_around() {
    const Mesh& mesh = out_.mesh;
    std::sort(moved_.begin(), moved_.end(), [](const Moved& a, const Moved& b) { return a.from < b.from; });
    for (const Index t : around_) {
      const auto moved = std::lower_bound(moved_.begin(), moved_.end(), t,
                                          [](const Moved& one, Index from) { return one.from < from; });
      out_.around.push_back(moved != moved_.end() && moved->from == t ? moved->to : t);
    }
    out_.around.insert(out_.around.end(), cut_.begin(), cut_.end());
    const std::size_t given = before_.triangle_of_given.size();
    for (std::size_t i = 0; i < added_.size() / 3; ++i) out_.around.push_back(mesh.triangle_of_given[given + i]);
  }

  // Two triangles with the same corners would count twice.
  void refuse_doubled() const {
    Vector<Corners> keys(&memory_);
    for (std::size_t i = 0; i < added_.size() / 3; ++i)
      keys.push_back(Corners(&added_[3 * i], static_cast<std::uint32_t>(i)));
    for (const Index t : around_) {
      Index v[3];
      for (int k = 0; k < 3; ++k) v[k] = number_of(before_.triangle(t)[k]);
      keys.push_back(Corners(v));
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i - 1] < keys[i]) continue;
      const std::uint32_t added = std::min(keys[i - 1].added, keys[i].added);
      if (added == HF_NO_INDEX) continue;  // they were there before
      fail(HF_ERROR_CONFLICT, added, "new triangle %u has the corners of another triangle; leave it out", added);
    }
  }

  void count() {
    Mesh& mesh = out_.mesh;
    MeshReport& report = mesh.report;
    const auto more = static_cast<std::uint32_t>(patch_.positions.size() + copies_.size());
    report.vertex_count += more;
    report.welded_vertex_count += more;
    report.triangle_count += static_cast<std::uint32_t>(added_.size() / 3);
    out_.came.assign(given_.begin(), given_.end());
    out_.came.insert(out_.came.end(), copies_.begin(), copies_.end());
    report.isolated_vertex_count = static_cast<std::uint32_t>(mesh.isolated.size());
  }

  const Mesh& before_;
  const Topology* topology_;
  JobRunner* jobs_;
  const MeshPatch& patch_;
  Memory& memory_;
  PatchedMesh out_;
  Vector<std::uint8_t> gone_, touched_;  // by triangle and by vertex before; touched_ is 1 for one that goes
  Vector<Index> around_, added_;         // triangles before; corners of the new ones
  Vector<Index> given_;                  // vertices of the caller that become inner ones, ascending
  Vector<Index> cut_, cut_corners_;      // triangles before that are cut, ascending; their corners after
  Vector<Index> copies_, copied_;        // the copies by the caller's number, ascending; inner vertices before
  Vector<Corners> doubled_;              // of the triangles that are set aside
  Vector<Index> slots_;                  // the inner numbers of new vertices: of given_, then of the copies
  struct Moved {
    Index from, to;
  };
  std::size_t removed_ = 0;
  Vector<Moved> moved_;  // usable triangles with another number
};

}  // namespace

PatchedMesh patched_mesh(const Mesh& before, const Topology* topology, const MeshPatch& patch, Memory& memory,
                         JobRunner* jobs) {
  require_triangles(before, "a patch", HF_NO_INDEX);
  if (!before.faces.empty())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "triangles of a surface of polygons cannot be exchanged; make the surface of triangles");
  return MeshPatcher(before, topology, patch, memory, jobs).make();
}

}  // namespace hf_inner::mesh
