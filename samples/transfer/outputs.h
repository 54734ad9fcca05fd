// What a transfer can be written as, beside a new skin: keys of the target's own rig, morph targets, meshes per frame.
#ifndef HF_SAMPLES_TRANSFER_OUTPUTS_H
#define HF_SAMPLES_TRANSFER_OUTPUTS_H

#include <filesystem>
#include <vector>

#include "common/mesh_file.h"
#include "transfer/session.h"

namespace samples {

// How far the written motion is from the transfer's, root mean square and largest, in box diagonals.
struct OutputFigures {
  double rms = 0, max = 0;
  size_t parts = 0;  // joints that turn, or morph targets
};

// The target with its own nodes, skin and looks; its clips are the played ones (rig_fit.h).
Model own_skin_model(const Model& target, const FlatMesh& mesh, const std::vector<PlayedClip>& clips, double box,
                     OutputFigures& figures);

// The target without a skin, its frames as weighted sums of few displacements: the leading left singular vectors of all
// frames together, as many as keep every frame within `tolerance` (root mean square over the box), at most `limit`,
// each one target or, where it goes both ways, two (weights are 0..1). Normals follow by least squares.
Model morph_model(const Model& target, const FlatMesh& mesh, const std::vector<PlayedClip>& clips, double box,
                  double tolerance, size_t limit, OutputFigures& figures);

// One mesh file per frame, CLIP_0000 and so on (pose_0000 for a sequence without a name), in `rest`'s vertex order with
// its faces. Returns the names written.
std::vector<std::filesystem::path> write_frames(const std::filesystem::path& folder, const std::string& extension,
                                                const SurfaceMesh& rest, const std::vector<PlayedClip>& clips);

}  // namespace samples

#endif
