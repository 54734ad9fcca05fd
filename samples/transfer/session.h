// One transfer session over the C API: two models, their surfaces, a transfer whose pairs may change while it runs.
//
//   Session session(source, target, pairs, threads, links, bar);     // factorises both surfaces, once
//   PlayedClip clip = session.play(source.animations[0], 30, bar);
//   session.edit(edits);                                       // pairs out and in: no factorisation
//   PlayedClip again = session.play(source.animations[0], 30, bar);
//
// Failure: std::runtime_error with the library's own sentence, or that of the pairs file.
#ifndef HF_SAMPLES_TRANSFER_SESSION_H
#define HF_SAMPLES_TRANSFER_SESSION_H

#include <memory>
#include <string>
#include <vector>

#include "common/links.h"
#include "common/progress_bar.h"
#include "gltf/known_body.h"
#include "gltf/pairs_file.h"
#include "gltf/skin_write.h"
#include "hf/hf.h"
#include "transfer/flat_surface.h"

namespace samples {

using namespace hf_gltf;

struct PairReport {
  std::string name;
  size_t source_vertices = 0, target_vertices = 0;  // of the files, copies included
  bool anchor = false, foot = false, trunk = false, contact = false, crossed = false;
  double source_leak = 0, target_leak = 0, alignment_degrees = -1, alignment_share = 0, confidence = 0;
};

// The motion of the feet over a clip, in box diagonals of the target.
struct FootReport {
  double path_mean = 0, path_max = 0;  // from the scaled path of the source's foot
  double sunk = 0;                     // deeper under the rest ground than the source's foot, scaled
  // Along the ground while the source's foot stands, from where it began to stand, beside its scaled path. It stands if
  // it is low, upright, and still or moves evenly as on a treadmill. A foot that rolls, kicks or falls may be low and
  // does not stand. low_max: the same of all low feet.
  double planted_mean = 0, planted_max = 0, low_max = 0;
  double surface_sunk = 0;  // how deep a vertex of the surface sinks that may not
  size_t planted = 0;
};

struct PlayedClip {
  SkinClip clip;                                                  // without rotations and translations in mode stretch
  std::vector<std::vector<double>> source_frames, target_frames;  // xyz of the flat vertices, one per time
  FootReport feet;
  double frame_ms = 0;         // per frame, inside the library
  double gap = 0;              // largest between linked pieces, in box diagonals
  glm::dvec3 travel{0, 0, 0};  // of the target, that was taken out
};

// How the region of a pair moves over a clip, beside the body as a whole: root mean square in boxes of the target, and
// the cosine between both motions.
struct LimbMotion {
  std::string name;
  double source_moved = 0, target_moved = 0, cosine = 1;
};

// Takes the straight travel along the ground out of posed copies of a surface, x y z of every vertex: the mean of the
// vertices that are not loose ends over the place where it began. Sway and steps stay. Returns the travel. up: a unit
// vector; times: one for each pose.
glm::dvec3 take_travel(const std::vector<double>& times, const glm::dvec3& up, const std::vector<uint8_t>& loose,
                       std::vector<std::vector<double>>& poses);

class Session {
 public:
  // ground: false switches the rules of the ground off. rigid: false lets what the skin of the target calls rigid bend.
  Session(const Model& source, const Model& target, const PairsFile& pairs, uint32_t threads, bool links,
          ProgressBar& bar, bool ground = true, bool rigid = true);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Dials for the next clips; nothing is prepared again.
  void set_dials(const TransferDials& dials);

  // Removes pairs by name and adds others. Regions of new pairs leave out vertices that existing pairs have.
  void edit(const EditsFile& edits);

  // Pairs that touch the ground in these poses become contacts, or feet if no pair is a foot. names: the pairs or
  // joints of the source that touch it; "none" alone: no contacts. If names is empty, they are found: a region that
  // stands on both models is a foot, and one that comes near the ground is a contact. Returns a line for each.
  std::vector<std::string> set_contacts(const std::vector<std::string>& names,
                                        const std::vector<std::vector<double>>& poses);

  // Whether clips lose their travel along the ground before they are transferred (take_travel).
  void set_in_place(bool in_place) { in_place_ = in_place; }
  // The pairs are the program's own: their crossings are no news for the user.
  void set_proposed(bool proposed) { proposed_ = proposed; }
  // rate: frames per second; below 0: the clip's own key times.
  PlayedClip play(const Animation& animation, double rate, ProgressBar& bar);
  // Returns posed copies of the source (x y z of every flat vertex).
  PlayedClip play(const std::string& name, const std::vector<double>& times, std::vector<std::vector<double>> poses,
                  ProgressBar& bar);
  // The motion of the feet in other frames of the same clip, such as those of a written file.
  FootReport feet_of(const PlayedClip& played) const;
  // How firmly each flat vertex of the target belongs to a foot that stands in a frame, 0 to 1. It comes in
  // continuously with the height of the source's foot.
  std::vector<double> standing(const PlayedClip& played, size_t frame) const;
  // How high each frame's ground is along the target's up: as deep as the source sinks, scaled.
  std::vector<double> grounds(const PlayedClip& played) const;
  // Of all pairs that are no part of the trunk.
  std::vector<LimbMotion> limbs_of(const PlayedClip& played) const;
  // The largest gap between linked pieces of the target over all frames, in box diagonals; 0 without links.
  double largest_gap(const std::vector<std::vector<double>>& frames) const;
  // Joints and weights; the caller adds the clips.
  SkinDescription skin();

  std::vector<PairReport> pairs();
  std::vector<std::string> warnings();
  double scale() const { return scale_; }
  // How the scale was found, for people.
  const std::string& scale_from() const { return scale_from_; }
  const KnownBody& source_known() const { return source_known_; }
  const KnownBody& target_known() const { return target_known_; }
  // By flat vertex of the target: 1 if it may sink into the ground, as loose ones may.
  const std::vector<uint8_t>& sinking() const { return sinking_; }
  uint32_t cluster_count() const { return info().cluster_count; }
  uint32_t joint_count() const;  // of the skin: clusters and rigid pieces
  size_t rigid_count() const { return rigid_count_; }
  bool stretches() const { return file_.settings.stretch; }  // no skin, no ground, no dials
  bool has_ground() const { return file_.settings.ground && !stretches(); }

  // Of the surfaces and the transfer.
  hf_transfer_info info() const;
  hf_transfer_statistics statistics() const;
  hf_surface_report source_mesh() const { return mesh_report(source_surface_->get()); }
  hf_surface_report target_mesh() const { return mesh_report(target_surface_->get()); }
  hf_surface source_surface() const { return source_surface_->get(); }
  hf_surface target_surface() const { return target_surface_->get(); }
  double setup_ms() const { return setup_ms_; }      // both surfaces
  double prepare_ms() const { return prepare_ms_; }  // fields, clusters, translations after the last change of pairs
  double edit_ms() const { return edit_ms_; }        // the last edit's calls, without prepare

  const FlatMesh& source_flat() const { return source_flat_; }
  const FlatMesh& target_flat() const { return target_flat_; }
  const Axes& source_axes() const { return file_.source_axes; }
  const Axes& target_axes() const { return file_.target_axes; }

 private:
  struct Live {
    PairEntry entry;
    Region source, target;
    uint32_t number = 0;
  };
  void create(uint32_t threads, bool links, ProgressBar& bar);
  void add(const std::vector<PairEntry>& entries);
  void keep_rigid(const ModelLinks& skin);
  void prepare();
  void change_flags(const std::vector<PairEntry>& entries);
  std::vector<std::string> other_axes() const;
  std::vector<PairEntry> found_contacts(const std::vector<std::vector<double>>& poses) const;
  std::vector<PairEntry> named_contacts(const std::vector<std::string>& names) const;
  std::vector<uint8_t> hanging(bool source) const;
  void apply(const std::vector<double>& posed, std::vector<double>& out);
  static hf_surface_report mesh_report(hf_surface surface);

  const Model& source_;
  const Model& target_;
  PairsFile file_;
  FlatMesh source_flat_, target_flat_;
  RegionFinder source_finder_, target_finder_;
  KnownBody source_known_, target_known_;  // what the skeletons say by themselves
  std::string scale_from_ = "the surfaces";
  std::unique_ptr<FlatSurface> source_surface_, target_surface_;
  hf_transfer transfer_ = nullptr;
  std::vector<Live> live_;
  std::vector<uint8_t> sinking_;
  std::vector<uint8_t> source_hangs_, target_hangs_;  // by flat vertex: 1 if it is no part of what stands
  bool in_place_ = false, proposed_ = false;
  bool ground_ = true, rigid_ = true;
  size_t rigid_count_ = 0;
  double scale_ = 1, setup_ms_ = 0, prepare_ms_ = 0, edit_ms_ = 0;
};

}  // namespace samples

#endif
