// Links for the pieces of a model: with the skin of a glTF file as a hint, and sentences about them.
#ifndef HF_SAMPLES_COMMON_LINKS_H
#define HF_SAMPLES_COMMON_LINKS_H

#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "hf/surface.h"

namespace samples {

using namespace hf_gltf;

// The automatic links of a model. `desc` points into the object.
struct ModelLinks {
  // model: NULL for a surface without a skin.
  ModelLinks(const Model* model, const FlatMesh& mesh);
  ModelLinks(const ModelLinks&) = delete;
  ModelLinks& operator=(const ModelLinks&) = delete;
  hf_links_desc desc = HF_INIT(hf_links_desc);
  std::vector<uint16_t> joints;  // 8 per vertex; empty without a skin
  std::vector<float> weights;
  std::vector<uint32_t> parents;  // by joint
};

// "66 pieces, joined by 824 links (8 light pieces; 2 stay apart)"; empty for a surface of one piece.
inline std::string links_sentence(hf_surface surface) {
  hf_links_info info = HF_INIT(hf_links_info);
  if (hf_surface_get_links_info(surface, &info) != HF_OK || info.piece_count < 2) return {};
  const auto number = [](uint32_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  std::string out = number(info.piece_count, "piece");
  if (info.link_count == 0) return out + ", not linked: fields and poses end where a piece ends";
  out += ", joined by " + number(info.link_count, "link");
  std::string more;
  if (info.light_piece_count > 0) more = number(info.light_piece_count, "light piece");
  if (info.lone_piece_count > 0)
    more += (more.empty() ? "" : "; ") + std::to_string(info.lone_piece_count) + " too far from the others to join";
  return more.empty() ? out : out + " (" + more + ")";
}

// "linked pieces open by 0.3 % of the box where they touch; gaps of links: 0.08 % of the box at 95 of 100 links, 0.6 %
// at worst; pieces that only touch open by 4 % at worst"; empty without links. diagonal: of the box. positions: xyz of
// every vertex.
std::string gaps_sentence(hf_surface surface, const std::vector<double>& positions, double diagonal);

// The frame in which linked pieces open widest, of all frames that were taken.
class WidestGap {
 public:
  explicit WidestGap(hf_surface surface) : surface_(surface) {}
  // positions: xyz of every vertex. place: such as "at 0.5 s". Throws std::runtime_error with the library's message.
  void take(const std::vector<double>& positions, const std::string& place);
  // "widest at 0.5 s: linked pieces open by ..."; empty without links.
  std::string sentence(double diagonal) const;

 private:
  hf_surface surface_;
  double worst_ = -1;
  std::string place_;
  std::vector<double> positions_;
};

// "34 vertices are reached by no handle and stay at rest: 30 in 2 components without one (at 7, 120), 4 without a
// triangle"; empty where everything is reached. reached: vertices of the sites, handles or regions. what, fate: the
// words "handle" and "stay at rest". The vertices named are the first of the components.
std::string unreached_sentence(hf_surface surface, const std::vector<uint32_t>& reached, const std::string& what,
                               const std::string& fate);

// "handle \"sleeve\" lies on a light piece: it moves that piece and hardly pulls the rest"; empty unless most of
// the vertices are on light pieces.
std::string light_sentence(hf_surface surface, const std::vector<uint32_t>& vertices, const std::string& name);

}  // namespace samples

#endif
