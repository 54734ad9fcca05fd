// Pieces of a model that its skin calls rigid: every vertex of the piece follows one joint, which moves nothing else,
// as that of a sword. Armour shares its joint with a body and goes along with it.
#ifndef HF_SAMPLES_COMMON_RIGID_PARTS_H
#define HF_SAMPLES_COMMON_RIGID_PARTS_H

#include <cstdint>
#include <vector>

#include "common/links.h"

namespace samples {

// Returns by vertex the first vertex of its rigid piece, or HF_NO_INDEX where the piece bends. The largest piece and
// models without a skin have none.
std::vector<uint32_t> rigid_parts(const FlatMesh& mesh, const Model& model, const ModelLinks& skin);

// One vertex of each rigid piece, as the library takes them.
std::vector<uint32_t> rigid_vertices(const FlatMesh& mesh, const std::vector<uint32_t>& parts);

}  // namespace samples

#endif
