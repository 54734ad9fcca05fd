// A generated head as a glTF model: one mesh with its 52 shapes as morph targets, and a clip that blinks.
#ifndef HF_SAMPLES_ASSETS_FACE_GLTF_H
#define HF_SAMPLES_ASSETS_FACE_GLTF_H

#include "assets/face.h"
#include "gltf/model.h"

namespace samples {

using namespace hf_gltf;

// shapes: with morph targets and the clip "blink"; else the bare head.
Model to_model(const Face& face, const std::string& name, bool shapes);

}  // namespace samples

#endif
