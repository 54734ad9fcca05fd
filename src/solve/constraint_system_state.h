// The state of a ConstraintSystem: the sites by slot, their elimination paths and dense blocks. A slot is the number of
// a site. A state can be copied cheaply, because copies share their immutable parts. Restoring a copy gives the same
// bits.
#pragma once
#include <limits>

#include "solve/dense_block.h"
#include "solve/eliminated_base.h"
#include "solve/site.h"

namespace hf_inner::surface {
class VertexMap;
}

namespace hf_inner::solve {

struct ConstraintState {
  // A row of the dense system has a number. The row of a site has the number of its slot. If the factor eliminates a
  // vertex and its site was removed, its value is unknown. The row of this value has the number -2 - b, with b the
  // vertex's index in EliminatedBase.
  static constexpr Index no_row = -1;
  static constexpr Index index_end = std::numeric_limits<Index>::max();
  static Index free_row(Index base_index) noexcept { return -2 - base_index; }
  static Index base_index(Index row) noexcept { return -2 - row; }

  // Says where the elimination path of a row is: in which group of paths, and in which column of the group.
  struct Path {
    Index group = -1, column = -1;
  };
  // A group of at most PathGroup::capacity elimination paths. row[column] is the dense row of a path, or no_row after
  // its removal.
  struct Group {
    std::shared_ptr<const factor::PathGroup> paths;
    Index row[factor::PathGroup::capacity];
    Index used = 0;
  };
  struct Entry {
    Site site;                                        // component -1: no site has this slot
    Path path;                                        // where the elimination path of its row is
    Index eliminated = -1;                            // index among the sites that the factor eliminates, or -1
    double border[PinnedOperator::most_border] = {};  // its row of the border N; only where pinned unknowns have paths
    bool used() const noexcept { return site.component >= 0; }
  };
  struct Free {
    Path path;
    bool is_row() const noexcept { return path.group >= 0; }  // else the factor eliminates it
  };
  // The predicted costs of an edit of the sites, and the way (route) in which it was carried out.
  struct Decision {
    EditRoute route = EditRoute::none;
    double dense_ms = 0, rebase_ms = 0;
    // Building the dense system again costs less if the factor eliminates the hard vertex sites.
    bool eliminate = false;
    Index end = index_end;  // a rebase takes hard vertex sites of slots below it out of the matrix
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
  void put(Index slot, const Site& site);  // slot: a number not in use

  Vector<Entry> entries;                       // by slot
  std::shared_ptr<const EliminatedBase> base;  // factor with eliminated sites; null: the operator's own
  Vector<Free> freed;                          // by eliminated site: its value, if it was removed
  Vector<Group> groups;
  Vector<std::shared_ptr<const DenseBlock>> blocks;  // by component; null without a row
  Vector<Index> sites_of;                            // sites by component
  Index rows = 0;                                    // rows of all blocks
  Decision decision;                                 // how the last edit was carried out
};

// The sites of another system. The present system can take their elimination paths (Factor::take_paths).
struct KnownPaths {
  std::shared_ptr<const ConstraintState> state;  // null: none
  std::shared_ptr<const factor::Factor> factor;
  std::shared_ptr<const surface::VertexMap> map;  // from the vertices of that system to vertices here; null: the same
};

}  // namespace hf_inner::solve
