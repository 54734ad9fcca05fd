// Links for the pieces of a model: with the skin of a glTF file as a hint, and sentences about them.
#ifndef HF_SAMPLES_COMMON_LINKS_H
#define HF_SAMPLES_COMMON_LINKS_H

#include <cstdio>
#include <string>
#include <vector>

#include "common/flat_mesh.h"
#include "hf/surface.h"

namespace samples {

// The automatic links of a model. `desc` points into the object.
struct ModelLinks {
  // model: NULL for a surface without a skin.
  ModelLinks(const Model* model, const FlatMesh& mesh);
  ModelLinks(const ModelLinks&) = delete;
  ModelLinks& operator=(const ModelLinks&) = delete;
  hf_links_desc desc = HF_INIT(hf_links_desc);
  std::vector<uint16_t> joints;  // 8 per vertex; empty without a skin
  std::vector<float> weights;
};

// "66 pieces, joined by 824 links (8 light pieces; 2 stay apart)"; empty for a surface of one piece.
inline std::string links_sentence(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  if (hf_surface_get_report(surface, &report) != HF_OK || report.piece_count < 2) return {};
  const auto number = [](uint32_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  std::string out = number(report.piece_count, "piece");
  if (report.link_count == 0) return out + ", not linked: fields and poses end where a piece ends";
  out += ", joined by " + number(report.link_count, "link");
  std::string more;
  if (report.light_piece_count > 0) more = number(report.light_piece_count, "light piece");
  if (report.lone_piece_count > 0)
    more += (more.empty() ? "" : "; ") + std::to_string(report.lone_piece_count) + " too far from the others to join";
  return more.empty() ? out : out + " (" + more + ")";
}

// "gaps between linked pieces: 0.08 % of the box at 95 of 100 links, 0.6 % at worst"; empty without links. diagonal: of
// the box. positions: xyz of every vertex.
inline std::string gaps_sentence(hf_surface surface, const std::vector<double>& positions, double diagonal) {
  hf_gaps_desc posed = HF_INIT(hf_gaps_desc);
  posed.positions_f64 = positions.data();
  hf_gaps_info info = HF_INIT(hf_gaps_info);
  if (hf_surface_measure_gaps(surface, &posed, 0, nullptr, &info) != HF_OK || info.link_count == 0) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "gaps between linked pieces: %.2g %% of the box at 95 of 100 links, %.2g %% at worst",
                100 * info.percentile_95 / diagonal, 100 * info.worst / diagonal);
  return text;
}

}  // namespace samples

#endif
