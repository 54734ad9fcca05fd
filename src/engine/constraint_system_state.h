// The state of a ConstraintSystem: sites by slot, their paths and dense blocks. A plain value that shares what is
// immutable, so copies are cheap and going back to one gives the same bits.
#pragma once
#include "engine/dense_block.h"
#include "engine/eliminated_base.h"
#include "engine/site.h"

namespace hf_inner {

struct ConstraintState {
  // A row of the dense system is named by the slot of its site or, for the free value of base index b, by -2 - b.
  static constexpr Index no_row = -1;
  static Index free_row(Index base_index) noexcept { return -2 - base_index; }
  static Index base_index(Index row) noexcept { return -2 - row; }

  // Where the path of a row lies.
  struct Path {
    Index group = -1, column = -1;
  };
  // Paths of up to PathGroup::capacity rows; row[column] = no_row once it is gone.
  struct Group {
    std::shared_ptr<const PathGroup> paths;
    Index row[PathGroup::capacity];
    Index used = 0;
  };
  struct Entry {
    Site site;                                        // component -1: the slot is free
    Path path;                                        // of a row
    Index eliminated = -1;                            // base index of a site in the factor
    double border[PinnedOperator::most_border] = {};  // its row of N: only where pins have paths
    bool used() const noexcept { return site.component >= 0; }
  };
  struct Free {
    Path path;
    bool is_row() const noexcept { return path.group >= 0; }  // else the base site is in force
  };
  // The cost model's prediction for an edit, and the route taken.
  struct Decision {
    EditRoute route = EditRoute::none;
    double dense_ms = 0, rebase_ms = 0;
    bool eliminate = false;  // starting over costs less with the hard vertex sites in the factor
  };

  ConstraintState(std::size_t components, Memory& memory)
      : entries(&memory),
        freed(&memory),
        groups(&memory),
        blocks(components, &memory),
        sites_of(components, 0, &memory) {}
  ConstraintState(const ConstraintState& other, Memory& memory)
      : entries(other.entries, &memory),
        base(other.base),
        freed(other.freed, &memory),
        groups(other.groups, &memory),
        blocks(other.blocks, &memory),
        sites_of(other.sites_of, &memory),
        rows(other.rows),
        decision(other.decision) {}
  ConstraintState(ConstraintState&&) = default;
  void swap(ConstraintState& other) noexcept;

  Path& path_of(Index row) noexcept { return row >= 0 ? entries[at(row)].path : freed[at(base_index(row))].path; }
  bool floating(std::size_t component) const noexcept { return !base || base->floating[component]; }
  void put(Index slot, const Site& site);  // into a free slot

  Vector<Entry> entries;                       // by slot
  std::shared_ptr<const EliminatedBase> base;  // null: the operator's own factor
  Vector<Free> freed;                          // by base index
  Vector<Group> groups;
  Vector<std::shared_ptr<const DenseBlock>> blocks;  // by component; null without a row
  Vector<Index> sites_of;                            // sites by component
  Index rows = 0;                                    // of all blocks
  Decision decision;                                 // of the edit that led here
};

}  // namespace hf_inner
