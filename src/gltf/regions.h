// Regions of vertices on a model, chosen as a user would name them: by joint, by place, or by vertex list.
//
// A joint owns the vertices for which it has the largest skin weight. A mesh without a skin is owned by its node. A
// ball takes the vertices within a radius of a seed vertex that are edge-connected to it inside the ball. So a ball on
// one foot never takes the other foot. Regions are lists of flat vertices (flat_mesh.h), with all copies of a welded
// vertex.
#ifndef HF_GLTF_REGIONS_H
#define HF_GLTF_REGIONS_H

#include <array>
#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/json_file.h"
#include "gltf/model.h"

namespace hf_gltf {

// The rows right, up and forward. A viewer who looks at the face has it on the right, so the left hand lies there.
struct Axes {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
};
// {"up": "+y", "forward": "-x"}
Axes read_axes(const JsonReader& json);

struct Selector {
  std::vector<std::string> joints;  // owners; may be empty
  bool with_children = false;       // the joints below them too
  std::vector<uint32_t> vertices;   // flat vertices, as in the file
  std::string extreme;              // up, down, forward, back, left, right, away; empty: none
  bool has_position = false, has_radius = false;
  glm::dvec3 position{0, 0, 0};
  double radius = 0.03;  // of the box diagonal
  std::string where;     // key path, for messages
};

// A JSON object with joint or joints, extreme, children, position, radius, vertices.
Selector read_selector(const JsonReader& json);

struct Region {
  std::vector<uint32_t> vertices;  // flat, ascending
  glm::dvec3 seed{0, 0, 0};        // centre of the ball, or of the region
};

class RegionFinder {
 public:
  RegionFinder(const Model& model, const FlatMesh& mesh, const Axes& axes);

  // Returns the union of the selectors. Throws std::runtime_error that names the key path, the joint or vertex, and the
  // existing names.
  Region find(const std::vector<Selector>& selectors) const;

  // Resolves overlaps. A vertex in several regions goes to the one with the nearest seed, but regions before `first`
  // keep all their vertices. Returns the index of a region that is left empty, or -1.
  int separate(std::vector<Region>& regions, size_t first = 0) const;

  // One line per joint: name, vertices owned, place. A name that several have is followed by the number of the node.
  std::vector<std::string> describe_joints() const;
  double diagonal() const { return diagonal_; }
  // Returns the joint (or mesh node) to which a vertex belongs; empty without a name.
  const std::string& owner_name(uint32_t vertex) const;
  // The same as a node of the model, -1: none.
  int owner(uint32_t vertex) const { return owner_[vertex]; }
  // Tells whether exactly one node has that name and is a joint of a skin.
  bool is_joint(const std::string& name) const;

 private:
  int node_of(const Selector& selector, const std::string& name) const;
  std::vector<uint32_t> owned_by(const Selector& selector) const;
  std::vector<uint32_t> ball(uint32_t seed, double radius) const;
  uint32_t seed_of(const Selector& selector, const std::vector<uint32_t>& owned) const;
  glm::dvec3 place_of(const Selector& selector) const;

  const Model& model_;
  const FlatMesh& mesh_;
  Axes axes_;
  double diagonal_ = 0;
  std::vector<int> owner_;  // node per flat vertex
  std::vector<glm::dvec3> node_place_;
  std::vector<std::vector<uint32_t>> neighbours_, copies_;  // per welded vertex
};

}  // namespace hf_gltf

#endif
