// A surface from a file, with a pose of the library on it: handles by name, motions over time, frames.
#ifndef HF_SAMPLES_DEFORM_POSABLE_H
#define HF_SAMPLES_DEFORM_POSABLE_H

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh_file.h"
#include "deform/rig_file.h"
#include "gltf/flat_mesh.h"
#include "gltf/model.h"
#include "hf/hf.h"

namespace samples {

using namespace hf_gltf;

// The content of a file: a glTF scene at rest, or a plain surface. `surface` keeps its faces and vertex order.
struct PosableMesh {
  Model model;
  FlatMesh flat;
  SurfaceMesh surface;
};
PosableMesh read_posable(const std::filesystem::path& file);

// The motion x -> R (x - centroid) + centroid + translation of one handle.
struct HandlePlace {
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 translation{0};
};

enum class Refine { none, one_step, from_last };  // full-mesh steps of a frame: hf_deform_desc

class Posable {
 public:
  struct Options {
    bool paper = false, links = true;
    bool given_rotations = false;  // a drag without a turn keeps the rotation of its handle
    // Of dragged handles: how much of the surface follows; none: as the entry says.
    std::optional<double> following;
    uint32_t limb_refine = 0;  // of dragged handles: full-mesh steps on their limbs
    bool rigid = false;        // pieces that are alone on a joint stay rigid
    uint32_t bands = 0, threads = 1;
    const Model* model = nullptr;  // its skin helps to link pieces; may be NULL
    const Posable* on = nullptr;   // of the same mesh: its surface is used again, and it outlives this object
  };
  Posable(const FlatMesh& mesh, const Options& options);
  ~Posable();
  Posable(const Posable&) = delete;
  Posable& operator=(const Posable&) = delete;

  // Gives regions another stiffness; handles stay as they are. Throws std::runtime_error.
  void stiffen(const std::vector<StiffEntry>& regions);
  // Throw std::runtime_error naming the handle.
  void add(const std::vector<HandleEntry>& handles);
  void remove(const std::vector<std::string>& names);
  // The motions of a step start where the handles stand. A motion without a turn frees the rotation of its handle, one
  // with a turn gives it. `t` is the share of the way, from 0 to 1.
  void begin(const Step& step);
  void drag(double t);
  // Plays a step frame by frame. Its drags continue by equal parts. frame(f, count) is called after each part, f from 1
  // to count.
  template <class Frame>
  void play(const Step& step, double frame_rate, Frame&& frame) {
    const int count = std::max(1, static_cast<int>(std::lround(step.seconds * frame_rate)));
    begin(step);
    for (int f = 1; f <= count; ++f) {
      drag(static_cast<double>(f) / count);
      frame(f, count);
    }
  }
  // Returns vertices (xyz) and normals.
  void deform(Refine refine, std::vector<double>& positions, std::vector<float>& normals, uint32_t iterations = 0);

  hf_pose pose() const { return pose_; }
  double diagonal() const { return diagonal_; }
  // Name, number and region of every handle, in the order in which handles were added.
  struct Live {
    std::string name;
    uint32_t number;
    HandleEntry entry;
    std::vector<uint32_t> vertices;
    glm::dvec3 centroid;
    MotionEntry motion;     // asked for last
    HandlePlace from, now;  // where the drag at hand began
    bool moving = false, from_rest = true, from_place = false, free_rotation = false, dragged = false;
    MotionEntry before;
  };
  const std::vector<Live>& handles() const { return live_; }
  // The first vertex of the rigid piece of a vertex, or HF_NO_INDEX.
  uint32_t rigid_part(uint32_t vertex) const { return rigid_.empty() ? HF_NO_INDEX : rigid_[vertex]; }
  hf_surface surface() const { return surface_; }
  // Returns the vertices of a handle, where its field is 1.
  std::vector<uint32_t> region_of(const Live& live) const;
  // Sentences about what the present handles do not do: vertices that none reaches, handles on light pieces.
  std::vector<std::string> remarks() const;

 private:
  void keep_rigid(const FlatMesh& mesh, const Model* model);
  void make_surface(const FlatMesh& mesh, const Options& options);
  glm::dvec3 at(const glm::dvec3& fraction) const { return lower_ + fraction * (upper_ - lower_); }
  // name: of the region, for errors.
  std::vector<uint32_t> vertices_of(const HandleEntry& entry, const std::string& name) const;
  void expect_added(hf_result result, const std::string& name) const;
  HandlePlace place(const Live& live, const MotionEntry& motion, double amount) const;

  const FlatMesh& mesh_;
  hf_surface surface_ = nullptr;
  bool own_ = true;  // the surface
  bool frees_ = true;
  std::optional<double> following_;
  uint32_t limb_refine_ = 0;
  std::vector<uint32_t> rigid_;  // by vertex; empty: none asked for
  hf_pose pose_ = nullptr;
  glm::dvec3 lower_{0}, upper_{0};
  double diagonal_ = 1;
  std::vector<Live> live_;
};

// Throws std::runtime_error with "what: the library's message" unless the result is HF_OK.
void expect_ok(hf_result result, const std::string& what);

}  // namespace samples

#endif
