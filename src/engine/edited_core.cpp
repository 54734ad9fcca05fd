#include "engine/edited_core.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "engine/link_change.h"
#include "engine/site_cost.h"
#include "factor/edited_factor.h"

namespace hf_inner {
namespace {

// Fields on an edited surface take corrections where rounding moves them by more than this. A stiffness of 1e4 on a
// torus gives 1.6e-11, on a ribbon of 300 squares 1.5e-10, beside needles 4e-9. With half, more strokes cost a
// correction; with twice, fields lose a digit.
constexpr double largest_rounding = 1e-10;

// Reads the rows of an edited operator: the rows before all edits, with other links and another stiffness.
class EditedRows {
 public:
  // links, stiffness: null for none.
  EditedRows(const SymmetricMatrix& plain, const LinkChange* links, const Vector<double>* stiffness, Memory& memory)
      : column(&memory), value(&memory), plain_(plain), links_(links), stiffness_(stiffness) {}
  EditedRows(const Core& core, Memory& memory)
      : EditedRows(core.unedited ? core.unedited->laplacian : core.laplacian, core.link_change.get(),
                   core.stiffness.get(), memory) {}

  // Calls use(u) for every neighbour of v that it had before all edits or has now, and for v. Some come twice.
  template <class Use>
  void for_neighbours(Index v, Use&& use) const {
    for (Index i = plain_.column_start[at(v)]; i < plain_.column_start[at(v) + 1]; ++i) use(plain_.row[at(i)]);
    for (const LinkEnd& end : links_at(v)) use(end.other);
  }
  // Reads the row of v into column and value. The diagonal of a changed row is minus the sum of the others.
  void read(Index v) {
    column.clear();
    value.clear();
    const double own = stiffness_of(v);
    const Span<const LinkEnd> ends = links_at(v);
    const LinkEnd* end = ends.begin();
    bool changed = !ends.empty();
    double sum = 0;
    const auto put = [&](Index u, double entry) {
      const double other = stiffness_of(u);
      const bool same = own == 1 && other == 1;  // most rows keep their bits
      changed |= !same;
      column.push_back(u);
      value.push_back(same ? entry : entry * edge_stiffness(own, other));
      sum -= value.back();
    };
    const auto put_links_before = [&](Index u) {
      for (; end != ends.end() && end->other < u; ++end) put(end->other, end->before - end->after);
    };
    std::size_t diagonal = 0;
    for (std::size_t i = at(plain_.column_start[at(v)]); i < at(plain_.column_start[at(v) + 1]); ++i) {
      const Index u = plain_.row[i];
      put_links_before(u);
      if (u == v) {
        diagonal = column.size();
        column.push_back(u);
        value.push_back(plain_.value[i]);
        continue;
      }
      if (end == ends.end() || end->other != u) {
        put(u, plain_.value[i]);
        continue;
      }
      if (!end->crosses)
        put(u, plain_.value[i] + (end->before - end->after));
      else if (end->after > 0)
        put(u, -end->after);
      ++end;
    }
    put_links_before(plain_.size());
    if (changed) value[diagonal] = sum;
  }
  Span<const LinkEnd> links_at(Index v) const noexcept { return links_ ? links_->at_vertex(v) : Span<const LinkEnd>(); }

  Vector<Index> column;  // of the row that was read, ascending
  Vector<double> value;

 private:
  double stiffness_of(Index v) const noexcept { return stiffness_ ? (*stiffness_)[at(v)] : 1.0; }
  const SymmetricMatrix& plain_;
  const LinkChange* links_;
  const Vector<double>* stiffness_;
};

double at_vertex(const Core& core, Index v) noexcept { return core.stiffness ? (*core.stiffness)[at(v)] : 1.0; }

// How much the diagonal of the factorised matrix is raised at a vertex.
double raise_at(const Core& core, Index v) noexcept {
  const std::size_t c = at(core.mesh.component[at(v)]);
  return core.ground[c] == v ? core.mean_diagonal[c] : 0.0;
}

bool has_end(const Core& core, Index v) noexcept { return core.link_change && !core.link_change->at_vertex(v).empty(); }

// Lists the rows in which the two factorised matrices differ, and which of these rows lie inside. A ground vertex and
// the end of an edited link count as the rim.
MatrixChange changed_rows(const Core& from, const Core& to) {
  Memory& memory = *from.memory;
  MatrixChange change(memory);
  Vector<Index>& rows = change.unknown;
  const EditedRows before(from, memory), after(to, memory);
  for (Index v = 0; from.stiffness != to.stiffness && v < to.size(); ++v) {
    if (at_vertex(to, v) == at_vertex(from, v)) continue;
    before.for_neighbours(v, [&](Index u) { rows.push_back(u); });
    for (const LinkEnd& end : after.links_at(v)) rows.push_back(end.other);
  }
  if (from.link_change != to.link_change) {
    for (const Core* core : {&from, &to}) {
      if (!core->link_change) continue;
      for (const LinkEnd& end : core->link_change->ends) rows.push_back(end.vertex);
    }
  }
  if (from.geometry != to.geometry) {
    for (const Core* core : {&from, &to}) {
      for (const Index v : core->ground)
        if (raise_at(from, v) != raise_at(to, v)) rows.push_back(v);
    }
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const Index v = rows[p];
    if (raise_at(from, v) != 0 || raise_at(to, v) != 0 || has_end(from, v) || has_end(to, v)) continue;
    bool inside = true;
    before.for_neighbours(v, [&](Index u) { inside = inside && std::binary_search(rows.begin(), rows.end(), u); });
    if (inside) change.inside.push_back(static_cast<Index>(p));
  }
  return change;
}

// Fills in the entries of D, and the entries of A in the rows inside.
void fill_entries(const Core& from, const Core& to, MatrixChange& change) {
  EditedRows before(from, *from.memory), after(to, *from.memory);
  auto inside = change.inside.begin();
  for (std::size_t p = 0; p < change.unknown.size(); ++p) {
    const Index v = change.unknown[p], row = static_cast<Index>(p);
    before.read(v);
    after.read(v);
    const bool is_inside = inside != change.inside.end() && at(*inside) == p;
    if (is_inside) ++inside;
    const double raised = raise_at(to, v) - raise_at(from, v);
    for (std::size_t i = 0, j = 0; i < before.column.size() || j < after.column.size();) {
      const bool in_before =
          j == after.column.size() || (i < before.column.size() && before.column[i] <= after.column[j]);
      const bool in_after =
          i == before.column.size() || (j < after.column.size() && after.column[j] <= before.column[i]);
      const Index u = in_before ? before.column[i] : after.column[j];
      const double old = in_before ? before.value[i] : 0.0;
      const double added = (in_after ? after.value[j] : 0.0) - old + (u == v ? raised : 0.0);
      i += in_before;
      j += in_after;
      if (added == 0 && !is_inside) continue;
      const auto there = std::lower_bound(change.unknown.begin(), change.unknown.end(), u);
      const Index column = static_cast<Index>(there - change.unknown.begin());
      if (is_inside) change.inside_entries.push_back({row, column, old});
      if (added != 0) change.entries.push_back({row, column, added});
    }
  }
}

}  // namespace

// The first vertex of every piece, and the sum and the number of its diagonals.
struct PieceDiagonals {
  explicit PieceDiagonals(const Core& plain)
      : first(plain.memory.get()), sum(plain.memory.get()), count(plain.memory.get()) {
    const Mesh& mesh = plain.geometry->unlinked().mesh;
    first.assign(at(mesh.component_count()), Mesh::none);
    sum.assign(first.size(), 0.0);
    count.assign(first.size(), 0.0);
    for (Index v = 0; v < plain.size(); ++v) {
      const std::size_t piece = at(mesh.component[at(v)]);
      if (first[piece] == Mesh::none) first[piece] = v;
      sum[piece] += std::fabs(plain.laplacian.value[plain.laplacian.diagonal(v)]);
      count[piece] += 1;
    }
  }
  Vector<Index> first;
  Vector<double> sum, count;
};

namespace {

std::shared_ptr<const PieceDiagonals> piece_diagonals(const Core& plain) {
  const std::lock_guard<std::mutex> lock(plain.pieces_guard);
  if (!plain.pieces) plain.pieces = make_shared_in<PieceDiagonals>(*plain.memory, plain);
  return plain.pieces;
}

// Finds the pinned vertex and the unit of the components that other links make, as Core::make does.
void find_linked_grounds(Core& made) {
  const Links& links = *made.geometry->links;
  const std::shared_ptr<const PieceDiagonals> found = piece_diagonals(*made.unedited);
  const PieceDiagonals& pieces = *found;
  Vector<double> sum(at(links.group_count), 0.0, made.memory.get()), count(sum.size(), 0.0, made.memory.get());
  made.ground.assign(sum.size(), Mesh::none);
  for (std::size_t p = 0; p < pieces.first.size(); ++p) {
    const std::size_t c = at(links.group[p]);
    if (made.ground[c] == Mesh::none || pieces.first[p] < made.ground[c]) made.ground[c] = pieces.first[p];
    sum[c] += pieces.sum[p];
    count[c] += pieces.count[p];
  }
  for (const LinkEnd& end : made.link_change->ends)
    sum[at(made.mesh.component[at(end.vertex)])] += end.after - end.before;
  made.mean_diagonal.resize(sum.size());
  for (std::size_t c = 0; c < sum.size(); ++c) made.mean_diagonal[c] = sum[c] > 0 ? sum[c] / count[c] : 1.0;
}

// A core of another kind of field, made with the ordering of `from`.
std::shared_ptr<const Core> make_again(const Core& from, SurfaceEdit edit) {
  CoreOptions options;
  options.operator_kind = from.geometry->operator_kind;
  options.field_kind = from.field_kind;
  options.ordering = from.ordering;
  options.flop_limit = from.flop_limit;
  options.formed_valence = from.formed_valence;
  options.like = from.root ? nullptr : &from;
  options.stiffness = std::move(edit.stiffness);
  return Core::make(std::move(edit.geometry), options);
}

std::shared_ptr<Core> edited_copy(std::shared_ptr<const Core> plain, const Core& from, SurfaceEdit edit) {
  const std::shared_ptr<Core> made = make_owner_in<Core>(plain->memory, std::move(edit.geometry));
  made->field_kind = plain->field_kind;
  made->ordering = plain->ordering;
  made->flop_limit = plain->flop_limit;
  made->formed_valence = plain->formed_valence;
  made->changed_count = plain->changed_count;
  made->first_changed = plain->first_changed;
  made->is_long = plain->is_long;
  made->stiffness = std::move(edit.stiffness);
  made->unedited = std::move(plain);
  const Core& before = *made->unedited;
  const Core* const same = made->geometry == before.geometry ? &before
                           : made->geometry == from.geometry ? &from
                                                             : nullptr;
  if (same) {
    made->ground.assign(same->ground.begin(), same->ground.end());
    made->mean_diagonal.assign(same->mean_diagonal.begin(), same->mean_diagonal.end());
    made->link_change = same->link_change;
  } else {
    made->link_change = LinkChange::make(before.geometry->links.get(), *made->geometry->links,
                                         before.geometry->operator_kind, *made->memory);
    find_linked_grounds(*made);
  }
  made->edited = make_shared_in<EditedMatrix>(*made->memory, made->unedited, made->link_change, made->stiffness);
  return made;
}

// Gives a core the factor of `near`, edited in the changed rows. Returns false if these rows lose too many digits.
bool share_factor(Core& made, std::shared_ptr<const Core> near, MatrixChange change) {
  try {
    fill_entries(*near, made, change);
    made.factor = edit_factor(near->factor, change, *made.memory, *made.jobs);
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
    return false;
  }
  made.is_long = made.is_long || made.factor->statistics().rounding > largest_rounding;
  made.factored = std::move(near);
  return true;
}

void factorise_again(Core& made, const Core& near) {
  try {
    made.factor = near.factor->refactor(grounded(made), {}, *made.memory, *made.jobs);
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
    const auto vertex = static_cast<std::uint32_t>(made.mesh.given_of_inner[error.index()]);
    fail(HF_ERROR_NOT_POSITIVE_DEFINITE, vertex,
         "with this stiffness the matrix is not positive definite, as found at vertex %u; raise negative weights, or "
         "let the stiffness vary less",
         vertex);
  }
  made.is_long = is_long_shape(made);
}

}  // namespace

void stiffen(SymmetricMatrix& laplacian, const Vector<double>& stiffness, Memory& memory) {
  EditedRows rows(laplacian, nullptr, &stiffness, memory);
  for (Index v = 0; v < laplacian.size(); ++v) {
    rows.read(v);  // this and earlier rows alone are written
    std::copy(rows.value.begin(), rows.value.end(), laplacian.value.begin() + laplacian.column_start[at(v)]);
  }
}

EditedMatrix::EditedMatrix(std::shared_ptr<const Core> plain, std::shared_ptr<const LinkChange> links,
                           std::shared_ptr<const Vector<double>> stiffness)
    : plain_(std::move(plain)), links_(std::move(links)), stiffness_(std::move(stiffness)), made_(*plain_->memory) {}

const SymmetricMatrix& EditedMatrix::get() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (made_.size() > 0) return made_;
  const SymmetricMatrix& before = plain_->laplacian;
  SymmetricMatrix made(*plain_->memory);
  const std::size_t room = before.row.size() + (links_ ? links_->ends.size() : 0);
  made.column_start.reserve(before.column_start.size());
  made.column_start.push_back(0);
  made.row.reserve(room);
  made.value.reserve(room);
  EditedRows rows(before, links_.get(), stiffness_.get(), *plain_->memory);
  for (Index v = 0; v < before.size(); ++v) {
    rows.read(v);
    made.row.insert(made.row.end(), rows.column.begin(), rows.column.end());
    made.value.insert(made.value.end(), rows.value.begin(), rows.value.end());
    made.column_start.push_back(static_cast<Index>(made.row.size()));
  }
  made_ = std::move(made);
  return made_;
}

std::shared_ptr<const Core> edit_core(std::shared_ptr<const Core> from, SurfaceEdit edit, double most) {
  const std::shared_ptr<const Core> plain = from->unedited ? from->unedited : from;
  if (!edit.geometry) edit.geometry = from->geometry;
  if (from->field_kind != FieldKind::harmonic) return make_again(*from, std::move(edit));
  if (!edit.stiffness && edit.geometry == plain->geometry) return plain;
  const std::shared_ptr<const Core> near = from->factored ? from->factored : from;
  const std::shared_ptr<Core> made = edited_copy(plain, *from, std::move(edit));
  MatrixChange change = changed_rows(*near, *made);
  const SiteCost cost(near->factor->statistics());
  const double inside = static_cast<double>(change.inside.size());
  const bool few = cost.edit_ns(static_cast<double>(change.unknown.size()) - inside, inside) < most * cost.rebase_ns(0);
  if (!few || !share_factor(*made, near, std::move(change))) factorise_again(*made, *near);
  return made;
}

}  // namespace hf_inner
