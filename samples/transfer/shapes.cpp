// See shapes.h.
#include "transfer/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "gltf/animate.h"

namespace samples {

using namespace hf_gltf;
namespace {

size_t shape_count(const MeshData& mesh) {
  return mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
}

// Two shapes of one mesh that have a name are two: the second gets a number.
std::vector<std::string> names_of(const MeshData& mesh) {
  std::vector<std::string> out;
  std::set<std::string> taken;
  for (size_t k = 0; k < shape_count(mesh); ++k) {
    const bool named = k < mesh.target_names.size() && !mesh.target_names[k].empty();
    const std::string given = named ? mesh.target_names[k] : "shape_" + std::to_string(k);
    std::string name = given;
    for (int copy = 2; !taken.insert(name).second; ++copy) name = given + " (" + std::to_string(copy) + ")";
    out.push_back(name);
  }
  return out;
}

// The nodes of a flat mesh, each once.
std::vector<int> mesh_nodes(const FlatMesh& mesh) {
  std::vector<int> out;
  for (const FlatPart& part : mesh.parts)
    if (std::find(out.begin(), out.end(), part.node) == out.end()) out.push_back(part.node);
  return out;
}

const MeshData& mesh_of(const Model& model, int node) {
  return model.meshes[static_cast<size_t>(model.nodes[static_cast<size_t>(node)].mesh)];
}

std::vector<std::string> shape_names(const Model& model, const FlatMesh& flat) {
  std::vector<std::string> out;
  for (const int node : mesh_nodes(flat)) {
    for (const std::string& name : names_of(mesh_of(model, node)))
      if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  }
  return out;
}

double largest_move(const FlatMesh& mesh, const std::vector<double>& rest, const std::vector<double>& posed) {
  double out = 0;
  for (size_t i = 0; i < rest.size(); i += 3)
    if (!mesh.loose[i / 3])
      out = std::max(out, std::hypot(posed[i] - rest[i], posed[i + 1] - rest[i + 1], posed[i + 2] - rest[i + 2]));
  return out;
}

// Puts zeros for `more` weights behind those of every key.
void widen(Channel& channel, size_t more) {
  std::vector<float> values;
  for (size_t i = 0; i < channel.values.size(); i += channel.width) {
    values.insert(values.end(), channel.values.begin() + static_cast<std::ptrdiff_t>(i),
                  channel.values.begin() + static_cast<std::ptrdiff_t>(i + channel.width));
    values.insert(values.end(), more, 0.0f);
  }
  channel.values.swap(values);
  channel.width += more;
}

// Gives the meshes of the flat surface room for the new shapes, behind their own. Returns how many each had.
std::vector<size_t> add_room(Model& model, const FlatMesh& flat, const std::vector<std::string>& names) {
  std::vector<size_t> own(model.meshes.size(), 0);
  std::set<int> done;
  for (const int node : mesh_nodes(flat)) {
    const int index = model.nodes[static_cast<size_t>(node)].mesh;
    if (!done.insert(index).second) continue;
    MeshData& mesh = model.meshes[static_cast<size_t>(index)];
    own[static_cast<size_t>(index)] = shape_count(mesh);
    std::vector<std::string> all = names_of(mesh);
    std::set<std::string> taken(all.begin(), all.end());
    for (const std::string& name : names) {
      std::string free = name;
      for (int copy = 2; !taken.insert(free).second; ++copy) free = name + " (" + std::to_string(copy) + ")";
      all.push_back(free);
    }
    mesh.target_names = all;
    mesh.weights.resize(all.size(), 0.0f);
    for (Primitive& primitive : mesh.primitives) primitive.targets.resize(all.size());
  }
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    Node& node = model.nodes[n];
    if (!done.count(node.mesh)) continue;
    if (!node.weights.empty()) node.weights.resize(model.meshes[static_cast<size_t>(node.mesh)].weights.size(), 0.0f);
    for (Animation& animation : model.animations)
      for (Channel& channel : animation.channels)
        if (channel.node == static_cast<int>(n) && channel.path == Path::weights) widen(channel, names.size());
  }
  return own;
}

// The source's morph weights over a clip, on every node of the target's meshes.
Animation weights_clip(const Model& source, const FlatMesh& source_flat, const Animation& clip, const Model& target,
                       const std::vector<int>& nodes, const std::vector<size_t>& own,
                       const std::vector<std::string>& names) {
  Animation out;
  out.name = clip.name;
  const std::vector<double> times = key_times(clip);
  std::vector<std::vector<float>> rows;
  for (const double time : times) {
    const Pose pose = sample(source, clip, time);
    std::vector<float> row(names.size(), 0.0f);
    std::set<std::string> found;
    for (const int node : mesh_nodes(source_flat)) {
      const std::vector<std::string> own_names = names_of(mesh_of(source, node));
      for (size_t k = 0; k < own_names.size(); ++k) {
        if (!found.insert(own_names[k]).second) continue;
        row[static_cast<size_t>(std::find(names.begin(), names.end(), own_names[k]) - names.begin())] =
            static_cast<float>(pose[static_cast<size_t>(node)].weights[k]);
      }
    }
    rows.push_back(std::move(row));
  }
  for (const int node : nodes) {
    Channel channel;
    channel.node = node;
    channel.path = Path::weights;
    const size_t before = own[static_cast<size_t>(target.nodes[static_cast<size_t>(node)].mesh)];
    channel.width = before + names.size();
    channel.times.assign(times.begin(), times.end());
    const std::vector<float>& rest = mesh_of(target, node).weights;
    for (const std::vector<float>& row : rows) {
      channel.values.insert(channel.values.end(), rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(before));
      channel.values.insert(channel.values.end(), row.begin(), row.end());
    }
    out.channels.push_back(std::move(channel));
  }
  return out;
}

bool moves_weights(const Animation& clip) {
  return std::any_of(clip.channels.begin(), clip.channels.end(),
                     [](const Channel& channel) { return channel.path == Path::weights; });
}

}  // namespace

CarriedShapes carry_shapes(Session& session, const Model& source, const Model& target,
                           const std::vector<const Animation*>& clips, ProgressBar& bar) {
  const FlatMesh &from = session.source_flat(), &to = session.target_flat();
  const std::vector<std::string> names = shape_names(source, from);
  if (names.empty()) throw std::runtime_error(source.name + " has no morph targets to transfer");
  const Pose rest = rest_pose(source);
  std::vector<std::vector<double>> poses;
  std::vector<double> times;
  for (const std::string& name : names) {
    Pose pose = rest;
    for (const int node : mesh_nodes(from)) {
      const std::vector<std::string> own_names = names_of(mesh_of(source, node));
      for (size_t k = 0; k < own_names.size(); ++k)
        if (own_names[k] == name) pose[static_cast<size_t>(node)].weights[k] += 1;
    }
    times.push_back(static_cast<double>(times.size()));
    poses.push_back(double_positions(posed_positions(source, from, pose)));
  }
  CarriedShapes out;
  out.frames = session.play("", times, std::move(poses), bar);
  const std::vector<double> source_rest = double_positions(from.positions),
                            target_rest = double_positions(to.positions);
  for (size_t s = 0; s < names.size(); ++s)
    out.shapes.push_back(
        {names[s],
         largest_move(from, source_rest, out.frames.source_frames[s]) / session.source_mesh().bounding_box_diagonal,
         largest_move(to, target_rest, out.frames.target_frames[s]) / session.target_mesh().bounding_box_diagonal});

  out.model = target;
  const std::vector<size_t> own = add_room(out.model, to, names);
  const std::vector<glm::dmat4> globals = global_matrices(target, rest_pose(target));
  const std::vector<glm::vec3> normals = welded_normals(to, to.positions, true);
  std::set<std::pair<int, int>> filled;
  size_t shared = 0, collapsed = 0;
  for (const FlatPart& part : to.parts) {
    if (!filled.insert({part.mesh, part.primitive}).second) {
      ++shared;
      continue;
    }
    Primitive& primitive =
        out.model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    const std::vector<glm::dmat4> matrices = vertex_matrices(target, globals, part.node, primitive);
    std::vector<glm::dmat3> back, turn;
    for (const glm::dmat4& matrix : matrices) {
      const glm::dmat3 m(matrix);
      const bool flat = !(std::abs(glm::determinant(m)) > 0);
      collapsed += flat;
      back.push_back(flat ? glm::dmat3(0) : glm::inverse(m));
      turn.push_back(glm::transpose(m));
    }
    const auto unit = [](const glm::dvec3& n) { return glm::length(n) > 0 ? glm::normalize(n) : glm::dvec3(0); };
    for (size_t s = 0; s < names.size(); ++s) {
      const std::vector<double>& frame = out.frames.target_frames[s];
      const std::vector<glm::vec3> posed_normals =
          primitive.normals.empty() ? std::vector<glm::vec3>() : welded_normals(to, to_points(frame), true);
      MorphTarget morph;
      for (uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
        const glm::dvec3 moved = glm::dvec3(frame[3 * v], frame[3 * v + 1], frame[3 * v + 2]) - to.positions[v];
        const uint32_t i = v - part.first_vertex;
        morph.positions.push_back(glm::vec3(back[i] * moved));
        if (primitive.normals.empty()) continue;
        const glm::dvec3 before = unit(turn[i] * glm::dvec3(normals[v])),
                         after = unit(turn[i] * glm::dvec3(posed_normals[v]));
        morph.normals.push_back(glm::vec3(after - before));
      }
      primitive.targets[own[static_cast<size_t>(part.mesh)] + s] = std::move(morph);
    }
  }
  if (shared > 0)
    out.notes.push_back(std::to_string(shared) +
                        " parts are drawn by several nodes; their shapes come from the first node");
  if (collapsed > 0)
    out.notes.push_back(std::to_string(collapsed) + " vertices are collapsed by their nodes and take no shape");
  size_t done = 0;
  for (const Animation* clip : clips) {
    if (!moves_weights(*clip)) continue;
    Animation animation = weights_clip(source, from, *clip, out.model, mesh_nodes(to), own, names);
    for (int copy = 2; find_animation(out.model, animation.name) >= 0; ++copy)
      animation.name = clip->name + " (" + std::to_string(copy) + ")";
    out.model.animations.insert(out.model.animations.begin() + static_cast<std::ptrdiff_t>(done++),
                                std::move(animation));
  }
  if (!clips.empty() && done == 0) out.notes.push_back("no chosen clip of the source moves morph weights");
  return out;
}

std::string shapes_text(Session& session, const CarriedShapes& carried, const std::string& output,
                        const std::string& heading) {
  char line[256];
  std::string out = heading + "\n  output        " + output + "\n";
  std::snprintf(
      line, sizeof line,
      "  shapes        %zu, %.2f ms each; scale %.4f\n  shape                   moves the source  the target (boxes)\n",
      carried.shapes.size(), carried.frames.frame_ms, session.scale());
  out += line;
  for (const ShapeReport& shape : carried.shapes) {
    std::snprintf(line, sizeof line, "  %-24s          %.4f      %.4f\n", shape.name.c_str(), shape.source_moved,
                  shape.target_moved);
    out += line;
  }
  for (const std::string& note : carried.notes) out += "  note: " + note + "\n";
  for (const std::string& warning : session.warnings()) out += "  note: " + warning + "\n";
  return out;
}

nlohmann::json shapes_json(Session& session, const CarriedShapes& carried, const std::string& output) {
  nlohmann::json shapes = nlohmann::json::array(), warnings = carried.notes;
  for (const ShapeReport& shape : carried.shapes)
    shapes.push_back(
        {{"name", shape.name}, {"source_moved", shape.source_moved}, {"target_moved", shape.target_moved}});
  for (const std::string& warning : session.warnings()) warnings.push_back(warning);
  return {{"output", output},
          {"written_as", "shapes"},
          {"shapes", shapes},
          {"ms_per_shape", carried.frames.frame_ms},
          {"scale", session.scale()},
          {"factorise_ms", session.setup_ms()},
          {"prepare_ms", session.prepare_ms()},
          {"warnings", warnings}};
}

}  // namespace samples
