// Mesh primitives of a glTF file: attributes, indices, morph targets. See gltf_convert_parts.h.
//
// Strips and fans become triangles in the order of the specification. Strip triangle i is (i, i + 1 + i % 2, i + 2 - i
// % 2). Fan triangle i is (i + 1, i + 2, 0). Triangles of a strip that name a vertex twice are its stitching and are
// left out; in lists they are kept, and their meaning is the user's matter.
#include <algorithm>
#include <cmath>
#include <map>

#include "gltf/gltf_convert_parts.h"

namespace hf_gltf {
namespace {

constexpr int max_texcoord_sets = 8;

template <typename Vector, int N>
std::vector<Vector> group(const std::vector<float>& values) {
  std::vector<Vector> out(values.size() / N);
  for (size_t i = 0; i < out.size(); ++i) {
    for (int c = 0; c < N; ++c) out[i][c] = values[i * N + static_cast<size_t>(c)];
  }
  return out;
}

class PrimitiveReader {
 public:
  PrimitiveReader(Conversion& in, const tinygltf::Primitive& from, std::string where, size_t joint_limit)
      : in_(in), from_(from), where_(std::move(where)), joint_limit_(joint_limit) {}

  // False: skipped, with a warning.
  bool run(Primitive& to) {
    const int position = attribute("POSITION");
    if (position < 0) {
      in_.warn(where_ + " has no POSITION, or no elements, and is skipped");
      return false;
    }
    count_ = in_.reader.count(position, where_ + ".POSITION");
    if (count_ >= 0xffffffffu) in_.fail(where_, "has too many vertices");
    in_.reader.charge(static_cast<uint64_t>(count_) * sizeof(glm::vec3), where_);
    to.positions =
        group<glm::vec3, 3>(in_.reader.floats(position, TINYGLTF_TYPE_VEC3, Stored::quantized, where_ + ".POSITION"));
    read_surface_attributes(to);
    read_influences(to);
    read_indices(to);
    read_targets(to);
    to.material = from_.material;
    if (to.material >= static_cast<int>(in_.source.gltf.materials.size())) in_.fail(where_, "names no material");
    return true;
  }

 private:
  int attribute(const std::string& name) const {
    const auto found = from_.attributes.find(name);
    return found == from_.attributes.end() ? -1 : found->second;
  }

  std::vector<float> floats(int accessor, const std::string& name, int type, Stored stored,
                            Stored base = Stored::floats) {
    const std::string where = where_ + "." + name;
    if (in_.reader.count(accessor, where) != count_) {
      in_.fail(where, "has " + std::to_string(in_.reader.count(accessor, where)) + " elements where POSITION has " +
                          std::to_string(count_));
    }
    return in_.reader.floats(accessor, type, stored, where, base);
  }

  void read_surface_attributes(Primitive& to) {
    if (const int a = attribute("NORMAL"); a >= 0) {
      to.normals = group<glm::vec3, 3>(floats(a, "NORMAL", TINYGLTF_TYPE_VEC3, Stored::quantized));
    }
    if (const int a = attribute("TANGENT"); a >= 0) {
      to.tangents = group<glm::vec4, 4>(floats(a, "TANGENT", TINYGLTF_TYPE_VEC4, Stored::quantized));
    }
    for (int set = 0; set < max_texcoord_sets; ++set) {
      const std::string name = "TEXCOORD_" + std::to_string(set);
      const int a = attribute(name);
      if (a < 0) break;
      to.texcoords.push_back(
          group<glm::vec2, 2>(floats(a, name, TINYGLTF_TYPE_VEC2, Stored::quantized, Stored::normalized)));
    }
    if (const int a = attribute("COLOR_0"); a >= 0) read_colors(a, to);
    for (const auto& item : from_.attributes) {
      const std::string& name = item.first;
      const bool known = name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name == "COLOR_0" ||
                         name.compare(0, 7, "JOINTS_") == 0 || name.compare(0, 8, "WEIGHTS_") == 0;
      const bool read = name.compare(0, 9, "TEXCOORD_") == 0 && is_below(name.substr(9), to.texcoords.size());
      if (known || read) continue;
      if (!carry_attribute(name, item.second, to))
        in_.warn(where_ + ": attribute " + name.substr(0, 60) + " is not kept");
    }
  }

  static bool is_below(const std::string& number, size_t count) {
    for (size_t i = 0; i < count; ++i)
      if (number == std::to_string(i)) return true;
    return false;
  }

  // Attributes of a host's own, and colours and texture coordinates beyond those that are read. Attributes that glTF
  // does not allow are not kept: sets with gaps, other types, own attributes of 32-bit integers.
  bool carry_attribute(const std::string& name, int accessor, Primitive& to) {
    const bool own = name[0] == '_', color = name.compare(0, 6, "COLOR_") == 0;
    const bool texcoord = name.compare(0, 9, "TEXCOORD_") == 0;
    if (!own && !color && !texcoord) return false;
    if (color && (to.colors.empty() || !has_sets_before(name, 6))) return false;
    if (texcoord && !has_sets_before(name, 9)) return false;
    const std::string where = where_ + "." + name.substr(0, 60);
    CarriedNumbers values = in_.reader.stored(accessor, where);
    if (values.count != count_ || values.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return false;
    const bool fraction = values.component == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                          (values.normalized && (values.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                                 values.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT));
    if (!own && (!fraction || (texcoord ? values.type != 2 : values.type < 3))) return false;
    to.carried_attributes.emplace_back(name, std::move(values));
    return true;
  }

  // Whether NAME_0 to NAME_n - 1 are there too, for NAME_n.
  bool has_sets_before(const std::string& name, size_t prefix) const {
    for (size_t i = 0; i < from_.attributes.size(); ++i) {
      const std::string before = name.substr(0, prefix) + std::to_string(i);
      if (before == name) return true;
      if (attribute(before) < 0) return false;
    }
    return false;
  }

  void read_colors(int accessor, Primitive& to) {
    const int components = in_.reader.components_of(accessor, where_ + ".COLOR_0");
    if (components == 3) {
      const auto rgb = group<glm::vec3, 3>(floats(accessor, "COLOR_0", TINYGLTF_TYPE_VEC3, Stored::normalized));
      for (const glm::vec3& c : rgb) to.colors.emplace_back(c, 1.0f);
    } else {
      to.colors = group<glm::vec4, 4>(floats(accessor, "COLOR_0", TINYGLTF_TYPE_VEC4, Stored::normalized));
    }
    for (glm::vec4& c : to.colors) c = glm::clamp(c, 0.0f, 1.0f);
  }

  // Any number of sets; the eight heaviest joints of a vertex are kept.
  void read_influences(Primitive& to) {
    size_t dropped = 0;
    for (int set = 0;; ++set) {
      const std::string n = std::to_string(set);
      const int joints = attribute("JOINTS_" + n), weights = attribute("WEIGHTS_" + n);
      if (joints < 0 && weights < 0) break;
      if (joints < 0 || weights < 0) in_.fail(where_, "has JOINTS_" + n + " or WEIGHTS_" + n + " without the other");
      if (in_.reader.count(joints, where_) != count_) {
        in_.fail(where_ + ".JOINTS_" + n, "has another length than POSITION");
      }
      const auto j = in_.reader.integers(joints, TINYGLTF_TYPE_VEC4, false, where_ + ".JOINTS_" + n);
      auto w = weights_of(weights, "WEIGHTS_" + n);
      if (set == 0) {
        in_.reader.charge(static_cast<uint64_t>(count_) * sizeof(Influences), where_);
        to.influences.resize(count_);
      }
      for (size_t i = 0; i < j.size(); ++i) {
        if (w[i] > 0 && j[i] >= joint_limit_) {
          in_.fail(where_, "names joint " + std::to_string(j[i]) + " at vertex " + std::to_string(i / 4) +
                               " of a skin with " + std::to_string(joint_limit_) + " joints");
        }
        dropped +=
            !place(to.influences[i / 4], static_cast<size_t>(set) * 4 + i % 4, static_cast<uint16_t>(j[i]), w[i]);
      }
    }
    if (dropped > 0) in_.warn(where_ + ": " + std::to_string(dropped) + " weights beyond eight per vertex are dropped");
    normalize_influences(to.influences);
  }

  // A weight that is negative or not finite counts as 0: other tools read such files, and the vertex has other weights.
  std::vector<float> weights_of(int accessor, const std::string& name) {
    const std::string where = where_ + "." + name;
    if (in_.reader.count(accessor, where) != count_) in_.fail(where, "has another length than POSITION");
    std::vector<float> out =
        in_.reader.floats(accessor, TINYGLTF_TYPE_VEC4, Stored::normalized, where, Stored::floats, true);
    for (float& weight : out) {
      if (std::isfinite(weight) && weight >= 0) continue;
      weight = 0;
      ++mended_;
    }
    return out;
  }

  // The first eight go to their own slots; a later one takes the lightest slot if it is heavier. False: a weight is
  // lost.
  static bool place(Influences& o, size_t slot, uint16_t joint, float weight) {
    const bool fits = slot < o.weights.size();
    if (!fits) slot = static_cast<size_t>(std::min_element(o.weights.begin(), o.weights.end()) - o.weights.begin());
    const float lost = fits ? 0 : std::min(o.weights[slot], weight);
    if (weight > o.weights[slot]) {
      o.weights[slot] = weight;
      o.joints[slot] = joint;
    }
    return lost == 0;
  }

  void normalize_influences(std::vector<Influences>& influences) {
    size_t empty = 0, uneven = 0;
    for (size_t v = 0; v < influences.size(); ++v) {
      Influences& o = influences[v];
      double sum = 0;
      for (size_t k = 0; k < 8; ++k) {
        sum += o.weights[k];
      }
      if (!(sum > 1e-6)) {
        ++empty;
        o = Influences();
        o.weights[0] = 1;
        continue;
      }
      if (std::abs(sum - 1) > 0.01) ++uneven;
      for (float& weight : o.weights) weight = static_cast<float>(weight / sum);
    }
    if (mended_ + empty + uneven == 0) return;
    std::string sentence;
    const auto add = [&](size_t count, const char* what) {
      if (count > 0) sentence += (sentence.empty() ? "" : ", ") + std::to_string(count) + what;
    };
    add(mended_, " weights that are negative or not finite count as 0");
    add(uneven, " vertices had weights that did not sum to 1 and were scaled");
    add(empty, " vertices without weights follow joint 0");
    in_.warn(where_ + ": " + sentence);
  }

  void read_indices(Primitive& to) {
    std::vector<uint32_t> stored;
    if (from_.indices >= 0) {
      stored = in_.reader.integers(from_.indices, TINYGLTF_TYPE_SCALAR, true, where_ + ".indices");
      for (size_t i = 0; i < stored.size(); ++i) {
        if (stored[i] >= count_) {
          in_.fail(where_ + ".indices", "names vertex " + std::to_string(stored[i]) + " of " + std::to_string(count_) +
                                            " in element " + std::to_string(i));
        }
      }
    } else {
      in_.reader.charge(static_cast<uint64_t>(count_) * sizeof(uint32_t), where_);
      stored.resize(count_);
      for (size_t i = 0; i < count_; ++i) stored[i] = static_cast<uint32_t>(i);
    }
    if (from_.mode != TINYGLTF_MODE_TRIANGLES && from_.mode != TINYGLTF_MODE_LINE &&
        from_.mode != TINYGLTF_MODE_POINTS) {
      in_.reader.charge(static_cast<uint64_t>(stored.size()) * 3 * sizeof(uint32_t), where_);
    }
    expand(stored, to);
    if (to.indices.empty()) in_.warn(where_ + " has no " + (to.topology == Topology::lines ? "line" : "triangle"));
  }

  void expand(std::vector<uint32_t>& stored, Primitive& to) {
    const size_t n = stored.size();
    const auto push = [&](size_t a, size_t b, size_t c) {
      const uint32_t i = stored[a], j = stored[b], k = stored[c];
      if (i != j && j != k && k != i) to.indices.insert(to.indices.end(), {i, j, k});
    };
    const size_t group_size = from_.mode == TINYGLTF_MODE_POINTS ? 1 : from_.mode == TINYGLTF_MODE_LINE ? 2 : 3;
    switch (from_.mode) {
      case TINYGLTF_MODE_LINE_LOOP:
      case TINYGLTF_MODE_LINE_STRIP:
        to.topology = Topology::lines;
        for (size_t i = 0; i + 1 < n; ++i) to.indices.insert(to.indices.end(), {stored[i], stored[i + 1]});
        if (from_.mode == TINYGLTF_MODE_LINE_LOOP && n > 2) {
          to.indices.insert(to.indices.end(), {stored[n - 1], stored[0]});
        }
        break;
      case TINYGLTF_MODE_TRIANGLE_STRIP:
        for (size_t i = 0; i + 2 < n; ++i) push(i, i + 1 + i % 2, i + 2 - i % 2);
        break;
      case TINYGLTF_MODE_TRIANGLE_FAN:
        for (size_t i = 0; i + 2 < n; ++i) push(i + 1, i + 2, 0);
        break;
      default:
        if (from_.mode == TINYGLTF_MODE_LINE) to.topology = Topology::lines;
        if (from_.mode == TINYGLTF_MODE_POINTS) to.topology = Topology::points;
        if (n % group_size != 0) {
          in_.warn(where_ + ": " + std::to_string(n % group_size) + " indices at the end are left over");
          stored.resize(n - n % group_size);
        }
        to.indices = std::move(stored);
    }
  }

  void read_targets(Primitive& to) {
    for (size_t t = 0; t < from_.targets.size(); ++t) {
      MorphTarget target;
      for (const auto& item : from_.targets[t]) {
        const std::string name = "targets[" + std::to_string(t) + "]." + item.first.substr(0, 60);
        if (item.first == "POSITION") {
          target.positions = group<glm::vec3, 3>(floats(item.second, name, TINYGLTF_TYPE_VEC3, Stored::quantized));
        } else if (item.first == "NORMAL") {
          target.normals = group<glm::vec3, 3>(floats(item.second, name, TINYGLTF_TYPE_VEC3, Stored::quantized));
        } else if (item.first == "TANGENT" && !to.tangents.empty()) {
          target.tangents = group<glm::vec3, 3>(floats(item.second, name, TINYGLTF_TYPE_VEC3, Stored::quantized));
        } else {
          in_.warn(where_ + "." + name + " is not kept");
        }
      }
      to.targets.push_back(std::move(target));
    }
  }

  Conversion& in_;
  const tinygltf::Primitive& from_;
  const std::string where_;
  const size_t joint_limit_;
  size_t count_ = 0;
  size_t mended_ = 0;  // weights
};

// The smallest joint count of the skins used with each mesh; no limit without a skin.
std::vector<size_t> joint_limits(const Conversion& in) {
  std::vector<size_t> limits(in.source.gltf.meshes.size(), SIZE_MAX);
  for (const Node& node : in.model.nodes) {
    if (node.mesh < 0 || node.skin < 0) continue;
    size_t& limit = limits[static_cast<size_t>(node.mesh)];
    limit = std::min(limit, in.model.skins[static_cast<size_t>(node.skin)].joints.size());
  }
  return limits;
}

// A target that a primitive lacks and another one has does not move it.
void complete_targets(Conversion& in, MeshData& mesh, const std::string& where) {
  size_t most = 0;
  for (const Primitive& primitive : mesh.primitives) most = std::max(most, primitive.targets.size());
  bool lacking = false;
  for (Primitive& primitive : mesh.primitives) {
    lacking = lacking || primitive.targets.size() < most;
    in.reader.charge((most - primitive.targets.size()) * sizeof(MorphTarget), where);
    primitive.targets.resize(most);
  }
  if (lacking)
    in.warn(where + " has primitives with different numbers of morph targets; those that lack one do not move");
}

}  // namespace

void convert_meshes(Conversion& in) {
  const std::vector<size_t> limits = joint_limits(in);
  const auto& meshes = in.source.gltf.meshes;
  for (size_t m = 0; m < meshes.size(); ++m) {
    const std::string where = "meshes[" + std::to_string(m) + "]";
    MeshData to;
    to.name = meshes[m].name;
    for (size_t p = 0; p < meshes[m].primitives.size(); ++p) {
      Primitive primitive;
      PrimitiveReader reader(in, meshes[m].primitives[p], where + ".primitives[" + std::to_string(p) + "]", limits[m]);
      if (!reader.run(primitive)) continue;
      const auto& carried = in.source.carried.primitives;
      if (m < carried.size() && p < carried[m].size()) primitive.carried = carried[m][p];
      to.primitives.push_back(std::move(primitive));
    }
    complete_targets(in, to, where);
    const size_t targets = target_count(to);
    to.weights.assign(meshes[m].weights.begin(), meshes[m].weights.end());
    if (!to.weights.empty() && to.weights.size() != targets) {
      if (targets > 0) {
        in.fail(where + ".weights", "has " + std::to_string(to.weights.size()) + " numbers for " +
                                        std::to_string(targets) + " morph targets");
      }
      in.warn(where + ".weights belong to no morph target and are dropped");
      to.weights.clear();
    }
    if (m < in.source.target_names.size() && in.source.target_names[m].size() == targets) {
      to.target_names = std::move(in.source.target_names[m]);
    }
    in.model.meshes.push_back(std::move(to));
  }
}

}  // namespace hf_gltf
