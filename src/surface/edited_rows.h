// Reads the rows of an edited operator: the rows before all edits, with other triangles, other links and another
// stiffness.
#pragma once
#include "surface/core.h"
#include "surface/link_change.h"
#include "surface/patch_rows.h"

namespace hf_inner::surface {

class EditedRows {
 public:
  // plain: the operator before all edits. patch, links, stiffness: null for none; links and stiffness belong to the
  // vertices after the patch.
  EditedRows(const SymmetricMatrix& plain, const PatchRows* patch, const LinkChange* links,
             const Vector<double>* stiffness, Memory& memory)
      : column(&memory),
        value(&memory),
        plain_(plain),
        patch_(patch),
        links_(links),
        stiffness_(stiffness),
        own_column_(&memory) {}
  EditedRows(const Core& core, Memory& memory)
      : EditedRows(core.unedited ? core.unedited->laplacian : core.laplacian, core.patch.get(), core.link_change.get(),
                   core.stiffness.get(), memory) {}

  // Calls use(u) for every neighbour of v before links and stiffness were edited and after that, and for v. Some come
  // twice.
  template <class Use>
  void for_neighbours(Index v, Use&& use) {
    const Row row = plain_row(v);
    for (std::size_t i = 0; i < row.size; ++i) use(row.column[i]);
    for (const LinkEnd& end : links_at(v)) use(end.other);
  }
  // Reads the row of v into column and value. The diagonal of a changed row is minus the sum of the others.
  void read(Index v);
  Span<const LinkEnd> links_at(Index v) const noexcept { return links_ ? links_->at_vertex(v) : Span<const LinkEnd>(); }

  Vector<Index> column;  // of the row that was read, ascending
  Vector<double> value;

 private:
  struct Row {
    const Index* column;
    const double* value;
    std::size_t size;
  };
  // The row without links and stiffness.
  Row plain_row(Index v);
  double stiffness_of(Index v) const noexcept { return stiffness_ ? (*stiffness_)[at(v)] : 1.0; }

  const SymmetricMatrix& plain_;
  const PatchRows* patch_;
  const LinkChange* links_;
  const Vector<double>* stiffness_;
  Vector<Index> own_column_;
};

}  // namespace hf_inner::surface
