#include "mesh/link_intake.h"

#include <cmath>

#include "base/arguments.h"
#include "mesh/joint_tree.h"
#include "mesh/link_constants.h"
#include "mesh/vertex_lists.h"

namespace hf_inner::mesh {
namespace {

// Barycentrics are scaled to sum 1 if they are this near to it. Less refuses sums of rounded decimals, more takes wrong
// numbers for weights. It refuses mistakes, and no link depends on it.
constexpr double barycentric_slack = 1e-3;
// Nearer sums are 1 up to rounding. The barycentrics do not change, so that a list read back has the same bits. It
// trades nothing: sums of three shares miss 1 by at most 4e-16.
constexpr double rounded_sum = 1e-15;
// Joints of a skeleton: as many as 16 bits can name.
constexpr std::uint32_t most_parents = 0x10000;

double read_length(double given, double standard, const Mesh& mesh, const char* name) {
  const double length = given;
  check_finite(length, name);
  return length == 0 ? standard : length / mesh.scale;
}

Link read_link(const hf_link& given, const Mesh& mesh, std::uint32_t i) {
  Link link;
  link.vertex = usable_vertex(mesh, given.vertex, i);
  link.weight = given.weight;
  if (!std::isfinite(link.weight)) fail(HF_ERROR_NON_FINITE, i, "the weight of link %u is not finite", i);
  if (!(link.weight > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, i, "the weight of link %u is %g; it must be above 0", i, link.weight);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = given.barycentrics[k];
    if (!std::isfinite(share)) fail(HF_ERROR_NON_FINITE, i, "a barycentric of link %u is not finite", i);
    if (share < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "a barycentric of link %u is %g; it must not be negative", i, share);
    sum += share;
  }
  if (!(std::fabs(sum - 1) <= barycentric_slack))
    fail(HF_ERROR_INVALID_ARGUMENT, i, "the barycentrics of link %u have the sum %g; it must be 1", i, sum);
  for (std::size_t k = 0; k < 3; ++k) {
    if (given.barycentrics[k] == 0) continue;
    link.share[k] = std::fabs(sum - 1) <= rounded_sum ? given.barycentrics[k] : given.barycentrics[k] / sum;
    link.corner[k] = usable_vertex(mesh, given.corners[k], i);
    if (link.corner[k] == link.vertex)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "link %u joins vertex %u to itself", i, given.vertex);
  }
  return link;
}

void read_skin_hint(const hf_links_desc& desc, const Mesh& mesh, SkinHint& out) {
  if (desc.influence_count == 0) {
    if (desc.joints || desc.weights)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "joints or weights are set, but influence_count is 0");
    return;
  }
  check_choice(static_cast<std::int32_t>(desc.influence_count), most_skin_joints + 1, "influence_count");
  require(desc.joints, "joints");
  require(desc.weights, "weights");
  for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
    for (std::size_t i = 0; i < desc.influence_count; ++i) {
      const float w = desc.weights[std::size_t{v} * desc.influence_count + i];
      if (!std::isfinite(w)) fail(HF_ERROR_NON_FINITE, v, "a weight of vertex %u is not finite", v);
    }
  }
  out = {desc.influence_count, desc.joints, desc.weights, {}};
}

// The skeleton of the joints of a skin.
void read_parents(const hf_links_desc& desc, const Mesh& mesh, Memory& memory, SkinHint& out) {
  require_zero(desc.reserved);
  if (desc.joint_count == 0) {
    if (desc.joint_parents)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "joint_parents is set, but joint_count is 0; set both or neither");
    return;
  }
  require(desc.joint_parents, "joint_parents");
  if (desc.joint_count > most_parents)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint_count is %u; it must be at most %u", desc.joint_count, most_parents);
  if (out.influence_count == 0)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "joint_parents is set, but influence_count is 0; set joints and weights too");
  for (std::uint32_t j = 0; j < desc.joint_count; ++j) {
    const std::uint32_t parent = desc.joint_parents[j];
    if (parent != HF_NO_INDEX && parent >= desc.joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, j, "the parent of joint %u is %u; it must be below joint_count, %u, or HF_NO_INDEX",
           j, parent, desc.joint_count);
  }
  out.parents = {desc.joint_parents, desc.joint_count};
  if (const std::uint32_t j = joint_in_circle(out.parents, memory); j != HF_NO_INDEX)
    fail(HF_ERROR_INVALID_ARGUMENT, j, "joint %u is its own ancestor; set the parent of the root to HF_NO_INDEX", j);
  for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
    for (std::size_t i = 0; i < desc.influence_count; ++i) {
      const std::uint32_t joint = desc.joints[std::size_t{v} * desc.influence_count + i];
      if (joint >= desc.joint_count)
        fail(HF_ERROR_OUT_OF_RANGE, v, "vertex %u names joint %u; it must be below joint_count, %u", v, joint,
             desc.joint_count);
    }
  }
}

void read_pieces(const Mesh& mesh, std::uint32_t count, const std::uint32_t* vertices, const char* count_name,
                 const char* name, Vector<std::int32_t>& out) {
  if (count > 0) read_list(mesh, count, vertices, count_name, name, out);
}

}  // namespace

void read_link_list(std::uint32_t count, const hf_link* links, const Mesh& mesh, Vector<Link>& out) {
  if (count > 0) require(links, "links");
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(read_link(links[i], mesh, i));
}

void read_links(const hf_links_desc& desc, const Mesh& mesh, LinksIn& out) {
  check_choice(desc.mode, 3, "mode");
  LinkOptions& options = out.options;
  options.mode = static_cast<LinkMode>(desc.mode);
  options.distance = read_length(desc.distance, default_link_distance, mesh, "distance");
  options.overlay = read_length(desc.overlay_distance, default_overlay, mesh, "overlay_distance");
  options.stiffness = desc.stiffness == 0 ? 1.0 : desc.stiffness;
  if (options.distance < 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "distance is below 0");
  check_finite(options.stiffness, "stiffness");
  if (!(options.stiffness > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "stiffness is %g; it must be above 0", options.stiffness);
  read_skin_hint(desc, mesh, options.skin);
  read_parents(desc, mesh, out.memory, options.skin);
  if (desc.tags) options.tags = {desc.tags, mesh.report.vertex_count};
  read_pieces(mesh, desc.light_count, desc.light_vertices, "light_count", "light_vertices", out.light);
  read_pieces(mesh, desc.heavy_count, desc.heavy_vertices, "heavy_count", "heavy_vertices", out.heavy);
  options.light = out.light;
  options.heavy = out.heavy;
  if (options.mode != LinkMode::list) {
    if (desc.link_count > 0)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "link_count is %u, but mode is not HF_LINK_LIST", desc.link_count);
    return;
  }
  read_link_list(desc.link_count, desc.links, mesh, out.list);
  options.list = out.list;
}

}  // namespace hf_inner::mesh
