#include "weights/rig.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <stdexcept>

#include "gltf/node_match.h"

namespace samples {
namespace {

// The skins that meshes use, in the order of their nodes.
std::vector<int> used_skins(const Model& model) {
  std::vector<int> out;
  for (const Node& node : model.nodes) {
    if (node.mesh >= 0 && node.skin >= 0 && std::find(out.begin(), out.end(), node.skin) == out.end())
      out.push_back(node.skin);
  }
  if (out.empty()) throw std::runtime_error(model.name + ": the model has no skin");
  return out;
}

// The joints of all skins, with their inverse bind matrices in the space of the first skin. to_first[s] takes the space
// of skin s there.
std::vector<glm::dmat4> collect_joints(const Model& model, const std::vector<int>& skins, Rig& rig,
                                       std::map<int, uint32_t>& number) {
  std::vector<glm::dmat4> to_first(model.skins.size(), glm::dmat4(1.0));
  for (const int s : skins) {
    const Skin& skin = model.skins[static_cast<size_t>(s)];
    for (size_t j = 0; j < skin.joints.size(); ++j) {
      const auto known = number.find(skin.joints[j]);
      if (known == number.end()) continue;
      to_first[static_cast<size_t>(s)] =
          glm::inverse(rig.inverse_bind[known->second]) * glm::dmat4(skin.inverse_bind[j]);
      break;
    }
    const glm::dmat4 back = glm::inverse(to_first[static_cast<size_t>(s)]);
    for (size_t j = 0; j < skin.joints.size(); ++j) {
      if (!number.emplace(skin.joints[j], static_cast<uint32_t>(rig.joints.size())).second) continue;
      rig.joints.push_back(skin.joints[j]);
      rig.names.push_back(model.nodes[static_cast<size_t>(skin.joints[j])].name);
      rig.inverse_bind.push_back(glm::dmat4(skin.inverse_bind[j]) * back);
    }
  }
  return to_first;
}

void add_primitive(const Primitive& primitive, const Skin& skin, const glm::dmat4& space,
                   const std::map<int, uint32_t>& number, Rig& rig) {
  const uint32_t first = static_cast<uint32_t>(rig.positions.size());
  for (size_t v = 0; v < primitive.positions.size(); ++v) {
    const glm::dvec3 p(primitive.positions[v]);
    rig.positions.push_back(space == glm::dmat4(1.0) ? p : glm::dvec3(space * glm::dvec4(p, 1.0)));
    const Influences& own = primitive.influences[v];
    for (size_t k = 0; k < rig.given.per_vertex; ++k) {
      rig.given.joints.push_back(own.weights[k] > 0 ? number.at(skin.joints[own.joints[k]]) : 0);
      rig.given.weights.push_back(own.weights[k]);
    }
  }
  for (const uint32_t v : primitive.indices) rig.triangles.push_back(first + v);
}

// The weights of a part, by joint of its skin.
std::vector<Influences> influences_of(const Model& model, const Rig& rig, const RigPart& part,
                                      const RigWeights& weights, size_t vertices) {
  const std::vector<int>& joints = model.skins[static_cast<size_t>(part.skin)].joints;
  std::vector<uint16_t> local(rig.joints.size(), 0);
  for (size_t j = 0; j < joints.size(); ++j) {
    const auto there = std::find(rig.joints.begin(), rig.joints.end(), joints[j]);
    local[static_cast<size_t>(there - rig.joints.begin())] = static_cast<uint16_t>(j);
  }
  std::vector<Influences> out(vertices);
  for (size_t v = 0; v < vertices; ++v) {
    const size_t row = (part.first_vertex + v) * weights.per_vertex;
    for (size_t k = 0; k < weights.per_vertex; ++k) {
      if (weights.weights[row + k] > 0) {
        out[v].joints[k] = local[weights.joints[row + k]];
        out[v].weights[k] = weights.weights[row + k];
      }
    }
  }
  return out;
}

// Whether a node says where a joint ends: it carries nothing, and its name says so. Blender writes arm_end below arm.
bool is_end(const Node& node) {
  if (node.mesh >= 0 || node.camera >= 0 || !node.children.empty()) return false;
  // Exporters append numbers to names that occur twice: arm_end.001, arm_end_04.
  std::string name = node.name.substr(0, node.name.find_last_not_of("0123456789._-") + 1);
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  constexpr size_t length = 3;
  const std::string last = name.size() > length ? name.substr(name.size() - length) : "";
  return last == "end" || last == "tip" || last == "nub";
}

// Appends the nodes that say where joints end. They have the places of the bind pose.
void add_ends(const Model& model, const std::map<int, uint32_t>& number, Rig& rig) {
  const size_t joints = rig.joints.size();
  const Pose rest = rest_pose(model);
  for (size_t j = 0; j < joints; ++j) {
    for (const int child : model.nodes[static_cast<size_t>(rig.joints[j])].children) {
      const Node& node = model.nodes[static_cast<size_t>(child)];
      if (number.count(child) || !is_end(node)) continue;
      const glm::dmat4 bind = glm::inverse(rig.inverse_bind[j]) * local_matrix(rest[static_cast<size_t>(child)]);
      rig.joints.push_back(child);
      rig.names.push_back(node.name);
      ++rig.end_count;
      rig.inverse_bind.push_back(glm::inverse(bind));
      rig.bones.heads.insert(rig.bones.heads.end(), {bind[3].x, bind[3].y, bind[3].z});
      rig.bones.parents.push_back(static_cast<uint32_t>(j));
      rig.bones.deforms.push_back(0);
    }
  }
}

// Exporters give bones one local axis along which they point. Every joint with one child votes for an axis.
void find_axes(Rig& rig) {
  const size_t count = rig.joints.size();
  std::vector<glm::dvec3> heads(count);
  std::vector<size_t> children(count, 0);
  for (size_t j = 0; j < count; ++j) {
    heads[j] = {rig.bones.heads[3 * j], rig.bones.heads[3 * j + 1], rig.bones.heads[3 * j + 2]};
    if (rig.bones.parents[j] != HF_NO_INDEX) ++children[rig.bones.parents[j]];
  }
  const auto axis_of = [&](size_t j, size_t choice) {
    const glm::dmat4 bind = glm::inverse(rig.inverse_bind[j]);
    const glm::dvec3 axis(bind[static_cast<int>(choice / 2)]);
    const double length = glm::length(axis);
    return length > 0 ? axis * ((choice % 2 ? -1.0 : 1.0) / length) : glm::dvec3(0);
  };
  constexpr double aligned = 0.98, quorum = 0.5;  // cosine; share of the voters
  size_t votes[6] = {}, voters = 0;
  for (size_t j = 0; j < count; ++j) {
    const uint32_t parent = rig.bones.parents[j];
    if (parent == HF_NO_INDEX || children[parent] != 1) continue;
    const glm::dvec3 way = heads[j] - heads[parent];
    if (!(glm::length(way) > 0)) continue;
    ++voters;
    for (size_t a = 0; a < 6; ++a) votes[a] += glm::dot(axis_of(parent, a), glm::normalize(way)) > aligned;
  }
  const size_t best = static_cast<size_t>(std::max_element(votes, votes + 6) - votes);
  if (static_cast<double>(votes[best]) < quorum * static_cast<double>(voters) || voters == 0) return;
  for (size_t j = 0; j < count; ++j) {
    const glm::dvec3 axis = axis_of(j, best);
    rig.bones.axes.insert(rig.bones.axes.end(), {axis.x, axis.y, axis.z});
  }
}

// A joint that has an end points there, whatever its axes say.
void point_at_ends(Rig& rig) {
  if (rig.end_count == 0) return;
  if (rig.bones.axes.empty()) rig.bones.axes.assign(rig.bones.heads.size(), 0.0);
  for (size_t end = rig.joint_count(); end < rig.joints.size(); ++end) {
    const size_t joint = rig.bones.parents[end];
    for (size_t c = 0; c < 3; ++c)
      rig.bones.axes[3 * joint + c] = rig.bones.heads[3 * end + c] - rig.bones.heads[3 * joint + c];
  }
}

}  // namespace

std::vector<std::vector<int>> skeletons_of(const Model& model) {
  const std::vector<int> skins = used_skins(model);
  std::vector<int> skin_of(model.nodes.size(), -1), skeleton(model.skins.size());
  std::iota(skeleton.begin(), skeleton.end(), 0);
  const auto unite = [&](int a, int b) {
    const int from = skeleton[static_cast<size_t>(b)], to = skeleton[static_cast<size_t>(a)];
    if (from != to) std::replace(skeleton.begin(), skeleton.end(), from, to);
  };
  for (const int s : skins) {
    for (const int joint : model.skins[static_cast<size_t>(s)].joints) {
      int& known = skin_of[static_cast<size_t>(joint)];
      if (known < 0) known = s;
      unite(known, s);
    }
  }
  for (const int s : skins) {
    for (const int joint : model.skins[static_cast<size_t>(s)].joints) {
      int up = model.nodes[static_cast<size_t>(joint)].parent;
      while (up >= 0 && skin_of[static_cast<size_t>(up)] < 0) up = model.nodes[static_cast<size_t>(up)].parent;
      if (up >= 0) unite(skin_of[static_cast<size_t>(up)], s);
    }
  }
  std::vector<std::vector<int>> out;
  std::map<int, size_t> place;
  for (const int s : skins) {
    const auto at = place.emplace(skeleton[static_cast<size_t>(s)], out.size());
    if (at.second) out.emplace_back();
    out[at.first->second].push_back(s);
  }
  return out;
}

Rig read_rig(const Model& model) {
  Rig rig = read_rig(model, used_skins(model));
  if (rig.positions.empty()) throw std::runtime_error(model.name + ": no triangle has joints");
  return rig;
}

Rig read_rig(const Model& model, const std::vector<int>& skins) {
  Rig rig;
  std::map<int, uint32_t> number;
  const std::vector<glm::dmat4> to_first = collect_joints(model, skins, rig, number);
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    const Node& node = model.nodes[n];
    if (node.mesh < 0 || std::find(skins.begin(), skins.end(), node.skin) == skins.end()) continue;
    const MeshData& mesh = model.meshes[static_cast<size_t>(node.mesh)];
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const Primitive& primitive = mesh.primitives[p];
      if (primitive.topology != Topology::triangles || primitive.influences.empty()) continue;
      rig.parts.push_back({static_cast<int>(n), node.mesh, static_cast<int>(p), node.skin,
                           static_cast<uint32_t>(rig.positions.size())});
      add_primitive(primitive, model.skins[static_cast<size_t>(node.skin)], to_first[static_cast<size_t>(node.skin)],
                    number, rig);
    }
  }
  rig.bones.deforms.assign(rig.joints.size(), 0);
  for (size_t i = 0; i < rig.given.joints.size(); ++i) {
    if (rig.given.weights[i] > 0) rig.bones.deforms[rig.given.joints[i]] = 1;
  }
  for (size_t j = 0; j < rig.joints.size(); ++j) {
    const glm::dvec4 head = glm::inverse(rig.inverse_bind[j])[3];
    for (int c = 0; c < 3; ++c) rig.bones.heads.push_back(head[c]);
    int up = model.nodes[static_cast<size_t>(rig.joints[j])].parent;
    while (up >= 0 && number.find(up) == number.end()) up = model.nodes[static_cast<size_t>(up)].parent;
    rig.bones.parents.push_back(up < 0 ? HF_NO_INDEX : number.at(up));
  }
  add_ends(model, number, rig);
  find_axes(rig);
  point_at_ends(rig);
  rig.loose = loose_vertices(rig.positions, rig.triangles);
  rig.diagonal = SurfaceBox(rig.positions, rig.loose).diagonal();
  return rig;
}

uint32_t joint_named(const Rig& rig, const std::string& name, const std::string& where) {
  std::vector<int> nodes;
  size_t found = 0;
  const int number = node_number(name);
  for (size_t j = 0; j < rig.names.size(); ++j) {
    if (rig.names[j] != name) continue;
    nodes.push_back(rig.joints[j]);
    found = j;
  }
  for (size_t j = 0; j < rig.names.size() && nodes.empty(); ++j)
    if (rig.joints[j] == number) return static_cast<uint32_t>(j);
  if (nodes.empty()) throw std::runtime_error(where + "the model has no joint \"" + name + "\"");
  if (nodes.size() > 1) throw std::runtime_error(where + "the model has " + several_joints(name, nodes));
  return static_cast<uint32_t>(found);
}

std::vector<glm::dvec3> pose_rig(const Rig& rig, const std::vector<glm::dmat4>& globals, const RigWeights& weights) {
  std::vector<glm::dmat4> joints;
  for (size_t j = 0; j < rig.joints.size(); ++j)
    joints.push_back(globals[static_cast<size_t>(rig.joints[j])] * rig.inverse_bind[j]);
  std::vector<glm::dvec3> out(rig.positions.size());
  for (size_t v = 0; v < out.size(); ++v) {
    glm::dmat4 blend(0.0);
    double sum = 0;
    for (size_t k = 0; k < weights.per_vertex; ++k) {
      const double w = static_cast<double>(weights.weights[v * weights.per_vertex + k]);
      if (w > 0) {
        blend += joints[weights.joints[v * weights.per_vertex + k]] * w;
        sum += w;
      }
    }
    out[v] = sum > 0 ? glm::dvec3(blend * glm::dvec4(rig.positions[v], 1.0)) / sum : rig.positions[v];
  }
  return out;
}

std::vector<Pose> clip_poses(const Model& model, const Rig& rig) {
  constexpr size_t least_poses = 40;
  std::vector<Pose> poses;
  if (model.animations.empty()) {
    constexpr double swing = 0.5;  // radians
    for (size_t f = 0; f < least_poses; ++f) {
      Pose pose = rest_pose(model);
      for (size_t j = 0; j < rig.joints.size(); ++j) {
        NodePose& node = pose[static_cast<size_t>(rig.joints[j])];
        if (!rig.bones.deforms[j] || node.fixed) continue;
        const double phase = 2.399963 * static_cast<double>(j), turn = 0.157 * static_cast<double>(f + 1);
        const glm::dvec3 axis =
            glm::normalize(glm::dvec3(std::sin(3 * phase) + 0.1, std::cos(5 * phase), std::sin(7 * phase + 1)));
        node.rotation = node.rotation * glm::angleAxis(swing * std::sin(turn + phase), axis);
      }
      poses.push_back(std::move(pose));
    }
    return poses;
  }
  const size_t each = (least_poses + model.animations.size() - 1) / model.animations.size();
  for (const Animation& clip : model.animations) {
    const double duration = clip_duration(clip);
    for (size_t f = 0; f < each; ++f)
      poses.push_back(sample(model, clip, duration * static_cast<double>(f) / static_cast<double>(each)));
  }
  return poses;
}

Pose bent_pose(const Model& model, const Rig& rig, const std::vector<std::string>& bends) {
  Pose pose = rest_pose(model);
  for (const std::string& bend : bends) {
    const size_t last = bend.rfind(','),
                 middle = last == std::string::npos || last == 0 ? last : bend.rfind(',', last - 1);
    if (middle == std::string::npos || last != middle + 2 || bend[middle + 1] < 'x' || bend[middle + 1] > 'z')
      throw std::runtime_error("--bend: JOINT,AXIS,DEGREES with x, y or z is needed, not " + bend);
    const std::string name = bend.substr(0, middle), angle = bend.substr(last + 1);
    const uint32_t joint = joint_named(rig, name, "--bend: ");
    char* end = nullptr;
    const double degrees = std::strtod(angle.c_str(), &end);
    if (angle.empty() || *end != '\0' || !std::isfinite(degrees))
      throw std::runtime_error("--bend: \"" + angle + "\" is no angle");
    glm::dvec3 axis(0);
    axis[bend[middle + 1] - 'x'] = 1;
    NodePose& node = pose[static_cast<size_t>(rig.joints[joint])];
    if (node.fixed) throw std::runtime_error("--bend: " + name + " has a matrix; it cannot be turned");
    node.rotation = node.rotation * glm::angleAxis(glm::radians(degrees), axis);
  }
  return pose;
}

void write_weights(Model& model, const Rig& rig, const RigWeights& weights, std::set<int>& written) {
  for (size_t first = 0, last = 0; first < rig.parts.size(); first = last) {
    while (last < rig.parts.size() && rig.parts[last].node == rig.parts[first].node) ++last;
    int& mesh = model.nodes[static_cast<size_t>(rig.parts[first].node)].mesh;
    MeshData own = model.meshes[static_cast<size_t>(mesh)];
    bool same = true;
    for (size_t p = first; p < last; ++p) {
      std::vector<Influences>& influences = own.primitives[static_cast<size_t>(rig.parts[p].primitive)].influences;
      std::vector<Influences> made = influences_of(model, rig, rig.parts[p], weights, influences.size());
      same = same && std::equal(made.begin(), made.end(), influences.begin(), [](const auto& a, const auto& b) {
               return a.joints == b.joints && a.weights == b.weights;
             });
      influences = std::move(made);
    }
    if (written.insert(mesh).second) {
      model.meshes[static_cast<size_t>(mesh)] = std::move(own);
    } else if (!same) {
      mesh = static_cast<int>(model.meshes.size());
      written.insert(mesh);
      model.meshes.push_back(std::move(own));
    }
  }
}

}  // namespace samples
