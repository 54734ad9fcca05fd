// A contact sheet of a transfer: the rest pose and frames over the clip, the source above, the target below, each seen
// from the side and from the front.
#ifndef HF_SAMPLES_TRANSFER_CLIP_SHEET_H
#define HF_SAMPLES_TRANSFER_CLIP_SHEET_H

#include <filesystem>
#include <vector>

#include "transfer/session.h"

namespace samples {

struct SheetBody {
  const Model& model;
  const FlatMesh& mesh;
  const Axes& axes;
};

// Four rows per clip; a body without a surface has none. Throws std::runtime_error when the file cannot be written.
void write_clip_sheet(const std::filesystem::path& file, const SheetBody& source, const SheetBody& target,
                      const std::vector<PlayedClip>& clips);

// The rest pose and shapes, seen from the front: all shapes where there are few, else some, evenly taken. names: of the
// frames.
void write_shape_sheet(const std::filesystem::path& file, const Session& session, const Model& source,
                       const Model& target, const PlayedClip& shapes, const std::vector<std::string>& names);

}  // namespace samples

#endif
