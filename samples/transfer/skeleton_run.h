// A transfer whose joints lead: the joints of the target turn as those of the source. No surface is factorised.
#ifndef HF_SAMPLES_TRANSFER_SKELETON_RUN_H
#define HF_SAMPLES_TRANSFER_SKELETON_RUN_H

#include <optional>
#include <string>
#include <vector>

#include "common/progress_bar.h"
#include "gltf/known_body.h"
#include "gltf/skeleton_pair.h"
#include "gltf/stance.h"
#include "transfer/transfer_options.h"
#include "transfer/transfer_report.h"

namespace samples {

// Two models as their files have them, and what their skeletons say in the poses in which they stand.
struct JointModels {
  JointModels(const Model& source_model, const Model& target_model, const TransferCommand& command,
              const std::optional<Pose>& given_source_rest, const std::optional<Pose>& given_target_rest);
  const Model &source, &target;
  FlatMesh source_mesh, target_mesh;  // in these poses
  Stance source_stance, target_stance;
  SkeletonPair pair;
  KnownBody source_known, target_known;
};

// Which way the motion goes, and why. Throws std::runtime_error if --way skeleton cannot be.
struct ChosenWay {
  bool joints = false;
  std::string why;
  bool either = false;  // joints can lead too: the way with the higher confidence is kept
};
ChosenWay choose_way(const TransferCommand& command, const JointModels& models);

// Plays the clips, writes file and sheet, reads the file again.
RunReport run_by_joints(const JointModels& models, const std::vector<const Animation*>& clips,
                        const TransferCommand& command, ProgressBar& bar);

// Adds what the joints say of the written clips: how limbs follow, how soles slide, how deep the surface goes. target:
// the written model; the first clips are those. Lowers the confidence.
void judge_pose(const JointModels& models, const Model& written, const std::vector<const Animation*>& clips,
                const std::vector<PlayedClip>& played, bool with_limbs, double scale, RunReport& report);

}  // namespace samples

#endif
