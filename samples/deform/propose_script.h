// Proposed handles as a script: what holds is added first, then one tip after the other is added, dragged and removed.
#ifndef HF_SAMPLES_DEFORM_PROPOSE_SCRIPT_H
#define HF_SAMPLES_DEFORM_PROPOSE_SCRIPT_H

#include <string>
#include <vector>

#include "deform/posable.h"

namespace samples {

struct ProposedHandle {
  // Named after the joint that moves most of it, else "foot 1", "tip 2", ...; the region is a list of vertices.
  HandleEntry entry;
  glm::dvec3 place{0};  // in the unit of the mesh
  hf_handle_proposal proposal;
};

// Asks the library, with the skeleton of the model where it has one. up: away from the ground.
std::vector<ProposedHandle> propose(const PosableMesh& mesh, const Posable& posable, const glm::dvec3& up);

// One line for each handle.
std::string list_of(const std::vector<ProposedHandle>& handles);

// The step that adds what holds.
Step hold_step(const std::vector<ProposedHandle>& handles);

// Shows all proposals, then raises limbs by their tips, arms first and then the longest, `tips` of them at most. Limbs
// keep their lengths. A limb that stands up, such as a head, tilts. Joints are dragged only where there is no tip.
ScriptFile propose_script(const FlatMesh& mesh, const std::vector<ProposedHandle>& handles, const glm::dvec3& up,
                          size_t tips);

}  // namespace samples

#endif
