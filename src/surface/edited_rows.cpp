#include "surface/edited_rows.h"

#include <limits>

namespace hf_inner::surface {

EditedRows::Row EditedRows::plain_row(Index v) {
  const auto row_of = [](const Vector<Index>& start, const Vector<Index>& column, const Vector<double>& value,
                         Index i) -> Row {
    const std::size_t begin = at(start[at(i)]);
    return {column.data() + begin, value.data() + begin, at(start[at(i) + 1]) - begin};
  };
  if (!patch_) return row_of(plain_.column_start, plain_.row, plain_.value, v);
  const Index changed = patch_->find(v);
  if (changed >= 0) return row_of(patch_->start, patch_->column, patch_->value, changed);
  const Row before = row_of(plain_.column_start, plain_.row, plain_.value, patch_->map.from(v));
  own_column_.clear();
  for (std::size_t i = 0; i < before.size; ++i) own_column_.push_back(patch_->map.to(before.column[i]));
  return {own_column_.data(), before.value, before.size};
}

void EditedRows::read(Index v) {
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
  const Row row = plain_row(v);
  for (std::size_t i = 0; i < row.size; ++i) {
    const Index u = row.column[i];
    put_links_before(u);
    if (u == v) {
      diagonal = column.size();
      column.push_back(u);
      value.push_back(row.value[i]);
      continue;
    }
    if (end == ends.end() || end->other != u) {
      put(u, row.value[i]);
      continue;
    }
    if (!end->crosses)
      put(u, row.value[i] + (end->before - end->after));
    else if (end->after > 0)
      put(u, -end->after);
    ++end;
  }
  put_links_before(std::numeric_limits<Index>::max());
  if (changed) value[diagonal] = sum;
}

}  // namespace hf_inner::surface
