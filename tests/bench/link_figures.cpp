// hf_link_figures MODEL.glb ... [--quick | --causes | --surfaces] [--pictures DIR]: what links between the pieces of
// models are worth, as one table. --quick leaves out the poses and the transfer without links. --causes also names the
// pieces whose links open in the artist's clips. --surfaces only makes the surfaces and prints a hash of the links, to
// count instructions.
//
// Contacts are measured apart from the library's links: every vertex within 0.5 % of the box of another piece, and the
// nearest point there. A pose turns one region by 60 degrees and holds another. All lengths are in % of the box.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>

#include "bench/link_scene.h"
#include "common/picture.h"
#include "gltf/animate.h"

namespace {

using namespace bench;

constexpr double contact_range = 0.005, turn_degrees = 60, handle_radius = 0.06, false_link = 0.03;
constexpr int pose_count = 4, clip_samples = 8;

hf_surface make_surface_of(const LinkScene& scene, const hf_links_desc* links, int times_count, double* out_ms) {
  hf_surface surface = nullptr;
  std::vector<double> times;
  for (int i = 0; i < times_count; ++i) {
    hf_surface_destroy(surface);
    const auto start = std::chrono::steady_clock::now();
    surface = make_linked(scene, links);
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  *out_ms = times[times.size() / 2];
  return surface;
}

// A vertex and the nearest point of another piece.
struct Contact {
  uint32_t vertex, corner[3];
  double share[3], distance;
};

// The nearest point of a triangle, as barycentrics.
void nearest_point(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double* w) {
  const glm::dvec3 ab = b - a, ac = c - a;
  const auto set = [&](double x, double y, double z) {
    w[0] = x;
    w[1] = y;
    w[2] = z;
  };
  const glm::dvec3 ap = p - a, bp = p - b, cp = p - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
               d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return set(1, 0, 0);
  if (d3 >= 0 && d4 <= d3) return set(0, 1, 0);
  if (d6 >= 0 && d5 <= d6) return set(0, 0, 1);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return set(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return set(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return set(0, 1 - t, t);
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return set(1, 0, 0);
  set(va / sum, vb / sum, vc / sum);
}

std::vector<Contact> find_contacts(const LinkScene& scene, const std::vector<uint32_t>& piece) {
  std::vector<Contact> out;
  const double range = contact_range * scene.diagonal;
  std::vector<char> seen(scene.flat.welded_count, 0);
  const std::vector<glm::dvec3>& p = scene.flat.positions;
  for (uint32_t v = 0; v < scene.flat.vertex_count(); ++v) {
    if (piece[v] == HF_NO_INDEX || seen[scene.flat.welded[v]]) continue;
    seen[scene.flat.welded[v]] = 1;
    Contact best{v, {0, 0, 0}, {1, 0, 0}, range};
    bool found = false;
    for (uint32_t t = 0; t < scene.flat.triangle_count(); ++t) {
      const uint32_t* c = &scene.flat.triangles[3 * size_t{t}];
      if (piece[c[0]] == piece[v] || piece[c[0]] == HF_NO_INDEX) continue;
      const glm::dvec3 low = glm::min(p[c[0]], glm::min(p[c[1]], p[c[2]])) - range,
                       high = glm::max(p[c[0]], glm::max(p[c[1]], p[c[2]])) + range;
      if (glm::any(glm::lessThan(p[v], low)) || glm::any(glm::greaterThan(p[v], high))) continue;
      double w[3];
      nearest_point(p[v], p[c[0]], p[c[1]], p[c[2]], w);
      const double d = glm::length(p[v] - w[0] * p[c[0]] - w[1] * p[c[1]] - w[2] * p[c[2]]);
      if (d >= best.distance) continue;
      best = {v, {c[0], c[1], c[2]}, {w[0], w[1], w[2]}, d};
      found = true;
    }
    if (found) out.push_back(best);
  }
  return out;
}

double apart(uint32_t vertex, const uint32_t* corner, const double* share, const std::vector<double>& xyz) {
  const auto at = [&](uint32_t v) {
    return glm::dvec3(xyz[3 * size_t{v}], xyz[3 * size_t{v} + 1], xyz[3 * size_t{v} + 2]);
  };
  glm::dvec3 d = at(vertex);
  for (int k = 0; k < 3; ++k) {
    if (share[k] > 0) d -= share[k] * at(corner[k]);
  }
  return glm::length(d);
}

struct Spread {
  double p95 = 0, worst = 0;
};
Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[(95 * values.size() + 99) / 100 - 1], values.back()};
}

// Extremities: vertices far from each other and from the middle.
std::vector<uint32_t> far_vertices(const LinkScene& scene, const std::vector<uint32_t>& piece, int count) {
  glm::dvec3 middle(0);
  for (const glm::dvec3& p : scene.flat.positions) middle += p / double(scene.flat.vertex_count());
  std::vector<double> distance(scene.flat.vertex_count());
  for (uint32_t v = 0; v < distance.size(); ++v)
    distance[v] = piece[v] == HF_NO_INDEX ? -1 : glm::length(scene.flat.positions[v] - middle);
  std::vector<uint32_t> out;
  for (int i = 0; i < count; ++i) {
    const uint32_t v = uint32_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
    out.push_back(v);
    for (uint32_t u = 0; u < distance.size(); ++u)
      distance[u] = std::min(distance[u], glm::length(scene.flat.positions[u] - scene.flat.positions[v]));
  }
  return out;
}

std::vector<double> turn(hf_surface surface, const LinkScene& scene, uint32_t turned, uint32_t held,
                         uint32_t* unreached) {
  hf_pose pose = nullptr;
  ok(hf_pose_create(surface, nullptr, &pose));
  uint32_t handle[2];
  const double radius = handle_radius * scene.diagonal;
  const glm::dvec3 a = scene.flat.positions[turned], b = scene.flat.positions[held];
  ok(hf_pose_add_handle_at(pose, &a.x, radius, &handle[0]));
  ok(hf_pose_add_handle_at(pose, &b.x, radius, &handle[1]));
  const glm::dvec3 along = glm::normalize(b - a);
  const glm::dvec3 axis =
      glm::normalize(glm::cross(along, std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  const double half = turn_degrees / 360 * 3.14159265358979323846;
  hf_transform transform = {};
  for (int k = 0; k < 3; ++k) transform.rotation[k] = std::sin(half) * axis[k];
  transform.rotation[3] = std::cos(half);
  ok(hf_pose_set_transform(pose, handle[0], &transform));
  std::vector<double> out(scene.xyz.size());
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions_f64 = out.data();
  hf_deform_info info = HF_INIT(hf_deform_info);
  for (int i = 0; i < 10; ++i) ok(hf_pose_deform(pose, &desc, &info));
  *unreached = info.unreached_vertex_count;
  hf_pose_destroy(pose);
  return out;
}

// How far the ends of every link move apart in the artist's clips, in boxes.
std::vector<double> widest_in_clips(const LinkScene& scene, const std::vector<hf_link>& links) {
  std::vector<double> out(links.size(), 0);
  for (const Animation& clip : scene.model.animations) {
    for (int i = 0; i < clip_samples; ++i) {
      const double time = clip_duration(clip) * i / (clip_samples - 1);
      const std::vector<double> xyz = double_positions(posed_positions(scene.model, scene.flat, clip, time));
      for (size_t l = 0; l < links.size(); ++l)
        out[l] =
            std::max(out[l], (apart(links[l].vertex, links[l].corners, links[l].barycentrics, xyz) - links[l].length) /
                                 scene.diagonal);
    }
  }
  return out;
}

// Share of links whose ends move apart by more than 3 % of the box. -1 without clips.
double false_share(const LinkScene& scene, const std::vector<hf_link>& links) {
  if (scene.model.animations.empty() || links.empty()) return -1;
  double wrong = 0;
  for (const double opened : widest_in_clips(scene, links)) wrong += opened > false_link;
  return wrong / double(links.size());
}

// Frames of the artist: samples of the clips; of a skin without clips, every joint turned about each axis by 60
// degrees.
std::vector<std::vector<double>> artist_frames(const LinkScene& scene) {
  std::vector<std::vector<double>> out;
  for (const Animation& clip : scene.model.animations) {
    for (int i = 0; i < clip_samples; ++i) {
      const double time = clip_duration(clip) * i / (clip_samples - 1);
      out.push_back(double_positions(posed_positions(scene.model, scene.flat, clip, time)));
    }
  }
  if (!out.empty()) return out;
  for (const Skin& skin : scene.model.skins) {
    for (const int joint : skin.joints) {
      const std::vector<glm::dmat4> world = global_matrices(scene.model, rest_pose(scene.model));
      for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        out.push_back(turned_by_skin(scene, joint, turn_about(world[size_t(joint)][3], axis, turn_degrees)));
    }
  }
  return out;
}

// Leaves out contacts that the artist's frames open by more than 3 % of the box: these pieces do not belong together.
void drop_false_contacts(const LinkScene& scene, std::vector<Contact>& contacts) {
  for (const std::vector<double>& xyz : artist_frames(scene)) {
    contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                  [&](const Contact& c) {
                                    return apart(c.vertex, c.corner, c.share, xyz) - c.distance >
                                           false_link * scene.diagonal;
                                  }),
                   contacts.end());
  }
}

// A field of two sites. unreached: NULL, or receives the vertices where it is 0 although no site holds them there.
std::vector<float> field_of(hf_surface surface, const LinkScene& scene, uint32_t first, uint32_t second,
                            uint32_t* unreached) {
  hf_solver solver = nullptr;
  ok(hf_create(surface, nullptr, &solver));
  const uint32_t vertices[2] = {first, second};
  const double values[2] = {1, 2};
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = 2;
  sites.vertices = vertices;
  sites.values = values;
  ok(hf_add_sites(solver, &sites, nullptr));
  std::vector<float> field(scene.flat.vertex_count());
  hf_solve_info info = HF_INIT(hf_solve_info);
  ok(hf_solve(solver, field.data(), 0, &info));
  hf_solver_destroy(solver);
  if (unreached) *unreached = info.unreached_vertex_count;
  return field;
}

uint32_t unreached_by_sites(hf_surface surface, const LinkScene& scene, uint32_t first, uint32_t second) {
  uint32_t out = 0;
  field_of(surface, scene, first, second, &out);
  return out;
}

// The surface with its links but those of light pieces.
hf_surface without_light(hf_surface linked, const LinkScene& scene, const std::vector<hf_link>& links) {
  std::vector<int32_t> light(scene.flat.vertex_count());
  ok(hf_surface_get_pieces(linked, scene.flat.vertex_count(), nullptr, light.data(), nullptr));
  std::vector<hf_link> kept;
  for (const hf_link& link : links) {
    bool heavy = !light[link.vertex];
    for (int k = 0; k < 3; ++k) heavy = heavy && (link.barycentrics[k] <= 0 || !light[link.corners[k]]);
    if (heavy) kept.push_back(link);
  }
  hf_links_desc desc = HF_INIT(hf_links_desc);
  desc.mode = HF_LINK_LIST;
  desc.link_count = uint32_t(kept.size());
  desc.links = kept.data();
  desc.overlay_distance = -1;  // the links of the others are kept, and no other edge of a body depends on it
  hf_surface out = nullptr;
  ok(hf_surface_relink(linked, kept.empty() ? nullptr : &desc, nullptr, &out));
  return out;
}

// How much links change the field of the piece with most vertices, between two far sites of it: 95 % of the vertices.
double body_change(hf_surface plain, hf_surface linked, const LinkScene& scene, std::vector<uint32_t> piece) {
  std::map<uint32_t, size_t> sizes;
  for (const uint32_t p : piece) sizes[p] += p != HF_NO_INDEX;
  uint32_t largest = 0;
  for (const auto& [p, size] : sizes) largest = size > sizes[largest] ? p : largest;
  for (uint32_t& p : piece) p = p == largest ? p : HF_NO_INDEX;
  const std::vector<uint32_t> ends = far_vertices(scene, piece, 2);
  const std::vector<float> a = field_of(plain, scene, ends[0], ends[1], nullptr),
                           b = field_of(linked, scene, ends[0], ends[1], nullptr);
  std::vector<double> change;
  for (size_t v = 0; v < piece.size(); ++v) {
    if (piece[v] == largest) change.push_back(std::abs(double(a[v]) - double(b[v])));
  }
  return spread_of(change).p95;
}

// A model played on itself: twelve pairs of regions spread over it, the mean distance of all vertices from the artist's
// frames, in % of the box. -1 without clips.
double played_on_itself(hf_surface surface, const LinkScene& scene, const std::vector<uint32_t>& piece) {
  if (scene.model.animations.empty()) return -1;
  constexpr int pair_count = 12, clip_count = 3;
  const std::vector<uint32_t> centres = far_vertices(scene, piece, pair_count);
  std::vector<uint32_t> counts, vertices;
  std::vector<char> taken(scene.flat.welded_count, 0);
  for (const uint32_t centre : centres) {
    uint32_t count = 0;
    for (uint32_t v = 0; v < scene.flat.vertex_count(); ++v) {
      if (piece[v] == HF_NO_INDEX || taken[scene.flat.welded[v]]) continue;
      if (glm::length(scene.flat.positions[v] - scene.flat.positions[centre]) > 0.03 * scene.diagonal) continue;
      taken[scene.flat.welded[v]] = 1;
      vertices.push_back(v);
      ++count;
    }
    if (count > 0) counts.push_back(count);
  }
  hf_transfer transfer = nullptr;
  ok(hf_transfer_create(surface, surface, nullptr, &transfer));
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = uint32_t(counts.size());
  pairs.source_counts = pairs.target_counts = counts.data();
  pairs.source_vertices = pairs.target_vertices = vertices.data();
  ok(hf_transfer_add_pairs(transfer, &pairs, nullptr));
  double sum = 0, frames = 0;
  std::vector<double> out(scene.xyz.size());
  for (size_t c = 0; c < std::min(scene.model.animations.size(), size_t{clip_count}); ++c) {
    const Animation& clip = scene.model.animations[c];
    for (int i = 0; i < clip_samples; ++i) {
      const std::vector<double> xyz = double_positions(
          posed_positions(scene.model, scene.flat, clip, clip_duration(clip) * i / (clip_samples - 1)));
      hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
      frame.source_positions_f64 = xyz.data();
      frame.target_positions_f64 = out.data();
      ok(hf_transfer_apply(transfer, &frame));
      // The whole may lie elsewhere: the mean displacement does not count.
      glm::dvec3 mean(0);
      const size_t n = scene.flat.vertex_count();
      const auto miss = [&](size_t v) {
        return glm::dvec3(out[3 * v] - xyz[3 * v], out[3 * v + 1] - xyz[3 * v + 1], out[3 * v + 2] - xyz[3 * v + 2]);
      };
      for (size_t v = 0; v < n; ++v) mean += miss(v) / double(n);
      for (size_t v = 0; v < n; ++v) sum += glm::length(miss(v) - mean) / double(n);
      frames += 1;
    }
  }
  hf_transfer_destroy(transfer);
  return 100 * sum / frames / scene.diagonal;
}

Picture tile(const LinkScene& scene, const std::vector<double>& xyz, const std::vector<uint32_t>& marks) {
  Surface surface = make_surface(xyz, scene.flat.triangles);
  View view;
  view.width = 520;
  view.height = 520;
  view.direction = {0.5, 0.25, 1.0};
  Marks dots;
  for (const uint32_t v : marks)
    dots.dots.push_back({{xyz[3 * size_t{v}], xyz[3 * size_t{v} + 1], xyz[3 * size_t{v} + 2]}});
  return render(surface, view, {}, dots);
}

// For the search for causes: the pairs of pieces with false links. The joint that moves most of a piece names it.
void list_false(const LinkScene& scene, const ModelLinks& skin, const std::vector<hf_link>& links,
                const std::vector<uint32_t>& piece) {
  std::map<uint32_t, std::map<int, double>> joints;
  for (size_t i = 0; i < skin.joints.size(); ++i) joints[piece[i / 8]][skin.joints[i]] += double(skin.weights[i]);
  const auto name_of = [&](uint32_t p) {
    std::pair<int, double> most{-1, 0};
    double all = 0;
    for (const auto& [joint, weight] : joints[p]) {
      all += weight;
      if (weight > most.second) most = {joint, weight};
    }
    char text[96] = "no joint";
    if (most.first >= 0)
      std::snprintf(text, sizeof text, "%u %s %.0f %%", p, scene.model.nodes[size_t(most.first)].name.c_str(),
                    100 * most.second / all);
    return std::string(text);
  };
  const std::vector<double> opened = widest_in_clips(scene, links);
  struct Pair {
    int links = 0, wrong = 0, tree = 0;
    double widest = 0, nearest = 1e300;
  };
  std::map<std::pair<uint32_t, uint32_t>, Pair> pairs;
  for (size_t l = 0; l < links.size(); ++l) {
    uint32_t other = 0;
    for (int k = 0; k < 3; ++k) other = links[l].barycentrics[k] > 0 ? piece[links[l].corners[k]] : other;
    const uint32_t own = piece[links[l].vertex];
    Pair& pair = pairs[{std::min(own, other), std::max(own, other)}];
    pair.links += 1;
    pair.wrong += opened[l] > false_link;
    pair.tree += links[l].in_tree;
    pair.widest = std::max(pair.widest, opened[l]);
    pair.nearest = std::min(pair.nearest, links[l].length / scene.diagonal);
  }
  for (const auto& [key, pair] : pairs) {
    if (pair.wrong > 0)
      std::printf("  %s | %s: %d of %d links open, up to %.1f %%; %s, %.2f %% apart at rest\n",
                  name_of(key.first).c_str(), name_of(key.second).c_str(), pair.wrong, pair.links, 100 * pair.widest,
                  pair.tree ? "tree" : "not in the tree", 100 * pair.nearest);
  }
}

// FNV-1a over the links, so that two searches can be compared.
uint64_t hash_of(const std::vector<hf_link>& links) {
  uint64_t hash = 14695981039346656037u;
  const auto take = [&](const void* from, size_t size) {
    for (size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<const unsigned char*>(from)[i]) * 1099511628211u;
  };
  for (const hf_link& link : links) {
    take(&link.vertex, sizeof link.vertex);
    take(link.corners, sizeof link.corners);
    take(link.barycentrics, sizeof link.barycentrics);
    if (link.weight < 1 || link.weight > 1) take(&link.weight, sizeof link.weight);
  }
  return hash;
}

// Figures of the artist's clips; a dash for a model without clips.
std::string or_dash(bool none, const char* format, double first, double second = 0) {
  char text[64];
  std::snprintf(text, sizeof text, format, first, second);
  return none ? "-" : text;
}

enum class Extent { whole, quick, causes, surfaces };

void report(const std::string& file, const std::string& pictures, Extent extent) {
  const bool quick = extent != Extent::whole;
  const LinkScene scene = read_scene(file);
  const ModelLinks links(scene.has_model ? &scene.model : nullptr, scene.flat);
  double plain_ms = 0, linked_ms = 0;
  const int times_count = quick ? 1 : 7;
  hf_surface plain = make_surface_of(scene, nullptr, times_count, &plain_ms),
             linked = make_surface_of(scene, &links.desc, times_count, &linked_ms);
  hf_surface_report found = HF_INIT(hf_surface_report);
  ok(hf_surface_get_report(linked, &found));
  hf_links_info joined = HF_INIT(hf_links_info);
  ok(hf_surface_get_links_info(linked, &joined));
  hf_surface_statistics before = HF_INIT(hf_surface_statistics), after = HF_INIT(hf_surface_statistics);
  ok(hf_surface_get_statistics(plain, &before));
  ok(hf_surface_get_statistics(linked, &after));
  std::vector<hf_link> list(joined.link_count);
  uint32_t count = 0;
  ok(hf_surface_get_links(linked, joined.link_count, list.data(), &count));
  const std::string name = file.substr(file.find_last_of('/') + 1);
  if (extent == Extent::surfaces) {
    std::printf("%-26s %u links, %016llx\n", name.c_str(), count, static_cast<unsigned long long>(hash_of(list)));
    return hf_surface_destroy(plain), hf_surface_destroy(linked);
  }
  std::vector<uint32_t> piece(scene.flat.vertex_count());
  ok(hf_surface_get_pieces(linked, scene.flat.vertex_count(), piece.data(), nullptr, &count));
  std::vector<Contact> contacts = find_contacts(scene, piece);
  drop_false_contacts(scene, contacts);
  const std::vector<uint32_t> ends = far_vertices(scene, piece, pose_count);
  Spread gap[2];
  uint32_t unreached = 0;
  std::vector<Picture> tiles;
  for (int i = 0; i < pose_count; ++i) {
    uint32_t held = ends[0];
    for (const uint32_t v : ends) {
      const glm::dvec3 p = scene.flat.positions[ends[size_t(i)]];
      if (glm::length(scene.flat.positions[v] - p) > glm::length(scene.flat.positions[held] - p)) held = v;
    }
    if (!pictures.empty()) tiles.push_back(tile(scene, scene.xyz, {ends[size_t(i)], held}));
    for (int k = quick ? 1 : 0; k < 2; ++k) {
      const std::vector<double> posed = turn(k ? linked : plain, scene, ends[size_t(i)], held, &unreached);
      std::vector<double> opened;
      for (const Contact& c : contacts)
        opened.push_back(std::max(0.0, apart(c.vertex, c.corner, c.share, posed) - c.distance));
      const Spread own = spread_of(opened);
      gap[k].p95 += own.p95 / pose_count * 100 / scene.diagonal;
      gap[k].worst += own.worst / pose_count * 100 / scene.diagonal;
      if (!pictures.empty()) tiles.push_back(tile(scene, posed, {}));
    }
  }
  const double wrong = false_share(scene, list);
  const double played[2] = {quick ? 0 : played_on_itself(plain, scene, piece), played_on_itself(linked, scene, piece)};
  char hash_text[24] = "";
  if (quick) std::snprintf(hash_text, sizeof hash_text, " %016llx |", static_cast<unsigned long long>(hash_of(list)));
  const std::string hash = hash_text;
  hf_surface heavy = without_light(linked, scene, list);
  std::printf(
      "| %-26s | %5u | %3u | %3u | %4u | %2u | %5.2f | %5.2f / %5.1f | %6.3f / %5.2f | %4.2f | %5.2f | %5.2f | %+3.0f "
      "%% | %4u | %s | %s | %.3f | %.5f |%s\n",
      name.c_str(), found.welded_vertex_count, joined.piece_count, found.component_count, joined.link_count,
      joined.light_piece_count, 100 * joined.longest_tree_link / scene.diagonal, gap[0].p95, gap[0].worst, gap[1].p95,
      gap[1].worst, after.factor_entries / before.factor_entries, after.links_ms, plain_ms,
      100 * (linked_ms / plain_ms - 1), unreached_by_sites(linked, scene, ends[0], ends[1]),
      or_dash(wrong < 0, "%5.1f %%", 100 * wrong).c_str(),
      or_dash(played[1] < 0, "%5.2f / %5.2f", played[0], played[1]).c_str(), body_change(plain, linked, scene, piece),
      body_change(heavy, linked, scene, piece), hash.c_str());
  hf_surface_destroy(heavy);
  if (extent == Extent::causes) list_false(scene, links, list, piece);
  std::fflush(stdout);
  if (!pictures.empty())
    write_png(pictures + "/" + name + ".png", contact_sheet(tiles, 3, {}, name + ": rest, without links, with links"));
  hf_surface_destroy(plain);
  hf_surface_destroy(linked);
}

}  // namespace

int main(int count, char** arguments) {
  std::string pictures;
  Extent extent = Extent::whole;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--quick") == 0) extent = Extent::quick;
    if (std::strcmp(arguments[i], "--causes") == 0) extent = Extent::causes;
    if (std::strcmp(arguments[i], "--surfaces") == 0) extent = Extent::surfaces;
    if (std::strcmp(arguments[i], "--pictures") == 0 && i + 1 < count) pictures = arguments[i + 1];
  }
  if (extent != Extent::surfaces)
    std::printf(
        "| model | vertices | pieces | groups | links | light | tree | gap without: 95 %% / worst | with | entries | "
        "search ms | surface ms | making | unreached | false "
        "| on itself: without / with | body | by light pieces "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--pictures") == 0) {
      ++i;
      continue;
    }
    if (std::strncmp(arguments[i], "--", 2) == 0) continue;
    try {
      report(arguments[i], pictures, extent);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "hf_link_figures: %s: %s\n", arguments[i], error.what());
      return 1;
    }
  }
  return 0;
}
