// One edit of a ConstraintSystem. It removes and adds rows on a copy of the state, which becomes the present one later.
#pragma once
#include "solve/constraint_system_state.h"

namespace hf_inner::solve {

class ConstraintEdit {
 public:
  // Thrown when the present order of the dense rows cannot take the edit. Either a component has no eliminated site
  // left, or a pivot failed and the order of the rows may be the reason.
  struct NeedsNewLayout {};

  // Prepares one edit of the sites. state: a copy of the system's state, which the edit changes in place. known: where
  // the paths of some sites are known. last: no other layout follows. After an exception this copy is useless.
  ConstraintEdit(const PinnedOperator& a, JobRunner& jobs, const SiteEdit& edit, ConstraintState& state,
                 const KnownPaths& known, bool last)
      : operator_(a), jobs_(jobs), edit_(edit), state_(state), known_(known), last_(last) {}

  void go_on();                // edits the present rows
  void start_over(Index end);  // adds every site again; hard vertex sites of slots below end leave the matrix

  std::uint32_t path_solves() const noexcept { return path_solves_; }
  std::uint32_t factorisations() const noexcept { return factorisations_; }

 private:
  struct Row {
    Index row;  // number of the row: a site's slot or free_row
    Index component;
  };
  struct Batch;
  struct Part;
  void remove_sites(Vector<Row>& coming);
  void place_sites(Vector<Row>& coming);
  void check_bases() const;
  void remove_rows(Span<const Row> rows);
  void add_rows(Span<const Row> rows);
  void add_paths(Span<const Index> rows);
  void take_known_paths(Vector<Index>& left);
  Index known_column(Index row, std::size_t group) const noexcept;
  void solve_part(Part& part) const;
  void take_part(Part& part);
  void project_pins(std::size_t first_group);
  void take_gram(std::size_t first_group, Batch& batch) const;
  Vector<Index> known_places() const;
  void take_known_gram(const ConstraintState::Group& mine, const ConstraintState::Group& other, Span<const Index> place,
                       double* gram) const;
  void take_couplings(Batch& batch) const;
  void append_rows(const Batch& batch);
  void refuse_dependent(const DenseBlock& block, Index component, Index failed) const;
  bool are_vertices(Index component) const;
  Index dependent_slot(const DenseBlock& block, Index component) const;
  void drop_empty_groups();
  void repack();
  std::shared_ptr<DenseBlock> block_to_edit(std::size_t component) const;
  const factor::Factor& factor() const noexcept { return state_.base ? *state_.base->factor : *operator_.factor; }
  Memory& memory() const noexcept { return *operator_.memory; }

  const PinnedOperator& operator_;
  JobRunner& jobs_;
  const SiteEdit& edit_;
  ConstraintState& state_;
  const KnownPaths& known_;
  bool last_;
  std::size_t taken_first_ = 0, taken_end_ = 0;  // the groups whose paths `known` has too
  std::uint32_t path_solves_ = 0, factorisations_ = 0;
};

}  // namespace hf_inner::solve
