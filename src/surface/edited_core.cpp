#include "surface/edited_core.h"

#include <algorithm>
#include <cmath>

#include "base/differences.h"
#include "base/error.h"
#include "base/index.h"
#include "factor/extended_factor.h"
#include "factor/site_cost.h"
#include "surface/core_difference.h"
#include "surface/edited_rows.h"
#include "surface/link_change.h"
#include "surface/piece_diagonals.h"

namespace hf_inner::surface {
namespace {

// Fields on an edited surface take corrections where rounding moves them by more than this. A stiffness of 1e4 on a
// torus gives 1.6e-11, on a ribbon of 300 squares 1.5e-10, beside needles 4e-9. With half, more strokes cost a
// correction; with twice, fields lose a digit.
constexpr double largest_rounding = 1e-10;

// The pieces after a patch.
PieceDiagonals patched_pieces(const Core& plain, const PatchRows& patch, const mesh::Mesh& mesh) {
  PieceDiagonals out(*plain.pieces, *plain.memory);
  const mesh::Mesh& old = plain.geometry->unlinked().mesh;
  const auto diagonal_before = [&](Index u) { return std::fabs(plain.laplacian.value[plain.laplacian.diagonal(u)]); };
  bool same = patch.map.keeps_numbers() && old.component_count() == mesh.component_count();
  if (same) {
    const Index both = std::min(old.vertex_count(), mesh.vertex_count());
    std::size_t others = 0;
    for_differences(old.component.data(), mesh.component.data(), at(both), [&](std::size_t) { ++others; });
    for (const Index v : patch.map.fresh()) others -= v < both && old.component[at(v)] != mesh.component[at(v)];
    same = others == 0;
  }
  if (!same) {
    out.sum_up(mesh, [&](Index v) {
      const Index changed = patch.find(v);
      return changed >= 0 ? patch.diagonal(changed) : diagonal_before(patch.map.from(v));
    });
    return out;
  }
  for (std::size_t i = 0; i < patch.vertex.size(); ++i) {
    const Index u = patch.map.from(patch.vertex[i]);
    const std::size_t c = at(mesh.component[at(patch.vertex[i])]);
    out.sum[c] += std::fabs(patch.diagonal(static_cast<Index>(i))) - (u == mesh::Mesh::none ? 0.0 : diagonal_before(u));
    out.count[c] += u == mesh::Mesh::none;
  }
  for (const Index u : patch.map.went()) {
    out.sum[at(old.component[at(u)])] -= diagonal_before(u);
    out.count[at(old.component[at(u)])] -= 1;
  }
  for (std::size_t c = 0; c < out.first.size(); ++c) {
    out.first[c] = patch.map.to(out.first[c]);
    for (Index v = 0; out.first[c] == mesh::Mesh::none && v < mesh.vertex_count(); ++v)
      if (at(mesh.component[at(v)]) == c) out.first[c] = v;
  }
  return out;
}

// Finds the pinned vertex and the unit of the components after an edit, as Core::make does.
void find_edited_grounds(Core& made) {
  const mesh::Links* const links = made.geometry->links.get();
  const Core& plain = *made.unedited;
  PieceDiagonals pieces(*made.memory);
  if (made.patch)
    pieces = patched_pieces(plain, *made.patch, made.geometry->unlinked().mesh);
  else
    pieces = PieceDiagonals(*plain.pieces, *made.memory);
  Vector<double> sum(at(made.mesh.component_count()), 0.0, made.memory.get()),
      count(sum.size(), 0.0, made.memory.get());
  made.ground.assign(sum.size(), mesh::Mesh::none);
  for (std::size_t p = 0; p < pieces.first.size(); ++p) {
    const std::size_t c = links ? at(links->group[p]) : p;
    if (made.ground[c] == mesh::Mesh::none || pieces.first[p] < made.ground[c]) made.ground[c] = pieces.first[p];
    sum[c] += pieces.sum[p];
    count[c] += pieces.count[p];
  }
  for (std::size_t i = 0; made.link_change && i < made.link_change->ends.size(); ++i) {
    const LinkEnd& end = made.link_change->ends[i];
    sum[at(made.mesh.component[at(end.vertex)])] += end.after - end.before;
  }
  made.mean_diagonal.resize(sum.size());
  for (std::size_t c = 0; c < sum.size(); ++c) made.mean_diagonal[c] = sum[c] > 0 ? sum[c] / count[c] : 1.0;
}

// A core with a factor of its own. One of the same pattern takes the ordering of `from`.
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

// patch: the rows that exchanged triangles changed since `plain`; null: none.
std::shared_ptr<Core> edited_copy(std::shared_ptr<const Core> plain, const Core& from, SurfaceEdit edit,
                                  std::shared_ptr<const PatchRows> patch) {
  const std::shared_ptr<Core> made = make_owner_in<Core>(plain->memory, std::move(edit.geometry));
  made->take_options(*plain);
  made->is_long = plain->is_long;
  made->stiffness = std::move(edit.stiffness);
  made->patch = std::move(patch);
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
    if (made->geometry->links)
      made->link_change = LinkChange::make(before.geometry->links.get(), *made->geometry->links,
                                           before.geometry->operator_kind, *made->memory);
    find_edited_grounds(*made);
  }
  made->edited =
      make_shared_in<EditedMatrix>(*made->memory, made->unedited, made->patch, made->link_change, made->stiffness);
  return made;
}

// Gives a core the factor of `near`, edited in the changed rows. Returns false if these rows lose too many digits.
bool share_factor(Core& made, std::shared_ptr<const Core> near, std::shared_ptr<const factor::Factor> base,
                  const factor::MatrixChange& change) {
  try {
    made.factor = factor::edit_factor(std::move(base), change, *made.memory, *made.jobs);
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
    return false;
  }
  made.is_long = made.is_long || made.factor->statistics().rounding > largest_rounding;
  made.factored = std::move(near);
  return true;
}

// The rows of the unknowns in a factor beside the factor of `from`: a new unknown has a row of its own.
Vector<Index> rows_of(const factor::Factor& factor, const Unknowns& unknowns, Memory& memory) {
  const VertexMap& map = unknowns.map;
  const Span<const Index> position = factor.position();
  Vector<Index> rows(position.begin(), position.begin() + std::min(map.before_count(), map.after_count()), &memory);
  rows.resize(at(unknowns.count()));
  if (!map.keeps_numbers()) {
    for (Index v = 0; v < map.after_count(); ++v)
      if (map.from(v) != mesh::Mesh::none) rows[at(v)] = position[at(map.from(v))];
  }
  for (std::size_t j = 0; j < map.fresh().size(); ++j)
    rows[at(map.fresh()[j])] = map.before_count() + static_cast<Index>(j);
  for (std::size_t d = 0; d < map.went().size(); ++d) rows[at(map.after_count()) + d] = position[at(map.went()[d])];
  return rows;
}

void factorise_again(Core& made, const factor::Factor& base) {
  try {
    made.factor = base.refactor(grounded(made), {}, *made.memory, *made.jobs);
  } catch (const Error& error) {
    if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
    const auto vertex = static_cast<std::uint32_t>(made.mesh.given_of_inner[error.index()]);
    fail(
        HF_ERROR_NOT_POSITIVE_DEFINITE, vertex,
        "with this edit the matrix is not positive definite, as found at vertex %u; raise negative weights, or let the "
        "stiffness vary less",
        vertex);
  }
  made.is_long = is_long_shape(made);
}

}  // namespace

void stiffen(SymmetricMatrix& laplacian, const Vector<double>& stiffness, Memory& memory) {
  EditedRows rows(laplacian, nullptr, nullptr, &stiffness, memory);
  for (Index v = 0; v < laplacian.size(); ++v) {
    rows.read(v);  // this and earlier rows alone are written
    std::copy(rows.value.begin(), rows.value.end(), laplacian.value.begin() + laplacian.column_start[at(v)]);
  }
}

EditedMatrix::EditedMatrix(std::shared_ptr<const Core> plain, std::shared_ptr<const PatchRows> patch,
                           std::shared_ptr<const LinkChange> links, std::shared_ptr<const Vector<double>> stiffness)
    : plain_(std::move(plain)),
      patch_(std::move(patch)),
      links_(std::move(links)),
      stiffness_(std::move(stiffness)),
      made_(*plain_->memory) {}

const SymmetricMatrix& EditedMatrix::get() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (made_.size() > 0) return made_;
  const SymmetricMatrix& before = plain_->laplacian;
  SymmetricMatrix made(*plain_->memory);
  const std::size_t room =
      before.row.size() + (patch_ ? patch_->column.size() : 0) + (links_ ? links_->ends.size() : 0);
  made.column_start.reserve(before.column_start.size());
  made.column_start.push_back(0);
  made.row.reserve(room);
  made.value.reserve(room);
  EditedRows rows(before, patch_.get(), links_.get(), stiffness_.get(), *plain_->memory);
  const Index size = patch_ ? patch_->map.after_count() : before.size();
  for (Index v = 0; v < size; ++v) {
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
  if (from->field_kind != mesh::FieldKind::harmonic) return make_again(*from, std::move(edit));
  if (!edit.stiffness && edit.geometry == plain->geometry) return plain;
  const auto is_numbered_as = [&](const Core& core) { return core.mesh.shares(edit.geometry->mesh); };
  std::shared_ptr<const PatchRows> patch;
  if (!is_numbered_as(*plain)) {
    patch = is_numbered_as(*from)    ? from->patch
            : plain->geometry->links ? nullptr
                                     : PatchRows::make(*plain, *edit.geometry);
    if (!patch) {  // the whole operator changes
      const std::shared_ptr<const Geometry> alone = edit.geometry->plain ? edit.geometry->plain : edit.geometry;
      const std::shared_ptr<const Core> made = make_again(*plain, {nullptr, alone});
      return edit_core(made, std::move(edit), most);
    }
  }
  const std::shared_ptr<const Core> near = from->factored ? from->factored : from;
  const std::shared_ptr<Core> made = edited_copy(plain, *from, std::move(edit), std::move(patch));
  std::shared_ptr<const factor::Factor> base = near->factor;
  factor::MatrixChange change(*made->memory);
  if (Unknowns::are_same(*near, *made)) {
    change = core_difference(*near, *made, nullptr);
  } else {
    const Unknowns unknowns(*near, *made);
    change = core_difference(*near, *made, &unknowns);
    base = factor::extend_factor(std::move(base), rows_of(*near->factor, unknowns, *made->memory), made->size(),
                                 unknowns.scale, *made->memory);
  }
  const factor::SiteCost cost(near->factor->statistics());
  const double inside = static_cast<double>(change.inside.size());
  const bool few = cost.edit_ns(static_cast<double>(change.unknown.size()) - inside, inside) < most * cost.rebase_ns(0);
  if (few && share_factor(*made, near, base, change)) return made;
  try {
    factorise_again(*made, *base);
  } catch (const Error& error) {
    // needles among new triangles: Core::make has ways to factorise them
    if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE || !made->patch) throw;
    return make_again(*plain, {made->stiffness, made->geometry});
  }
  return made;
}

}  // namespace hf_inner::surface
