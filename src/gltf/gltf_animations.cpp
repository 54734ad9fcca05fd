// Animations of a glTF file. See gltf_convert_parts.h.
//
// Channels are resolved to their sampler's keys. Times must be finite and must not decrease; of keys at one time the
// last one counts and the others are dropped with a warning. A clip begins at 0 s: keys before give way to one there.
// The number of values must be exactly what keys, path and interpolation ask for. A node that is animated and given by
// a matrix is taken apart into TRS.
#include <algorithm>
#include <cmath>
#include <set>

#include "gltf/animate.h"
#include "gltf/gltf_convert_parts.h"

namespace hf_gltf {
namespace {

class ChannelReader {
 public:
  ChannelReader(Conversion& in, const tinygltf::Animation& animation, std::string where)
      : in_(in), animation_(animation), where_(std::move(where)) {}

  // False: skipped.
  bool run(const tinygltf::AnimationChannel& from, Channel& to) {
    if (!read_target(from, to)) return false;
    if (from.sampler < 0 || static_cast<size_t>(from.sampler) >= animation_.samplers.size()) {
      in_.fail(where_, "names no sampler");
    }
    const tinygltf::AnimationSampler& sampler = animation_.samplers[static_cast<size_t>(from.sampler)];
    to.interpolation = sampler.interpolation == "STEP"          ? Interpolation::step
                       : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubic_spline
                                                                : Interpolation::linear;
    to.times = in_.reader.floats(sampler.input, TINYGLTF_TYPE_SCALAR, Stored::floats, where_ + " (key times)");
    read_values(sampler, to);
    if (to.times.empty()) {
      in_.warn(where_ + " has no keys and is skipped");
      return false;
    }
    drop_equal_times(to);
    if (to.path == Path::rotation) normalize_rotations(to);
    return true;
  }

 private:
  bool read_target(const tinygltf::AnimationChannel& from, Channel& to) {
    if (from.target_node < 0) {
      in_.warn(where_ + " has no target node and is skipped");
      return false;
    }
    if (static_cast<size_t>(from.target_node) >= in_.model.nodes.size()) in_.fail(where_, "names no node");
    to.node = from.target_node;
    const std::string& path = from.target_path;
    if (path == "translation" || path == "scale" || path == "rotation") {
      to.path = path == "translation" ? Path::translation : path == "scale" ? Path::scale : Path::rotation;
      to.width = path == "rotation" ? 4 : 3;
      return true;
    }
    const Node& node = in_.model.nodes[static_cast<size_t>(to.node)];
    to.path = Path::weights;
    to.width = node.mesh < 0 ? 0 : target_count(in_.model.meshes[static_cast<size_t>(node.mesh)]);
    if (path == "weights" && to.width > 0) return true;
    in_.warn(where_ +
             (path == "weights" ? " animates morph weights of a node without morph targets"
                                : " animates \"" + path.substr(0, 40) + "\"") +
             " and is skipped");
    return false;
  }

  void read_values(const tinygltf::AnimationSampler& sampler, Channel& to) {
    const std::string where = where_ + " (key values)";
    const size_t keys = to.times.size();
    const size_t groups = to.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const bool scalars = to.path == Path::weights;
    const size_t expected = keys * groups * (scalars ? to.width : 1);
    const size_t found = in_.reader.count(sampler.output, where);
    if (found != expected) {
      in_.fail(where, "has " + std::to_string(found) + " elements where " + std::to_string(keys) + " keys ask for " +
                          std::to_string(expected));
    }
    const int type = scalars ? TINYGLTF_TYPE_SCALAR : to.width == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3;
    const bool integers = to.path == Path::rotation || to.path == Path::weights;
    to.values = in_.reader.floats(sampler.output, type, integers ? Stored::signed_normalized : Stored::floats, where);
  }

  void drop_equal_times(Channel& to) {
    const size_t keys = to.times.size();
    const size_t block = to.values.size() / keys;
    size_t kept = 0;
    for (size_t k = 0; k < keys; ++k) {
      if (k > 0 && to.times[k] < to.times[k - 1]) {
        in_.fail(where_, "has key times that decrease at key " + std::to_string(k) + " (" +
                             std::to_string(to.times[k - 1]) + " s, " + std::to_string(to.times[k]) + " s)");
      }
      if (k + 1 < keys && to.times[k + 1] == to.times[k]) continue;
      if (kept != k) {
        to.times[kept] = to.times[k];
        std::copy_n(to.values.begin() + static_cast<std::ptrdiff_t>(k * block), block,
                    to.values.begin() + static_cast<std::ptrdiff_t>(kept * block));
      }
      ++kept;
    }
    if (kept == keys) return;
    in_.warn(where_ + ": of keys at one time the last is kept, " + std::to_string(keys - kept) + " are dropped");
    to.times.resize(kept);
    to.values.resize(kept * block);
  }

  void normalize_rotations(Channel& to) {
    const size_t groups = to.interpolation == Interpolation::cubic_spline ? 3 : 1;
    for (size_t k = 0; k < to.times.size(); ++k) {
      float* q = to.values.data() + (k * groups + (groups == 3 ? 1 : 0)) * 4;
      const double length = std::sqrt(static_cast<double>(q[0]) * q[0] + static_cast<double>(q[1]) * q[1] +
                                      static_cast<double>(q[2]) * q[2] + static_cast<double>(q[3]) * q[3]);
      if (!(length > 1e-6)) in_.fail(where_, "has a rotation of length 0 at key " + std::to_string(k));
      for (int c = 0; c < 4; ++c) q[c] = static_cast<float>(q[c] / length);
    }
  }

  Conversion& in_;
  const tinygltf::Animation& animation_;
  const std::string where_;
};

// The derivative at 0 s of a cubic between the keys next - 1 and next. For a rotation it is the derivative of the unit
// quaternion, plus a part along the quaternion.
std::vector<double> slope_at_zero(const Channel& from, size_t next) {
  const double start = from.times[next - 1], d = static_cast<double>(from.times[next]) - start;
  const double s = -start / d, s2 = s * s, s3 = s2 * s;
  const auto part = [&](size_t key, size_t group, size_t c) {
    return static_cast<double>(from.values[(3 * key + group) * from.width + c]);
  };
  std::vector<double> out(from.width);
  double squares = 0;
  for (size_t c = 0; c < from.width; ++c) {
    const double a = part(next - 1, 1, c), b = part(next, 1, c);
    const double out_a = d * part(next - 1, 2, c), in_b = d * part(next, 0, c);
    out[c] = ((6 * s2 - 6 * s) * (a - b) + (3 * s2 - 4 * s + 1) * out_a + (3 * s2 - 2 * s) * in_b) / d;
    const double at = (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * out_a + (3 * s2 - 2 * s3) * b + (s3 - s2) * in_b;
    squares += at * at;
  }
  if (from.path != Path::rotation || !(squares > 0)) return out;
  for (double& o : out) o /= std::sqrt(squares);
  return out;
}

// Cuts off the part before 0 s, as other players begin at 0 s. The curve behind is the same: a part of a cubic is a
// cubic, and its tangents are slopes per second. False: there is no such part.
bool begin_at_zero(Channel& channel) {
  if (!(channel.times.front() < 0)) return false;
  const auto next =
      static_cast<size_t>(std::upper_bound(channel.times.begin(), channel.times.end(), 0.0f) - channel.times.begin());
  const size_t block = channel.values.size() / channel.times.size();
  const bool cubic = channel.interpolation == Interpolation::cubic_spline;
  std::vector<double> first = sample_channel(channel, 0);
  if (cubic) {
    first.insert(first.begin(), channel.width, 0.0);
    const bool ends = next == channel.times.size();
    const std::vector<double> slope = ends ? std::vector<double>(channel.width, 0.0) : slope_at_zero(channel, next);
    first.insert(first.end(), slope.begin(), slope.end());
  }
  // the last of the keys before makes room
  const auto gone = static_cast<std::ptrdiff_t>(next - 1), width = static_cast<std::ptrdiff_t>(block);
  channel.times.erase(channel.times.begin(), channel.times.begin() + gone);
  channel.values.erase(channel.values.begin(), channel.values.begin() + gone * width);
  channel.times[0] = 0;
  std::transform(first.begin(), first.end(), channel.values.begin(), [](double o) { return static_cast<float>(o); });
  return true;
}

// Makes axes of length 0 perpendicular to the others, so that a collapsed node has a rotation. Any one is right.
void complete_axes(glm::dmat3& axes, const glm::dvec3& scale) {
  const auto empty = [&](int c) { return scale[c % 3] == 0; };
  const int empty_count = empty(0) + empty(1) + empty(2);
  if (empty_count == 3) axes = glm::dmat3(1);
  for (int c = 0; empty_count == 2 && c < 3; ++c) {
    if (empty(c)) continue;
    const glm::dvec3 other = std::abs(axes[c].x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    axes[(c + 1) % 3] = glm::normalize(glm::cross(axes[c], other));
    axes[(c + 2) % 3] = glm::cross(axes[c], axes[(c + 1) % 3]);
  }
  for (int c = 0; empty_count == 1 && c < 3; ++c) {
    if (empty(c)) axes[c] = glm::normalize(glm::cross(axes[(c + 1) % 3], axes[(c + 2) % 3]));
  }
}

// matrix = T R S for an animated node. The rest of a shear is lost, with a warning.
void take_apart(Conversion& in, size_t n) {
  Node& node = in.model.nodes[n];
  const glm::dmat4 matrix = *node.matrix;
  node.matrix.reset();
  glm::dmat3 axes(matrix);
  glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (glm::determinant(axes) < 0) scale.x = -scale.x;
  const std::string where = "nodes[" + std::to_string(n) + "]";
  for (int c = 0; c < 3; ++c) {
    if (scale[c] != 0) axes[c] /= scale[c];
  }
  complete_axes(axes, scale);
  const glm::dmat3 gram = glm::transpose(axes) * axes;
  for (int c = 0; c < 3; ++c) {
    if (std::abs(gram[c][(c + 1) % 3]) > 1e-3) in.warn(where + " is animated; the shear of its matrix is lost");
  }
  node.translation = glm::dvec3(matrix[3]);
  node.rotation = glm::quat(glm::normalize(glm::quat_cast(axes)));
  node.scale = glm::vec3(scale);
}

// Channels without a node, which move materials, lights or cameras.
void convert_carried(Conversion& in, const nlohmann::json& from, const std::string& where, Animation& to) {
  for (const nlohmann::json& item : from) {
    const nlohmann::json& sampler = item["sampler"];
    CarriedChannel channel;
    channel.target = item["target"].dump();
    const std::string mode = sampler.value("interpolation", "LINEAR");
    channel.interpolation = mode == "STEP"          ? Interpolation::step
                            : mode == "CUBICSPLINE" ? Interpolation::cubic_spline
                                                    : Interpolation::linear;
    const std::string inner = where + " (" + channel.target.substr(0, 100) + ")";
    channel.times = in.reader.floats(sampler["input"].get<int>(), TINYGLTF_TYPE_SCALAR, Stored::floats, inner);
    channel.values = in.reader.stored(sampler["output"].get<int>(), inner);
    const size_t keys = channel.times.size() * (mode == "CUBICSPLINE" ? 3 : 1);
    bool good = keys > 0 && channel.values.count > 0 && channel.values.count % keys == 0 && channel.times[0] >= 0;
    for (size_t k = 1; k < channel.times.size(); ++k) good = good && channel.times[k] > channel.times[k - 1];
    if (good) {
      to.carried_channels.push_back(std::move(channel));
    } else {
      in.warn(inner + " has keys that do not fit and is skipped");
    }
  }
}

}  // namespace

void convert_animations(Conversion& in) {
  const auto& animations = in.source.gltf.animations;
  for (size_t a = 0; a < animations.size(); ++a) {
    const std::string where = "animations[" + std::to_string(a) + "]";
    Animation to;
    to.name = animations[a].name;
    std::set<std::pair<int, Path>> seen;
    size_t cut = 0, twice = 0;
    for (size_t c = 0; c < animations[a].channels.size(); ++c) {
      const std::string inner = where + ".channels[" + std::to_string(c) + "]";
      Channel channel;
      if (!ChannelReader(in, animations[a], inner).run(animations[a].channels[c], channel)) continue;
      if (!seen.insert({channel.node, channel.path}).second) {
        ++twice;
        continue;
      }
      if (channel.path != Path::weights && in.model.nodes[static_cast<size_t>(channel.node)].matrix) {
        take_apart(in, static_cast<size_t>(channel.node));
      }
      cut += begin_at_zero(channel);
      to.channels.push_back(std::move(channel));
    }
    if (twice > 0)
      in.warn(where + " has " + std::to_string(twice) +
              " channels that animate what an earlier one does; they are skipped");
    if (cut > 0)
      in.warn(where + " has keys before 0 s in " + std::to_string(cut) + " channels; the clip begins at 0 s");
    CarriedDocument& carried = in.source.carried;
    if (a < carried.animation_channels.size()) convert_carried(in, carried.animation_channels[a], where, to);
    if (to.channels.empty() && to.carried_channels.empty()) {
      in.warn(where + " moves nothing and is skipped");
      continue;
    }
    if (a < carried.animations.size()) to.carried = std::move(carried.animations[a]);
    in.model.animations.push_back(std::move(to));
  }
}

}  // namespace hf_gltf
