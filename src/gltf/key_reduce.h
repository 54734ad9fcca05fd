// Leaves out keys of a clip that its other keys give back by interpolation, within a bound on where vertices go.
#ifndef HF_GLTF_KEY_REDUCE_H
#define HF_GLTF_KEY_REDUCE_H

#include "gltf/flat_mesh.h"
#include "gltf/model.h"

namespace hf_gltf {

// Each linear channel keeps the fewest keys, found from the start on, between which a straight line misses no key by
// more than its part of the tolerance. A rotation counts by how far it moves the furthest vertex of its joint. Then all
// key times are played: if a vertex is further off than `tolerance` (a length), the channels get smaller parts. Returns
// the largest distance found. Other channels stay as they are.
double reduce_keys(const Model& model, const FlatMesh& mesh, Animation& animation, double tolerance);

// Keys of all channels.
size_t key_count(const Animation& animation);

}  // namespace hf_gltf

#endif
