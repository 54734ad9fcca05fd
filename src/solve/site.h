// Site is one constraint of a field. SiteEdit turns one set of sites into another.
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner::solve {

// A constraint w'u + compliance lambda = s on at most three unknowns of the field u. w are the weights, lambda is the
// flux into the site and s its value. A compliance of 0 makes the site hard.
struct Site {
  Index vertex[3] = {-1, -1, -1};  // inner vertices, or unknowns of another operator; unused corners are -1
  double weight[3] = {0, 0, 0};
  double compliance = 0;  // 1 / alpha; 0 = hard
  Index component = -1;
  Index part = -1;  // a site's elimination path is stored with paths of the same part only; -1: of any
  bool is_vertex() const noexcept { return vertex[1] < 0; }
  bool is_hard_vertex() const noexcept { return is_vertex() && compliance == 0; }
  static Site at_unknown(Index unknown, Index component, double compliance = 0) noexcept {
    Site site;
    site.vertex[0] = unknown;
    site.weight[0] = 1;
    site.compliance = compliance;
    site.component = component;
    return site;
  }
  static Site at_vertex(const mesh::Mesh& mesh, Index vertex, double compliance = 0) noexcept {
    return at_unknown(vertex, mesh.component[at(vertex)], compliance);
  }
};

// Lists the slots to empty and the slots to fill. A slot is the number of a site. A slot in both lists means that its
// site moves.
struct SiteEdit {
  Span<const Index> remove;
  Span<const Index> add;
  Span<const Site> sites;  // for `add`, in its order
  // The state after the edit, and so every bit of a field, depends on the sites by slot alone, not on earlier edits.
  // The caller's part: `add` is ascending, and an edit that changes a slot adds every later site again.
  bool history_free = false;
};

// The route says how the last edit of sites was carried out.
enum class EditRoute : std::int32_t {
  none = 0,
  dense = 1,   // rows of the dense system were added and removed
  fresh = 2,   // the dense system was made again, which costs less than editing it
  rebase = 3,  // hard vertex sites were eliminated in a new factor
};

}  // namespace hf_inner::solve
