// A contact sheet of a posed surface: frames over time with the handles coloured by layer, and the last one as shading
// stripes.
#ifndef HF_SAMPLES_DEFORM_POSE_SHEET_H
#define HF_SAMPLES_DEFORM_POSE_SHEET_H

#include <filesystem>
#include <string>
#include <vector>

#include "common/picture.h"
#include "deform/posable.h"

namespace samples {

struct SheetFrame {
  std::vector<double> positions;
  std::string label;
  std::vector<uint8_t> layer;  // per vertex: 1 + the layer of the handle it belongs to, or 0
};

void write_pose_sheet(const std::filesystem::path& file, const PosableMesh& mesh, const std::vector<SheetFrame>& frames,
                      const ScriptFile& script, const std::string& title);

}  // namespace samples

#endif
