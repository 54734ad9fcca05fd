// The formats in which a transfer can be written, beside a new skin: keys of the target's own rig, morph targets, one
// mesh per frame.
#ifndef HF_SAMPLES_TRANSFER_OUTPUTS_H
#define HF_SAMPLES_TRANSFER_OUTPUTS_H

#include <filesystem>
#include <vector>

#include "common/mesh_file.h"
#include "transfer/session.h"

namespace samples {

// How far the written motion is from the transfer's motion, in box diagonals: root mean square and largest distance.
struct OutputFigures {
  double rms = 0, max = 0;
  size_t parts = 0;               // joints that turn, or morph targets
  size_t keys = 0, all_keys = 0;  // written, and before keys were left out
};

// The target as it is, with the transferred clips before its own (rig_fit.h). Standing feet are met more firmly than
// the rest. key_tolerance: see reduce_keys, in boxes.
Model own_skin_model(const Model& target, const Session& session, const std::vector<PlayedClip>& clips, double box,
                     double key_tolerance, OutputFigures& figures);

// The topmost node over the target's joints. Throws std::runtime_error without a skin.
int root_of_skin(const Model& model);
// Gives the travel that was taken out of the first clips to a node, as two keys.
void add_root_motion(Model& model, int root, const std::vector<PlayedClip>& clips);

// A written model's first clips, played: the source's frames, and what the model gives at the same times.
std::vector<PlayedClip> written_clips(const Model& written, const Session& session,
                                      const std::vector<PlayedClip>& clips);

// Leaves out keys of the first clips (key_reduce.h).
void reduce_clips(Model& model, const FlatMesh& mesh, size_t clips, double tolerance, OutputFigures& figures);

// The target without a skin; its frames are weighted sums of few displacements. These are the leading left singular
// vectors of all frames together. There are as many as keep every frame within `tolerance` (root mean square over the
// box), but at most `limit`. Each is one morph target, or two if its weight has both signs, because weights are 0..1.
// Normals follow by least squares.
Model morph_model(const Model& target, const FlatMesh& mesh, const std::vector<PlayedClip>& clips, double box,
                  double tolerance, size_t limit, OutputFigures& figures);

// Writes one mesh file per frame, named CLIP_0000 and so on (pose_0000 for a sequence without a name), with the vertex
// order and the faces of `rest`. Returns the names of the files.
std::vector<std::filesystem::path> write_frames(const std::filesystem::path& folder, const std::string& extension,
                                                const SurfaceMesh& rest, const std::vector<PlayedClip>& clips);

}  // namespace samples

#endif
