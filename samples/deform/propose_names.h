// Names proposed handles by the skeleton of a model: the lowest joint that moves most of a region, with all below it,
// names the handle. A hand, a head, a tail or a thing that one of them holds is dragged, not pinned.
#ifndef HF_SAMPLES_DEFORM_PROPOSE_NAMES_H
#define HF_SAMPLES_DEFORM_PROPOSE_NAMES_H

#include <string>

#include "common/links.h"
#include "deform/posable.h"
#include "gltf/known_body.h"

namespace samples {

class RegionOwners {
 public:
  explicit RegionOwners(const PosableMesh& mesh);
  // The lowest node that moves, with what hangs on it, more than half of the vertices within the radius: a hand, not
  // one of its fingers. -1: no node does.
  int owner(const glm::dvec3& point, double radius) const;
  std::string name(int node) const;
  // Whether a node belongs to an arm, a head or a tail, or hangs on one, as a sword does.
  bool hangs_free(int node) const;

 private:
  bool is_under(int node, int other) const;
  const PosableMesh& mesh_;
  ModelLinks skin_;
  KnownBody body_;
};

}  // namespace samples

#endif
