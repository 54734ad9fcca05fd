// Gives the skeleton of a model to the library (hf/skeleton.h). Nodes become joints; a mesh without a skin moves with
// its node.
#ifndef HF_SAMPLES_DEFORM_MODEL_SKELETON_H
#define HF_SAMPLES_DEFORM_MODEL_SKELETON_H

#include "gltf/flat_mesh.h"
#include "gltf/model.h"
#include "hf/skeleton.h"

namespace samples {

using namespace hf_gltf;

class ModelSkeleton {
 public:
  // mesh: the surface of the model at rest. Throws std::runtime_error with the library's message.
  ModelSkeleton(const Model& model, const FlatMesh& mesh);
  ~ModelSkeleton() { hf_skeleton_destroy(skeleton_); }
  ModelSkeleton(const ModelSkeleton&) = delete;
  ModelSkeleton& operator=(const ModelSkeleton&) = delete;
  // NULL for a model without a skin.
  hf_skeleton get() const { return skeleton_; }

 private:
  hf_skeleton skeleton_ = nullptr;
};

}  // namespace samples

#endif
