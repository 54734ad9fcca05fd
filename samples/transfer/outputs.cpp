// See outputs.h.
#include "transfer/outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <stdexcept>

#include "gltf/animate.h"
#include "gltf/clip_binding.h"
#include "gltf/file_name.h"
#include "gltf/key_reduce.h"
#include "gltf/rig_fit.h"
#include "transfer/posed_region.h"

namespace samples {

using namespace hf_gltf;
namespace {

void measure(const std::vector<glm::dvec3>& got, const std::vector<double>& wanted, const std::vector<uint8_t>& loose,
             double box, double& sum, OutputFigures& figures) {
  const auto count = static_cast<double>(std::count(loose.begin(), loose.end(), 0));
  for (size_t v = 0; v < got.size(); ++v) {
    if (loose[v]) continue;
    const double miss = glm::distance(got[v], glm::dvec3(wanted[3 * v], wanted[3 * v + 1], wanted[3 * v + 2])) / box;
    sum += miss * miss / count;
    figures.max = std::max(figures.max, miss);
  }
}

// Eigenvectors of a symmetric matrix by Jacobi's rotations, largest value first: columns of `vectors`.
void eigen(std::vector<double> a, size_t n, std::vector<double>& values, std::vector<double>& vectors) {
  std::vector<double> u(n * n, 0.0);
  for (size_t i = 0; i < n; ++i) u[i * n + i] = 1;
  double diagonal = 0;
  for (size_t i = 0; i < n; ++i) diagonal += std::abs(a[i * n + i]);
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0;
    for (size_t p = 0; p < n; ++p)
      for (size_t q = p + 1; q < n; ++q) off += std::abs(a[p * n + q]);
    if (off <= 1e-14 * diagonal) break;
    for (size_t p = 0; p < n; ++p) {
      for (size_t q = p + 1; q < n; ++q) {
        if (a[p * n + q] == 0) continue;
        const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1)),
                     c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (size_t k = 0; k < n; ++k) {
          const double x = a[k * n + p], y = a[k * n + q];
          a[k * n + p] = c * x - s * y;
          a[k * n + q] = s * x + c * y;
        }
        for (size_t k = 0; k < n; ++k) {
          const double x = a[p * n + k], y = a[q * n + k];
          a[p * n + k] = c * x - s * y;
          a[q * n + k] = s * x + c * y;
          const double f = u[k * n + p], g = u[k * n + q];
          u[k * n + p] = c * f - s * g;
          u[k * n + q] = s * f + c * g;
        }
      }
    }
  }
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return a[i * n + i] > a[j * n + j]; });
  values.resize(n);
  vectors.resize(n * n);
  for (size_t k = 0; k < n; ++k) {
    values[k] = a[order[k] * n + order[k]];
    for (size_t i = 0; i < n; ++i) vectors[i * n + k] = u[i * n + order[k]];
  }
}

// Displacements of all frames of all clips, and how many of their leading directions are needed.
struct Directions {
  size_t frames = 0, count = 0;
  std::vector<double> values, vectors;  // of the Gram matrix: frames x frames
};

Directions directions_of(const std::vector<std::vector<double>>& rows, double vertices, double box, double tolerance,
                         size_t limit) {
  Directions out;
  const size_t n = out.frames = rows.size();
  std::vector<double> gram(n * n);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j <= i; ++j)
      gram[i * n + j] = gram[j * n + i] = std::inner_product(rows[i].begin(), rows[i].end(), rows[j].begin(), 0.0);
  eigen(gram, n, out.values, out.vectors);
  // what is left of every frame after k directions: G_ff - sum_k s_k^2 V_fk^2
  std::vector<double> left(n);
  for (size_t f = 0; f < n; ++f) left[f] = gram[f * n + f];
  while (out.count < std::min(n, limit)) {
    double worst = 0;
    for (const double x : left) worst = std::max(worst, std::sqrt(std::max(x, 0.0) / vertices) / box);
    if (worst <= tolerance || !(out.values[out.count] > 0)) break;
    for (size_t f = 0; f < n; ++f)
      left[f] -= out.values[out.count] * out.vectors[f * n + out.count] * out.vectors[f * n + out.count];
    ++out.count;
  }
  out.count = std::max<size_t>(out.count, 1);
  return out;
}

// The links between pieces of a surface.
std::vector<RigTie> ties_of(hf_surface surface) {
  uint32_t count = 0;
  check(hf_surface_get_links(surface, 0, nullptr, &count), "the links");
  std::vector<hf_link> links(count);
  if (count > 0) check(hf_surface_get_links(surface, count, links.data(), nullptr), "the links");
  std::vector<RigTie> out(count);
  for (size_t i = 0; i < links.size(); ++i) {
    out[i].vertex = links[i].vertex;
    for (int c = 0; c < 3; ++c) {
      out[i].corners[c] = links[i].corners[c];
      out[i].shares[c] = links[i].barycentrics[c];
    }
  }
  return out;
}

// The ground that the computed frames keep. Where they lie deeper, so does the ground.
RigGround ground_of(const Session& session, const PlayedClip& clip) {
  RigGround out;
  out.up = session.target_axes().up;
  out.heights = session.grounds(clip);
  out.sinking = session.sinking();
  for (size_t f = 0; f < out.heights.size(); ++f)
    out.heights[f] = std::min(out.heights[f], lowest_of(clip.target_frames[f], out.up, out.sinking));
  return out;
}

std::string safe_name(const std::string& name) {
  std::string out = name.empty() ? "pose" : name;
  for (char& c : out)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  return out;
}

}  // namespace

void reduce_clips(Model& model, const FlatMesh& mesh, size_t clips, double tolerance, OutputFigures& figures) {
  for (size_t c = 0; c < clips; ++c) {
    figures.all_keys += key_count(model.animations[c]);
    reduce_keys(model, mesh, model.animations[c], tolerance);
    figures.keys += key_count(model.animations[c]);
  }
}

int root_of_skin(const Model& model) {
  if (model.skins.empty()) throw std::runtime_error(model.name + " has no skin, so there is no root for its travel");
  int root = model.skins.front().joints.front();
  while (model.nodes[static_cast<size_t>(root)].parent >= 0) root = model.nodes[static_cast<size_t>(root)].parent;
  return root;
}

void add_root_motion(Model& model, int root, const std::vector<PlayedClip>& clips) {
  Node& node = model.nodes[static_cast<size_t>(root)];
  split_matrix(node);
  for (size_t c = 0; c < clips.size(); ++c) {
    const std::vector<double>& times = clips[c].clip.times;
    if (!(glm::length(clips[c].travel) > 0)) continue;
    std::vector<Channel>& channels = model.animations[c].channels;
    const auto known = std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) {
      return channel.node == root && channel.path == Path::translation;
    });
    const bool is_new = known == channels.end();
    const auto number = is_new ? 0 : static_cast<size_t>(known - channels.begin());
    if (is_new) {
      Channel channel;
      channel.node = root;
      channel.times = {static_cast<float>(times.front()), static_cast<float>(times.back())};
      for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 3; ++i) channel.values.push_back(static_cast<float>(node.translation[i]));
      channels.insert(channels.begin(), std::move(channel));
    }
    Channel& channel = channels[number];
    if (channel.times.size() == 1) {  // it stood still
      channel.times.push_back(static_cast<float>(times.back()));
      for (int i = 0; i < 3; ++i) channel.values.push_back(channel.values[static_cast<size_t>(i)]);
    }
    for (size_t k = 0; k < channel.times.size(); ++k) {
      const double share = (static_cast<double>(channel.times[k]) - times.front()) / (times.back() - times.front());
      for (int i = 0; i < 3; ++i)
        channel.values[3 * k + static_cast<size_t>(i)] += static_cast<float>(share * clips[c].travel[i]);
    }
  }
}

std::vector<PlayedClip> written_clips(const Model& written, const Session& session,
                                      const std::vector<PlayedClip>& clips) {
  const FlatMesh mesh = flatten(written);
  SurfacePoser surface(written, mesh);
  std::vector<PlayedClip> out;
  for (size_t c = 0; c < clips.size(); ++c) {
    PlayedClip played;
    played.clip.name = clips[c].clip.name;
    played.clip.times = clips[c].clip.times;
    played.source_frames = clips[c].source_frames;
    played.frame_ms = clips[c].frame_ms;
    for (const double time : played.clip.times)
      played.target_frames.push_back(double_positions(surface.at(written.animations[c], time)));
    played.feet = session.feet_of(played);
    played.gap = session.largest_gap(played.target_frames);
    out.push_back(std::move(played));
  }
  return out;
}

Model own_skin_model(const Model& target, const Session& session, const std::vector<PlayedClip>& clips, double box,
                     double key_tolerance, OutputFigures& figures) {
  const FlatMesh& mesh = session.target_flat();
  const RigFit rig(target, mesh, ties_of(session.target_surface()));
  Model out = target;
  double sum = 0;
  size_t frames = 0, done = 0;
  for (const PlayedClip& clip : clips) {
    const RigGround ground = ground_of(session, clip);
    const std::vector<RigPose> poses = rig.fit_all(
        clip.clip.times, clip.target_frames, [&](size_t f) { return session.standing(clip, f); }, &ground);
    for (size_t f = 0; f < poses.size(); ++f, ++frames)
      measure(posed_positions(target, mesh, rig.whole(poses[f])), clip.target_frames[f], mesh.loose, box, sum, figures);
    insert_clip(out, done++, rig.clip(clip.clip.name, clip.clip.times, poses));
  }
  figures.rms = frames > 0 ? std::sqrt(sum / static_cast<double>(frames)) : 0;
  figures.parts = rig.turning();
  reduce_clips(out, mesh, clips.size(), key_tolerance * box, figures);
  return out;
}

Model morph_model(const Model& target, const FlatMesh& mesh, const std::vector<PlayedClip>& clips, double box,
                  double tolerance, size_t limit, OutputFigures& figures) {
  std::vector<std::vector<double>> rows;
  const std::vector<double> rest = double_positions(mesh.positions);
  const std::vector<glm::vec3> rest_normals = welded_normals(mesh, mesh.positions);
  for (const PlayedClip& clip : clips) {
    for (std::vector<double> frame : clip.target_frames) {
      for (size_t i = 0; i < frame.size(); ++i) frame[i] -= rest[i];
      rows.push_back(std::move(frame));
    }
  }
  const size_t n = rows.size(), vertices = mesh.positions.size();
  if (n > 2000)
    throw std::runtime_error("morph targets: " + std::to_string(n) +
                             " frames are too many; choose fewer clips or a lower --fps");
  const Directions directions = directions_of(rows, static_cast<double>(vertices), box, tolerance, limit);
  const size_t count = directions.count;
  // target k = sum_f V_fk d_f times the largest |V_fk|; the weight of frame f is V_fk over that
  std::vector<std::vector<glm::vec3>> moves(count, std::vector<glm::vec3>(vertices)), turns = moves;
  std::vector<float> weights(n * count);
  for (size_t k = 0; k < count; ++k) {
    double largest = 0;
    for (size_t f = 0; f < n; ++f) largest = std::max(largest, std::abs(directions.vectors[f * n + k]));
    for (size_t f = 0; f < n; ++f) weights[f * count + k] = static_cast<float>(directions.vectors[f * n + k] / largest);
    std::vector<double> sum(3 * vertices, 0.0);
    for (size_t f = 0; f < n; ++f)
      for (size_t i = 0; i < sum.size(); ++i) sum[i] += largest * directions.vectors[f * n + k] * rows[f][i];
    for (size_t v = 0; v < vertices; ++v)
      moves[k][v] = glm::vec3(static_cast<float>(sum[3 * v]), static_cast<float>(sum[3 * v + 1]),
                              static_cast<float>(sum[3 * v + 2]));
  }
  size_t row = 0;
  for (const PlayedClip& clip : clips) {
    for (const std::vector<double>& frame : clip.target_frames) {
      const std::vector<glm::vec3> normals = welded_normals(mesh, to_points(frame));
      for (size_t k = 0; k < count; ++k) {
        // V is orthonormal, so the projection is a product; the scale cancels as above
        double largest = 0;
        for (size_t f = 0; f < n; ++f) largest = std::max(largest, std::abs(directions.vectors[f * n + k]));
        const auto w = static_cast<float>(directions.vectors[row * n + k] * largest);
        for (size_t v = 0; v < vertices; ++v) turns[k][v] += w * (normals[v] - rest_normals[v]);
      }
      ++row;
    }
  }
  // programs clamp weights to 0..1, so a direction that goes both ways is two targets; between keys their sum is as
  // linear as one weight
  struct Part {
    size_t direction;
    float sign;
  };
  std::vector<Part> parts;
  for (size_t k = 0; k < count; ++k) {
    for (const float sign : {1.0f, -1.0f}) {
      bool used = false;
      for (size_t f = 0; f < n; ++f) used = used || sign * weights[f * count + k] > 0;
      if (used) parts.push_back({k, sign});
    }
  }
  figures.parts = parts.size();
  Model out = bake(target, mesh, mesh.positions);
  keep_carried(target, out);
  std::map<int, size_t> mesh_of;
  std::vector<size_t> filled(out.meshes.size(), 0);
  for (const FlatPart& from : mesh.parts) {
    const size_t m = mesh_of.emplace(from.node, mesh_of.size()).first->second;
    Primitive& primitive = out.meshes[m].primitives[filled[m]++];
    for (const Part& part : parts) {
      MorphTarget morph;
      for (size_t v = from.first_vertex; v < size_t{from.first_vertex} + from.vertex_count; ++v) {
        morph.positions.push_back(part.sign * moves[part.direction][v]);
        morph.normals.push_back(part.sign * turns[part.direction][v]);
      }
      primitive.targets.push_back(std::move(morph));
    }
  }
  row = 0;
  for (const PlayedClip& clip : clips) {
    Animation animation;
    animation.name = clip.clip.name;
    for (size_t node = 0; node < out.nodes.size(); ++node) {
      if (out.nodes[node].mesh < 0) continue;
      Channel channel;
      channel.node = static_cast<int>(node);
      channel.path = Path::weights;
      channel.width = parts.size();
      channel.times.assign(clip.clip.times.begin(), clip.clip.times.end());
      for (size_t f = row; f < row + clip.target_frames.size(); ++f) {
        for (const Part& part : parts)
          channel.values.push_back(std::max(0.0f, part.sign * weights[f * count + part.direction]));
      }
      animation.channels.push_back(std::move(channel));
    }
    row += clip.target_frames.size();
    out.animations.push_back(std::move(animation));
  }
  const FlatMesh again = flatten(out);
  SurfacePoser surface(out, again);
  double sum = 0;
  for (size_t c = 0; c < clips.size(); ++c) {
    for (size_t f = 0; f < clips[c].target_frames.size(); ++f)
      measure(surface.at(out.animations[c], clips[c].clip.times[f]), clips[c].target_frames[f], again.loose, box, sum,
              figures);
  }
  figures.rms = std::sqrt(sum / static_cast<double>(std::max<size_t>(n, 1)));
  return out;
}

std::vector<std::filesystem::path> write_frames(const std::filesystem::path& folder, const std::string& extension,
                                                const SurfaceMesh& rest, const std::vector<PlayedClip>& clips) {
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> out;
  SurfaceMesh mesh = rest;
  mesh.normals.clear();
  for (const PlayedClip& clip : clips) {
    for (size_t f = 0; f < clip.target_frames.size(); ++f) {
      mesh.positions = to_points(clip.target_frames[f]);
      char number[32];
      std::snprintf(number, sizeof number, "_%04zu", f);
      out.push_back(folder / file_named(safe_name(clip.clip.name) + number + extension));
      write_mesh_file(mesh, out.back());
    }
  }
  return out;
}

}  // namespace samples
