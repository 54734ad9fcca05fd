#include "engine/stiffness.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "engine/site_cost.h"
#include "factor/edited_factor.h"

namespace hf_inner {
namespace {

// Fields on an edited surface take corrections where rounding moves them by more than this. A stiffness of 1e4 on a
// torus gives 1.6e-11, on a ribbon of 300 squares 1.5e-10, beside needles 4e-9. With half, more strokes cost a
// correction; with twice, fields lose a digit.
constexpr double largest_rounding = 1e-10;

double at_vertex(const Core& core, Index v) noexcept { return core.stiffness ? (*core.stiffness)[at(v)] : 1.0; }

// Writes the row of vertex v with a stiffness: its entries from `value` on. of(vertex) is the stiffness of a vertex.
// Returns whether the row differs from that of the plain operator.
template <class StiffnessOf>
bool write_row(const SymmetricMatrix& plain, Index v, StiffnessOf&& of, double* value) {
  const double own = of(v);
  const std::size_t begin = at(plain.column_start[at(v)]), end = at(plain.column_start[at(v) + 1]);
  std::size_t diagonal = 0;
  double sum = 0;
  bool changed = false;
  for (std::size_t i = begin; i < end; ++i) {
    if (plain.row[i] == v) {
      diagonal = i - begin;
      continue;
    }
    const double other = of(plain.row[i]);
    const bool same = own == 1 && other == 1;  // most rows keep their bits
    value[i - begin] = same ? plain.value[i] : plain.value[i] * edge_stiffness(own, other);
    changed |= !same;
    sum -= value[i - begin];
  }
  value[diagonal] = changed ? sum : plain.value[begin + diagonal];
  return changed;
}

// Lists the rows in which the two operators differ, and which of these rows lie inside. A ground vertex counts as the
// rim, because the factorised matrix has more there than the operator.
MatrixChange changed_rows(const SymmetricMatrix& plain, const Core& from, const Core& to) {
  Memory& memory = *from.memory;
  MatrixChange change(memory);
  Vector<Index>& rows = change.unknown;
  for (Index v = 0; v < plain.size(); ++v) {
    if (at_vertex(to, v) == at_vertex(from, v)) continue;
    for (Index i = plain.column_start[at(v)]; i < plain.column_start[at(v) + 1]; ++i) rows.push_back(plain.row[at(i)]);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const Index v = rows[p];
    if (from.ground[at(from.mesh.component[at(v)])] == v) continue;
    bool inside = true;
    for (Index i = plain.column_start[at(v)]; inside && i < plain.column_start[at(v) + 1]; ++i)
      inside = std::binary_search(rows.begin(), rows.end(), plain.row[at(i)]);
    if (inside) change.inside.push_back(static_cast<Index>(p));
  }
  return change;
}

// Fills in the entries of D, and the entries of A in the rows inside.
void fill_entries(const SymmetricMatrix& plain, const Core& from, const Core& to, MatrixChange& change) {
  Memory& memory = *from.memory;
  Vector<double> before(&memory), after(&memory);
  auto inside = change.inside.begin();
  for (std::size_t p = 0; p < change.unknown.size(); ++p) {
    const Index v = change.unknown[p];
    const std::size_t begin = at(plain.column_start[at(v)]), count = at(plain.column_start[at(v) + 1]) - begin;
    before.resize(count);
    after.resize(count);
    write_row(
        plain, v, [&](Index u) { return at_vertex(from, u); }, before.data());
    write_row(
        plain, v, [&](Index u) { return at_vertex(to, u); }, after.data());
    const bool is_inside = inside != change.inside.end() && at(*inside) == p;
    if (is_inside) ++inside;
    for (std::size_t i = 0; i < count; ++i) {
      if (after[i] == before[i] && !is_inside) continue;
      const auto there = std::lower_bound(change.unknown.begin(), change.unknown.end(), plain.row[begin + i]);
      const Index column = static_cast<Index>(there - change.unknown.begin());
      const Index row = static_cast<Index>(p);
      if (is_inside) change.inside_entries.push_back({row, column, before[i]});
      if (after[i] != before[i]) change.entries.push_back({row, column, after[i] - before[i]});
    }
  }
}

// A core of another kind of field, made with the ordering of `from`.
std::shared_ptr<const Core> make_again(const Core& from, std::shared_ptr<const Vector<double>> stiffness) {
  CoreOptions options;
  options.operator_kind = from.geometry->operator_kind;
  options.field_kind = from.field_kind;
  options.ordering = from.ordering;
  options.flop_limit = from.flop_limit;
  options.formed_valence = from.formed_valence;
  options.like = from.root ? nullptr : &from;
  options.stiffness = std::move(stiffness);
  return Core::make(from.geometry, options);
}

std::shared_ptr<Core> edited_copy(std::shared_ptr<const Core> plain, std::shared_ptr<const Vector<double>> stiffness) {
  const std::shared_ptr<Core> made = make_owner_in<Core>(plain->memory, plain->geometry);
  made->field_kind = plain->field_kind;
  made->ordering = plain->ordering;
  made->flop_limit = plain->flop_limit;
  made->formed_valence = plain->formed_valence;
  made->changed_count = plain->changed_count;
  made->first_changed = plain->first_changed;
  made->is_long = plain->is_long;
  made->ground.assign(plain->ground.begin(), plain->ground.end());
  made->mean_diagonal.assign(plain->mean_diagonal.begin(), plain->mean_diagonal.end());
  made->stiffness = stiffness;
  made->edited = make_shared_in<EditedMatrix>(*plain->memory, plain, std::move(stiffness));
  made->unedited = std::move(plain);
  return made;
}

// Gives a core the factor of `near`, edited in the changed rows. Returns false if these rows lose too many digits.
bool share_factor(Core& made, std::shared_ptr<const Core> near, MatrixChange change) {
  try {
    fill_entries(made.unedited->laplacian, *near, made, change);
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

void stiffen(SymmetricMatrix& laplacian, const Vector<double>& stiffness) {
  for (Index v = 0; v < laplacian.size(); ++v)
    write_row(
        laplacian, v, [&](Index u) { return stiffness[at(u)]; }, &laplacian.value[at(laplacian.column_start[at(v)])]);
}

EditedMatrix::EditedMatrix(std::shared_ptr<const Core> plain, std::shared_ptr<const Vector<double>> stiffness)
    : plain_(std::move(plain)), stiffness_(std::move(stiffness)), made_(*plain_->memory) {}

const SymmetricMatrix& EditedMatrix::get() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (made_.size() > 0) return made_;
  const SymmetricMatrix& before = plain_->laplacian;
  SymmetricMatrix made(*plain_->memory);
  made.column_start.assign(before.column_start.begin(), before.column_start.end());
  made.row.assign(before.row.begin(), before.row.end());
  made.value.assign(before.value.begin(), before.value.end());
  stiffen(made, *stiffness_);
  made_ = std::move(made);
  return made_;
}

std::shared_ptr<const Core> edit_core(std::shared_ptr<const Core> from, std::shared_ptr<const Vector<double>> stiffness,
                                      double most) {
  if (from->field_kind != FieldKind::harmonic) return make_again(*from, std::move(stiffness));
  const std::shared_ptr<const Core> plain = from->unedited ? from->unedited : from;
  if (!stiffness) return plain;
  const std::shared_ptr<const Core> near = from->factored ? from->factored : from;
  const std::shared_ptr<Core> made = edited_copy(plain, std::move(stiffness));
  MatrixChange change = changed_rows(plain->laplacian, *near, *made);
  const SiteCost cost(near->factor->statistics());
  const double inside = static_cast<double>(change.inside.size());
  const bool few = cost.edit_ns(static_cast<double>(change.unknown.size()) - inside, inside) < most * cost.rebase_ns(0);
  if (!few || !share_factor(*made, near, std::move(change))) factorise_again(*made, *near);
  return made;
}

}  // namespace hf_inner
