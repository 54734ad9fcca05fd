#include "mesh/mesh_patch.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "mesh/places.h"
#include "mesh/union_find.h"

namespace hf_inner {
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
  MeshPatcher(const Mesh& before, const MeshPatch& patch, Memory& memory)
      : before_(before),
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
        doubled_(&memory) {}

  PatchedMesh make() {
    list_doubled();
    read_removed();
    read_added();
    read_cuts();
    find_around();
    number_vertices();
    put_vertices();
    put_triangles();
    refuse_doubled();
    find_components();
    count();
    return std::move(out_);
  }

 private:
  static constexpr std::uint8_t is_cut = 2;  // in gone_; a removed triangle has 1
  static constexpr Index first_copy = -2;    // corners of cut triangles: -2 - i for the i-th copy

  void list_doubled() {
    for (const Mesh::Doubled& one : before_.doubled) doubled_.push_back(Corners(one.corner));
    std::sort(doubled_.begin(), doubled_.end());
  }
  // The corners of a triangle that changes are touched.
  void touch(Index t, std::uint32_t i, const char* list) {
    const Index* const v = before_.triangle(t);
    if (std::binary_search(doubled_.begin(), doubled_.end(), Corners(v)))
      fail(HF_ERROR_UNSUPPORTED, i,
           "entry %u of %s: triangle %u lies on another one; leave one of them out of the mesh", i, list,
           before_.given_of_triangle(t));
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
      touch(t, i, "removed_triangles");
      if (gone_[at(t)])
        fail(HF_ERROR_CONFLICT, i, "entry %u of removed_triangles: triangle %u is listed twice", i, given);
      gone_[at(t)] = 1;
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
      touch(t, HF_NO_INDEX, "cut_edges");
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

  // The triangles that stay and have a touched corner.
  void find_around() {
    const Index* v = before_.corners.data();
    for (Index t = 0; t < before_.triangle_count(); ++t, v += 3) {
      if ((touched_[at(v[0])] | touched_[at(v[1])] | touched_[at(v[2])]) != 0 && !gone_[at(t)]) around_.push_back(t);
    }
  }

  void number_vertices() {
    Vector<std::uint8_t> held(before_.positions.size(), 0, &memory_);
    for (const Index t : around_) {
      for (int k = 0; k < 3; ++k) held[at(before_.triangle(t)[k])] = 1;
    }
    for (const Vector<Index>* corners : {&added_, &cut_corners_}) {
      for (const Index v : *corners)
        if (v >= 0) held[at(v)] = 1;
    }
    out_.number.resize(before_.positions.size());
    Index next = 0;
    for (std::size_t v = 0; v < out_.number.size(); ++v) out_.number[v] = touched_[v] && !held[v] ? Mesh::none : next++;
    first_new_ = next;
    for (std::size_t v = 0; v < out_.number.size(); ++v)
      if (touched_[v] && held[v]) out_.touched.push_back(out_.number[v]);
    const Index copy = first_new_ + static_cast<Index>(given_.size());
    for (Index v = first_new_; v < copy + static_cast<Index>(copies_.size()); ++v) out_.touched.push_back(v);
    for (Index& v : added_) v = v >= 0 ? out_.number[at(v)] : first_new_ + (-2 - v);
    for (Index& v : cut_corners_) v = v >= 0 ? out_.number[at(v)] : copy + (first_copy - v);
  }

  void put_vertices() {
    Mesh& mesh = out_.mesh;
    mesh.report = before_.report;
    mesh.centre = before_.centre;
    mesh.scale = before_.scale;
    const std::size_t first = at(first_new_) + given_.size(), count = first + copies_.size(),
                      old = before_.report.vertex_count;
    mesh.positions.resize(count);
    mesh.given_of_inner.resize(count);
    for (std::size_t v = 0; v < out_.number.size(); ++v) {
      const Index to = out_.number[v];
      if (to == Mesh::none) continue;
      mesh.positions[at(to)] = before_.positions[v];
      mesh.given_of_inner[at(to)] = before_.given_of_inner[v];
    }
    mesh.inner_of_given.resize(old + patch_.positions.size() + copies_.size());
    Vector<Mesh::Isolated> isolated(&memory_);
    auto known = before_.isolated.begin();
    for (std::size_t g = 0; g < old; ++g) {
      const Index v = before_.inner_of_given[g];
      Index& to = mesh.inner_of_given[g];
      to = v == Mesh::none ? Mesh::none : out_.number[at(v)];
      if (v == Mesh::none)
        isolated.push_back(*known++);
      else if (to == Mesh::none)
        isolated.push_back({static_cast<Index>(g), before_.to_given(before_.positions[at(v)])});
    }
    for (std::size_t i = 0; i < patch_.positions.size(); ++i) {
      mesh.inner_of_given[old + i] = Mesh::none;
      isolated.push_back({static_cast<Index>(old + i), patch_.positions[i]});
    }
    for (std::size_t i = 0; i < copies_.size(); ++i) {
      mesh.positions[first + i] = before_.positions[at(copied_[i])];
      mesh.given_of_inner[first + i] = copies_[i];
      mesh.inner_of_given[at(copies_[i])] = static_cast<Index>(first + i);
    }
    // vertices that a new triangle takes are isolated no more
    auto taken = given_.begin();
    for (const Mesh::Isolated& one : isolated) {
      if (taken == given_.end() || *taken != one.given) {
        mesh.isolated.push_back(one);
        continue;
      }
      const Index v = first_new_ + static_cast<Index>(taken - given_.begin());
      mesh.positions[at(v)] = mesh.to_inner(one.position);
      mesh.given_of_inner[at(v)] = one.given;
      mesh.inner_of_given[at(one.given)] = v;
      ++taken;
    }
    for (const Index g : before_.turned)
      if (mesh.inner_of_given[at(g)] != Mesh::none) mesh.turned.push_back(g);
  }

  void put_triangles() {
    Mesh& mesh = out_.mesh;
    const Index count = before_.triangle_count();
    Vector<Index> number(at(count), &memory_);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < at(count); ++t) {
      number[t] = gone_[t] == 1 ? Mesh::none : static_cast<Index>(kept);
      kept += gone_[t] != 1;
    }
    if (kept == 0 && added_.empty())
      fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the edit removes every triangle; nothing is left of the surface");
    mesh.corners.resize(3 * kept + added_.size());
    Index* out = mesh.corners.data();
    const Index* corner = before_.corners.data();
    const Index* cut = cut_corners_.data();
    for (std::size_t t = 0; t < at(count); ++t, corner += 3) {
      if (gone_[t] == 1) continue;
      for (int k = 0; k < 3; ++k) *out++ = gone_[t] == is_cut ? *cut++ : out_.number[at(corner[k])];
    }
    std::copy(added_.begin(), added_.end(), out);
    const std::size_t given = before_.triangle_of_given.size();
    mesh.triangle_of_given.resize(given + added_.size() / 3);
    for (std::size_t g = 0; g < given; ++g) {
      const Index t = before_.triangle_of_given[g];
      mesh.triangle_of_given[g] = t == Mesh::none ? t : number[at(t)];
    }
    for (std::size_t i = 0; i < added_.size() / 3; ++i)
      mesh.triangle_of_given[given + i] = static_cast<Index>(kept + i);
    mesh.cuts.assign(before_.cuts.begin(), before_.cuts.end());
    mesh.cuts.append(patch_.cuts.begin(), patch_.cuts.end());
    for (Mesh::Doubled one : before_.doubled) {
      for (Index& v : one.corner) v = out_.number[at(v)];
      mesh.doubled.push_back(one);
    }
  }

  // Two triangles with the same corners would count twice.
  void refuse_doubled() const {
    Vector<Corners> keys(&memory_);
    for (std::size_t i = 0; i < added_.size() / 3; ++i)
      keys.push_back(Corners(&added_[3 * i], static_cast<std::uint32_t>(i)));
    for (const Index t : around_) {
      Index v[3];
      for (int k = 0; k < 3; ++k) v[k] = out_.number[at(before_.triangle(t)[k])];
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

  // Components stay if the triangles around the patch join what they joined before.
  void find_components() {
    Mesh& mesh = out_.mesh;
    const std::size_t count = mesh.positions.size();
    mesh.component.resize(count);
    Vector<Index> local(count, Mesh::none, &memory_), old(&memory_);
    Index next = 0;
    const auto number = [&](Index v, Index component) {
      if (local[at(v)] == Mesh::none) {
        local[at(v)] = next++;
        old.push_back(component);
      }
      return local[at(v)];
    };
    Vector<Index> sides(&memory_);  // pairs to unite
    for (const Index t : around_) {
      Index v[3];
      for (int k = 0; k < 3; ++k) {
        const Index u = before_.triangle(t)[k];
        v[k] = number(out_.number[at(u)], before_.component[at(u)]);
      }
      sides.insert(sides.end(), {v[0], v[1], v[1], v[2]});
    }
    for (const Vector<Index>* corners : {&added_, &cut_corners_}) {
      for (std::size_t i = 0; i < corners->size(); i += 3) {
        Index v[3];
        for (std::size_t k = 0; k < 3; ++k) v[k] = number((*corners)[i + k], Mesh::none);
        sides.insert(sides.end(), {v[0], v[1], v[1], v[2]});
      }
    }
    UnionFind sets(old.size(), memory_);
    for (std::size_t i = 0; i < sides.size(); i += 2) sets.unite(sides[i], sides[i + 1]);
    for (std::size_t v = 0; v < out_.number.size(); ++v) {  // corners of new triangles that stand alone so far
      const Index u = out_.number[v] == Mesh::none ? Mesh::none : local[at(out_.number[v])];
      if (u != Mesh::none) old[at(u)] = before_.component[v];
    }
    const std::size_t components = at(before_.component_count());
    Vector<Index> set_of(components, Mesh::none, &memory_), of_set(old.size(), Mesh::none, &memory_);
    bool same = true;
    for (std::size_t v = 0; v < old.size(); ++v) {
      const Index set = sets.find(static_cast<Index>(v));
      if (old[v] == Mesh::none) continue;
      Index &there = set_of[at(old[v])], &here = of_set[at(set)];
      if (there == Mesh::none) there = set;
      if (here == Mesh::none) here = old[v];
      same = same && there == set && here == old[v];
    }
    for (std::size_t v = 0; v < old.size(); ++v)
      same = same && of_set[at(sets.find(static_cast<Index>(v)))] != Mesh::none;
    for (std::size_t v = 0; v < out_.number.size(); ++v) {  // all of a component went
      if (out_.number[v] == Mesh::none) same = same && set_of[at(before_.component[v])] != Mesh::none;
    }
    out_.same_components = same;
    if (!same) return count_components();
    for (std::size_t v = 0; v < out_.number.size(); ++v)
      if (out_.number[v] != Mesh::none) mesh.component[at(out_.number[v])] = before_.component[v];
    for (std::size_t v = at(first_new_); v < count; ++v) mesh.component[v] = of_set[at(sets.find(local[v]))];
  }

  // Components are numbered by the first of the caller's vertices in them.
  void count_components() {
    Mesh& mesh = out_.mesh;
    UnionFind sets(mesh.positions.size(), memory_);
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      sets.unite(mesh.triangle(t)[0], mesh.triangle(t)[1]);
      sets.unite(mesh.triangle(t)[1], mesh.triangle(t)[2]);
    }
    mesh.component.assign(mesh.positions.size(), Mesh::none);
    mesh.report.component_count = 0;
    for (const Index v : mesh.inner_of_given) {
      if (v == Mesh::none || mesh.component[at(v)] != Mesh::none) continue;
      Index& of_root = mesh.component[at(sets.find(v))];
      if (of_root == Mesh::none) of_root = static_cast<Index>(mesh.report.component_count++);
      mesh.component[at(v)] = of_root;
    }
  }

  void count() {
    Mesh& mesh = out_.mesh;
    MeshReport& report = mesh.report;
    const auto more = static_cast<std::uint32_t>(patch_.positions.size() + copies_.size());
    report.vertex_count += more;
    report.welded_vertex_count += more;
    report.triangle_count += static_cast<std::uint32_t>(added_.size() / 3);
    report.isolated_vertex_count = static_cast<std::uint32_t>(mesh.isolated.size());
  }

  const Mesh& before_;
  const MeshPatch& patch_;
  Memory& memory_;
  PatchedMesh out_;
  Vector<std::uint8_t> gone_, touched_;  // by triangle and by vertex before
  Vector<Index> around_, added_;         // triangles before; corners of the new ones
  Vector<Index> given_;                  // vertices of the caller that become inner ones, ascending
  Vector<Index> cut_, cut_corners_;      // triangles before that are cut, ascending; their corners after
  Vector<Index> copies_, copied_;        // the copies by the caller's number, ascending; inner vertices before
  Vector<Corners> doubled_;              // of the triangles that are set aside
  Index first_new_ = 0;
};

}  // namespace

PatchedMesh patched_mesh(const Mesh& before, const MeshPatch& patch, Memory& memory) {
  require_triangles(before, "a patch", HF_NO_INDEX);
  if (!before.faces.empty())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "triangles of a surface of polygons cannot be exchanged; make the surface of triangles");
  return MeshPatcher(before, patch, memory).make();
}

}  // namespace hf_inner
