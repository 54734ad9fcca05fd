#include "surface/core_difference.h"

#include <algorithm>
#include <cmath>

#include "surface/edited_rows.h"

namespace hf_inner::surface {
namespace {

double at_vertex(const Core& core, Index v) noexcept { return core.stiffness ? (*core.stiffness)[at(v)] : 1.0; }

// How much the diagonal of the factorised matrix is raised at a vertex.
double raise_at(const Core& core, Index v) noexcept {
  const std::size_t c = at(core.mesh.component[at(v)]);
  return core.ground[c] == v ? core.mean_diagonal[c] : 0.0;
}

bool has_end(const Core& core, Index v) noexcept { return core.link_change && !core.link_change->at_vertex(v).empty(); }

class Difference {
 public:
  Difference(const Core& from, const Core& to, const Unknowns* unknowns)
      : from_(from),
        to_(to),
        unknowns_(unknowns),
        before_(from, *from.memory),
        after_(to, *from.memory),
        old_(from.memory.get()),
        now_(from.memory.get()),
        change_(*from.memory) {}

  factor::MatrixChange find() {
    list_rows();
    list_inside();
    fill_entries();
    return std::move(change_);
  }

 private:
  struct Entry {
    Index column;
    double value;
    bool operator<(const Entry& o) const noexcept { return column < o.column; }
  };

  // The vertex of `from` that an unknown is, or none for a new one; of `to`, or none for one that went.
  Index before_of(Index x) const noexcept {
    if (!unknowns_) return x;
    const Index v = unknowns_->vertex_before(x);
    return v < from_.size() ? v : mesh::Mesh::none;
  }
  Index after_of(Index x) const noexcept { return x < to_.size() ? x : mesh::Mesh::none; }
  Index unknown_of_before(Index v) const noexcept { return unknowns_ ? unknowns_->of_before(v) : v; }

  double raise_before(Index x) const noexcept {
    const Index v = before_of(x);
    return v == mesh::Mesh::none ? 0.0 : raise_at(from_, v);
  }
  double raise_after(Index x) const noexcept {
    const Index v = after_of(x);
    return v == mesh::Mesh::none ? raise_before(x) : raise_at(to_, v);
  }

  void list_rows() {
    Vector<Index>& rows = change_.unknown;
    for (Index v = 0; (from_.stiffness != to_.stiffness) && v < to_.size(); ++v) {
      const Index u = before_of(v);
      if (u == mesh::Mesh::none || at_vertex(to_, v) == at_vertex(from_, u)) continue;
      before_.for_neighbours(u, [&](Index w) { rows.push_back(unknown_of_before(w)); });
      after_.for_neighbours(v, [&](Index w) { rows.push_back(w); });
    }
    if (from_.link_change != to_.link_change) {
      for (std::size_t i = 0; from_.link_change && i < from_.link_change->ends.size(); ++i)
        rows.push_back(unknown_of_before(from_.link_change->ends[i].vertex));
      for (std::size_t i = 0; to_.link_change && i < to_.link_change->ends.size(); ++i)
        rows.push_back(to_.link_change->ends[i].vertex);
    }
    if (from_.geometry != to_.geometry) {
      const auto take = [&](Index x) {
        if (raise_before(x) != raise_after(x)) rows.push_back(x);
      };
      for (const Index v : from_.ground) take(unknown_of_before(v));
      for (const Index v : to_.ground) take(v);
    }
    if (unknowns_) list_patch();
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  }

  // The rows that exchanged triangles change, and the rows of vertices that came and went.
  void list_patch() {
    Vector<Index>& rows = change_.unknown;
    rows.insert(rows.end(), unknowns_->map.fresh().begin(), unknowns_->map.fresh().end());
    for (Index x = to_.size(); x < unknowns_->count(); ++x) rows.push_back(x);
    const auto take = [&](Index x) {
      if (before_of(x) == mesh::Mesh::none || after_of(x) == mesh::Mesh::none) return;
      read_before(x);
      read_after(x);
      if (old_.size() != now_.size() ||
          !std::equal(old_.begin(), old_.end(), now_.begin(),
                      [](const Entry& a, const Entry& b) { return a.column == b.column && a.value == b.value; }))
        rows.push_back(x);
    };
    for (std::size_t i = 0; to_.patch && i < to_.patch->vertex.size(); ++i) take(to_.patch->vertex[i]);
    for (std::size_t i = 0; from_.patch && i < from_.patch->vertex.size(); ++i)
      take(unknown_of_before(from_.patch->vertex[i]));
  }

  void list_inside() {
    const Vector<Index>& rows = change_.unknown;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const Index x = rows[p], u = before_of(x), v = after_of(x);
      if (raise_before(x) != 0 || raise_after(x) != 0) continue;
      if ((u != mesh::Mesh::none && has_end(from_, u)) || (v != mesh::Mesh::none && has_end(to_, v))) continue;
      bool inside = true;
      if (u != mesh::Mesh::none)
        before_.for_neighbours(
            u, [&](Index w) { inside = inside && std::binary_search(rows.begin(), rows.end(), unknown_of_before(w)); });
      if (inside) change_.inside.push_back(static_cast<Index>(p));
    }
  }

  void read_before(Index x) {
    old_.clear();
    const Index u = before_of(x);
    if (u == mesh::Mesh::none) return old_.push_back({x, unknowns_->scale * unknowns_->scale});
    before_.read(u);
    for (std::size_t i = 0; i < before_.column.size(); ++i)
      old_.push_back({unknown_of_before(before_.column[i]), before_.value[i]});
    if (unknowns_) std::sort(old_.begin(), old_.end());
  }
  void read_after(Index x) {
    now_.clear();
    const Index v = after_of(x);
    if (v != mesh::Mesh::none) {
      after_.read(v);
      for (std::size_t i = 0; i < after_.column.size(); ++i) now_.push_back({after_.column[i], after_.value[i]});
      return;
    }
    for (const Entry& entry : old_)  // read before
      if (after_of(entry.column) == mesh::Mesh::none) now_.push_back(entry);
  }

  // Fills in the entries of D, and the entries of A in the rows inside.
  void fill_entries() {
    const Vector<Index>& rows = change_.unknown;
    auto inside = change_.inside.begin();
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const Index x = rows[p], row = static_cast<Index>(p);
      read_before(x);
      read_after(x);
      const bool is_inside = inside != change_.inside.end() && at(*inside) == p;
      if (is_inside) ++inside;
      const double raised = raise_after(x) - raise_before(x);
      for (std::size_t i = 0, j = 0; i < old_.size() || j < now_.size();) {
        const bool in_before = j == now_.size() || (i < old_.size() && old_[i].column <= now_[j].column);
        const bool in_after = i == old_.size() || (j < now_.size() && now_[j].column <= old_[i].column);
        const Index y = in_before ? old_[i].column : now_[j].column;
        const double old = in_before ? old_[i].value : 0.0;
        const double added = (in_after ? now_[j].value : 0.0) - old + (y == x ? raised : 0.0);
        i += in_before;
        j += in_after;
        if (added == 0 && !is_inside) continue;
        const auto there = std::lower_bound(rows.begin(), rows.end(), y);
        const Index column = static_cast<Index>(there - rows.begin());
        if (is_inside) change_.inside_entries.push_back({row, column, old});
        if (added != 0) change_.entries.push_back({row, column, added});
      }
    }
  }

  const Core &from_, &to_;
  const Unknowns* unknowns_;
  EditedRows before_, after_;
  Vector<Entry> old_, now_;  // the rows that were read, in the numbering of the unknowns
  factor::MatrixChange change_;
};

}  // namespace

Unknowns::Unknowns(const Core& from, const Core& to) : map(from.mesh, to.mesh, *from.memory) {
  scale = std::sqrt(from.mean_diagonal.front());
}

factor::MatrixChange core_difference(const Core& from, const Core& to, const Unknowns* unknowns) {
  return Difference(from, to, unknowns).find();
}

}  // namespace hf_inner::surface
