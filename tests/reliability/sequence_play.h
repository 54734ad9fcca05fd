// The player of a sequence (sequence_player.h). sequence_calls.cpp makes the calls, sequence_compare.cpp compares.
#pragma once
#include <memory>

#include "play.h"
#include "sequence_model.h"
#include "sequence_player.h"

namespace sequences {

using play::Bytes;
using play::expect;
using play::fail;
using play::Failure;
using play::hold;

// A surface that is destroyed with the last branch that names it.
struct Owned {
  hf_surface handle = nullptr;
  int field_kind = 0;  // of the factor it was made with
  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { hf_surface_destroy(handle); }
};

// A solver, its surface and the model of both. Branches share surfaces; a surface may be destroyed before its solvers.
// Clones are kept to go back to: no call edits them, whatever becomes of their solver.
struct Branch {
  std::shared_ptr<Owned> surface;  // empty: destroyed already
  hf_solver solver = nullptr;
  Model model;
  std::vector<std::unique_ptr<Branch>> kept;
  std::vector<double> kept_field;  // of a kept clone: the field of its solver when it was made
  explicit Branch(const Setting& setting) : model(setting) {}
  Branch(const Branch&) = delete;
  Branch& operator=(const Branch&) = delete;
  ~Branch() { hf_solver_destroy(solver); }
};

class Player {
 public:
  Player(Bytes bytes, Outcome& outcome) : bytes_(bytes), outcome_(outcome) {}
  void run();

 private:
  void begin();
  hf_surface_desc surface_desc(int field_kind) const;
  hf_solver_desc solver_desc() const;
  std::shared_ptr<Owned> make_surface(int field_kind, const hf_factor_desc* saved = nullptr);
  Owned& surface_of(Branch& branch);
  Branch& here() { return *branches_[active_]; }
  // the meaning of bytes
  Place take_place(bool points);
  double take_value();
  double take_stiffness();
  std::uint32_t take_site();
  void take_addition(Edit& edit, bool points);
  // calls
  void call(unsigned kind);
  void edit_sites(const Edit& edit, unsigned how);
  std::unique_ptr<Branch> clone_of(Branch& branch);
  void keep();
  void go_back(bool forget);
  void branch_off();
  void reload();
  void solve_some();
  void solve_single();
  void preview();
  void rebase();
  void share();
  void drop_surface();
  void pick();
  void pose();
  // comparisons
  void compare(Branch& branch);
  void compare_kept(Branch& clone);
  void compare_sites(Branch& branch);
  std::vector<double> field_of(Branch& branch);
  double error_of(Branch& branch, const std::vector<double>& field);

  Bytes bytes_;
  Outcome& outcome_;
  const Surface* surface_ = nullptr;
  Setting setting_;
  std::size_t surface_number_ = 0;
  int operator_kind_ = 0, field_kind_ = 0, ordering_ = 0;
  std::vector<std::unique_ptr<Branch>> branches_;
  std::size_t active_ = 0;
};

}  // namespace sequences
