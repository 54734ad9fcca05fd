#include "engine/stiffness.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "engine/site_cost.h"
#include "factor/edited_factor.h"

namespace hf_inner {
namespace {

double at_vertex(const Core& core, Index v) noexcept { return core.stiffness ? (*core.stiffness)[at(v)] : 1.0; }

// Writes the row of vertex v of the operator with another stiffness.
template <class StiffnessOf>
void write_row(const SymmetricMatrix& plain, Index v, StiffnessOf&& of, double* value) {
  const double own = of(v);
  std::size_t diagonal = 0;
  double sum = 0;
  bool changed = false;
  for (std::size_t i = at(plain.column_start[at(v)]); i < at(plain.column_start[at(v) + 1]); ++i) {
    if (plain.row[i] == v) {
      diagonal = i;
      continue;
    }
    const double share = edge_stiffness(own, of(plain.row[i]));
    changed |= share != 1;
    value[i] = plain.value[i] * share;
    sum -= value[i];
  }
  value[diagonal] = changed ? sum : plain.value[diagonal];  // other rows keep their bits
}

// The vertices whose rows differ, ascending: those of another stiffness and their neighbours.
Vector<Index> changed_rows(const Core& from, const Core& to) {
  const SymmetricMatrix& k = from.laplacian;
  Vector<std::uint8_t> differs(at(k.size()), 0, from.memory.get());
  for (Index v = 0; v < k.size(); ++v) {
    if (at_vertex(to, v) == at_vertex(from, v)) continue;
    for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) differs[at(k.row[at(i)])] = 1;
  }
  Vector<Index> rows(from.memory.get());
  for (Index v = 0; v < k.size(); ++v) {
    if (differs[at(v)]) rows.push_back(v);
  }
  return rows;
}

// The difference of the two operators on these rows.
MatrixChange difference(const SymmetricMatrix& to, const SymmetricMatrix& from, Vector<Index> rows, Memory& memory) {
  MatrixChange change(memory);
  change.unknown = std::move(rows);
  for (std::size_t p = 0; p < change.unknown.size(); ++p) {
    const std::size_t v = at(change.unknown[p]);
    for (std::size_t i = at(to.column_start[v]); i < at(to.column_start[v + 1]); ++i) {
      if (to.value[i] == from.value[i]) continue;
      const auto there = std::lower_bound(change.unknown.begin(), change.unknown.end(), to.row[i]);
      const Index column = static_cast<Index>(there - change.unknown.begin());
      change.entries.push_back({static_cast<Index>(p), column, to.value[i] - from.value[i]});
    }
  }
  return change;
}

}  // namespace

void stiffen(SymmetricMatrix& laplacian, const Vector<double>& stiffness) {
  for (Index v = 0; v < laplacian.size(); ++v)
    write_row(
        laplacian, v, [&](Index u) { return stiffness[at(u)]; }, laplacian.value.data());
}

namespace {

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

std::shared_ptr<Core> edited_copy(const Core& plain, std::shared_ptr<const Vector<double>> stiffness) {
  const std::shared_ptr<Core> made = make_owner_in<Core>(plain.memory, plain.geometry);
  made->field_kind = plain.field_kind;
  made->ordering = plain.ordering;
  made->flop_limit = plain.flop_limit;
  made->formed_valence = plain.formed_valence;
  made->changed_count = plain.changed_count;
  made->first_changed = plain.first_changed;
  made->is_long = plain.is_long;
  made->ground.assign(plain.ground.begin(), plain.ground.end());
  made->mean_diagonal.assign(plain.mean_diagonal.begin(), plain.mean_diagonal.end());
  SymmetricMatrix& k = made->laplacian;
  const SymmetricMatrix& before = plain.laplacian;
  k.column_start.assign(before.column_start.begin(), before.column_start.end());
  k.row.assign(before.row.begin(), before.row.end());
  k.value.assign(before.value.begin(), before.value.end());
  stiffen(k, *stiffness);
  made->stiffness = std::move(stiffness);
  return made;
}

}  // namespace

std::shared_ptr<const Core> edit_core(std::shared_ptr<const Core> from, std::shared_ptr<const Vector<double>> stiffness,
                                      double most) {
  if (from->field_kind != FieldKind::harmonic) return make_again(*from, std::move(stiffness));
  const std::shared_ptr<const Core> plain = from->unedited ? from->unedited : from;
  if (!stiffness) return plain;
  const std::shared_ptr<const Core> near = from->factored ? from->factored : from;
  Memory& memory = *from->memory;
  const std::shared_ptr<Core> made = edited_copy(*plain, std::move(stiffness));
  made->unedited = plain;
  Vector<Index> rows = changed_rows(*near, *made);
  const SiteCost cost(near->factor->statistics());
  if (cost.edit_ns(static_cast<double>(rows.size())) < most * cost.rebase_ns(0)) {
    const MatrixChange change = difference(made->laplacian, near->laplacian, std::move(rows), memory);
    made->factor = edit_factor(near->factor, change, memory, *from->jobs);
    made->factored = near;
  } else {
    made->factor = near->factor->refactor(grounded(*made), {}, memory, *from->jobs);
  }
  return made;
}

}  // namespace hf_inner
