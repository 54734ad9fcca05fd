// Generated from include/hf/*.h by bindings/generate; do not edit.
// hf/hf.hpp - C++17 wrapper of hf.h: handles destroy themselves, failures are exceptions, arrays are vectors.
//
//   hf::Surface surface(positions, triangles);
//   hf::Solver solver(surface);
//   solver.add_sites({0, 41}, {0.0, 1.0});
//   std::vector<float> field = solver.solve();
// clang-format off
#ifndef HF_HF_HPP
#define HF_HF_HPP

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hf/call.hpp"

namespace hf {
class Progress;
class Surface;
class Solver;
class Geodesics;
class Direction;
class Pose;
class Quads;
class Flow;
class Region;
class Detail;
class Skeleton;
class Retarget;
class Transfer;
class Weights;

// A factor that Surface::save wrote. The surface loads it instead of computing it.
struct Factor {
  // all of them, as saved
  std::vector<uint8_t> bytes{};
  hf_factor_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Says which pieces to link. Joints and weights or tags help the automatic links; each array may be none. A light piece
// is a sheet over a larger one, such as cloth: it follows the surface below and hardly pulls it.
struct Links {
  // `[vertex_count x influence_count]` of a skin: pieces of the same joint link sooner
  std::vector<uint16_t> joints{};
  // `[vertex_count x influence_count]` of sum 1; where all are 0, a vertex shares no joint
  std::vector<float> weights{};
  // `[joint_count]` parent of each joint, HF_NO_INDEX for a root; needs joints and weights. Pieces of parent and child
  // link wherever they touch. Pieces of joints farther apart in the skeleton, such as two feet, link only if nothing
  // else joins them
  std::vector<uint32_t> joint_parents{};
  // `[vertex_count]`: pieces with different tags do not link, as a rider and a horse. The first vertex of a piece
  // counts
  std::vector<uint32_t> tags{};
  // `[link_count]`
  std::vector<hf_link> links{};
  // `[light_count]`: their pieces are light
  std::vector<uint32_t> light_vertices{};
  // `[heavy_count]`: their pieces are not, as one that gets a site or handle
  std::vector<uint32_t> heavy_vertices{};
  // HF_LINK_*
  int32_t mode = 0;
  // longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal
  double distance = 0;
  // of all links, times each one's weight; 0 = 1
  double stiffness = 0;
  // automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 % of the diagonal, below 0:
  // no piece is light unless light_vertices say so
  double overlay_distance = 0;
  hf_links_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Faces of any number of corners. Set corners, and the arrays that your host stores: sizes alone (Maya, USD), starts
// and sizes (Blender's loops), or starts alone as offsets (newer Blender). Where this interface names a triangle of
// such a mesh, it names a face.
//
// No field depends on how you would cut a face into triangles. HF_OPERATOR_INTRINSIC_DELAUNAY takes the mean of both
// cuts of a bent quad. It moves this mean towards the polygon Laplacian of Bunge and others 2020 until a weight would
// become negative; docs/surfaces.md compares errors. HF_OPERATOR_COTANGENT and HF_OPERATOR_CLAMPED use that polygon
// Laplacian. HF_OPERATOR_UNIFORM uses the sides of the faces. Directions, distances, iso-lines, streamlines and quads
// work on triangles: the library cuts the faces. Its cut does not depend on the order of the corners. Normals of poses
// are sums of the area vectors of faces.
struct Faces {
  // `[corner_count]` of uint32_t: vertices, counter-clockwise seen from outside
  std::vector<uint32_t> corners{};
  // none, or `[faces]` of uint32_t: corners of each face, 3 to 65,535. none: starts give them
  std::vector<uint32_t> sizes{};
  // none, or `[faces]` of uint32_t: first corner of each face. none: the faces follow one another. Without sizes
  // `[faces + 1]`: the corners of face f end where face f + 1 starts
  std::vector<uint32_t> starts{};
  hf_faces_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// The mesh and the options of a surface. Set either triangles or faces.
struct SurfaceOptions {
  // HF_WELD_*
  int32_t weld = 0;
  // none, or faces instead of triangles
  std::optional<Faces> faces{};
  // for HF_WELD_TOLERANCE, in the unit of the positions, > 0
  double weld_tolerance = 0;
  // HF_OPERATOR_*
  int32_t operator_kind = 0;
  // HF_FIELD_*: the factor made now. Others are made when a solver or region needs one
  int32_t field_kind = 0;
  // HF_ORDERING_*
  int32_t ordering = 0;
  // threads the library may use, yours included, 1 to 256; 0 = 1
  uint32_t thread_count = 0;
  // refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941 vertices, triangles or edges are
  // always refused
  uint32_t vertex_limit = 0;
  // refuse more triangles, or faces that would be cut into more; 0 = eight per vertex of the vertex limit
  uint32_t triangle_limit = 0;
  // refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit
  uint32_t memory_limit_mb = 0;
  // refuse a factorisation of more than this many 10^9 operations. They are counted before it begins; 0 = 100,000,
  // about an hour of one core
  uint32_t work_limit_gflop = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  // none, or the saved factor of this mesh; ordering is then 0 or the factor's
  std::optional<Factor> saved_factor{};
  // none: HF_LINK_NONE. A saved factor needs the links it was made with
  std::optional<Links> links{};
  hf_surface_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix, const Reals& positions,
      const Indices& triangles) const;
};

// A graph of your own and the options of its surface: tetrahedra, points, a network. The weights w_ij of its edges make
// the Laplacian (L u)_i = sum_j w_ij (u_i - u_j). Limits and hooks are as in SurfaceOptions.
struct GraphOptions {
  // none, or `[vertex_count]` of float or double: M of HF_FIELD_BIHARMONIC, any unit, above 0 and up to 1e100; none:
  // all 1. A mass below 1e-4 of the mean of its component is raised to it
  Reals masses{};
  // >= 1, also without masses
  uint32_t vertex_count = 0;
  // 1: weights may be below 0, if L stays positive semi-definite. The cotangent weights of tetrahedra do. A field can
  // then leave the range of its sites. 0: they are refused
  bool allow_negative = false;
  // HF_FIELD_*: the factor made now. Others are made when a solver asks
  int32_t field_kind = 0;
  // HF_ORDERING_*
  int32_t ordering = 0;
  // threads the library may use, yours included, 1 to 256; 0 = 1
  uint32_t thread_count = 0;
  // refuse larger graphs before allocating; 0 = 20,000,000
  uint32_t vertex_limit = 0;
  // refuse more edges; 0 = sixteen per vertex of the vertex limit
  uint32_t edge_limit = 0;
  // refuse to hold more memory than this, in MiB; 0 = no limit
  uint32_t memory_limit_mb = 0;
  // refuse a factorisation of more than this many 10^9 operations; 0 = 100,000
  uint32_t work_limit_gflop = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  // none, or the saved factor of this graph; ordering is then 0 or the factor's
  std::optional<Factor> saved_factor{};
  hf_graph_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix, const Indices& edges,
      const Reals& weights) const;
};

// Lists triangles that go, vertices and triangles that come in, and edges to cut along. Vertices and triangles keep
// their numbers; new ones follow those there are. New vertices are welded to no other, so two can lie at one place. A
// vertex without a triangle is isolated from then on, and a new triangle can take it again.
//
// A cut gives the vertices along it copies, and the triangles on one side take these. Surface::cuts lists the corners.
// The end of a cut inside the surface stays one vertex, so a cut takes two edges there. A cut around a part, or from
// border to border, parts it from the rest: it is a component then.
struct Patch {
  // `[removed_triangle_count]` triangles of your mesh
  std::vector<uint32_t> removed_triangles{};
  // `[new_vertex_count x 3]` in the unit of your mesh
  std::vector<double> new_positions{};
  // `[new_triangle_count x 3]` vertices of your mesh and new ones
  std::vector<uint32_t> new_triangles{};
  // `[cut_edge_count x 2]` the two vertices of an edge
  std::vector<uint32_t> cut_edges{};
  hf_patch_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Lists the changes of Surface::edit: stiffness and links, or a patch. The stiffness of a vertex is a number by which
// the weights of its edges are multiplied: an edge from i to j counts 2 s_i s_j / (s_i + s_j) times, as two springs in
// a row. A region of large stiffness bends and stretches little and hardly changes its surroundings: a belt, a shield,
// a shell. A region of small stiffness takes up the bending around it.
struct SurfaceEdit {
  // `[vertex_count]` as given; other vertices keep their stiffness. none: all vertices in order
  std::vector<uint32_t> vertices{};
  // `[vertex_count]` 1e-4 to 1e4; 1: as the surface was made. Welded copies share one. none: no stiffness changes, and
  // vertex_count is 0
  std::vector<double> stiffness{};
  // `[link_count]` links that come in, after those that stay
  std::vector<hf_link> links{};
  // `[removed_link_count]` links that go out, by their numbers in Surface::links
  std::vector<uint32_t> removed_links{};
  // none, or triangles that go and come, or a cut; the edit changes nothing else then
  std::optional<Patch> patch{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_surface_edit_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Describes the line of a knife: points on the surface, each joined to the next by the shortest path along triangles.
// Set one of vertices, places and points. A line whose last point is its first is closed.
struct CutOptions {
  // `[point_count]` vertices of your mesh, or none
  std::vector<uint32_t> vertices{};
  // `[point_count]`, or none
  std::vector<hf_place> places{};
  // `[point_count x 3]` points in space, at rest, in the unit and frame of the mesh, or none. Each stands for the
  // nearest point of the surface, up to two boxes away
  std::vector<double> points{};
  // a point nearer to a vertex than this share of its edge becomes the vertex, and one nearer to an edge than this
  // share of the height moves onto the edge. So no slivers come in. From 1e-6 to 0.4; 0 = 0.05
  double snap_share = 0;
  // refuse a line of more points and crossings of edges; 0 = 1,000,000
  uint32_t crossing_limit = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_cut_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Options of picking: posed positions, if the surface is not at rest, and which triangles count.
struct PickOptions {
  // none, or `[vertex_count x 3]` of float or double: posed positions (Pose.deform writes them). none: the rest
  // positions
  Reals positions{};
  // 1: a ray passes through triangles seen from behind
  bool front_only = false;
  hf_pick_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct SolverOptions {
  // HF_FIELD_*; if the surface has no factor of that kind yet, it is made now
  int32_t field_kind = 0;
  // fields solved at once, 1 to 64; 0 = 1
  uint32_t channel_count = 0;
  // at most this many sites; 0 = 100,000
  uint32_t site_limit = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_solver_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Places and values of sites. Set one of vertices, places and points. The finer the mesh, the less influence a point
// site has. Give the site a radius to avoid this: it then holds the field on a geodesic disc. A radius below the mesh
// spacing still gives a point. A soft disc shares its stiffness among its vertices. For harmonic fields the boundary
// vertices of a disc count towards site_limit; for bi-harmonic fields all its vertices do.
struct Sites {
  // `[site_count]` vertices of your mesh, or none
  std::vector<uint32_t> vertices{};
  // `[site_count x channel_count]`, up to 1e200 in size; none = 0
  std::vector<double> values{};
  // `[site_count]`, or none
  std::vector<hf_place> places{};
  // `[site_count x 3]` points in space, at rest, in the unit and frame of the mesh, or none. Each stands for the
  // nearest point of the surface, up to two boxes away
  std::vector<double> points{};
  // `[site_count]` >= 0, relative to the mean diagonal of K; 0 = hard (exact); none = all hard; clamped to 1e-12 to
  // 1e12
  std::vector<double> stiffness{};
  // `[site_count]` >= 0, geodesic, in the unit of the mesh; 0 = a point; none = all points
  std::vector<double> radii{};
  hf_sites_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// One batch of edits, applied in the order remove, move, set, add. A count of 0 skips its part.
struct Edit {
  // `[remove_count]`
  std::vector<uint32_t> remove_sites{};
  // `[move_count]`
  std::vector<uint32_t> move_sites{};
  // `[set_count]`
  std::vector<uint32_t> set_sites{};
  // `[set_count x channel_count]`
  std::vector<double> set_values{};
  // none, or places of `[move_count]` sites
  std::optional<Sites> move_to{};
  // none, or the sites to add
  std::optional<Sites> add{};
  hf_edit_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct GeodesicsOptions {
  // HF_GEODESICS_*
  int32_t method = 0;
  // of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to 10,000; 0 = 1
  double smoothing = 0;
  // none, or an object to poll and cancel through: creation and every later call report to it
  const Progress* progress = nullptr;
  hf_geodesics_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct ExtremitiesOptions {
  // HF_EXTREMITIES_*
  int32_t kind = 0;
  // tips that protrude less are left out: share of the box diagonal; 0 = 0.05; up to 10
  double least_length_share = 0;
  // sources of the mean distance per component, 1 to 1,000; 0 = 40
  uint32_t source_count = 0;
  // for HF_EXTREMITIES_GEODESIC: an object of this surface. If its method is HF_GEODESICS_HEAT its factor serves; else,
  // and for none, the call makes a factor
  const Geodesics* geodesics = nullptr;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_extremities_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct DirectionOptions {
  // 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1
  uint32_t degree = 0;
  // most constraints; 0 = 100,000
  uint32_t site_limit = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_direction_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct PoseOptions {
  // bands per field, 2 to 64; 0 = 10
  uint32_t band_count = 0;
  // iterations of a pose solve, 1 to 1000; 0 = 10
  uint32_t iteration_count = 0;
  // groups of vertices that share a rotation, 1 to 2000; 0 = 250
  uint32_t group_count = 0;
  hf_pose_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// The handles to add. Set region_counts and region_vertices, or radii and one of vertices, places and points. The
// region of a place is its nearest vertex, and all vertices that are edge-connected to it within the radius.
struct HandlesOptions {
  // `[handle_count]` vertices of your mesh, or none
  std::vector<uint32_t> vertices{};
  // `[handle_count]`, or none
  std::vector<hf_place> places{};
  // `[handle_count x 3]` points in space, at rest, in the unit and frame of the mesh, or none. A point can lie inside
  // the body, as a joint does: its nearest vertex counts
  std::vector<double> points{};
  // `[handle_count]` of the regions of places, in the unit of the mesh; none: regions are given. A radius below 1 % of
  // the box makes regions of 2 vertices or more
  std::vector<double> radii{};
  // 0 to HF_LAYER_COUNT - 1, for the whole batch
  uint32_t layer = 0;
  // 1: handles of layer 0 start on the posed surface, not at rest; see below
  bool in_place = false;
  // 1: you give the places alone of all these handles; Pose::set_free_rotations frees single ones
  bool free_rotation = false;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_handles_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
      const std::vector<std::vector<uint32_t>>& region_vertices) const;
};

// The options of Pose::deform are outputs and a range of vertices. Set at least one output.
struct DeformOptions {
  // 1 to 1000; 0 = the pose's
  uint32_t iteration_count = 0;
  // 1: forget the last pose and start from the fields. The frame then has the bits of a fresh pose with the same
  // handles, added in the same order, and the same transforms. Without restart a frame continues from the last one,
  // so it also depends on that
  bool restart = false;
  // 0 to 64: steps of as-rigid-as-possible on the whole surface, with the same factor. A step takes about 0.2 us per
  // vertex. 0 and 1 keep bends smooth. 8 and more keep the lengths of edges; bends get sharper
  int32_t refine = 0;
  // 1: the steps go on from the surface of the last call, instead of starting at the smooth pose. Then one step a frame
  // keeps lengths in a drag as well as 8 do without. If the handles do not move, more calls converge to the
  // minimum. A restart, or a call without it, forgets that surface. Needs a refine of 1 or more. Higher layers
  // start at the smooth pose. Memory: 72 bytes per vertex
  bool refine_from_last = false;
  // outputs hold vertex_count vertices from this one on; 0 and 0: all
  uint32_t first_vertex = 0;
  // positions of a range cost only the range; but with higher layers, rigid pieces, refine, limb_refine or normals they
  // cost the whole surface
  uint32_t vertex_count = 0;
  hf_deform_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct HandleProposalsOptions {
  // `[joint_count x 3]` their places at rest, in the unit and frame of the mesh
  std::vector<double> joints{};
  // `[joint_count]` position of each joint's parent in the list; HF_NO_INDEX for a root
  std::vector<uint32_t> parents{};
  // none, or the skeleton of the mesh, instead of joints and parents. It rests in the unit and frame of the mesh. If it
  // has a skin, the skin has the vertices of the mesh
  const Skeleton* skeleton = nullptr;
  // direction away from the ground, of any length; zero = up of the skeleton where it is known, else the y axis
  std::optional<std::array<double, 3>> up{};
  // as in ExtremitiesOptions; 0 = 0.05
  double least_length_share = 0;
  // most proposals, 1 to HF_HANDLE_LIMIT; 0 = 32
  uint32_t limit = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_handle_proposals_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Options of a quad mesh. HF_INIT gives quads along the curvature, with edges of 0.022 box diagonals.
struct QuadsOptions {
  // `[crease_count x 2]` the two vertices of each edge, of your mesh
  std::vector<uint32_t> crease_edges{};
  // `[guide_count]` vertices of your mesh; guides of one vertex are averaged
  std::vector<uint32_t> guide_vertices{};
  // `[guide_count x 3]` along the surface, of any length above 0; quads run along the vector and across it
  std::vector<double> guide_vectors{};
  // none = all 1, or `[guide_count]`, above 0 to 1: 1 holds the direction. A smaller weight mixes it with the direction
  // of the curvature, which has the rest of the weight
  std::vector<float> guide_weights{};
  // `[irregular_count x 3]` at the surface, in the unit and frame of the mesh
  std::vector<double> irregular_points{};
  // `[irregular_count]` how many quads meet there: 3 or 5
  std::vector<uint32_t> irregular_valences{};
  // none = any, or `[irregular_count x 3]`: one side of the irregular vertex runs along it; 0 0 0 = any
  std::vector<double> irregular_directions{};
  // wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts
  uint32_t face_count = 0;
  // wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it
  double edge_length = 0;
  // edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0 = none.  If there are
  // more than 1,024 lines of creases and borders, only the longest are kept. Creases nearer to each other than an edge
  // may be released
  double crease_angle = 0;
  // rounds of tangential relaxation, up to 1,000; 0 = 60; HF_NO_INDEX = none, and the mesh is not fitted to the surface
  // either
  uint32_t relax_count = 0;
  // a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none. Quads are made of the side
  // that (a, b, c) points to, and mirrored. Creases, guides and irregular vertices on the other side are not used
  std::optional<std::array<double, 4>> symmetry_plane{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_quads_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

struct RegionOptions {
  // none, or `[vertex_count x 3]` of float or double: positions of the mesh or of a pose. A morph of weight 0 writes
  // the same bits. none: the positions of the mesh, to 1e-15 of the box. The call copies the array
  Reals positions{};
  // HF_BASE_*. If the surface has no factor for it yet, it is made now
  int32_t base = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_region_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Describes a closed curve through at least 3 points, on the mesh at rest. Set one of vertices, places and points. The
// vertices on the chosen side of the curve are the region. A single vertex joins the region too if all its neighbours
// but one are in it. The rim is the vertices next to the region, on or beyond the curve. It follows the curve within an
// edge; where the curve runs along edges, the rim is the curve. A whole border of the surface is a curve too; it has
// only one side. The curve passes a vertex at most 8 times.
struct Curve {
  // `[point_count]` vertices of your mesh, or none
  std::vector<uint32_t> vertices{};
  // `[point_count]`, or none
  std::vector<hf_place> places{};
  // `[point_count x 3]` points in space, at rest, in the unit and frame of the mesh, or none. Each stands for the
  // nearest point of the surface, up to two boxes away
  std::vector<double> points{};
  // HF_SIDE_*
  int32_t side = 0;
  // with HF_SIDE_SEED
  uint32_t seed_vertex = 0;
  // HF_CURVE_*
  int32_t kind = 0;
  hf_curve_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// A change of a region. The parts are applied in the order curve, rings, remove, add. A part that is 0 or none is
// skipped.
struct RegionEditOptions {
  // `[remove_count]` vertices that leave the region; others are passed over
  std::vector<uint32_t> remove_vertices{};
  // `[add_count]` vertices that join it; those in it already are passed over
  std::vector<uint32_t> add_vertices{};
  // rings of vertices by which the region grows; below 0 it shrinks
  int32_t ring_count = 0;
  // the region becomes what this curve encloses
  std::optional<Curve> curve{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_region_edit_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Gives Region::morph and Detail::morph their weight and outputs. Set at least one output.
struct MorphOptions {
  hf_morph_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix, double weight) const;
};

struct DetailOptions {
  // `[pair_count]` rim vertices of the source mesh
  std::vector<uint32_t> source_vertices{};
  // `[pair_count]` rim vertices of the target mesh
  std::vector<uint32_t> target_vertices{};
  // of the detail, > 0; 0 = square root of target base area over source base area
  double scale = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_detail_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Options of a retarget. none in Retarget gives the defaults.
struct RetargetOptions {
  // `[source.joint_count x 10]` a pose that counts as rest, or none: the rest of the skeleton. Give poses in which both
  // characters stand alike
  std::vector<float> source_rest{};
  // `[target.joint_count x 10]` the same for the target, or none
  std::vector<float> target_rest{};
  // HF_ROOT_MOTION_*
  int32_t root_motion = 0;
  // bits of HF_RETARGET_*
  uint32_t leave_out = 0;
  // travel of the target over travel of the source; 0: the ratio of leg lengths
  double scale = 0;
  // of the ground under a clip on the spot, in the space of the source, per second; 0: the ground rests.
  // Skeleton::ground_velocity finds it
  std::optional<std::array<double, 3>> ground_velocity{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_retarget_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// The skin of a character: its surface, and the joints of each vertex. These are the arrays of a glTF skin as the file
// has them: with inverse_binds the library moves the surface from the pose of binding to the pose `rest`.
struct Skin {
  // `[vertex_count x 3]`
  std::vector<float> positions{};
  // `[triangle_count x 3]`, or none with triangle_count 0
  std::vector<uint32_t> triangles{};
  // `[vertex_count x influence_count]`
  std::vector<uint32_t> joints{};
  // `[vertex_count x influence_count]` >= 0; a vertex whose weights are all 0 has no joint
  std::vector<float> weights{};
  // 1: positions are in the pose `rest` and in the space of the joints, also with inverse_binds. 0: in the pose of
  // inverse_binds if there are any
  bool at_rest = false;
  hf_skin_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// The joints of a character at rest. A joint transform is 10 numbers relative to the parent: translation x y z,
// rotation x y z w, scale x y z.
struct SkeletonOptions {
  // `[joint_count x 16]` inverse bind matrices, columns first. All zero: no skin names the joint; it moves its children
  // and rigid meshes only. none: the skin is given in the pose `rest`, and every joint can bend it
  std::vector<float> inverse_binds{};
  // `[3]` declared axis, any length, or none: find it
  std::vector<float> up{};
  // `[3]` declared axis, any length, or none: find it
  std::vector<float> forward{};
  // `[joint_count]` declared HF_ROLE_*, -1 for a joint without; or none
  std::vector<int32_t> roles{};
  // `[joint_count]` HF_SIDE_* of joints with a declared role; or none: find the sides
  std::vector<int32_t> sides{};
  // `[travel_count x 3]` where each clip leads from its first to its last frame; it tells forward; or none
  std::vector<float> travels{};
  // none: there is none, and joints are judged by names and places alone
  std::optional<Skin> skin{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_skeleton_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
      const std::vector<std::string>& names, const std::vector<uint32_t>& parents,
      const std::vector<float>& rest) const;
};

// most pairs of a transfer
struct TransferOptions {
  // none, or `[source.vertex_count x 3]` of float or double Poses in which the two bodies correspond, in each surface's
  // unit. none: the positions of the surface. Give a standing pose here for a character bound in a crouch. Motion is
  // measured from these poses. They do not change the fields.
  Reals source_rest{};
  // none, or `[target.vertex_count x 3]` of float or double
  Reals target_rest{};
  // HF_TRANSFER_*
  int32_t mode = 0;
  // 1 to 512. 0 = the larger of 80 and 5 per pair
  uint32_t cluster_count = 0;
  // HF_GROUND_*
  int32_t ground = 0;
  // width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per pair, up to 0.12
  double kernel_width = 0;
  // lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the boxes when no pair is
  // a foot
  double scale = 0;
  // A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6 times the angle it is not
  // aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative = never.
  double alignment_angle = 0;
  // Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y, forward +z). Lengths, and
  // right x up = forward, must hold within 1e-3. The library takes the nearest rotation.
  std::optional<std::array<double, 9>> source_axes{};
  std::optional<std::array<double, 9>> target_axes{};
  hf_transfer_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// The pairs to add. The regions of each surface are vertex lists, one after the other.
struct Pairs {
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_pairs_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
      const std::vector<std::vector<uint32_t>>& source_vertices,
      const std::vector<std::vector<uint32_t>>& target_vertices, const std::vector<uint32_t>& flags) const;
};

// Dials that an animator turns while a transfer plays. Neutral dials give the bits of a transfer without dials, and the
// result is continuous in each dial.
struct TransferDials {
  // the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A planted foot does
  // not slide. The body travels as much farther
  double stride = 0;
  // raises the pairs flagged HF_PAIR_TRUNK and HF_PAIR_ANCHOR by this share of their mean height at rest, -0.5 to 0.5;
  // 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised
  double hip_height_share = 0;
  // pairs flagged HF_PAIR_NECK, together one limb How far a limb follows the source, -1 to 1. At 0 (neutral) the limb
  // plays the source's motion from its own rest direction. At 1 it also gets the rest direction of the source's limb.
  // At -1 it does not move against its root.
  double neck_follow = 0;
  // pairs flagged HF_PAIR_TAIL, together one limb
  double tail_follow = 0;
  // turns arms (HF_PAIR_ARM) away from the body, about the forward axis at rest, -pi/2 to pi/2 radians; 0 = neutral
  double arm_space = 0;
  // how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less, so that they move
  // as far. 1: they make the whole turn. Between, a part may jump that turns by half a turn against the part before it
  double long_follow = 0;
  hf_transfer_dials fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Describes one frame: the input is the posed source, the output the posed target. Set at least one output.
struct TransferFrame {
  // `[hold_count]` each pair at most once A hold puts the target region of a pair exactly at a position of yours, such
  // as a foot on a step or a hand on a rail. The mean of the region's vertices lands there; welded copies count once.
  // The rest of the surface follows.
  std::vector<uint32_t> hold_pairs{};
  // `[hold_count x 3]` in the target's unit and frame
  std::vector<double> hold_positions{};
  hf_transfer_frame fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
      const Reals& source_positions) const;
};

// The joints of a skeleton, in the unit and frame of the mesh.
struct Joints {
  // `[joint_count x 3]`
  std::vector<double> heads{};
  // `[joint_count x 3]`, or none: heads are joints, and the library finds the tails
  std::vector<double> tails{};
  // `[joint_count x 3]` with tails none: where each joint points, any length, a zero vector for unknown; or none.
  // A joint reaches to the child that lies there, or to the end of the skin. A      child that does      not deform
  // says where a last joint ends
  std::vector<double> axes{};
  // `[joint_count]` number of the parent, HF_NO_INDEX for a root; none: all are roots
  std::vector<uint32_t> parents{};
  // `[joint_count]` 1: the joint gets weights; none: all do
  std::vector<int32_t> deforms{};
  // `[joint_count]` for Weights::set_joints: the number that the joint had before, HF_NO_INDEX for a new one; none: the
  // same number. Weights: none
  std::vector<uint32_t> sources{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_joints_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Places with given weights. Set one of vertices, places and points. To keep a painted region, pin all its vertices.
struct Pins {
  // `[pin_count]`, or none
  std::vector<hf_place> places{};
  // `[pin_count x 3]` points in space, at rest, in the unit and frame of the mesh, or none. Each stands for the nearest
  // point of the surface, up to two boxes away
  std::vector<double> points{};
  // `[pin_count]` of the geodesic disc around the place, in the unit of the mesh; none or 0: the place alone
  std::vector<double> radii{};
  // `[pin_count x influence_count]` joints
  std::vector<uint32_t> joints{};
  // `[pin_count x influence_count]` >= 0, scaled to the sum 1
  std::vector<float> weights{};
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_pins_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
      const std::vector<uint32_t>& vertices) const;
};

// Weights to transfer from one surface to another.
struct WeightsTransferOptions {
  // `[source.vertex_count x source_influence_count]`
  std::vector<uint32_t> joints{};
  // `[source.vertex_count x source_influence_count]` >= 0; a vertex whose weights are all 0 gives none
  std::vector<float> weights{};
  // a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal
  double distance = 0;
  // between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees)
  double angle = 0;
  // joints of each vertex in the result: 4 or 8; 0: 4
  uint32_t influence_count = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_weights_transfer_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// Weights to mirror.
struct WeightsMirrorOptions {
  // `[joint_count x 3]` the joints at rest, in the frame of the mesh
  std::vector<double> heads{};
  // one line for each joint in UTF-8, or none: joints are paired by their places
  std::vector<std::string> names{};
  // `[joint_count]` the joint of the other side, HF_NO_INDEX: find it; or none
  std::vector<uint32_t> partners{};
  // `[6]` a point and a normal, or none: find the plane
  std::vector<double> plane{};
  // `[vertex_count x source_influence_count]`
  std::vector<uint32_t> joints{};
  // `[vertex_count x source_influence_count]` >= 0; a vertex whose weights are all 0 gives none
  std::vector<float> weights{};
  // HF_MIRROR_*
  int32_t to = 0;
  // as in WeightsTransferOptions
  double distance = 0;
  // as in WeightsTransferOptions
  double angle = 0;
  // joints of each vertex in the result: 4 or 8; 0: 4
  uint32_t influence_count = 0;
  // none, or an object to poll and cancel through
  const Progress* progress = nullptr;
  hf_weights_mirror_desc fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const;
};

// A cut as triangles that go and come. The first three arrays fit Patch. New vertices and triangles have the numbers
// after the last ones of your mesh. The arrays are yours: each is none or as large as its capacity.
struct Cut {
  // `[removed_triangle_capacity]` triangles of your mesh, ascending
  std::vector<uint32_t> removed_triangles;
  // `[new_vertex_capacity x 3]` in the unit of your mesh
  std::vector<double> new_positions;
  // `[new_triangle_capacity x 3]` vertices of your mesh, the first of welded copies, and new ones
  std::vector<uint32_t> new_triangles;
  // `[new_vertex_capacity x 3]` vertices of your mesh; the new vertex lies between them. Mix their attributes, as skin
  // weights. HF_NO_INDEX where a weight is 0
  std::vector<uint32_t> vertex_corners;
  // `[new_vertex_capacity x 3]` their weights, of sum 1. A single 1 copies a vertex
  std::vector<double> vertex_barycentrics;
  // `[new_triangle_capacity]` the removed triangle that each new one is a part of
  std::vector<uint32_t> source_triangles;
  // `[new_triangle_capacity x 3 x 3]` three weights for each corner of a new triangle, of the corners of its source:
  // for what corners have, as UVs at seams
  std::vector<double> corner_barycentrics;
  // `[rim_capacity x 2]` along the line: the vertex on its left and that on its right; one and the same where the line
  // ends inside the surface. At a border between its ends: those after it
  std::vector<uint32_t> rim_vertices;
};

// Iso-lines as polylines. Each point lies on a mesh edge with the end vertices a and b, at the position (1 - parameter)
// a + parameter b. So you can interpolate any vertex attribute at the point. The arrays are yours: each is none or as
// large as its capacity.
struct Isolines {
  // `[point_capacity x 2]` vertices a and b of your mesh, the first of welded copies
  std::vector<uint32_t> point_edges;
  // `[point_capacity]` 0 to 1
  std::vector<double> parameters;
  // `[point_capacity x 3]` in the unit and frame of your mesh
  std::vector<double> positions;
  // `[line_capacity + 1]` line i holds the points line_starts`[i]` to line_starts`[i + 1]` - 1
  std::vector<uint32_t> line_starts;
  // `[line_capacity]` position of its level in the list
  std::vector<uint32_t> line_levels;
  // `[line_capacity]` 1: closed, the first point is not repeated; 0: ends at borders
  std::vector<int32_t> line_closed;
};

// Places, values and fluxes of the sites. The arrays are yours; each is none or has `capacity` entries. The entries are
// ordered by site number.
struct SitesInfo {
  // `[capacity]` numbers
  std::vector<uint32_t> sites;
  // `[capacity]` the vertex of the place, HF_NO_INDEX for a point in a triangle
  std::vector<uint32_t> vertices;
  // `[capacity]`
  std::vector<uint32_t> components;
  // `[capacity x channel_count]`
  std::vector<double> values;
  // `[capacity]` 0 = hard
  std::vector<double> stiffness;
  // `[capacity x channel_count]` lambda: what flows into the surface at the site, in value x weight; the sum over a
  // disc
  std::vector<double> flux;
  // `[capacity]` 0 = a point
  std::vector<double> radii;
};

// A path along the surface, from its first point to its last. Each point lies on a mesh edge with the end vertices a
// and b, at the position (1 - parameter) a + parameter b; at a vertex a is b. An end inside a triangle has HF_NO_INDEX
// for both. The arrays are yours: each is none or as large as the capacity.
struct Path {
  // `[point_capacity x 2]` vertices a and b of your mesh, the first of welded copies
  std::vector<uint32_t> point_edges;
  // `[point_capacity]` 0 to 1
  std::vector<double> parameters;
  // `[point_capacity x 3]` in the unit and frame of your mesh
  std::vector<double> positions;
  // in the unit of the mesh; -1: no path
  double length = 0;
};

// This struct receives a pose or a transfer as a skin for linear blend skinning. The clusters become joints with fixed
// vertex weights, and the skin holds their motion in the last frame. Joint j takes a point p to R (p - pivot) +
// translation, with R its rotation. Its inverse bind matrix is the translation by -pivot.
//
// If you ask for scales, a joint may also stretch along its own axes. With B the rotation of `axes`, the joint takes p
// to R B diag(scale) B^-1 (p - pivot) + translation. In a scene file that is a node with rotation R B and that scale,
// and the inverse bind matrix takes p to B^-1 (p - pivot). The arrays are yours; each may be none.
struct SkinInfo {
  // `[joint_capacity x 3]` rest centroid of what each joint moves
  std::vector<double> pivots;
  // `[joint_capacity x 4]` quaternion x, y, z, w of the last frame
  std::vector<double> rotations;
  // `[joint_capacity x 3]` posed place of the pivot
  std::vector<double> translations;
  // `[joint_capacity x 4]` quaternion of B, fixed while handles stay
  std::vector<double> axes;
  // `[joint_capacity x 3]` along the axes in the last frame; none = joints are rigid
  std::vector<double> scales;
  // `[vertex_capacity x influence_count]`
  std::vector<uint32_t> vertex_joints;
  // `[vertex_capacity x influence_count]` of sum 1, descending
  std::vector<float> vertex_weights;
  // joints per vertex, 4 or 8; 0 = 4
  uint32_t influence_count = 0;
};

// Receives the rows of a blend. The arrays are yours; each may be none. Positions and offsets are in the unit of the
// mesh, gradients per unit of the mesh.
struct BlendRows {
  // `[vertex_capacity x 2]` number of the first entry of the vertex, and count of its entries
  std::vector<uint32_t> rows;
  // `[entry_capacity]` each below the count of clusters
  std::vector<uint16_t> clusters;
  // `[entry_capacity]` multiples of 2^-24; the weights of a vertex sum to 1
  std::vector<float> weights;
  // `[entry_capacity x 3]` of the weights along the rest surface, for normals
  std::vector<float> gradients;
  // `[vertex_capacity x 3]` at rest, relative to centre
  std::vector<float> positions;
  // `[vertex_capacity x 3]` unit, at rest
  std::vector<float> normals;
  // `[vertex_capacity x 3]` 0 unless handles were added in place or rotations freed
  std::vector<float> offsets;
  // entries of the vertex that has the most
  uint32_t longest_row = 0;
};

// Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF). The
// arrays are yours; each may be none. Rows hold the heaviest entries of a vertex, by falling weight. Unused entries
// have weight 0.
//
// The errors say what shorter rows and rounded weights cost. A vertex is off by at most the change of its weights times
// the largest distance between the places to which its clusters move it.
struct BlendInfluences {
  // `[vertex_capacity x influence_count]` each below the count of clusters
  std::vector<uint16_t> clusters;
  // `[vertex_capacity x influence_count]` 65535ths; the weights of a vertex sum to 65535
  std::vector<uint16_t> weights;
  // `[vertex_capacity x influence_count]` none = not wanted. Refused for more than 256 clusters
  std::vector<uint8_t> byte_clusters;
  // `[vertex_capacity x influence_count]` none = not wanted. 255ths, of sum 255; weights that round to 0 are left out
  std::vector<uint8_t> byte_weights;
  // the largest change of a vertex's weights, 0 to 1: half the sum of the differences
  double change = 0;
  // the same for byte_weights
  double byte_change = 0;
  // the largest distance of a vertex from its place in the last frame, in box diagonals
  double error = 0;
  // the same for byte_weights
  double byte_error = 0;
  // clusters of each vertex, the length of a row, 1 to 64; 0 = 8
  uint32_t influence_count = 0;
};

// Quads::mesh writes the quad mesh to these arrays. They are yours: each is none or as large as its capacity.
struct QuadsMesh {
  // `[vertex_capacity x 3]` in the unit and frame of your mesh
  std::vector<double> positions;
  // `[face_capacity x 4]` vertices of each quad, counter-clockwise
  std::vector<uint32_t> faces;
  // `[vertex_capacity]` triangle or face of your mesh that contains the vertex
  std::vector<uint32_t> triangles;
  // `[vertex_capacity x 3]` weights of that triangle's corners, in its own order, of sum 1; in a face of more corners
  // the weights of `corners`
  std::vector<double> barycentrics;
  // `[vertex_capacity x 3]` vertices of your mesh that barycentrics belong to, the first of welded copies
  std::vector<uint32_t> corners;
};

struct Streamlines {
  // `[point_capacity x 3]` in the unit and frame of your mesh
  std::vector<double> positions;
  // `[point_capacity]` of the field, rising along every line
  std::vector<double> values;
  // `[line_capacity + 1]` line i holds the points line_starts`[i]` to line_starts`[i + 1]` - 1
  std::vector<uint32_t> line_starts;
  // `[line_capacity x 2]` vertices where it starts and ends, of welded copies the first
  std::vector<uint32_t> line_ends;
};

// Receives the weights. The arrays are yours; each may be none.
struct WeightsOut {
  // `[vertex_capacity x influence_count]`
  std::vector<uint32_t> joints;
  // `[vertex_capacity x influence_count]` descending, of sum exactly 1
  std::vector<float> weights;
  // `[vertex_capacity]` HF_WEIGHTS_*
  std::vector<uint8_t> origins;
  // joints per vertex, 4 or 8
  uint32_t influence_count = 0;
};

// Reports the progress of a long call. Any thread can poll the object and cancel the call through it. Use one object
// for one call at a time. If a cancel may come after the end of the call, make a new object for the next call.
class Progress {
 public:
  // Creates a progress object.
  explicit Progress() {
    Call c;
    hf_progress raw = nullptr;
    check(hf_progress_create(&raw));
    own(raw, c.counts({}));
  }

  // Writes how much of the running call is done.
  double fraction() const {
    Call c(counts_);
    double fraction = 0;
    check(hf_progress_get_fraction(get(), &fraction));
    return fraction;
  }

  // Stops the call that uses this object, or the next one that does. That call returns HF_ERROR_CANCELLED.
  void cancel() const {
    Call c(counts_);
    check(hf_progress_cancel(get()));
  }

  hf_progress get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_progress raw, Counts counts) {
    handle_ = Handle<hf_progress, hf_progress_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_progress, hf_progress_destroy> handle_;
  Counts counts_;
};

// hf/surface.h - prepare a mesh once: weld it, check it and factorise its Laplacian.
//
// Make one surface per mesh, or per graph of your own (Surface::from_graph). Solvers, poses, direction fields, regions,
// transfers and quads are made on a surface and share its factor. A surface never changes, so any number of threads may
// use it: an edit makes another one (Surface::edit). An object made on a surface keeps the data it needs, so you can
// destroy objects in any order.
class Surface {
 public:
  // Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call copies the
  // mesh. Afterwards the surface uses only the allocator and the job runner of the desc. The mesh may be dirty: the
  // surface counts non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices and components.
  // Surface::report gives these counts.
  //
  // A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces are
  // doubled if they have the same corners after welding, in either direction. So a two-sided sheet, such as a leaf,
  // hair or a cape, is one sheet with a border. Results give the index of the first of doubled triangles; calls take
  // the index of any. Vertices of the second side alone get opposite normals from poses, and a ray with front_only hits
  // both sides.
  //
  // positions: `[vertex_count x 3]` of float or double, any unit, any offset
  // triangles: `[triangle_count x 3]` of uint32_t or uint16_t, counter-clockwise seen from outside
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  Surface(const Reals& positions, const Indices& triangles, const SurfaceOptions& options = {}) {
    Call c;
    const hf_surface_desc desc = options.fill(c, "", positions, triangles);
    hf_surface raw = nullptr;
    check(hf_surface_create(&desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Makes a surface of a graph, for fields on any domain whose edges and weights you compute. The call copies the
  // graph. Solvers with sites at vertices, fields, previews, certificates, clones, saved factors, components and
  // reports work as on a mesh. A call that needs triangles returns HF_ERROR_UNSUPPORTED. These are poses, regions,
  // directions, geodesics, iso-lines, extremities, quads, flow, picking, transfers, skin weights, vector fields, links
  // and screening. Sites at places, at points or on discs need triangles too.
  //
  // A vertex without an edge is isolated: fields are 0 there, and it takes no site. Weights that differ from the median
  // of their component by a factor above 1e30 are limited; hf_mesh_statistics counts their vertices as changed. Bi-
  // harmonic fields limit weights to 1e3 times the median.
  //
  // edges: `[edge_count x 2]` of uint32_t or uint16_t: vertices, in any order. The weights of parallel edges are added
  // up. Self loops are ignored
  // weights: `[edge_count]` of float or double, any unit, up to 1e100 in size. An edge of weight 0 is left out
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  static Surface from_graph(const Indices& edges, const Reals& weights, const GraphOptions& options = {}) {
    Call c;
    const hf_graph_desc desc = options.fill(c, "", edges, weights);
    hf_surface raw = nullptr;
    check(hf_surface_create_graph(&desc, &raw));
    return Surface(raw, c.counts({"vertex_count"}));
  }

  // Writes the options of a surface.
  hf_surface_info info() const {
    Call c(counts_);
    auto info = make<hf_surface_info>();
    check(hf_surface_get_info(get(), &info));
    return info;
  }

  // Writes the report of the mesh.
  hf_surface_report report() const {
    Call c(counts_);
    auto report = make<hf_surface_report>();
    check(hf_surface_get_report(get(), &report));
    return report;
  }

  // Writes the statistics of the mesh.
  hf_mesh_statistics mesh_statistics() const {
    Call c(counts_);
    auto statistics = make<hf_mesh_statistics>();
    check(hf_surface_get_mesh_statistics(get(), &statistics));
    return statistics;
  }

  // Writes the component of every vertex of your mesh, and HF_NO_INDEX for isolated vertices. Components are numbered
  // in the order of their lowest vertex numbers.
  std::vector<uint32_t> components() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> components;
    for (bool done = false; !done;) {
      auto* components_at = c.room(components, {"capacity"});
      const hf_result code = hf_surface_get_components(get(), c.count("capacity", 0), components_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    components.resize(c.product({"capacity"}));
    return components;
  }

  // Writes how the pieces of a surface are linked.
  hf_links_info links_info() const {
    Call c(counts_);
    auto info = make<hf_links_info>();
    check(hf_surface_get_links_info(get(), &info));
    return info;
  }

  // Writes the links of a surface. You can edit them and give them back with HF_LINK_LIST. A list does not say which
  // pieces are light: name them in light_vertices, as Surface::pieces marks them. Then the list alone gives the same
  // surface, bit for bit, without a search.
  std::vector<hf_link> links() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_link> links;
    for (bool done = false; !done;) {
      auto* links_at = c.room(links, {"capacity"});
      const hf_result code = hf_surface_get_links(get(), c.count("capacity", 0), links_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    links.resize(c.product({"capacity"}));
    return links;
  }

  // Writes the piece of every vertex of your mesh, and HF_NO_INDEX for isolated vertices. Pieces are numbered in the
  // order of their lowest vertices.
  std::tuple<std::vector<uint32_t>, std::vector<int32_t>> pieces() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> pieces;
    std::vector<int32_t> light;
    for (bool done = false; !done;) {
      auto* pieces_at = c.room(pieces, {"capacity"});
      auto* light_at = c.room(light, {"capacity"});
      const hf_result code = hf_surface_get_pieces(get(), c.count("capacity", 0), pieces_at, light_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    pieces.resize(c.product({"capacity"}));
    light.resize(c.product({"capacity"}));
    return {std::move(pieces), std::move(light)};
  }

  // Measures the gaps that a deformation opens between linked pieces. The gap of a link is how much farther its ends
  // are apart than at rest, and 0 if they are nearer. The gap of a contact (hf_links_info) is measured in the same way.
  // A vertex touches a piece if it is nearer to it than 0.5 % of the bounding box. With joint_parents its joint must be
  // the joint of the nearest point there, or the parent or child of that joint. Each touches one point of the piece:
  // the nearest at rest. Its opening is the smaller of two distances, minus the distance at rest: its own distance from
  // the piece, and the distance of the point that it touched from the piece of the vertex. So a piece that slides along
  // another opens no vertex, but its links have gaps. Touching vertices are found where links are: by Surface and
  // Surface::relink. Links that an edit adds have none.
  //
  // positions: `[vertex_count x 3]` of float or double: the deformed mesh. It can come from a pose, a transfer or any
  // other source.
  // info: filled in when given
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
  std::vector<double> measure_gaps(const Reals& positions, hf_gaps_info* info = nullptr) const {
    Call c(counts_);
    const hf_array positions_ = c.view(positions, true, "positions", {"vertex_count", "3"});
    auto info_ = make<hf_gaps_info>();
    if (!info) info = &info_;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<double> gaps;
    for (bool done = false; !done;) {
      auto* gaps_at = c.room(gaps, {"capacity"});
      const hf_result code = hf_surface_measure_gaps(get(), &positions_, c.count("capacity", 0), gaps_at, info);
      done = c.enough(code, {{"capacity", info->link_count}});
    }
    gaps.resize(c.product({"capacity"}));
    return gaps;
  }

  // Makes a surface with other links from the mesh of a surface. The new surface orders the unknowns as the old one
  // where its matrix has the same pattern: other stiffness, weights or light pieces.
  //
  // progress: an object to poll and cancel through.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  Surface relink(const Links& options = {}, const Progress* progress = nullptr) const {
    Call c(counts_);
    const hf_links_desc desc = options.fill(c, "");
    hf_surface raw = nullptr;
    check(hf_surface_relink(get(), &desc, progress ? progress->get() : nullptr, &raw));
    return Surface(raw, c.counts({"vertex_count"}));
  }

  // Makes a surface with another stiffness, other links or other triangles from a surface, which stays as it is. The
  // new surface shares the factor: an edit of up to a few thousand vertices costs the elimination paths of its rim, as
  // sites do, and a link costs up to six paths. The library factorises again with the same ordering where that costs
  // less, and for bi-harmonic fields. A surface that is edited back has the fields of the old one.
  //
  // Fields, poses and weights follow the stiffness. Where the stiffness is 100 or more, a pose changes lengths of edges
  // by about half a percent in the mean. A part that must not bend at all is a rigid piece (Pose::set_rigid_pieces).
  // Bi-harmonic operators square it, so they count at most 100 and at least 0.01. Lengths do not change, so regions,
  // transfers, distances, directions and quads do not see stiffness.
  //
  // A link joins two pieces, and removing the last link between two pieces parts them: a sword that is taken up and
  // dropped. The new surface is the one that Surface::relink makes of the same list of links. Surface::components gives
  // the new components. Light pieces and contacts stay as they are.
  //
  // After a patch the surface is the one that Surface makes of the triangles without the removed ones and with the new
  // ones, HF_WELD_NONE for the new vertices. Vertices keep their stiffness. New ones, and those that were isolated,
  // have 1. Distances, directions and quads make a factor of their own when they are first asked for, as on a new
  // surface. Patches over a quarter of the surface, and with HF_OPERATOR_CLAMPED, make the whole operator and its
  // factor anew. Take links out before, and put them in again after it.
  //
  // Solver::move_to takes sites along, and Pose::move_to takes handles along. After a patch or a cut make a new pose:
  // Pose::move_to refuses other triangles. Soft sites keep the unit of their stiffness while links and triangles stay;
  // others change it as they do for Surface::relink. Surface::save is refused: save the factor of the surface before
  // its edits. Memory limits hold for both surfaces together.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_FOUND, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE,
  // HF_ERROR_UNSUPPORTED.
  Surface edit(const SurfaceEdit& options = {}) const {
    Call c(counts_);
    const hf_surface_edit_desc desc = options.fill(c, "list_");
    hf_surface raw = nullptr;
    check(hf_surface_edit(get(), &desc, &raw));
    Surface made(raw, c.counts({"vertex_count"}));
    made.counts_["vertex_count"] = made.info().vertex_count;
    return made;
  }

  // Writes the corners that all cuts gave other vertices since the surface was made, in the order of the cuts. A second
  // cut adds its corners behind the corners of the first cut: go on from the last count.
  std::vector<hf_cut_corner> cuts() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_cut_corner> cuts;
    for (bool done = false; !done;) {
      auto* cuts_at = c.room(cuts, {"capacity"});
      const hf_result code = hf_surface_get_cuts(get(), c.count("capacity", 0), cuts_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    cuts.resize(c.product({"capacity"}));
    return cuts;
  }

  // Writes the stiffness of every vertex of your mesh, and 1 for isolated vertices.
  std::vector<double> stiffness() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<double> stiffness;
    for (bool done = false; !done;) {
      auto* stiffness_at = c.room(stiffness, {"capacity"});
      const hf_result code = hf_surface_get_stiffness(get(), c.count("capacity", 0), stiffness_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    stiffness.resize(c.product({"capacity"}));
    return stiffness;
  }

  // Writes the statistics of a surface and of the factor it was made with.
  hf_surface_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_surface_statistics>();
    check(hf_surface_get_statistics(get(), &statistics));
    return statistics;
  }

  // Saves the factor of one kind of field. An authoring tool saves it once. A game ships the bytes beside the mesh and
  // gives them to Surface, which then takes a fraction of the time. The bytes are the same for the same mesh, options
  // and library version, whatever the number of threads. The bytes are little-endian and hold a format version, a hash
  // of the matrix and a checksum. They hold no sites.
  //
  // field_kind: HF_FIELD_*. If its factor does not exist yet, the call makes it first.
  // progress: an object to poll and cancel through.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_TOO_SMALL.
  std::vector<uint8_t> save(int32_t field_kind = 0, const Progress* progress = nullptr) const {
    Call c(counts_);
    size_t size = 0;
    check(hf_surface_save(get(), field_kind, progress ? progress->get() : nullptr, 0, nullptr, &size));
    std::vector<uint8_t> block(size);
    check(hf_surface_save(get(), field_kind, progress ? progress->get() : nullptr, block.size(), block.data(), &size));
    return block;
  }

  // Turns a line on the surface into a cut through triangles. Give the arrays to Surface::edit as a patch, and change
  // your mesh in the same way. The surface itself does not change.
  //
  // A line from border to border, or a closed line around a part, parts it from the rest. A line that starts at the
  // border opens it. An end inside the surface stays closed. The line may pass vertices and run along edges. It is
  // straight where its triangles are unfolded, and bends at its points and at vertices only. The parts of a triangle
  // are a Delaunay triangulation of it. Points are whole multiples of 2^-29 of an edge. On a mesh whose triangles are
  // turned alike, left is left for a viewer who looks at the outside along the line. New vertices have the stiffness 1.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.
  Cut trace_cut(const CutOptions& options = {}) const {
    Call c(counts_);
    const hf_cut_desc desc = options.fill(c, "");
    auto cut = make<hf_cut>();
    c.sizes["removed_triangle_capacity"] = Call::kFirst;
    c.sizes["new_vertex_capacity"] = Call::kFirst;
    c.sizes["new_triangle_capacity"] = Call::kFirst;
    c.sizes["rim_capacity"] = Call::kFirst;
    Cut found;
    for (bool done = false; !done;) {
      cut.removed_triangle_capacity = c.count("removed_triangle_capacity", 0);
      cut.new_vertex_capacity = c.count("new_vertex_capacity", 0);
      cut.new_triangle_capacity = c.count("new_triangle_capacity", 0);
      cut.rim_capacity = c.count("rim_capacity", 0);
      cut.removed_triangles = c.room(found.removed_triangles, {"removed_triangle_capacity"});
      cut.new_positions = c.room(found.new_positions, {"new_vertex_capacity", "3"});
      cut.new_triangles = c.room(found.new_triangles, {"new_triangle_capacity", "3"});
      cut.vertex_corners = c.room(found.vertex_corners, {"new_vertex_capacity", "3"});
      cut.vertex_barycentrics = c.room(found.vertex_barycentrics, {"new_vertex_capacity", "3"});
      cut.source_triangles = c.room(found.source_triangles, {"new_triangle_capacity"});
      cut.corner_barycentrics = c.room(found.corner_barycentrics, {"new_triangle_capacity", "3", "3"});
      cut.rim_vertices = c.room(found.rim_vertices, {"rim_capacity", "2"});
      const hf_result code = hf_surface_trace_cut(get(), &desc, &cut);
      done = c.enough(code, {{"removed_triangle_capacity", cut.removed_triangle_count}, {"new_vertex_capacity",
          cut.new_vertex_count}, {"new_triangle_capacity", cut.new_triangle_count}, {"rim_capacity", cut.rim_count}});
    }
    found.removed_triangles.resize(c.product({"removed_triangle_capacity"}));
    found.new_positions.resize(c.product({"new_vertex_capacity", "3"}));
    found.new_triangles.resize(c.product({"new_triangle_capacity", "3"}));
    found.vertex_corners.resize(c.product({"new_vertex_capacity", "3"}));
    found.vertex_barycentrics.resize(c.product({"new_vertex_capacity", "3"}));
    found.source_triangles.resize(c.product({"new_triangle_capacity"}));
    found.corner_barycentrics.resize(c.product({"new_triangle_capacity", "3", "3"}));
    found.rim_vertices.resize(c.product({"rim_capacity", "2"}));
    return found;
  }

  // Finds what a mouse click hits: the first triangle on a ray.
  //
  // origin: `[3]` in the frame of the positions. The direction can have any length above 0.
  // direction: `[3]` in the frame of the positions. The direction can have any length above 0.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
  hf_hit cast_ray(const std::vector<double>& origin, const std::vector<double>& direction,
      const PickOptions& options = {}) const {
    Call c(counts_);
    const double* origin_ = c.array(origin, true, "origin", {"3"});
    const double* direction_ = c.array(direction, true, "direction", {"3"});
    const hf_pick_desc desc = options.fill(c, "");
    auto hit = make<hf_hit>();
    check(hf_surface_cast_ray(get(), origin_, direction_, &desc, &hit));
    return hit;
  }

  // Finds the vertex nearest to a point.
  //
  // point: `[3]` in the frame of the positions.
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
  std::tuple<uint32_t, double> find_vertex(const std::vector<double>& point, const PickOptions& options = {}) const {
    Call c(counts_);
    const double* point_ = c.array(point, true, "point", {"3"});
    const hf_pick_desc desc = options.fill(c, "");
    uint32_t vertex = 0;
    double distance = 0;
    check(hf_surface_find_vertex(get(), point_, &desc, &vertex, &distance));
    return {vertex, distance};
  }

  // Writes levels, ascending. HF_LEVELS_AREA makes all strips equal in area. HF_LEVELS_LENGTH makes the mean widths of
  // the strips equal. So iso-lines around point sites are evenly spaced, where equal steps of the value would crowd
  // them. HF_LEVELS_LENGTH leaves out the parts where the field is flat to 1e-9 of its range.
  //
  // In formulas, A(c) is the area where the field is below c, and L(c) is the length of the iso-line of level c. Both
  // are exact for the piecewise linear field. HF_LEVELS_AREA takes equal steps of A. HF_LEVELS_LENGTH takes equal steps
  // of the integral of A'(c) / L(c) dc. That integral is the height on a cylinder and the distance from the pole on a
  // sphere.
  //
  // field: `[vertex_count]` of float or double.
  // spacing: HF_LEVELS_*.
  // level_count: 1 to 1,000,000.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
  std::vector<double> space_levels(const Reals& field, uint32_t level_count, int32_t spacing = 0) const {
    Call c(counts_);
    const hf_array field_ = c.view(field, true, "field", {"vertex_count"});
    c.known("level_count", level_count);
    std::vector<double> levels(c.product({"level_count"}));
    check(hf_surface_space_levels(get(), &field_, spacing, level_count, levels.data()));
    return levels;
  }

  // Traces the iso-lines of levels. The levels must be finite and can have any order; the lines come in the order of
  // the levels. A vertex whose value equals a level counts as just above it, so lines have no gaps. A line either
  // closes or ends. It ends at a border or at a triangle without values. At an edge of three or more triangles (non-
  // manifold), these are taken in pairs. A line continues inside a pair, and ends at a triangle without a partner. The
  // function leaves out lines of length zero. Seen from outside a consistently oriented mesh, the field is higher on
  // the left of a line.
  //
  // field: `[vertex_count]` of float or double.
  // levels: `[level_count]`.
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
  Isolines trace_isolines(const Reals& field, const std::vector<double>& levels) const {
    Call c(counts_);
    const hf_array field_ = c.view(field, true, "field", {"vertex_count"});
    const double* levels_ = c.array(levels, true, "levels", {"level_count"});
    auto lines = make<hf_isolines>();
    c.sizes["point_capacity"] = Call::kFirst;
    c.sizes["line_capacity"] = Call::kFirst;
    Isolines found;
    for (bool done = false; !done;) {
      lines.point_capacity = c.count("point_capacity", 0);
      lines.line_capacity = c.count("line_capacity", 0);
      lines.point_edges = c.room(found.point_edges, {"point_capacity", "2"});
      lines.parameters = c.room(found.parameters, {"point_capacity"});
      lines.positions = c.room(found.positions, {"point_capacity", "3"});
      lines.line_starts = c.room(found.line_starts, {"line_capacity + 1"});
      lines.line_levels = c.room(found.line_levels, {"line_capacity"});
      lines.line_closed = c.room(found.line_closed, {"line_capacity"});
      const hf_result code = hf_surface_trace_isolines(get(), &field_, c.count("level_count", 1), levels_, &lines);
      done = c.enough(code, {{"point_capacity", lines.point_count}, {"line_capacity", lines.line_count}});
    }
    found.point_edges.resize(c.product({"point_capacity", "2"}));
    found.parameters.resize(c.product({"point_capacity"}));
    found.positions.resize(c.product({"point_capacity", "3"}));
    found.line_starts.resize(c.product({"line_capacity + 1"}));
    found.line_levels.resize(c.product({"line_capacity"}));
    found.line_closed.resize(c.product({"line_capacity"}));
    return found;
  }

  // Lists the minima, maxima and saddles of the piecewise linear field. The signs of the field around each vertex
  // decide (Banchoff 1970). Take its neighbours with lower values and the edges between them. The index of the vertex
  // is 1 minus their Euler characteristic. The vertex number breaks ties, so a flat area has critical points too. The
  // indices sum to the Euler characteristic on every component. On a mesh that is not Delaunay a harmonic field can
  // show an extremum away from its sites, because the default operator uses other edges than the mesh.
  // HF_OPERATOR_CLAMPED uses the edges of the mesh and avoids this.
  //
  // field: `[vertex_count]` of float or double.
  // info: filled in when given
  //
  // Fails with HF_ERROR_NON_FINITE.
  std::vector<hf_critical_point> find_critical_points(const Reals& field, hf_critical_info* info = nullptr) const {
    Call c(counts_);
    const hf_array field_ = c.view(field, true, "field", {"vertex_count"});
    auto info_ = make<hf_critical_info>();
    if (!info) info = &info_;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_critical_point> points;
    for (bool done = false; !done;) {
      auto* points_at = c.room(points, {"capacity"});
      const hf_result code = hf_surface_find_critical_points(get(), &field_, c.count("capacity", 0), points_at, info);
      done = c.enough(code, {{"capacity", info->point_count}});
    }
    points.resize(c.product({"capacity"}));
    return points;
  }

  // Proposes the tips of the surface as places for sites and handles, the longest tip first. The list does not depend
  // on the order of the vertices. Pose and meshing change it only within the resolution of the mesh.
  //
  // field: `[vertex_count]`, packed: the field whose peaks are proposed, 0 at isolated vertices. Unit: length^2
  // (Poisson), length (geodesic), each up to a constant per component
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT.
  std::vector<hf_extremity> find_extremities(const ExtremitiesOptions& options = {},
      std::vector<double>* field = nullptr) const {
    Call c(counts_);
    hf_extremities_desc desc = options.fill(c, "");
    if (field) field->resize(c.product({"vertex_count"}));
    double* field_at = field ? field->data() : nullptr;
    desc.out_field = field_at;
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_extremity> extremities;
    for (bool done = false; !done;) {
      auto* extremities_at = c.room(extremities, {"capacity"});
      const hf_result code = hf_surface_find_extremities(get(), &desc, c.count("capacity", 0), extremities_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    extremities.resize(c.product({"capacity"}));
    return extremities;
  }

  // Proposes handles for the first drag of a mesh: feet and the trunk hold, tips are dragged. Pinned proposals come
  // first, then the others, each group by length, the longest first. The places do not depend on the order of the
  // vertices. They follow translation and scale. A skeleton gives each proposal the joint that moves it, a role and a
  // side. If its roles are known, feet and the trunk are pinned. Hands, heads, tails and pieces that hang on them, such
  // as a sword, are not. Each head, hand, foot, tail, ear and wing gets at most one proposal. A part that no joint of
  // the skin moves, such as the box that an animator drags, gets none.
  //
  // regions: `[vertex_count]`: position in the list of the proposal whose region has the vertex; HF_NO_INDEX for a
  // vertex of no region
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.
  std::vector<hf_handle_proposal> propose_handles(const HandleProposalsOptions& options = {},
      std::vector<uint32_t>* regions = nullptr) const {
    Call c(counts_);
    hf_handle_proposals_desc desc = options.fill(c, "");
    if (regions) regions->resize(c.product({"vertex_count"}));
    uint32_t* regions_at = regions ? regions->data() : nullptr;
    desc.out_regions = regions_at;
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_handle_proposal> proposals;
    for (bool done = false; !done;) {
      auto* proposals_at = c.room(proposals, {"capacity"});
      const hf_result code = hf_surface_propose_handles(get(), &desc, c.count("capacity", 0), proposals_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    proposals.resize(c.product({"capacity"}));
    return proposals;
  }

  // With the struct of C.
  explicit Surface(const hf_surface_desc& desc) {
    Call c;
    c.known("vertex_count", desc.positions.count);
    hf_surface raw = nullptr;
    check(hf_surface_create(&desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }




  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_surface get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Surface(hf_surface raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_surface raw, Counts counts) {
    handle_ = Handle<hf_surface, hf_surface_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_surface, hf_surface_destroy> handle_;
  Counts counts_;
};

// A set of sites on a surface, and their field.
class Solver {
 public:
  // Creates a solver without sites.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_POSITIVE_DEFINITE.
  Solver(const Surface& surface, const SolverOptions& options = {}) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_solver_desc desc = options.fill(c, "");
    hf_solver raw = nullptr;
    check(hf_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"channel_count", "vertex_count"}));
  }

  // Creates a solver with the same sites under the same numbers; its fields have the same bits. Both share the factor
  // and the solved sites, so a copy costs its list of sites only. Use one copy per thread or per set of sites. For
  // undo, keep copies: one before each edit.
  Solver clone() const {
    Call c(counts_);
    hf_solver raw = nullptr;
    check(hf_solver_clone(get(), &raw));
    return Solver(raw, c.counts({"channel_count", "vertex_count"}));
  }

  // Moves a solver to an edited surface. Its sites keep their numbers, values and screening.
  //
  // surface: any number of calls of Surface::edit or Surface::relink make it from the solver's surface, or the solver's
  // surface from it.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED.
  void move_to(const Surface& surface) {
    Call c(counts_);
    c.parent("surface", surface.known_counts());
    check(hf_solver_move_to(get(), surface.get()));
    counts_["vertex_count"] = known(surface.known_counts(), "vertex_count");
  }

  // Writes the options of a solver.
  hf_solver_info info() const {
    Call c(counts_);
    auto info = make<hf_solver_info>();
    check(hf_solver_get_info(get(), &info));
    return info;
  }

  // Adds sites.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  std::vector<uint32_t> add_sites(const Sites& options = {}) {
    Call c(counts_);
    const hf_sites_desc desc = options.fill(c, "");
    std::vector<uint32_t> sites(c.product({"site_count"}));
    check(hf_add_sites(get(), &desc, sites.data()));
    return sites;
  }

  // Adds one hard site at a vertex.
  //
  // values: `[channel_count]`, or none for 0.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  uint32_t add_site(uint32_t vertex, const std::vector<double>& values = {}) {
    Call c(counts_);
    const double* values_ = c.array(values, false, "values", {"channel_count"});
    uint32_t site = 0;
    check(hf_solver_add_site(get(), vertex, values_, &site));
    return site;
  }

  // Removes sites by number. The field is 0 on a component that has no site left. If you add a site there again, the
  // field is exact.
  //
  // sites: `[site_count]`.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  void remove_sites(const std::vector<uint32_t>& sites) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    check(hf_remove_sites(get(), c.count("site_count", 1), sites_));
  }

  // Moves sites to new places. Each site keeps its number, value, stiffness and radius.
  //
  // sites: `[site_count]`.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_FOUND, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  void move_sites(const std::vector<uint32_t>& sites, const Sites& options = {}) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const hf_sites_desc desc = options.fill(c, "");
    check(hf_solver_move_sites(get(), c.count("site_count", 1), sites_, &desc));
  }

  // Gives sites new values. The call costs nothing until the next solve.
  //
  // sites: `[site_count]`.
  // values: `[site_count x channel_count]`.
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_TOO_LARGE.
  void set_values(const std::vector<uint32_t>& sites, const std::vector<double>& values) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const double* values_ = c.array(values, true, "values", {"site_count", "channel_count"});
    check(hf_solver_set_values(get(), c.count("site_count", 1), sites_, values_));
  }

  // Applies a batch of edits at once.
  std::vector<uint32_t> edit_sites(const Edit& options = {}) {
    Call c(counts_);
    const hf_edit_desc desc = options.fill(c, "");
    std::vector<uint32_t> sites(c.product({"add.site_count"}));
    check(hf_solver_edit_sites(get(), &desc, sites.data()));
    return sites;
  }

  // Returns the number of sites, or 0 for an invalid object.
  uint32_t site_count() const {
    return hf_solver_get_site_count(get());
  }

  // Writes all sites.
  SitesInfo sites() const {
    Call c(counts_);
    auto info = make<hf_sites_info>();
    c.sizes["capacity"] = Call::kFirst;
    SitesInfo found;
    for (bool done = false; !done;) {
      info.capacity = c.count("capacity", 0);
      info.sites = c.room(found.sites, {"capacity"});
      info.vertices = c.room(found.vertices, {"capacity"});
      info.components = c.room(found.components, {"capacity"});
      info.values = c.room(found.values, {"capacity", "channel_count"});
      info.stiffness = c.room(found.stiffness, {"capacity"});
      info.flux = c.room(found.flux, {"capacity", "channel_count"});
      info.radii = c.room(found.radii, {"capacity"});
      const hf_result code = hf_solver_get_sites(get(), &info);
      done = c.enough(code, {{"capacity", info.count}});
    }
    found.sites.resize(c.product({"capacity"}));
    found.vertices.resize(c.product({"capacity"}));
    found.components.resize(c.product({"capacity"}));
    found.values.resize(c.product({"capacity", "channel_count"}));
    found.stiffness.resize(c.product({"capacity"}));
    found.flux.resize(c.product({"capacity", "channel_count"}));
    found.radii.resize(c.product({"capacity"}));
    return found;
  }

  // Screens the field: (K + A H) u = A H p + W lambda, with A the vertex areas. The field follows p where H is large,
  // and the influence of a site fades over a distance of about 1 / sqrt(H). A H is at most 1e12 times the mean diagonal
  // of K. Such a field needs no site on a component where some H is above 0.
  //
  // screening: `[vertex_count]` H >= 0, in 1 / length^2 with the unit of the mesh; none removes the screening.
  // targets: `[vertex_count x channel_count]` p, or none for 0. Both are copied. The values of the first of welded
  // copies hold for all of them. Sites stay. A site with a radius holds the rim of its disc only. Undo restores the
  // screening with the sites.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_TOO_LARGE,
  // HF_ERROR_UNSUPPORTED.
  void set_screening(const std::vector<double>& screening = {}, const std::vector<double>& targets = {}) {
    Call c(counts_);
    const double* screening_ = c.array(screening, false, "screening", {"vertex_count"});
    const double* targets_ = c.array(targets, false, "targets", {"vertex_count", "channel_count"});
    check(hf_solver_set_screening(get(), screening_, targets_));
  }

  // Solves for the field at every vertex of your mesh, in single or double precision. Hard sites hold their values
  // exactly. The field is 0 on components without a site.
  //
  // out: `[vertex_count x channel_count]` of float or double.
  // info: filled in when given
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE.
  std::vector<float> solve(hf_solve_info* info = nullptr) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count", "channel_count"}));
    solve_into(out.data(), out.size(), info);
    return out;
  }

  // The same in double.
  std::vector<double> solve_f64(hf_solve_info* info = nullptr) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count", "channel_count"}));
    solve_into(out.data(), out.size(), info);
    return out;
  }

  // As solve, into memory of yours.
  void solve_into(float* out, size_t size, hf_solve_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "channel_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_solver_solve(get(), &out_view, info));
  }

  // As solve, into memory of yours.
  void solve_into(double* out, size_t size, hf_solve_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "channel_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_solver_solve(get(), &out_view, info));
  }

  // Solves for the field at chosen vertices only, with the same bits as Solver::solve in double. The call reads only
  // those columns of the factor on which these vertices depend (elimination paths), on the calling thread. One path is
  // up to a sixth of the factor, but the paths of many vertices share most of their columns. The call costs a whole
  // solve for bi-harmonic fields, and whenever sites are eliminated in the factor (see Solver::prepare_rebase). A
  // vertex of a component without a site gets 0.
  //
  // vertices: `[vertex_count]`.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  std::vector<double> solve_at(const std::vector<uint32_t>& vertices) const {
    Call c(counts_);
    c.sizes.erase("vertex_count");  // of the list given here
    const uint32_t* vertices_ = c.array(vertices, true, "vertices", {"vertex_count"});
    std::vector<double> values(c.product({"vertex_count", "channel_count"}));
    check(hf_solver_solve_at(get(), c.count("vertex_count", 1), vertices_, values.data()));
    return values;
  }

  // Solves for a tangent vector field, with a solver of 3 channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.3).
  // The channels are the x, y and z of the constraint vectors, and the call solves each as a field. It then projects
  // the vector v of each vertex on the tangent plane: v - (n . v) n. Here n is the area-weighted normal.
  //
  // out: `[vertex_count x 3]` of float or double, not normalised.
  // normals: `[vertex_count x 3]`, packed: the normals used.
  // info: filled in when given
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE.
  std::vector<float> solve_vectors(std::vector<double>* normals = nullptr, hf_solve_info* info = nullptr) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count", "3"}));
    solve_vectors_into(out.data(), out.size(), normals, info);
    return out;
  }

  // The same in double.
  std::vector<double> solve_vectors_f64(std::vector<double>* normals = nullptr, hf_solve_info* info = nullptr) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count", "3"}));
    solve_vectors_into(out.data(), out.size(), normals, info);
    return out;
  }

  // As solve_vectors, into memory of yours.
  void solve_vectors_into(float* out, size_t size, std::vector<double>* normals = nullptr,
      hf_solve_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "3"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    double* normals_at = normals ? normals->data() : nullptr;
    check(hf_solver_solve_vectors(get(), &out_view, normals_at, info));
  }

  // As solve_vectors, into memory of yours.
  void solve_vectors_into(double* out, size_t size, std::vector<double>* normals = nullptr,
      hf_solve_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "3"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    double* normals_at = normals ? normals->data() : nullptr;
    check(hf_solver_solve_vectors(get(), &out_view, normals_at, info));
  }

  // Solves with a single-precision copy of the factor. This reads half the bytes of Solver.solve; use it while the user
  // drags a value or a site. The error is about 1e-6 of the value range for harmonic fields. Bi-harmonic fields, long
  // shapes and crowded sites can have an error of any size: ask for corrections there and read error_estimate. Hard
  // sites at vertices are exact. One correction (iterative refinement, Wilkinson 1963) reduces the error of a harmonic
  // field below 1e-9, a second one below 1e-12. Each correction costs as much as two to three calls of Solver.solve.
  //
  // The first call makes the single-precision copy, which costs about two solves. All solvers of that field kind on the
  // surface share the copy. It is freed with the last of these solvers, or by Solver::release_preview. A solver whose
  // factor eliminates sites gives the exact field. info.exact is then 1.
  //
  // correction_count: 0 to 8.
  // out: `[vertex_count x channel_count]` of float or double, as Solver::solve. Single precision rounds most
  // corrections away.
  // info: filled in when given
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT.
  std::vector<float> solve_preview(uint32_t correction_count = 0, hf_preview_info* info = nullptr) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count", "channel_count"}));
    solve_preview_into(out.data(), out.size(), correction_count, info);
    return out;
  }

  // The same in double.
  std::vector<double> solve_preview_f64(uint32_t correction_count = 0, hf_preview_info* info = nullptr) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count", "channel_count"}));
    solve_preview_into(out.data(), out.size(), correction_count, info);
    return out;
  }

  // As solve_preview, into memory of yours.
  void solve_preview_into(float* out, size_t size, uint32_t correction_count = 0,
      hf_preview_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "channel_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_solver_solve_preview(get(), &out_view, correction_count, info));
  }

  // As solve_preview, into memory of yours.
  void solve_preview_into(double* out, size_t size, uint32_t correction_count = 0,
      hf_preview_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "channel_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_solver_solve_preview(get(), &out_view, correction_count, info));
  }

  // Frees the single-precision copy for all solvers that share it, as soon as no running call uses it. The next preview
  // makes the copy again.
  void release_preview() const {
    Call c(counts_);
    check(hf_solver_release_preview(get()));
  }

  // Moves vector sites to other vertices of their components. Each vector is carried along the shortest path of edges,
  // from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3).
  //
  // sites: `[site_count]`.
  // vertices: `[site_count]`.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND,
  // HF_ERROR_OUT_OF_RANGE.
  void move_vectors(const std::vector<uint32_t>& sites, const std::vector<uint32_t>& vertices) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const uint32_t* vertices_ = c.array(vertices, true, "vertices", {"site_count"});
    check(hf_solver_move_vectors(get(), c.count("site_count", 1), sites_, vertices_));
  }

  // Turns the vector of site i about its vertex normal, counter-clockwise by angles`[i]` radians. Does not factorise.
  //
  // sites: `[site_count]`.
  // angles: `[site_count]`.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
  void rotate_vectors(const std::vector<uint32_t>& sites, const std::vector<double>& angles) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const double* angles_ = c.array(angles, true, "angles", {"site_count"});
    check(hf_solver_rotate_vectors(get(), c.count("site_count", 1), sites_, angles_));
  }

  // Solves the field and checks it against its equations. The check uses only the operator K and the site values. So it
  // finds a damaged factor, borrowed bytes that changed, or a fault of the machine. The call returns
  // HF_ERROR_INACCURATE (index = worst vertex) if the check fails, and writes certificate then too. Do not use fields
  // of that solver; make the surface again.
  //
  // tolerance: largest error to accept, > 0; 0 = 1e-8
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INACCURATE, HF_ERROR_INVALID_ARGUMENT.
  hf_certificate certify(double tolerance = 0) const {
    Call c(counts_);
    auto certificate = make<hf_certificate>();
    certificate.tolerance = tolerance;
    check(hf_solver_certify(get(), &certificate));
    return certificate;
  }

  // Factorises in the background with the hard vertex sites eliminated, so that they cost no dense solve. It runs on
  // the calling thread, while other threads edit and solve with this solver. The next edit switches to the new factor.
  // Fields before and after are the same up to rounding. Call it on a thread of yours when
  // hf_solver_statistics.rebase_advised is 1. An edit of very many sites does this by itself when that is quicker.
  // Memory: one more factor, for as long as it eliminates sites.
  //
  // Fails with HF_ERROR_BUSY, HF_ERROR_EMPTY.
  void prepare_rebase() const {
    Call c(counts_);
    check(hf_solver_prepare_rebase(get()));
  }

  // Writes the statistics.
  hf_solver_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_solver_statistics>();
    check(hf_solver_get_statistics(get(), &statistics));
    return statistics;
  }

  // With the struct of C.
  Solver(const Surface& surface, const hf_solver_desc& desc) {
    Call c;
    c.parent("surface", surface.known_counts());
    c.known("channel_count", desc.channel_count);
    if (!desc.channel_count) c.known("channel_count", 1);
    hf_solver raw = nullptr;
    check(hf_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"channel_count", "vertex_count"}));
  }


  std::vector<uint32_t> add_sites(const std::vector<uint32_t>& vertices, const std::vector<double>& values = {}) {
    Sites options;
    options.vertices = vertices;
    options.values = values;
    return add_sites(options);
  }

  void move_sites(const std::vector<uint32_t>& sites, const std::vector<uint32_t>& vertices,
      const std::vector<double>& values = {}) {
    Sites options;
    options.vertices = vertices;
    options.values = values;
    move_sites(sites, options);
  }

  uint32_t channel_count() const noexcept { return known(counts_, "channel_count"); }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_solver get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Solver(hf_solver raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_solver raw, Counts counts) {
    handle_ = Handle<hf_solver, hf_solver_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_solver, hf_solver_destroy> handle_;
  Counts counts_;
};

// Computes geodesic distances on one surface: the lengths of shortest paths along it.
class Geodesics {
 public:
  // Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT takes one
  // numeric factorisation and holds a factor of its own beside the surface's.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_POSITIVE_DEFINITE.
  Geodesics(const Surface& surface, const GeodesicsOptions& options = {}) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_geodesics_desc desc = options.fill(c, "");
    hf_geodesics raw = nullptr;
    check(hf_geodesics_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Writes the distance along the surface from every vertex to the nearest source, in the unit of the mesh. The
  // distance is 0 at the sources, and -1 at vertices that no source can reach.
  //
  // sources: `[source_count]` vertices of your mesh; repeats are allowed. Paths follow the triangles and ignore links.
  // Triangles with the same corners count once: a two-sided sheet measures as a single one. No distance of EXACT
  // and FRONT is below the straight line to the nearest source. EXACT is right up to rounding. The error of FRONT
  // falls with the edge length. HEAT rounds the distance off at corners and where two shortest paths meet.
  // out: `[vertex_count]` of float or double.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  std::vector<float> solve(const std::vector<uint32_t>& sources) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count"}));
    solve_into(sources, out.data(), out.size());
    return out;
  }

  // The same in double.
  std::vector<double> solve_f64(const std::vector<uint32_t>& sources) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count"}));
    solve_into(sources, out.data(), out.size());
    return out;
  }

  // As solve, into memory of yours.
  void solve_into(const std::vector<uint32_t>& sources, float* out, size_t size) const {
    Call c(counts_);
    const uint32_t* sources_ = c.array(sources, true, "sources", {"source_count"});
    need(size, c.product({"vertex_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_geodesics_solve(get(), c.count("source_count", 1), sources_, &out_view));
  }

  // As solve, into memory of yours.
  void solve_into(const std::vector<uint32_t>& sources, double* out, size_t size) const {
    Call c(counts_);
    const uint32_t* sources_ = c.array(sources, true, "sources", {"source_count"});
    need(size, c.product({"vertex_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_geodesics_solve(get(), c.count("source_count", 1), sources_, &out_view));
  }

  // Finds the shortest path between two points, exact up to rounding, whatever the method of the object. If several are
  // as short, it writes one of them. The path is straight where its triangles are unfolded; it bends at vertices only.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
  // HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL.
  Path find_path(const hf_place& from, const hf_place& to) const {
    Call c(counts_);
    auto path = make<hf_path>();
    c.sizes["point_capacity"] = Call::kFirst;
    Path found;
    for (bool done = false; !done;) {
      path.point_capacity = c.count("point_capacity", 0);
      path.point_edges = c.room(found.point_edges, {"point_capacity", "2"});
      path.parameters = c.room(found.parameters, {"point_capacity"});
      path.positions = c.room(found.positions, {"point_capacity", "3"});
      const hf_result code = hf_geodesics_find_path(get(), &from, &to, &path);
      done = c.enough(code, {{"point_capacity", path.point_count}});
    }
    found.point_edges.resize(c.product({"point_capacity", "2"}));
    found.parameters.resize(c.product({"point_capacity"}));
    found.positions.resize(c.product({"point_capacity", "3"}));
    found.length = path.length;
    return found;
  }

  // Lays the surface around a point out in a plane (logarithmic map): for decals, brushes and textures. A vertex lies
  // at the length of its shortest path from the point, in the direction in which the path starts.
  //
  // radius: vertices farther away get NaN too and take no time; 0 = no bound.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
  // HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL.
  std::tuple<std::vector<double>, std::vector<double>> map(const hf_place& centre, double radius = 0) const {
    Call c(counts_);
    std::vector<double> map(c.product({"vertex_count", "2"}));
    std::vector<double> frame(c.product({"6"}));
    check(hf_geodesics_get_map(get(), &centre, radius, map.data(), frame.data()));
    return {std::move(map), std::move(frame)};
  }

  // With the struct of C.
  Geodesics(const Surface& surface, const hf_geodesics_desc& desc) {
    Call c;
    c.parent("surface", surface.known_counts());
    hf_geodesics raw = nullptr;
    check(hf_geodesics_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_geodesics get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_geodesics raw, Counts counts) {
    handle_ = Handle<hf_geodesics, hf_geodesics_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_geodesics, hf_geodesics_destroy> handle_;
  Counts counts_;
};

// A direction field on a surface, with a factor and constraints of its own.
class Direction {
 public:
  // Makes a direction field without constraints. It computes the connection between tangent planes and the operator,
  // and factorises once, with two unknowns per vertex.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_POSITIVE_DEFINITE.
  Direction(const Surface& surface, const DirectionOptions& options = {}) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_direction_desc desc = options.fill(c, "");
    hf_direction raw = nullptr;
    check(hf_direction_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Makes a direction field with the same constraints under the same numbers; it has the same bits. Both share
  // connection and factor, so the copy costs the constraints only. For undo, keep copies: one before each edit.
  Direction clone() const {
    Call c(counts_);
    hf_direction raw = nullptr;
    check(hf_direction_clone(get(), &raw));
    return Direction(raw, c.counts({"vertex_count"}));
  }

  // Adds constraints: vectors at vertices. The function projects the vectors on the tangent planes. Each constraint
  // costs two sparse triangular solves (elimination paths) and two rows of a small dense system. For a batch of very
  // many constraints, the function factorises once instead, with their vertices eliminated. Later edits cost paths and
  // rows again.
  //
  // vertices: `[site_count]` vertices of your mesh.
  // vectors: `[site_count x 3]`; a zero vector makes the field 0 there.
  //
  // Fails with HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
  // HF_ERROR_TOO_LARGE.
  std::vector<uint32_t> add_sites(const std::vector<uint32_t>& vertices, const std::vector<double>& vectors) {
    Call c(counts_);
    const uint32_t* vertices_ = c.array(vertices, true, "vertices", {"site_count"});
    const double* vectors_ = c.array(vectors, true, "vectors", {"site_count", "3"});
    std::vector<uint32_t> sites(c.product({"site_count"}));
    check(hf_direction_add_sites(get(), c.count("site_count", 1), vertices_, vectors_, sites.data()));
    return sites;
  }

  // Removes constraints by number.
  //
  // sites: `[site_count]`.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  void remove_sites(const std::vector<uint32_t>& sites) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    check(hf_direction_remove_sites(get(), c.count("site_count", 1), sites_));
  }

  // Moves constraints to other vertices of the same component. The connection transports each vector along the shortest
  // path of edges, from tangent plane to tangent plane.
  //
  // sites: `[site_count]`.
  // vertices: `[site_count]`.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND,
  // HF_ERROR_OUT_OF_RANGE.
  void move_sites(const std::vector<uint32_t>& sites, const std::vector<uint32_t>& vertices) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const uint32_t* vertices_ = c.array(vertices, true, "vertices", {"site_count"});
    check(hf_direction_move_sites(get(), c.count("site_count", 1), sites_, vertices_));
  }

  // Gives constraints new vectors and projects them on the tangent planes. Does not factorise.
  //
  // sites: `[site_count]`.
  // vectors: `[site_count x 3]`.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
  void set_vectors(const std::vector<uint32_t>& sites, const std::vector<double>& vectors) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const double* vectors_ = c.array(vectors, true, "vectors", {"site_count", "3"});
    check(hf_direction_set_vectors(get(), c.count("site_count", 1), sites_, vectors_));
  }

  // Turns constraint i by angles`[i]` radians, counter-clockwise seen from outside. Does not factorise.
  //
  // sites: `[site_count]`.
  // angles: `[site_count]`.
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
  void rotate_sites(const std::vector<uint32_t>& sites, const std::vector<double>& angles) {
    Call c(counts_);
    const uint32_t* sites_ = c.array(sites, true, "sites", {"site_count"});
    const double* angles_ = c.array(angles, true, "angles", {"site_count"});
    check(hf_direction_rotate_sites(get(), c.count("site_count", 1), sites_, angles_));
  }

  // Returns the number of constraints, or 0 for an invalid object.
  uint32_t site_count() const {
    return hf_direction_get_site_count(get());
  }

  // Writes the constraints. Their numbers ascend.
  std::tuple<std::vector<uint32_t>, std::vector<uint32_t>, std::vector<double>> sites() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> sites;
    std::vector<uint32_t> vertices;
    std::vector<double> vectors;
    for (bool done = false; !done;) {
      auto* sites_at = c.room(sites, {"capacity"});
      auto* vertices_at = c.room(vertices, {"capacity"});
      auto* vectors_at = c.room(vectors, {"capacity", "3"});
      const hf_result code = hf_direction_get_sites(get(), c.count("capacity", 0), sites_at, vertices_at, vectors_at,
          &count);
      done = c.enough(code, {{"capacity", count}});
    }
    sites.resize(c.product({"capacity"}));
    vertices.resize(c.product({"capacity"}));
    vectors.resize(c.product({"capacity", "3"}));
    return {std::move(sites), std::move(vertices), std::move(vectors)};
  }

  // Writes the field as vectors in space. The vectors are tangent to the surface up to 1e-12 of their length. For
  // degree 2 or 4 the function writes one of the 2 or 4 directions. Constrained vertices hold their vectors; vertices
  // that no constraint reaches get 0.
  //
  // out: `[vertex_count x 3]` of float or double.
  // info: filled in when given
  //
  // Fails with HF_ERROR_EMPTY.
  std::vector<float> solve(hf_solve_info* info = nullptr) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count", "3"}));
    solve_into(out.data(), out.size(), info);
    return out;
  }

  // The same in double.
  std::vector<double> solve_f64(hf_solve_info* info = nullptr) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count", "3"}));
    solve_into(out.data(), out.size(), info);
    return out;
  }

  // As solve, into memory of yours.
  void solve_into(float* out, size_t size, hf_solve_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "3"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_direction_solve(get(), &out_view, info));
  }

  // As solve, into memory of yours.
  void solve_into(double* out, size_t size, hf_solve_info* info = nullptr) const {
    Call c(counts_);
    need(size, c.product({"vertex_count", "3"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_direction_solve(get(), &out_view, info));
  }

  // Lists the singularities of the field, ordered by triangle (Crane, Desbrun and Schroeder 2010, Section 5). On a
  // closed manifold component of one orientation the indices sum to degree times the Euler characteristic.
  //
  // Fails with HF_ERROR_EMPTY.
  std::vector<hf_singularity> singularities() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_singularity> singularities;
    for (bool done = false; !done;) {
      auto* singularities_at = c.room(singularities, {"capacity"});
      const hf_result code = hf_direction_get_singularities(get(), c.count("capacity", 0), singularities_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    singularities.resize(c.product({"capacity"}));
    return singularities;
  }

  // Writes the statistics.
  hf_direction_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_direction_statistics>();
    check(hf_direction_get_statistics(get(), &statistics));
    return statistics;
  }

  // With the struct of C.
  Direction(const Surface& surface, const hf_direction_desc& desc) {
    Call c;
    c.parent("surface", surface.known_counts());
    hf_direction raw = nullptr;
    check(hf_direction_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_direction get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Direction(hf_direction raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_direction raw, Counts counts) {
    handle_ = Handle<hf_direction, hf_direction_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_direction, hf_direction_destroy> handle_;
  Counts counts_;
};

// A set of handles on a surface.
class Pose {
 public:
  // Creates a pose without handles.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT.
  Pose(const Surface& surface, const PoseOptions& options = {}) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_pose_desc desc = options.fill(c, "");
    hf_pose raw = nullptr;
    check(hf_pose_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Copies a pose with its handles and transforms, so that several threads can pose one rig.
  Pose clone() const {
    Call c(counts_);
    hf_pose raw = nullptr;
    check(hf_pose_clone(get(), &raw));
    return Pose(raw, c.counts({"vertex_count"}));
  }

  // Moves a pose to an edited surface: its handles keep their numbers, layers, transforms and options. The next
  // Pose.deform goes on from the pose as it stands, with the new stiffness and links. So a faint stroke moves next to
  // nothing, also where handles of free rotation could rest in two poses. With restart the frame equals the frame of a
  // new pose on `surface`, to 1e-6 of the box.
  //
  // surface: any number of calls of Surface::edit or Surface::relink make it from the pose's surface, or the pose's
  // surface from it.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_UNSUPPORTED.
  void move_to(const Surface& surface) {
    Call c(counts_);
    c.parent("surface", surface.known_counts());
    check(hf_pose_move_to(get(), surface.get()));
    counts_["vertex_count"] = known(surface.known_counts(), "vertex_count");
  }

  // Writes the options of a pose.
  hf_pose_info info() const {
    Call c(counts_);
    auto info = make<hf_pose_info>();
    check(hf_pose_get_info(get(), &info));
    return info;
  }

  // Adds handles with identity transforms. On layer 0 the identity is the rest place, so a new handle pulls a posed
  // surface back to rest there. Use in_place to grab a posed surface. Each new handle then gets the rigid motion of its
  // region in the last pose (Pose::handle writes it). The surface stays in place (to 1e-6 of the box). It goes over to
  // the best pose of the new handles while handles move by 0.05 of the box, or back to rest. Until then the region of
  // the new handle keeps a part of its bend. restart ends this at once. On a higher layer the surface does not move (to
  // 1e-9 of the box) until you move the handle. Handles of lower layers hold the surface in place for the higher
  // layers.
  //
  // region_vertices: lists of whole numbers: all regions one after the other; none: places are given
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
  // HF_ERROR_TOO_LARGE.
  std::vector<uint32_t> add_handles(const std::vector<std::vector<uint32_t>>& region_vertices = {},
      const HandlesOptions& options = {}) {
    Call c(counts_);
    const hf_handles_desc desc = options.fill(c, "", region_vertices);
    std::vector<uint32_t> handles(c.product({"handle_count"}));
    check(hf_pose_add_handles(get(), &desc, handles.data()));
    return handles;
  }

  // Adds one handle on layer 0. Its region has the vertex nearest to a point at rest. It also has all vertices within
  // `radius` of the point that are edge-connected to this vertex.
  //
  // point: `[3]`.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE,
  // HF_ERROR_TOO_LARGE.
  uint32_t add_handle_at(const std::vector<double>& point, double radius) {
    Call c(counts_);
    const double* point_ = c.array(point, true, "point", {"3"});
    uint32_t handle = 0;
    check(hf_pose_add_handle_at(get(), point_, radius, &handle));
    return handle;
  }

  // Removes handles by number. A handle on a higher layer takes its edit with it: the surface is then, bit for bit, as
  // if the handle had never been added. On layer 0 this holds when you remove the handles that were added last, and for
  // frames with `restart`.
  //
  // handles: `[handle_count]`.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  void remove_handles(const std::vector<uint32_t>& handles) {
    Call c(counts_);
    const uint32_t* handles_ = c.array(handles, true, "handles", {"handle_count"});
    check(hf_pose_remove_handles(get(), c.count("handle_count", 1), handles_));
  }

  // Places handles. On layer 0 a transform is a motion from the rest place. On a higher layer it is an edit in the rest
  // frame of the handle. There the region moves by F (edit) F^-1, with F the rigid motion that the lower layers give
  // the handle. Rotations continue from call to call, so a handle that you dragged past 180 degrees stays turned that
  // far. The transforms take effect at the next Pose.deform.
  //
  // handles: `[handle_count]`.
  // rotations: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
  // translations: up to 1e15 box diagonals
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
  void set_transforms(const std::vector<uint32_t>& handles, const std::vector<double>& rotations = {},
      const std::vector<double>& translations = {}) {
    Call c(counts_);
    const uint32_t* handles_ = c.array(handles, true, "handles", {"handle_count"});
    std::vector<hf_transform> transforms(c.product({"handle_count"}));
    need(rotations.empty() ? transforms.size() * 4 : rotations.size(), transforms.size() * 4, "rotations");
    for (size_t i = 0; i < rotations.size(); ++i) transforms[i / 4].rotation[i % 4] = rotations[i];
    need(translations.empty() ? transforms.size() * 3 : translations.size(), transforms.size() * 3, "translations");
    for (size_t i = 0; i < translations.size(); ++i) transforms[i / 3].translation[i % 3] = translations[i];
    check(hf_pose_set_transforms(get(), c.count("handle_count", 1), handles_, transforms.data()));
  }

  // Places one handle.
  //
  // rotation: unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free
  // translation: up to 1e15 box diagonals
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
  void set_transform(uint32_t handle, const std::optional<std::array<double, 4>>& rotation = {},
      const std::optional<std::array<double, 3>>& translation = {}) {
    Call c(counts_);
    hf_transform transform{};
    if (rotation) std::copy(rotation->begin(), rotation->end(), transform.rotation);
    if (translation) std::copy(translation->begin(), translation->end(), transform.translation);
    check(hf_pose_set_transform(get(), handle, &transform));
  }

  // Frees the rotations of handles, or lets you give them again. A handle of free rotation is a positional constraint
  // (Sorkine and Alexa 2007). Its centroid lands exactly where its transform puts it; the rotation of the transform is
  // ignored. Each Pose.deform finds the rotation together with the pose, and Pose::handle writes it. The rotation has
  // the least as-rigid-as-possible energy. The energy of a pulled group of vertices is measured from a longer and
  // thinner shape than the rest shape of the group. So the rotation is not exactly the rotation of least energy from
  // the rest shape.
  //
  // Free the rotation while the user drags a handle: the wrist then follows the hand. Give the rotation while the user
  // turns a ring. A given rotation starts at the present rotation of the handle, so the pose does not change. When you
  // free a rotation on layer 0, the surface stays as it is. It releases the old rotation as handles move, as with
  // in_place; so move the handles after this call. On a higher layer a changed handle moves the surface at the next
  // frame. A handle alone in its component keeps its rotation. The first frame of a pose, and a frame with restart,
  // move free handles to their places in 8 steps, as a drag does. Such a frame takes the time of about 8 pose solves.
  // refine keeps the rotation of the smooth pose.
  //
  // handles: `[handle_count]`.
  // free_rotation: 1: the solve finds the rotations; 0: you give them.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND.
  void set_free_rotations(const std::vector<uint32_t>& handles, bool free_rotation = false) {
    Call c(counts_);
    const uint32_t* handles_ = c.array(handles, true, "handles", {"handle_count"});
    check(hf_pose_set_free_rotations(get(), c.count("handle_count", 1), handles_, free_rotation ? 1 : 0));
  }

  // Sets how much of the surface follows handles of layer 0. Below 1, soft pins hold the surface where it would be
  // without these handles. So a body does not lean after a dragged hand. Where the field of the handle is near 1, the
  // pins are weak, so the limb stays free. Keep 1 for the handles that hold the body, and set less for a handle that is
  // dragged. Every handle still lands exactly, and a limb that is too short gets longer. The next Pose.deform shows a
  // change at once. But a handle that was just added in place leaves the surface where it stands until a handle moves.
  // Full-mesh steps (refine) ignore the pins. Repeated steps (refine_from_last) let the body lean again.
  //
  // handles: `[handle_count]`.
  // following: 0 to 1. At 1 all of the surface follows the handle; a new handle has 1. At 0 only the limb of the handle
  // follows, such as an arm.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_UNSUPPORTED.
  void set_following(const std::vector<uint32_t>& handles, double following = 0) {
    Call c(counts_);
    const uint32_t* handles_ = c.array(handles, true, "handles", {"handle_count"});
    check(hf_pose_set_following(get(), c.count("handle_count", 1), handles_, following));
  }

  // Keeps the lengths of edges on the limbs of handles of layer 0, such as an arm whose hand is pulled. The limb is the
  // part of the surface where the field of the handle falls a long way over little area. It ends at the trunk, or at
  // the next handle on the limb. The steps move the limb alone. All other vertices keep their bits, so the body leans
  // no more than without the steps. A limb that is pulled beyond its length is stretched evenly. The limbs take their
  // steps after the steps of DeformOptions.refine. If handles have different counts of steps, all their limbs take the
  // largest count.
  //
  // handles: `[handle_count]`.
  // refine: 0 to 64 steps of as-rigid-as-possible on the limb in every frame; 0 = none, as in a new handle. With 1,
  // bends stay smooth. With 8 and more, most edges keep their lengths to a few per cent, and the limb bends like
  // two bones. Edges beside the handle can change more.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NOT_FOUND, HF_ERROR_UNSUPPORTED.
  void set_limb_refine(const std::vector<uint32_t>& handles, int32_t refine = 0) {
    Call c(counts_);
    const uint32_t* handles_ = c.array(handles, true, "handles", {"handle_count"});
    check(hf_pose_set_limb_refine(get(), c.count("handle_count", 1), handles_, refine));
  }

  // Names the rigid pieces of the mesh, such as a sword. A piece is an edge-connected part of the mesh. Each frame
  // moves a rigid piece by the rigid motion that fits the piece best, also after refine. Vertices near links count most
  // in this fit. If the region of a handle touches a rigid piece, the whole piece joins the region and moves with the
  // handle. A second handle on the same piece is refused (HF_ERROR_CONFLICT). Call this function before you add such
  // handles. Pose::skin writes the motions before this fit.
  //
  // vertices: `[vertex_count]`, one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
  // replaces the previous list.
  //
  // Fails with HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  void set_rigid_pieces(const std::vector<uint32_t>& vertices) {
    Call c(counts_);
    c.sizes.erase("vertex_count");  // of the list given here
    const uint32_t* vertices_ = c.array(vertices, true, "vertices", {"vertex_count"});
    check(hf_pose_set_rigid_pieces(get(), c.count("vertex_count", 1), vertices_));
  }

  // Places handles by 4 x 4 matrices M.
  //
  // handles: `[handle_count]`.
  // matrices: `[handle_count x 16]`, column by column. The last column is the translation. M moves a rest position p to
  // the posed position M p. Its linear part must be a rotation within 1e-4; the function takes the nearest
  // rotation. Its last row must be 0 0 0 1.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND.
  void set_matrices(const std::vector<uint32_t>& handles, const std::vector<double>& matrices) {
    Call c(counts_);
    const uint32_t* handles_ = c.array(handles, true, "handles", {"handle_count"});
    const double* matrices_ = c.array(matrices, true, "matrices", {"handle_count", "16"});
    check(hf_pose_set_matrices(get(), c.count("handle_count", 1), handles_, matrices_));
  }

  // Writes the info of a handle.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  hf_handle_info handle(uint32_t handle) const {
    Call c(counts_);
    auto info = make<hf_handle_info>();
    check(hf_pose_get_handle(get(), handle, &info));
    return info;
  }

  // Returns the number of handles, or 0 for an invalid object.
  uint32_t handle_count() const {
    return hf_pose_get_handle_count(get());
  }

  // Writes the field of a handle, which says how much each vertex follows the handle. At a vertex that a handle
  // reaches, the fields of all handles sum to 1.
  //
  // out: `[vertex_count]` of float or double.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  std::vector<float> field(uint32_t handle) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count"}));
    field_into(handle, out.data(), out.size());
    return out;
  }

  // The same in double.
  std::vector<double> field_f64(uint32_t handle) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count"}));
    field_into(handle, out.data(), out.size());
    return out;
  }

  // As field, into memory of yours.
  void field_into(uint32_t handle, float* out, size_t size) const {
    Call c(counts_);
    need(size, c.product({"vertex_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_pose_get_field(get(), handle, &out_view));
  }

  // As field, into memory of yours.
  void field_into(uint32_t handle, double* out, size_t size) const {
    Call c(counts_);
    need(size, c.product({"vertex_count"}), "out");
    const hf_array_out out_view = c.out(out, "vertex_count");
    check(hf_pose_get_field(get(), handle, &out_view));
  }

  // Does the same as Pose.deform, with the options of a desc.
  //
  // out: `[vertex_count x 3]` of float or double: posed positions
  // normals: `[vertex_count x 3]` of float or double: unit normals of the posed surface, shared across seams
  // info: filled in when given
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  std::vector<float> deform(const DeformOptions& options = {}, std::vector<float>* normals = nullptr,
      hf_deform_info* info = nullptr) {
    Call c(counts_);
    c.known("vertex_count", options.vertex_count);
    std::vector<float> out(c.product({"vertex_count", "3"}));
    deform_into(out.data(), out.size(), options, normals, info);
    return out;
  }

  // The same in double.
  std::vector<double> deform_f64(const DeformOptions& options = {}, std::vector<float>* normals = nullptr,
      hf_deform_info* info = nullptr) {
    Call c(counts_);
    c.known("vertex_count", options.vertex_count);
    std::vector<double> out(c.product({"vertex_count", "3"}));
    deform_into(out.data(), out.size(), options, normals, info);
    return out;
  }

  // As deform, into memory of yours.
  void deform_into(float* out, size_t size, const DeformOptions& options = {}, std::vector<float>* normals = nullptr,
      hf_deform_info* info = nullptr) {
    Call c(counts_);
    hf_deform_desc desc = options.fill(c, "");
    need(size, c.product({"vertex_count", "3"}), "out");
    desc.positions = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    float* normals_at = normals ? normals->data() : nullptr;
    desc.normals = c.out(normals_at, "vertex_count");
    check(hf_pose_deform(get(), &desc, info));
  }

  // As deform, into memory of yours.
  void deform_into(double* out, size_t size, const DeformOptions& options = {}, std::vector<float>* normals = nullptr,
      hf_deform_info* info = nullptr) {
    Call c(counts_);
    hf_deform_desc desc = options.fill(c, "");
    need(size, c.product({"vertex_count", "3"}), "out");
    desc.positions = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    float* normals_at = normals ? normals->data() : nullptr;
    desc.normals = c.out(normals_at, "vertex_count");
    check(hf_pose_deform(get(), &desc, info));
  }

  // Writes the statistics of a pose.
  hf_pose_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_pose_statistics>();
    check(hf_pose_get_statistics(get(), &statistics));
    return statistics;
  }

  // Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they were added.
  // If the handles do not reach some vertices, a last joint that never moves holds those vertices. The weights of a
  // vertex are its 4 or 8 largest, scaled so that their sum is exactly 1 in single precision. Weights and pivots change
  // only when handles are added or removed.
  //
  // The joint motions bring the skin as near as possible to the last Pose.deform, as it is without refine. With scales,
  // classic bends, twists and lifts replay within 0.5 per cent of the box. Without scales, bends and twists replay
  // within 1 per cent and stretched surfaces within about 2.5 per cent.
  //
  // influence_count: joints per vertex, 4 or 8; 0 = 4
  // scales: `[joint_capacity x 3]` along the axes in the last frame; none = joints are rigid
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED.
  SkinInfo skin(uint32_t influence_count = 0, bool want_scales = false) const {
    Call c(counts_);
    auto skin = make<hf_skin_info>();
    skin.influence_count = influence_count;
    c.known("influence_count", influence_count ? influence_count : 4);
    c.sizes["joint_capacity"] = c.count("joint_count", Call::kFirst);
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    SkinInfo found;
    for (bool done = false; !done;) {
      skin.joint_capacity = c.count("joint_capacity", 0);
      skin.vertex_capacity = c.count("vertex_capacity", 0);
      skin.pivots = c.room(found.pivots, {"joint_capacity", "3"});
      skin.rotations = c.room(found.rotations, {"joint_capacity", "4"});
      skin.translations = c.room(found.translations, {"joint_capacity", "3"});
      skin.axes = c.room(found.axes, {"joint_capacity", "4"});
      skin.scales = want_scales ? c.room(found.scales, {"joint_capacity", "3"}) : nullptr;
      skin.vertex_joints = c.room(found.vertex_joints, {"vertex_capacity", "influence_count"});
      skin.vertex_weights = c.room(found.vertex_weights, {"vertex_capacity", "influence_count"});
      const hf_result code = hf_pose_get_skin(get(), &skin);
      done = c.enough(code, {{"joint_capacity", skin.joint_count}, {"vertex_capacity", skin.vertex_count}});
    }
    found.pivots.resize(c.product({"joint_capacity", "3"}));
    found.rotations.resize(c.product({"joint_capacity", "4"}));
    found.translations.resize(c.product({"joint_capacity", "3"}));
    found.axes.resize(c.product({"joint_capacity", "4"}));
    if (want_scales) found.scales.resize(c.product({"joint_capacity", "3"}));
    found.vertex_joints.resize(c.product({"vertex_capacity", "influence_count"}));
    found.vertex_weights.resize(c.product({"vertex_capacity", "influence_count"}));
    found.influence_count = skin.influence_count;
    return found;
  }

  // Writes the info of a blend.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  hf_blend_info blend_info() const {
    Call c(counts_);
    auto info = make<hf_blend_info>();
    check(hf_pose_get_blend_info(get(), &info));
    return info;
  }

  // Writes the arrays that a shader needs once for each `revision`. Call it without arrays for the counts, then with
  // arrays. If handles do not reach some vertices, a last cluster that never moves holds those vertices.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  BlendRows blend_rows() const {
    Call c(counts_);
    auto rows = make<hf_blend_rows>();
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    c.sizes["entry_capacity"] = Call::kFirst;
    BlendRows found;
    for (bool done = false; !done;) {
      rows.vertex_capacity = c.count("vertex_capacity", 0);
      rows.entry_capacity = c.count("entry_capacity", 0);
      rows.rows = c.room(found.rows, {"vertex_capacity", "2"});
      rows.clusters = c.room(found.clusters, {"entry_capacity"});
      rows.weights = c.room(found.weights, {"entry_capacity"});
      rows.gradients = c.room(found.gradients, {"entry_capacity", "3"});
      rows.positions = c.room(found.positions, {"vertex_capacity", "3"});
      rows.normals = c.room(found.normals, {"vertex_capacity", "3"});
      rows.offsets = c.room(found.offsets, {"vertex_capacity", "3"});
      const hf_result code = hf_pose_get_blend_rows(get(), &rows);
      done = c.enough(code, {{"vertex_capacity", rows.vertex_count}, {"entry_capacity", rows.entry_count}});
    }
    found.rows.resize(c.product({"vertex_capacity", "2"}));
    found.clusters.resize(c.product({"entry_capacity"}));
    found.weights.resize(c.product({"entry_capacity"}));
    found.gradients.resize(c.product({"entry_capacity", "3"}));
    found.positions.resize(c.product({"vertex_capacity", "3"}));
    found.normals.resize(c.product({"vertex_capacity", "3"}));
    found.offsets.resize(c.product({"vertex_capacity", "3"}));
    found.longest_row = rows.longest_row;
    return found;
  }

  // Writes rows of one length. They change with `revision`, as the rows of Pose::blend_rows do. Call it without arrays
  // for the count and the errors.
  //
  // influence_count: clusters of each vertex, the length of a row, 1 to 64; 0 = 8
  // byte_clusters: `[vertex_capacity x influence_count]` none = not wanted. Refused for more than 256 clusters
  // byte_weights: `[vertex_capacity x influence_count]` none = not wanted. 255ths, of sum 255; weights that round to 0
  // are left out
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  BlendInfluences blend_influences(uint32_t influence_count = 0, bool want_byte_clusters = false,
      bool want_byte_weights = false) const {
    Call c(counts_);
    auto influences = make<hf_blend_influences>();
    influences.influence_count = influence_count;
    c.known("influence_count", influence_count ? influence_count : 8);
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    BlendInfluences found;
    for (bool done = false; !done;) {
      influences.vertex_capacity = c.count("vertex_capacity", 0);
      influences.clusters = c.room(found.clusters, {"vertex_capacity", "influence_count"});
      influences.weights = c.room(found.weights, {"vertex_capacity", "influence_count"});
      influences.byte_clusters = want_byte_clusters ? c.room(found.byte_clusters, {"vertex_capacity",
          "influence_count"}) : nullptr;
      influences.byte_weights = want_byte_weights ? c.room(found.byte_weights, {"vertex_capacity",
          "influence_count"}) : nullptr;
      const hf_result code = hf_pose_get_blend_influences(get(), &influences);
      done = c.enough(code, {{"vertex_capacity", influences.vertex_count}});
    }
    found.clusters.resize(c.product({"vertex_capacity", "influence_count"}));
    found.weights.resize(c.product({"vertex_capacity", "influence_count"}));
    if (want_byte_clusters) found.byte_clusters.resize(c.product({"vertex_capacity", "influence_count"}));
    if (want_byte_weights) found.byte_weights.resize(c.product({"vertex_capacity", "influence_count"}));
    found.change = influences.change;
    found.byte_change = influences.byte_change;
    found.error = influences.error;
    found.byte_error = influences.byte_error;
    found.influence_count = influences.influence_count;
    return found;
  }

  // Solves a frame without writing vertices, for a shader that computes them. The pose is the same as after
  // Pose::deform. Higher layers, rigid pieces and limb_refine need the surface. With them the call costs as much as
  // Pose.deform.
  //
  // iteration_count: 1 to 1000; 0 = as in PoseOptions.
  // restart: 1: as in DeformOptions.
  // info: filled in when given
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT.
  void solve(uint32_t iteration_count = 0, bool restart = false, hf_deform_info* info = nullptr) {
    Call c(counts_);
    check(hf_pose_solve(get(), iteration_count, restart ? 1 : 0, info));
  }

  // Writes the transforms of the clusters in the last Pose::solve or Pose.deform, without its refine. Before the first
  // solve they are identities. After handles were added or removed, solve before you read them: they may be identities
  // until then. The call allocates nothing.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  std::vector<float> blend_transforms() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<float> transforms;
    for (bool done = false; !done;) {
      auto* transforms_at = c.room(transforms, {"capacity", "12"});
      const hf_result code = hf_pose_get_blend_transforms(get(), c.count("capacity", 0), transforms_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    transforms.resize(c.product({"capacity", "12"}));
    return transforms;
  }

  // With the struct of C.
  Pose(const Surface& surface, const hf_pose_desc& desc) {
    Call c;
    c.parent("surface", surface.known_counts());
    hf_pose raw = nullptr;
    check(hf_pose_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_pose get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Pose(hf_pose raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_pose raw, Counts counts) {
    handle_ = Handle<hf_pose, hf_pose_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_pose, hf_pose_destroy> handle_;
  Counts counts_;
};

// Quads.
class Quads {
 public:
  // Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature. Creases and
  // borders are straight lines of edges. Irregular vertices are the singularities of the crosses, and places where the
  // function split quads to keep to the surface.
  //
  // The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge lengths,
  // it snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose diagonal keeps nearer to
  // the surface, so a renderer should split quads into triangles from the first corner. If the mesh stays farther than
  // an edge length from the surface, a limb is lost. Then the function makes up to three finer meshes, and removes rows
  // of quads until the number is right. The function checks every result. Each directed edge occurs once. No face
  // repeats a corner. The result has the Euler characteristic of the surface.
  //
  // The surface may have borders, any genus and several components; the function turns triangles that disagree in
  // orientation. Where three or more triangles share an edge, the two flattest are joined, then the next two. A
  // triangle without a partner gets a border. Surface::report counts such edges. A Moebius band is parted across.
  //
  // With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to rounding. Half
  // of the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box diagonals, the side of the
  // normal counts.
  //
  // The user can place irregular vertices and drag them. The function makes each by guides on a ring around the place,
  // an edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of 1,000 irregular vertices
  // at random places of 20 meshes come out within an edge of the place; such a vertex then moves to the place and stays
  // there. A vertex of 5 quads brings others of 3 with it, because the indices of the crosses sum to four times the
  // Euler characteristic. On a torus or a knot a single one of 5 is often lost.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INTERNAL, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  Quads(const Surface& surface, const QuadsOptions& options = {}) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_quads_desc desc = options.fill(c, "");
    hf_quads raw = nullptr;
    check(hf_quads_create(surface.get(), &desc, &raw));
    own(raw, c.counts({}));
  }

  // Makes the mesh of `quads` again, with other options: for strokes and creases that the user drags. Quads with the
  // same options gives the same result, bit for bit. The first update takes as long. It keeps the tables that do not
  // depend on guides, creases and relax_count. Later updates with the same edge_length, face_count and symmetry_plane
  // take less time. Without relaxation (relax_count = HF_NO_INDEX) they take 0.1 s for 15,000 vertices. Use that while
  // the user drags, and relax_count = 0 at the end. Other sizes and planes are allowed; what belongs to them is made
  // again. After an error `quads` is unchanged. Kept memory: 2 to 4 kB per vertex, until `quads` is destroyed.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INTERNAL, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  void update(const QuadsOptions& options = {}) {
    Call c(counts_);
    const hf_quads_desc desc = options.fill(c, "");
    check(hf_quads_update(get(), &desc));
  }

  // Writes the counts.
  hf_quads_info info() const {
    Call c(counts_);
    auto info = make<hf_quads_info>();
    check(hf_quads_get_info(get(), &info));
    return info;
  }

  // Writes every array that is not none.
  //
  // Fails with HF_ERROR_TOO_SMALL.
  QuadsMesh mesh() const {
    Call c(counts_);
    auto mesh = make<hf_quads_mesh>();
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    c.sizes["face_capacity"] = Call::kFirst;
    QuadsMesh found;
    for (bool done = false; !done;) {
      mesh.vertex_capacity = c.count("vertex_capacity", 0);
      mesh.face_capacity = c.count("face_capacity", 0);
      mesh.positions = c.room(found.positions, {"vertex_capacity", "3"});
      mesh.faces = c.room(found.faces, {"face_capacity", "4"});
      mesh.triangles = c.room(found.triangles, {"vertex_capacity"});
      mesh.barycentrics = c.room(found.barycentrics, {"vertex_capacity", "3"});
      mesh.corners = c.room(found.corners, {"vertex_capacity", "3"});
      const hf_result code = hf_quads_get_mesh(get(), &mesh);
      done = c.enough(code, {{"vertex_capacity", mesh.vertex_count}, {"face_capacity", mesh.face_count}});
    }
    found.positions.resize(c.product({"vertex_capacity", "3"}));
    found.faces.resize(c.product({"face_capacity", "4"}));
    found.triangles.resize(c.product({"vertex_capacity"}));
    found.barycentrics.resize(c.product({"vertex_capacity", "3"}));
    found.corners.resize(c.product({"vertex_capacity", "3"}));
    return found;
  }

  // With the struct of C.
  Quads(const Surface& surface, const hf_quads_desc& desc) {
    Call c;
    c.parent("surface", surface.known_counts());
    hf_quads raw = nullptr;
    check(hf_quads_create(surface.get(), &desc, &raw));
    own(raw, c.counts({}));
  }

  // With the struct of C.
  void update(const hf_quads_desc& desc) { check(hf_quads_update(get(), &desc)); }

  hf_quads get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_quads raw, Counts counts) {
    handle_ = Handle<hf_quads, hf_quads_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_quads, hf_quads_destroy> handle_;
  Counts counts_;
};

// A surface that is prepared for tracing streamlines.
class Flow {
 public:
  // Prepares a surface for tracing: computes half-edges and weights.
  //
  // Fails with HF_ERROR_UNSUPPORTED.
  explicit Flow(const Surface& surface) {
    Call c;
    c.parent("surface", surface.known_counts());
    hf_flow raw = nullptr;
    check(hf_flow_create(surface.get(), &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Traces streamlines of any field that is finite at every vertex in a triangle. For a harmonic field of
  // HF_OPERATOR_CLAMPED the lines are denser where the field is steeper. Surface::trace_isolines gives the lines that
  // cross the streamlines.
  //
  // field: `[vertex_count]` of float or double.
  // seeds: `[seed_count]` vertices of your mesh
  // wanted_count: lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.
  Streamlines trace(const Reals& field, const std::vector<uint32_t>& seeds = {}, uint32_t wanted_count = 0) const {
    Call c(counts_);
    const hf_array field_ = c.view(field, true, "field", {"vertex_count"});
    auto lines = make<hf_streamlines>();
    lines.wanted_count = wanted_count;
    lines.seeds = c.array(seeds, false, "seeds", {"seed_count"});
    lines.seed_count = c.count("seed_count", 0);
    c.sizes["point_capacity"] = Call::kFirst;
    c.sizes["line_capacity"] = Call::kFirst;
    Streamlines found;
    for (bool done = false; !done;) {
      lines.point_capacity = c.count("point_capacity", 0);
      lines.line_capacity = c.count("line_capacity", 0);
      lines.positions = c.room(found.positions, {"point_capacity", "3"});
      lines.values = c.room(found.values, {"point_capacity"});
      lines.line_starts = c.room(found.line_starts, {"line_capacity + 1"});
      lines.line_ends = c.room(found.line_ends, {"line_capacity", "2"});
      const hf_result code = hf_flow_trace(get(), &field_, &lines);
      done = c.enough(code, {{"point_capacity", lines.point_count}, {"line_capacity", lines.line_count}});
    }
    found.positions.resize(c.product({"point_capacity", "3"}));
    found.values.resize(c.product({"point_capacity"}));
    found.line_starts.resize(c.product({"line_capacity + 1"}));
    found.line_ends.resize(c.product({"line_capacity", "2"}));
    return found;
  }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_flow get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_flow raw, Counts counts) {
    handle_ = Handle<hf_flow, hf_flow_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_flow, hf_flow_destroy> handle_;
  Counts counts_;
};

// A region of a surface and its smooth base.
class Region {
 public:
  // Creates a region without vertices.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_POSITIVE_DEFINITE.
  Region(const Surface& surface, const RegionOptions& options = {}) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_region_desc desc = options.fill(c, "");
    hf_region raw = nullptr;
    check(hf_region_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Copies a region. The copy shares the factor and all memory, until one of the two is edited. For undo, keep copies:
  // one before each edit.
  Region clone() const {
    Call c(counts_);
    hf_region raw = nullptr;
    check(hf_region_clone(get(), &raw));
    return Region(raw, c.counts({"vertex_count"}));
  }

  // Changes the region and computes its new base. The vertices next to the region (its rim) are sites with their
  // positions as values. Sites that stay cost nothing; the others are one batch as in Solver::edit_sites. One backward
  // sweep over the factor then gives the base; for a small region the sweep covers only the part of the factor that its
  // vertices need. A region may have several pieces, in several components. Progress covers curve, sites and base; the
  // call can be cancelled between them.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  void edit(const RegionEditOptions& options = {}) {
    Call c(counts_);
    const hf_region_edit_desc desc = options.fill(c, "");
    check(hf_region_edit(get(), &desc));
  }

  // Writes the info of a region.
  hf_region_info info() const {
    Call c(counts_);
    auto info = make<hf_region_info>();
    check(hf_region_get_info(get(), &info));
    return info;
  }

  // Writes the statistics of a region.
  hf_region_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_region_statistics>();
    check(hf_region_get_statistics(get(), &statistics));
    return statistics;
  }

  // Writes one list of vertices of your mesh, ascending. Where vertices were welded, the list has the first copy.
  //
  // list: HF_REGION_*.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT.
  std::vector<uint32_t> vertices(int32_t list = 0) const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> vertices;
    for (bool done = false; !done;) {
      auto* vertices_at = c.room(vertices, {"capacity"});
      const hf_result code = hf_region_get_vertices(get(), list, c.count("capacity", 0), vertices_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    vertices.resize(c.product({"capacity"}));
    return vertices;
  }

  // Writes the corners of the region's last curve, to draw it, in order, in the unit and frame of the positions in
  // RegionOptions. The last corner is joined to the first. Rings, added and removed vertices leave it as it is.
  std::vector<double> curve() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<double> points;
    for (bool done = false; !done;) {
      auto* points_at = c.room(points, {"capacity", "3"});
      const hf_result code = hf_region_get_curve(get(), c.count("capacity", 0), points_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    points.resize(c.product({"capacity", "3"}));
    return points;
  }

  // Morphs the region. A vertex of the region moves from p to p + weight (base - p), with p its position in
  // RegionOptions. All other vertices stay at p. Weight 0 gives p bit for bit, and weight 1 gives the base. A weight
  // below 0 exaggerates detail, and a weight above 1 turns it inside out. An empty region gives p. The call solves
  // nothing.
  //
  // weight: any finite number
  // out: `[vertex_count x 3]` of float or double, in the unit of the mesh
  // normals: `[vertex_count x 3]` of float or double: unit normals of the morphed surface, shared across seams
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
  std::vector<float> morph(double weight, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count", "3"}));
    morph_into(weight, out.data(), out.size(), normals);
    return out;
  }

  // The same in double.
  std::vector<double> morph_f64(double weight, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count", "3"}));
    morph_into(weight, out.data(), out.size(), normals);
    return out;
  }

  // As morph, into memory of yours.
  void morph_into(double weight, float* out, size_t size, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    hf_morph_desc desc = MorphOptions().fill(c, "", weight);
    need(size, c.product({"vertex_count", "3"}), "out");
    desc.positions = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    float* normals_at = normals ? normals->data() : nullptr;
    desc.normals = c.out(normals_at, "vertex_count");
    check(hf_region_morph(get(), &desc));
  }

  // As morph, into memory of yours.
  void morph_into(double weight, double* out, size_t size, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    hf_morph_desc desc = MorphOptions().fill(c, "", weight);
    need(size, c.product({"vertex_count", "3"}), "out");
    desc.positions = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    float* normals_at = normals ? normals->data() : nullptr;
    desc.normals = c.out(normals_at, "vertex_count");
    check(hf_region_morph(get(), &desc));
  }

  // With the struct of C.
  Region(const Surface& surface, const hf_region_desc& desc) {
    Call c;
    c.parent("surface", surface.known_counts());
    c.known("vertex_count", desc.positions.count);
    hf_region raw = nullptr;
    check(hf_region_create(surface.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // With the struct of C.
  void edit(const hf_region_edit_desc& desc) { check(hf_region_edit(get(), &desc)); }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_region get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Region(hf_region raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_region raw, Counts counts) {
    handle_ = Handle<hf_region, hf_region_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_region, hf_region_destroy> handle_;
  Counts counts_;
};

// The detail of a source region, transferred to a target region. Both may be on one surface or on two.
class Detail {
 public:
  // Carries the detail of the source region to the target region. A harmonic map with positive weights takes each
  // region to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its rim) lie on the
  // circle, by arc length between the pairs of desc. Points at the same place in the disc correspond. The function
  // stores the offset from base to surface in a local frame of the source. The axes of the frame are the normal of the
  // base and the direction in which the first disc coordinate grows. It interpolates the offsets in the triangles of
  // the source, and applies them in the same frames of the target. The detail fades to nothing at the rim. If source
  // and target are the same region, the result is the surface itself. Later edits of the regions do not change the
  // object.
  //
  // Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_UNSUPPORTED.
  Detail(const Region& source, const Region& target, const DetailOptions& options = {}) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    const hf_detail_desc desc = options.fill(c, "");
    hf_detail raw = nullptr;
    check(hf_detail_create(source.get(), target.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Writes the target's surface with its detail replaced. A vertex of the target region gets base + weight (transferred
  // detail); all others keep their positions. Weight 0 gives the smooth base, and weight 1 the detail as it was on the
  // source. A weight above 1 exaggerates the detail, and a weight below 0 turns it inside out.
  //
  // weight: any finite number
  // out: `[vertex_count x 3]` of float or double, in the unit of the mesh
  // normals: `[vertex_count x 3]` of float or double: unit normals of the morphed surface, shared across seams
  //
  // Fails with HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
  std::vector<float> morph(double weight, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    std::vector<float> out(c.product({"vertex_count", "3"}));
    morph_into(weight, out.data(), out.size(), normals);
    return out;
  }

  // The same in double.
  std::vector<double> morph_f64(double weight, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    std::vector<double> out(c.product({"vertex_count", "3"}));
    morph_into(weight, out.data(), out.size(), normals);
    return out;
  }

  // As morph, into memory of yours.
  void morph_into(double weight, float* out, size_t size, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    hf_morph_desc desc = MorphOptions().fill(c, "", weight);
    need(size, c.product({"vertex_count", "3"}), "out");
    desc.positions = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    float* normals_at = normals ? normals->data() : nullptr;
    desc.normals = c.out(normals_at, "vertex_count");
    check(hf_detail_morph(get(), &desc));
  }

  // As morph, into memory of yours.
  void morph_into(double weight, double* out, size_t size, std::vector<float>* normals = nullptr) const {
    Call c(counts_);
    hf_morph_desc desc = MorphOptions().fill(c, "", weight);
    need(size, c.product({"vertex_count", "3"}), "out");
    desc.positions = c.out(out, "vertex_count");
    if (normals) normals->resize(c.product({"vertex_count", "3"}));
    float* normals_at = normals ? normals->data() : nullptr;
    desc.normals = c.out(normals_at, "vertex_count");
    check(hf_detail_morph(get(), &desc));
  }

  // With the struct of C.
  Detail(const Region& source, const Region& target, const hf_detail_desc& desc) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    hf_detail raw = nullptr;
    check(hf_detail_create(source.get(), target.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_detail get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_detail raw, Counts counts) {
    handle_ = Handle<hf_detail, hf_detail_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_detail, hf_detail_destroy> handle_;
  Counts counts_;
};

// A skeleton at rest and the findings about it. Calls read the object, none changes it.
class Skeleton {
 public:
  // Finds the velocity of the soles where they touch the ground, for a clip on the spot: a treadmill under a walk. It
  // is 0 for a clip that travels.
  //
  // poses: `[frame_count x joint_count x 10]`.
  // seconds: between two frames, above 0.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
  std::vector<double> ground_velocity(const std::vector<float>& poses, double seconds) const {
    Call c(counts_);
    const float* poses_ = c.array(poses, true, "poses", {"frame_count", "joint_count", "10"});
    std::vector<double> velocity(c.product({"3"}));
    check(hf_skeleton_get_ground_velocity(get(), c.count("frame_count", 1), poses_, seconds, velocity.data()));
    return velocity;
  }

  // Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give it if feet
  // shall stand on the ground. The object keeps a copy of everything.
  //
  // names: one line for each joint in UTF-8, or none: names then say nothing
  // parents: `[joint_count]` number of the parent, HF_NO_INDEX for a root
  // rest: `[joint_count x 10]` joint transforms
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  Skeleton(const std::vector<std::string>& names, const std::vector<uint32_t>& parents, const std::vector<float>& rest,
      const SkeletonOptions& options = {}) {
    Call c;
    const hf_skeleton_desc desc = options.fill(c, "", names, parents, rest);
    hf_skeleton raw = nullptr;
    check(hf_skeleton_create(&desc, &raw));
    own(raw, c.counts({"joint_count"}));
  }

  // Writes the findings.
  hf_skeleton_info info() const {
    Call c(counts_);
    auto info = make<hf_skeleton_info>();
    check(hf_skeleton_get_info(get(), &info));
    return info;
  }

  // Writes one entry for each joint.
  std::vector<hf_joint_info> joints() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_joint_info> joints;
    for (bool done = false; !done;) {
      auto* joints_at = c.room(joints, {"capacity"});
      const hf_result code = hf_skeleton_get_joints(get(), c.count("capacity", 0), joints_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    joints.resize(c.product({"capacity"}));
    return joints;
  }

  // Writes the chains.
  std::vector<hf_chain> chains() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_chain> chains;
    for (bool done = false; !done;) {
      auto* chains_at = c.room(chains, {"capacity"});
      const hf_result code = hf_skeleton_get_chains(get(), c.count("capacity", 0), chains_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    chains.resize(c.product({"capacity"}));
    return chains;
  }

  // Writes the joints of chain after chain.
  std::vector<uint32_t> chain_joints() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> joints;
    for (bool done = false; !done;) {
      auto* joints_at = c.room(joints, {"capacity"});
      const hf_result code = hf_skeleton_get_chain_joints(get(), c.count("capacity", 0), joints_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    joints.resize(c.product({"capacity"}));
    return joints;
  }

  // Writes the reasons as text. The reasons for the axes come first. Then each doubtful finding has one line.
  std::string reasons() const {
    Call c(counts_);
    size_t size = 0;
    check(hf_skeleton_get_reasons(get(), 0, nullptr, &size));
    std::vector<uint8_t> block(size);
    check(hf_skeleton_get_reasons(get(), block.size(), reinterpret_cast<char*>(block.data()), &size));
    return std::string(block.begin(), block.end() - (block.empty() ? 0 : 1));
  }

  // With the struct of C.
  explicit Skeleton(const hf_skeleton_desc& desc) {
    Call c;
    c.known("joint_count", desc.joint_count);
    hf_skeleton raw = nullptr;
    check(hf_skeleton_create(&desc, &raw));
    own(raw, c.counts({"joint_count"}));
  }

  uint32_t joint_count() const noexcept { return known(counts_, "joint_count"); }

  hf_skeleton get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_skeleton raw, Counts counts) {
    handle_ = Handle<hf_skeleton, hf_skeleton_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_skeleton, hf_skeleton_destroy> handle_;
  Counts counts_;
};

// The motion of one skeleton on another.
class Retarget {
 public:
  // Pairs the joints of two skeletons.
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
  Retarget(const Skeleton& source, const Skeleton& target, const RetargetOptions& options = {}) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    const hf_retarget_desc desc = options.fill(c, "");
    hf_retarget raw = nullptr;
    check(hf_retarget_create(source.get(), target.get(), &desc, &raw));
    own(raw, c.counts({"joint_count"}));
  }

  // Copies a retarget with the state of its feet: for another character with the same skeletons, and for undo.
  Retarget clone() const {
    Call c(counts_);
    hf_retarget raw = nullptr;
    check(hf_retarget_clone(get(), &raw));
    return Retarget(raw, c.counts({"joint_count"}));
  }

  // Computes the pose of the target. The frame depends on the source pose and on the state of the feet: whether each is
  // planted, and how far it is moved to keep its place. The state comes from the frames since the last reset and fades
  // within a step.
  //
  // source_pose: `[source.joint_count x 10]`.
  // seconds: time since the last frame, 0 for the first frame and for a repeated frame.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
  std::vector<float> solve(const std::vector<float>& source_pose, double seconds = 0) {
    Call c(counts_);
    const float* source_pose_ = c.array(source_pose, true, "source_pose", {"source.joint_count", "10"});
    std::vector<float> target_pose(c.product({"target.joint_count", "10"}));
    check(hf_retarget_solve(get(), source_pose_, seconds, target_pose.data()));
    return target_pose;
  }

  // Forgets the state of the feet and the figures of the info. Call it where the clip jumps.
  void reset() {
    Call c(counts_);
    check(hf_retarget_reset(get()));
  }

  // Writes the figures.
  hf_retarget_info info() const {
    Call c(counts_);
    auto info = make<hf_retarget_info>();
    check(hf_retarget_get_info(get(), &info));
    return info;
  }

  // Writes how chains follow.
  std::vector<hf_chain_match> chains() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<hf_chain_match> chains;
    for (bool done = false; !done;) {
      auto* chains_at = c.room(chains, {"capacity"});
      const hf_result code = hf_retarget_get_chains(get(), c.count("capacity", 0), chains_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    chains.resize(c.product({"capacity"}));
    return chains;
  }

  // Writes which joint of the source each joint of the target follows. A joint between two gets the nearer, a joint
  // without a partner HF_NO_INDEX.
  std::vector<uint32_t> partners() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> partners;
    for (bool done = false; !done;) {
      auto* partners_at = c.room(partners, {"capacity"});
      const hf_result code = hf_retarget_get_partners(get(), c.count("capacity", 0), partners_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    partners.resize(c.product({"capacity"}));
    return partners;
  }

  // With the struct of C.
  Retarget(const Skeleton& source, const Skeleton& target, const hf_retarget_desc& desc) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    hf_retarget raw = nullptr;
    check(hf_retarget_create(source.get(), target.get(), &desc, &raw));
    own(raw, c.counts({"joint_count"}));
  }

  uint32_t joint_count() const noexcept { return known(counts_, "joint_count"); }

  hf_retarget get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Retarget(hf_retarget raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_retarget raw, Counts counts) {
    handle_ = Handle<hf_retarget, hf_retarget_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_retarget, hf_retarget_destroy> handle_;
  Counts counts_;
};

// hf/transfer.h - play the motion of one surface on another.
//
// You pair regions of the source surface with regions of the target surface. From the pairs both surfaces get the same
// harmonic coordinates, and places of equal coordinates correspond. The vertices around such a place form a cluster.
// The target takes over the rotations of the source's clusters. Its translations follow from its own shape (Xu, Zhang,
// Cohen-Or and Xiong 2009, Section 6), and from where the source's clusters turn about one another. A limb whose parts
// reach farther than the source's turns less, so that it moves as far: a held sword, a long tail, a large head. The
// dial long_follow gives it the whole turn.
class Transfer {
 public:
  // Creates a transfer between two surfaces; both may be the same.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_INVALID_OBJECT, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE.
  Transfer(const Surface& source, const Surface& target, const TransferOptions& options = {}) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    const hf_transfer_desc desc = options.fill(c, "");
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.get(), target.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Adds pairs.
  //
  // source_vertices: lists of whole numbers: all regions one after the other; vertices of your mesh, up to 4 entries
  // per vertex
  // target_vertices: lists of whole numbers:
  // flags: `[pair_count]` HF_PAIR_*, or none for none
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  std::vector<uint32_t> add_pairs(const std::vector<std::vector<uint32_t>>& source_vertices,
      const std::vector<std::vector<uint32_t>>& target_vertices, const std::vector<uint32_t>& flags = {},
      const Pairs& options = {}) {
    Call c(counts_);
    const hf_pairs_desc desc = options.fill(c, "", source_vertices, target_vertices, flags);
    std::vector<uint32_t> pairs(c.product({"pair_count"}));
    check(hf_transfer_add_pairs(get(), &desc, pairs.data()));
    return pairs;
  }

  // Removes pairs by number.
  //
  // pairs: `[pair_count]`.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  void remove_pairs(const std::vector<uint32_t>& pairs) {
    Call c(counts_);
    const uint32_t* pairs_ = c.array(pairs, true, "pairs", {"pair_count"});
    check(hf_transfer_remove_pairs(get(), c.count("pair_count", 1), pairs_));
  }

  // Writes the info of a pair. The first call after a change of pairs solves the fields of all pairs, unless
  // Transfer::apply has done so. This changes no result.
  //
  // Fails with HF_ERROR_NOT_FOUND.
  hf_pair_info pair(uint32_t pair) const {
    Call c(counts_);
    auto info = make<hf_pair_info>();
    check(hf_transfer_get_pair(get(), pair, &info));
    return info;
  }

  // Writes the info of the whole transfer. The first call after a change of pairs solves fields, as Transfer::pair
  // does.
  //
  // Fails with HF_ERROR_EMPTY.
  hf_transfer_info info() const {
    Call c(counts_);
    auto info = make<hf_transfer_info>();
    check(hf_transfer_get_info(get(), &info));
    return info;
  }

  // Writes the statistics of a transfer.
  hf_transfer_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_transfer_statistics>();
    check(hf_transfer_get_statistics(get(), &statistics));
    return statistics;
  }

  // Sets the dials of a transfer for the next frames.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
  void set_dials(const TransferDials& options = {}) {
    Call c(counts_);
    const hf_transfer_dials desc = options.fill(c, "");
    check(hf_transfer_set_dials(get(), &desc));
  }

  // Writes the dials; stride is never 0.
  hf_transfer_dials dials() const {
    Call c(counts_);
    auto dials = make<hf_transfer_dials>();
    check(hf_transfer_get_dials(get(), &dials));
    return dials;
  }

  // Names the rigid pieces of the target, such as a sword. A piece is an edge-connected part of the mesh. Each frame
  // moves a rigid piece by the rigid motion that fits the piece best, as Pose::set_rigid_pieces does. This fit is the
  // last step of a frame. So a hold on a part of a rigid piece may miss its position, and a rigid piece may sink into
  // the ground.
  //
  // vertices: `[vertex_count]`, one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
  // replaces the previous list and applies from the next frame on. The call does not factorise.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  void set_rigid_pieces(const std::vector<uint32_t>& vertices) {
    Call c(counts_);
    c.sizes.erase("vertex_count");  // of the list given here
    const uint32_t* vertices_ = c.array(vertices, true, "vertices", {"vertex_count"});
    check(hf_transfer_set_rigid_pieces(get(), c.count("vertex_count", 1), vertices_));
  }

  // Transfers one posed frame. If the source is at rest, the target is at rest too. If a limb's rest directions differ
  // much on the two surfaces (hf_pair_info), it takes the direction of the source's limb instead, by a share.
  //
  // The bits of a frame depend on the pairs, in the order of their numbers, on the dials and on this desc alone.
  // Removed pairs and earlier frames have no effect, so a scrubbed timeline and a played one give the same frames, bit
  // for bit. The result changes as little as the source does: a source that stands still except for noise gives a
  // target that stands still.
  //
  // The ground counts too if the mode is HF_TRANSFER_FIELDS and some pairs are anchors (their target region follows the
  // path of the source's region). While a foot of the source stands on the ground, the target's foot follows its scaled
  // path exactly. No vertex of the target sinks deeper into the ground than the source, scaled, except the vertices of
  // Transfer::sinking. A part that would sink bends up. The ground does not move regions that you hold. A lying target
  // rests on the parts that the source rests on. A rigid motion of the whole source is copied unchanged. All rules of
  // the ground come in continuously. The ground is under the feet of each body at rest, and what hangs lower is none: a
  // cape, a tail, scenery. Without feet, or where the trunk is below them, it is the lowest vertex. HF_GROUND_OFF
  // switches it off.
  //
  // source_positions: `[source.vertex_count x 3]` of float or double: the posed source, its own vertex order
  // out: `[target.vertex_count x 3]` of float or double
  // target_normals: `[target.vertex_count x 3]` of float or double
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_NOT_FOUND, HF_ERROR_TOO_LARGE,
  // HF_ERROR_UNSUPPORTED.
  std::vector<float> apply(const Reals& source_positions, const TransferFrame& options = {},
      std::vector<float>* target_normals = nullptr) {
    Call c(counts_);
    std::vector<float> out(c.product({"target.vertex_count", "3"}));
    apply_into(source_positions, out.data(), out.size(), options, target_normals);
    return out;
  }

  // The same in double.
  std::vector<double> apply_f64(const Reals& source_positions, const TransferFrame& options = {},
      std::vector<float>* target_normals = nullptr) {
    Call c(counts_);
    std::vector<double> out(c.product({"target.vertex_count", "3"}));
    apply_into(source_positions, out.data(), out.size(), options, target_normals);
    return out;
  }

  // As apply, into memory of yours.
  void apply_into(const Reals& source_positions, float* out, size_t size, const TransferFrame& options = {},
      std::vector<float>* target_normals = nullptr) {
    Call c(counts_);
    hf_transfer_frame desc = options.fill(c, "", source_positions);
    need(size, c.product({"target.vertex_count", "3"}), "out");
    desc.target_positions = c.out(out, "target.vertex_count");
    if (target_normals) target_normals->resize(c.product({"target.vertex_count", "3"}));
    float* target_normals_at = target_normals ? target_normals->data() : nullptr;
    desc.target_normals = c.out(target_normals_at, "target.vertex_count");
    check(hf_transfer_apply(get(), &desc));
  }

  // As apply, into memory of yours.
  void apply_into(const Reals& source_positions, double* out, size_t size, const TransferFrame& options = {},
      std::vector<float>* target_normals = nullptr) {
    Call c(counts_);
    hf_transfer_frame desc = options.fill(c, "", source_positions);
    need(size, c.product({"target.vertex_count", "3"}), "out");
    desc.target_positions = c.out(out, "target.vertex_count");
    if (target_normals) target_normals->resize(c.product({"target.vertex_count", "3"}));
    float* target_normals_at = target_normals ? target_normals->data() : nullptr;
    desc.target_normals = c.out(target_normals_at, "target.vertex_count");
    check(hf_transfer_apply(get(), &desc));
  }

  // Writes which target vertices may sink into the ground.
  //
  // Fails with HF_ERROR_EMPTY.
  std::vector<uint8_t> sinking() const {
    Call c(counts_);
    std::vector<uint8_t> sinking(c.product({"target.vertex_count"}));
    check(hf_transfer_get_sinking(get(), sinking.data()));
    return sinking;
  }

  // Writes the transfer as a skin (hf/pose.h), with the motion of the last frame. With influence_count 4 the skin
  // replays Transfer::apply exactly, because that function also uses the four largest weights. Each rigid piece is one
  // joint. These joints come after the joints of clusters.
  //
  // influence_count: joints per vertex, 4 or 8; 0 = 4
  // scales: `[joint_capacity x 3]` along the axes in the last frame; none = joints are rigid
  //
  // Fails with HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED.
  SkinInfo skin(uint32_t influence_count = 0, bool want_scales = false) const {
    Call c(counts_);
    auto skin = make<hf_skin_info>();
    skin.influence_count = influence_count;
    c.known("influence_count", influence_count ? influence_count : 4);
    c.sizes["joint_capacity"] = c.count("joint_count", Call::kFirst);
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    SkinInfo found;
    for (bool done = false; !done;) {
      skin.joint_capacity = c.count("joint_capacity", 0);
      skin.vertex_capacity = c.count("vertex_capacity", 0);
      skin.pivots = c.room(found.pivots, {"joint_capacity", "3"});
      skin.rotations = c.room(found.rotations, {"joint_capacity", "4"});
      skin.translations = c.room(found.translations, {"joint_capacity", "3"});
      skin.axes = c.room(found.axes, {"joint_capacity", "4"});
      skin.scales = want_scales ? c.room(found.scales, {"joint_capacity", "3"}) : nullptr;
      skin.vertex_joints = c.room(found.vertex_joints, {"vertex_capacity", "influence_count"});
      skin.vertex_weights = c.room(found.vertex_weights, {"vertex_capacity", "influence_count"});
      const hf_result code = hf_transfer_get_skin(get(), &skin);
      done = c.enough(code, {{"joint_capacity", skin.joint_count}, {"vertex_capacity", skin.vertex_count}});
    }
    found.pivots.resize(c.product({"joint_capacity", "3"}));
    found.rotations.resize(c.product({"joint_capacity", "4"}));
    found.translations.resize(c.product({"joint_capacity", "3"}));
    found.axes.resize(c.product({"joint_capacity", "4"}));
    if (want_scales) found.scales.resize(c.product({"joint_capacity", "3"}));
    found.vertex_joints.resize(c.product({"vertex_capacity", "influence_count"}));
    found.vertex_weights.resize(c.product({"vertex_capacity", "influence_count"}));
    found.influence_count = skin.influence_count;
    return found;
  }

  // With the struct of C.
  Transfer(const Surface& source, const Surface& target, const hf_transfer_desc& desc) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.get(), target.get(), &desc, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // With the struct of C.
  void set_dials(const hf_transfer_dials& desc) { check(hf_transfer_set_dials(get(), &desc)); }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_transfer get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  void own(hf_transfer raw, Counts counts) {
    handle_ = Handle<hf_transfer, hf_transfer_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_transfer, hf_transfer_destroy> handle_;
  Counts counts_;
};

// The weights of one surface for one skeleton.
class Weights {
 public:
  // Computes weights.
  //
  // influence_count: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it has none, it
  // is made now. Sets *weights to none first.
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_UNSUPPORTED.
  Weights(const Surface& surface, const Joints& options = {}, uint32_t influence_count = 0) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_joints_desc desc = options.fill(c, "");
    c.known("influence_count", influence_count ? influence_count : 4);
    hf_weights raw = nullptr;
    check(hf_weights_create(surface.get(), &desc, influence_count, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // Copies the weights with joints, pins and locks. The copy shares the factors and all memory, until one of the two is
  // changed. For undo, keep copies: one before each change.
  Weights clone() const {
    Call c(counts_);
    hf_weights raw = nullptr;
    check(hf_weights_clone(get(), &raw));
    return Weights(raw, c.counts({"vertex_count"}));
  }

  // Replaces all
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT,
  // HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_UNSUPPORTED.
  void set_joints(const Joints& options = {}) {
    Call c(counts_);
    const hf_joints_desc desc = options.fill(c, "");
    check(hf_weights_set_joints(get(), &desc));
  }

  // Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices of a disc.
  // Pins at the same places with other weights cost no path.
  //
  // vertices: `[pin_count]` vertices of your mesh, or none
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_CONFLICT, HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT,
  // HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE.
  void set_pins(const std::vector<uint32_t>& vertices = {}, const Pins& options = {}) {
    Call c(counts_);
    const hf_pins_desc desc = options.fill(c, "", vertices);
    check(hf_weights_set_pins(get(), &desc));
  }

  // Locks joints: their weights stay, and the other joints share the rest. Replaces all locks; lock_count 0 unlocks.
  //
  // joints: `[lock_count]`.
  // values: `[vertex_count x lock_count]` weights to keep, 0 to 1, or none for the present ones. Welded copies take the
  // values of the first. Pinned vertices keep the weights of their pins.
  //
  // Fails with HF_ERROR_DUPLICATE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE, HF_ERROR_OUT_OF_RANGE.
  void set_locks(const std::vector<uint32_t>& joints, const std::vector<float>& values = {}) {
    Call c(counts_);
    const uint32_t* joints_ = c.array(joints, true, "joints", {"lock_count"});
    const float* values_ = c.array(values, false, "values", {"vertex_count", "lock_count"});
    check(hf_weights_set_locks(get(), c.count("lock_count", 1), joints_, values_));
  }

  // Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first joint of the
  // vertex.
  //
  // Fails with HF_ERROR_TOO_LARGE.
  WeightsOut weights() const {
    Call c(counts_);
    auto weights = make<hf_weights_out>();
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    WeightsOut found;
    for (bool done = false; !done;) {
      weights.vertex_capacity = c.count("vertex_capacity", 0);
      weights.joints = c.room(found.joints, {"vertex_capacity", "influence_count"});
      weights.weights = c.room(found.weights, {"vertex_capacity", "influence_count"});
      weights.origins = c.room(found.origins, {"vertex_capacity"});
      const hf_result code = hf_weights_get(get(), &weights);
      done = c.enough(code, {{"vertex_capacity", weights.vertex_count}, {"influence_count", weights.influence_count}});
    }
    found.joints.resize(c.product({"vertex_capacity", "influence_count"}));
    found.weights.resize(c.product({"vertex_capacity", "influence_count"}));
    found.origins.resize(c.product({"vertex_capacity"}));
    found.influence_count = weights.influence_count;
    return found;
  }

  // Writes the flags of each joint, and how many vertices have a constraint for it. Joints that do not deform have no
  // flags.
  std::tuple<std::vector<uint32_t>, std::vector<uint32_t>> joints() const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> flags;
    std::vector<uint32_t> vertex_counts;
    for (bool done = false; !done;) {
      auto* flags_at = c.room(flags, {"capacity"});
      auto* vertex_counts_at = c.room(vertex_counts, {"capacity"});
      const hf_result code = hf_weights_get_joints(get(), c.count("capacity", 0), flags_at, vertex_counts_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    flags.resize(c.product({"capacity"}));
    vertex_counts.resize(c.product({"capacity"}));
    return {std::move(flags), std::move(vertex_counts)};
  }

  // Writes the info.
  hf_weights_info info() const {
    Call c(counts_);
    auto info = make<hf_weights_info>();
    check(hf_weights_get_info(get(), &info));
    return info;
  }

  // Writes the statistics.
  hf_weights_statistics statistics() const {
    Call c(counts_);
    auto statistics = make<hf_weights_statistics>();
    check(hf_weights_get_statistics(get(), &statistics));
    return statistics;
  }

  // Proposes joints that should not deform, and says why. The weights do not change: to follow a proposal, set deforms
  // to 0.
  //
  // names: one line for each joint in UTF-8, or none.
  //
  // Fails with HF_ERROR_INVALID_ARGUMENT.
  std::vector<uint32_t> helpers(const std::vector<std::string>& names = {}) const {
    Call c(counts_);
    uint32_t count = 0;
    c.sizes["capacity"] = Call::kFirst;
    std::vector<uint32_t> reasons;
    for (bool done = false; !done;) {
      auto* reasons_at = c.room(reasons, {"capacity"});
      const hf_result code = hf_weights_get_helpers(get(), c.text(names), c.count("capacity", 0), reasons_at, &count);
      done = c.enough(code, {{"capacity", count}});
    }
    reasons.resize(c.product({"capacity"}));
    return reasons;
  }

  // Transfers weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand in the
  // same frame. A vertex gets the weights of the nearest point of the source whose normal agrees. One bi-harmonic field
  // fills in the vertices without such a point. A piece without any takes the weights of the nearest points.
  //
  // info: filled in when given
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.
  static WeightsOut transfer(const Surface& source, const Surface& target, const WeightsTransferOptions& options = {},
      hf_weights_transfer_info* info = nullptr) {
    Call c;
    c.parent("source", source.known_counts());
    c.parent("target", target.known_counts());
    const hf_weights_transfer_desc desc = options.fill(c, "");
    auto weights_ = make<hf_weights_out>();
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    WeightsOut found;
    for (bool done = false; !done;) {
      weights_.vertex_capacity = c.count("vertex_capacity", 0);
      weights_.joints = c.room(found.joints, {"vertex_capacity", "influence_count"});
      weights_.weights = c.room(found.weights, {"vertex_capacity", "influence_count"});
      weights_.origins = c.room(found.origins, {"vertex_capacity"});
      const hf_result code = hf_weights_transfer(source.get(), target.get(), &desc, &weights_, info);
      done = c.enough(code, {{"vertex_capacity", weights_.vertex_count}, {"influence_count",
          weights_.influence_count}});
    }
    found.joints.resize(c.product({"vertex_capacity", "influence_count"}));
    found.weights.resize(c.product({"vertex_capacity", "influence_count"}));
    found.origins.resize(c.product({"vertex_capacity"}));
    found.influence_count = weights_.influence_count;
    return found;
  }

  // Mirrors the weights of one side to the other. The mesh need not be symmetric. A vertex gets the weights of the
  // nearest point to its reflection whose normal agrees, with the joints of the other side. One bi-harmonic field fills
  // in the rest. The plane comes from joints with partners, else from the surface. The largest component of a found
  // normal is positive. So for a normal along x, HF_MIRROR_TO_NEGATIVE copies from +x to -x.
  //
  // info: filled in when given
  // statistics: filled in when given
  //
  // Fails with HF_ERROR_CANCELLED, HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
  // HF_ERROR_OUT_OF_RANGE, HF_ERROR_TOO_LARGE, HF_ERROR_TOO_SMALL, HF_ERROR_UNSUPPORTED.
  static std::tuple<WeightsOut, std::vector<uint32_t>, std::vector<uint32_t>> mirror(const Surface& surface,
      const WeightsMirrorOptions& options = {}, hf_weights_mirror_info* info = nullptr,
      hf_weights_mirror_statistics* statistics = nullptr) {
    Call c;
    c.parent("surface", surface.known_counts());
    const hf_weights_mirror_desc desc = options.fill(c, "");
    auto weights_ = make<hf_weights_out>();
    std::vector<uint32_t> partners_(c.product({"joint_count"}));
    std::vector<uint32_t> pairings(c.product({"joint_count"}));
    c.sizes["vertex_capacity"] = c.count("vertex_count", Call::kFirst);
    WeightsOut found;
    for (bool done = false; !done;) {
      weights_.vertex_capacity = c.count("vertex_capacity", 0);
      weights_.joints = c.room(found.joints, {"vertex_capacity", "influence_count"});
      weights_.weights = c.room(found.weights, {"vertex_capacity", "influence_count"});
      weights_.origins = c.room(found.origins, {"vertex_capacity"});
      const hf_result code = hf_weights_mirror(surface.get(), &desc, &weights_, partners_.data(), pairings.data(), info,
          statistics);
      done = c.enough(code, {{"vertex_capacity", weights_.vertex_count}, {"influence_count",
          weights_.influence_count}});
    }
    found.joints.resize(c.product({"vertex_capacity", "influence_count"}));
    found.weights.resize(c.product({"vertex_capacity", "influence_count"}));
    found.origins.resize(c.product({"vertex_capacity"}));
    found.influence_count = weights_.influence_count;
    return {std::move(found), std::move(partners_), std::move(pairings)};
  }

  // With the struct of C.
  Weights(const Surface& surface, const hf_joints_desc& desc, uint32_t influence_count = 0) {
    Call c;
    c.parent("surface", surface.known_counts());
    hf_weights raw = nullptr;
    check(hf_weights_create(surface.get(), &desc, influence_count, &raw));
    own(raw, c.counts({"vertex_count"}));
  }

  // With the struct of C.
  void set_joints(const hf_joints_desc& desc) { check(hf_weights_set_joints(get(), &desc)); }

  // With the struct of C.
  void set_pins(const hf_pins_desc& desc) { check(hf_weights_set_pins(get(), &desc)); }

  uint32_t vertex_count() const noexcept { return known(counts_, "vertex_count"); }

  hf_weights get() const noexcept { return handle_.get(); }
  const Counts& known_counts() const noexcept { return counts_; }

 private:
  Weights(hf_weights raw, Counts counts) : handle_(raw), counts_(std::move(counts)) {}
  void own(hf_weights raw, Counts counts) {
    handle_ = Handle<hf_weights, hf_weights_destroy>(raw);
    counts_ = std::move(counts);
  }
  Handle<hf_weights, hf_weights_destroy> handle_;
  Counts counts_;
};

inline hf_factor_desc Factor::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_factor_desc>();
  desc.bytes = bytes.empty() ? nullptr : bytes.data();
  desc.byte_count = bytes.size();
  return desc;
}

inline hf_links_desc Links::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_links_desc>();
  desc.mode = mode;
  desc.distance = distance;
  desc.stiffness = stiffness;
  desc.overlay_distance = overlay_distance;
  desc.joints = c.array(joints, false, "joints", {"vertex_count", prefix + "influence_count"});
  desc.weights = c.array(weights, false, "weights", {"vertex_count", prefix + "influence_count"});
  desc.joint_parents = c.array(joint_parents, false, "joint_parents", {prefix + "joint_count"});
  desc.tags = c.array(tags, false, "tags", {"vertex_count"});
  desc.links = c.array(links, false, "links", {prefix + "link_count"});
  desc.light_vertices = c.array(light_vertices, false, "light_vertices", {prefix + "light_count"});
  desc.heavy_vertices = c.array(heavy_vertices, false, "heavy_vertices", {prefix + "heavy_count"});
  desc.influence_count = c.count(prefix + "influence_count", 0);
  desc.link_count = c.count(prefix + "link_count", 0);
  desc.light_count = c.count(prefix + "light_count", 0);
  desc.heavy_count = c.count(prefix + "heavy_count", 0);
  desc.joint_count = c.count(prefix + "joint_count", 0);
  return desc;
}

inline hf_faces_desc Faces::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_faces_desc>();
  desc.corners = c.view(corners, false, "corners", {"corner_count"});
  desc.sizes = c.view(sizes, false, "sizes", {"faces"});
  desc.starts = c.view(starts, false, "starts", sizes.empty() ? Dims{"faces + 1"} : Dims{"faces"});
  return desc;
}

inline hf_surface_desc SurfaceOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const Reals& positions, const Indices& triangles) const {
  auto desc = make<hf_surface_desc>();
  desc.weld = weld;
  desc.weld_tolerance = weld_tolerance;
  desc.operator_kind = operator_kind;
  desc.field_kind = field_kind;
  desc.ordering = ordering;
  desc.thread_count = thread_count;
  desc.vertex_limit = vertex_limit;
  desc.triangle_limit = triangle_limit;
  desc.memory_limit_mb = memory_limit_mb;
  desc.work_limit_gflop = work_limit_gflop;
  desc.positions = c.view(positions, true, "positions", {"vertex_count", "3"});
  desc.triangles = c.view(triangles, true, "triangles", {"triangle_count", "3"});
  desc.progress = progress ? progress->get() : nullptr;
  if (faces) desc.faces = c.keep(faces->fill(c, "faces."));
  if (saved_factor) desc.saved_factor = c.keep(saved_factor->fill(c, "saved_factor."));
  if (links) desc.links = c.keep(links->fill(c, "links."));
  return desc;
}

inline hf_graph_desc GraphOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const Indices& edges, const Reals& weights) const {
  auto desc = make<hf_graph_desc>();
  desc.vertex_count = vertex_count;
  desc.allow_negative = allow_negative ? 1 : 0;
  desc.field_kind = field_kind;
  desc.ordering = ordering;
  desc.thread_count = thread_count;
  desc.vertex_limit = vertex_limit;
  desc.edge_limit = edge_limit;
  desc.memory_limit_mb = memory_limit_mb;
  desc.work_limit_gflop = work_limit_gflop;
  c.known("vertex_count", vertex_count);
  desc.edges = c.view(edges, true, "edges", {"edge_count", "2"});
  desc.weights = c.view(weights, true, "weights", {"edge_count"});
  desc.masses = c.view(masses, false, "masses", {"vertex_count"});
  desc.progress = progress ? progress->get() : nullptr;
  if (saved_factor) desc.saved_factor = c.keep(saved_factor->fill(c, "saved_factor."));
  return desc;
}

inline hf_patch_desc Patch::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_patch_desc>();
  desc.removed_triangles = c.array(removed_triangles, false, "removed_triangles", {prefix + "removed_triangle_count"});
  desc.new_positions = c.array(new_positions, false, "new_positions", {prefix + "new_vertex_count", "3"});
  desc.new_triangles = c.array(new_triangles, false, "new_triangles", {prefix + "new_triangle_count", "3"});
  desc.cut_edges = c.array(cut_edges, false, "cut_edges", {prefix + "cut_edge_count", "2"});
  desc.removed_triangle_count = c.count(prefix + "removed_triangle_count", 0);
  desc.new_vertex_count = c.count(prefix + "new_vertex_count", 0);
  desc.new_triangle_count = c.count(prefix + "new_triangle_count", 0);
  desc.cut_edge_count = c.count(prefix + "cut_edge_count", 0);
  return desc;
}

inline hf_surface_edit_desc SurfaceEdit::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_surface_edit_desc>();
  desc.vertices = c.array(vertices, false, "vertices", {prefix + "vertex_count"});
  desc.stiffness = c.array(stiffness, false, "stiffness", {prefix + "vertex_count"});
  desc.links = c.array(links, false, "links", {prefix + "link_count"});
  desc.removed_links = c.array(removed_links, false, "removed_links", {prefix + "removed_link_count"});
  desc.progress = progress ? progress->get() : nullptr;
  if (patch) desc.patch = c.keep(patch->fill(c, "patch."));
  desc.vertex_count = c.count(prefix + "vertex_count", 0);
  desc.link_count = c.count(prefix + "link_count", 0);
  desc.removed_link_count = c.count(prefix + "removed_link_count", 0);
  return desc;
}

inline hf_cut_desc CutOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_cut_desc>();
  desc.snap_share = snap_share;
  desc.crossing_limit = crossing_limit;
  desc.vertices = c.array(vertices, false, "vertices", {prefix + "point_count"});
  desc.places = c.array(places, false, "places", {prefix + "point_count"});
  desc.points = c.array(points, false, "points", {prefix + "point_count", "3"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.point_count = c.count(prefix + "point_count", 0);
  return desc;
}

inline hf_pick_desc PickOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_pick_desc>();
  desc.front_only = front_only ? 1 : 0;
  desc.positions = c.view(positions, false, "positions", {"vertex_count", "3"});
  return desc;
}

inline hf_solver_desc SolverOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_solver_desc>();
  desc.field_kind = field_kind;
  desc.channel_count = channel_count;
  desc.site_limit = site_limit;
  c.known("channel_count", channel_count ? channel_count : 1);
  desc.progress = progress ? progress->get() : nullptr;
  return desc;
}

inline hf_sites_desc Sites::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_sites_desc>();
  desc.vertices = c.array(vertices, false, "vertices", {prefix + "site_count"});
  desc.places = c.array(places, false, "places", {prefix + "site_count"});
  desc.points = c.array(points, false, "points", {prefix + "site_count", "3"});
  desc.values = c.array(values, false, "values", {prefix + "site_count", "channel_count"});
  desc.stiffness = c.array(stiffness, false, "stiffness", {prefix + "site_count"});
  desc.radii = c.array(radii, false, "radii", {prefix + "site_count"});
  desc.site_count = c.count(prefix + "site_count", 1);
  return desc;
}

inline hf_edit_desc Edit::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_edit_desc>();
  desc.remove_sites = c.array(remove_sites, false, "remove_sites", {prefix + "remove_count"});
  desc.move_sites = c.array(move_sites, false, "move_sites", {prefix + "move_count"});
  desc.set_sites = c.array(set_sites, false, "set_sites", {prefix + "set_count"});
  desc.set_values = c.array(set_values, false, "set_values", {prefix + "set_count", "channel_count"});
  if (move_to) desc.move_to = c.keep(move_to->fill(c, "move_to."));
  if (add) desc.add = c.keep(add->fill(c, "add."));
  desc.remove_count = c.count(prefix + "remove_count", 0);
  desc.move_count = c.count(prefix + "move_count", 0);
  desc.set_count = c.count(prefix + "set_count", 0);
  return desc;
}

inline hf_geodesics_desc GeodesicsOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_geodesics_desc>();
  desc.method = method;
  desc.smoothing = smoothing;
  desc.progress = progress ? progress->get() : nullptr;
  return desc;
}

inline hf_extremities_desc ExtremitiesOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_extremities_desc>();
  desc.kind = kind;
  desc.least_length_share = least_length_share;
  desc.source_count = source_count;
  c.known("source_count", source_count ? source_count : 40);
  desc.geodesics = geodesics ? geodesics->get() : nullptr;
  desc.progress = progress ? progress->get() : nullptr;
  return desc;
}

inline hf_direction_desc DirectionOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_direction_desc>();
  desc.degree = degree;
  desc.site_limit = site_limit;
  desc.progress = progress ? progress->get() : nullptr;
  return desc;
}

inline hf_pose_desc PoseOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_pose_desc>();
  desc.band_count = band_count;
  desc.iteration_count = iteration_count;
  desc.group_count = group_count;
  return desc;
}

inline hf_handles_desc HandlesOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const std::vector<std::vector<uint32_t>>& region_vertices) const {
  auto desc = make<hf_handles_desc>();
  desc.layer = layer;
  desc.in_place = in_place ? 1 : 0;
  desc.free_rotation = free_rotation ? 1 : 0;
  c.lists(region_vertices, false, &desc.region_counts, &desc.region_vertices, "region_vertices",
      {prefix + "handle_count"});
  desc.vertices = c.array(vertices, false, "vertices", {prefix + "handle_count"});
  desc.places = c.array(places, false, "places", {prefix + "handle_count"});
  desc.points = c.array(points, false, "points", {prefix + "handle_count", "3"});
  desc.radii = c.array(radii, false, "radii", {prefix + "handle_count"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.handle_count = c.count(prefix + "handle_count", 1);
  return desc;
}

inline hf_deform_desc DeformOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_deform_desc>();
  desc.iteration_count = iteration_count;
  desc.restart = restart ? 1 : 0;
  desc.refine = refine;
  desc.refine_from_last = refine_from_last ? 1 : 0;
  desc.first_vertex = first_vertex;
  desc.vertex_count = vertex_count;
  c.known("vertex_count", vertex_count);
  return desc;
}

inline hf_handle_proposals_desc HandleProposalsOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_handle_proposals_desc>();
  desc.least_length_share = least_length_share;
  desc.limit = limit;
  desc.joints = c.array(joints, false, "joints", {prefix + "joint_count", "3"});
  desc.parents = c.array(parents, false, "parents", {prefix + "joint_count"});
  if (up) std::copy(up->begin(), up->end(), desc.up);
  desc.skeleton = skeleton ? skeleton->get() : nullptr;
  desc.progress = progress ? progress->get() : nullptr;
  desc.joint_count = c.count(prefix + "joint_count", 0);
  return desc;
}

inline hf_quads_desc QuadsOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_quads_desc>();
  desc.face_count = face_count;
  desc.edge_length = edge_length;
  desc.crease_angle = crease_angle;
  desc.relax_count = relax_count;
  desc.crease_edges = c.array(crease_edges, false, "crease_edges", {prefix + "crease_count", "2"});
  desc.guide_vertices = c.array(guide_vertices, false, "guide_vertices", {prefix + "guide_count"});
  desc.guide_vectors = c.array(guide_vectors, false, "guide_vectors", {prefix + "guide_count", "3"});
  desc.guide_weights = c.array(guide_weights, false, "guide_weights", {prefix + "guide_count"});
  desc.irregular_points = c.array(irregular_points, false, "irregular_points", {prefix + "irregular_count", "3"});
  desc.irregular_valences = c.array(irregular_valences, false, "irregular_valences", {prefix + "irregular_count"});
  desc.irregular_directions = c.array(irregular_directions, false, "irregular_directions", {prefix + "irregular_count",
      "3"});
  if (symmetry_plane) std::copy(symmetry_plane->begin(), symmetry_plane->end(), desc.symmetry_plane);
  desc.progress = progress ? progress->get() : nullptr;
  desc.crease_count = c.count(prefix + "crease_count", 0);
  desc.guide_count = c.count(prefix + "guide_count", 0);
  desc.irregular_count = c.count(prefix + "irregular_count", 0);
  return desc;
}

inline hf_region_desc RegionOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_region_desc>();
  desc.base = base;
  desc.positions = c.view(positions, false, "positions", {"vertex_count", "3"});
  desc.progress = progress ? progress->get() : nullptr;
  return desc;
}

inline hf_curve_desc Curve::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_curve_desc>();
  desc.side = side;
  desc.seed_vertex = seed_vertex;
  desc.kind = kind;
  desc.vertices = c.array(vertices, false, "vertices", {prefix + "point_count"});
  desc.places = c.array(places, false, "places", {prefix + "point_count"});
  desc.points = c.array(points, false, "points", {prefix + "point_count", "3"});
  desc.point_count = c.count(prefix + "point_count", 0);
  return desc;
}

inline hf_region_edit_desc RegionEditOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_region_edit_desc>();
  desc.ring_count = ring_count;
  desc.remove_vertices = c.array(remove_vertices, false, "remove_vertices", {prefix + "remove_count"});
  desc.add_vertices = c.array(add_vertices, false, "add_vertices", {prefix + "add_count"});
  desc.progress = progress ? progress->get() : nullptr;
  if (curve) desc.curve = c.keep(curve->fill(c, "curve."));
  desc.remove_count = c.count(prefix + "remove_count", 0);
  desc.add_count = c.count(prefix + "add_count", 0);
  return desc;
}

inline hf_morph_desc MorphOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    double weight) const {
  auto desc = make<hf_morph_desc>();
  desc.weight = weight;
  return desc;
}

inline hf_detail_desc DetailOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_detail_desc>();
  desc.scale = scale;
  desc.source_vertices = c.array(source_vertices, false, "source_vertices", {prefix + "pair_count"});
  desc.target_vertices = c.array(target_vertices, false, "target_vertices", {prefix + "pair_count"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.pair_count = c.count(prefix + "pair_count", 0);
  return desc;
}

inline hf_retarget_desc RetargetOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_retarget_desc>();
  desc.root_motion = root_motion;
  desc.leave_out = leave_out;
  desc.scale = scale;
  desc.source_rest = c.array(source_rest, false, "source_rest", {"source.joint_count", "10"});
  desc.target_rest = c.array(target_rest, false, "target_rest", {"target.joint_count", "10"});
  if (ground_velocity) std::copy(ground_velocity->begin(), ground_velocity->end(), desc.ground_velocity);
  desc.progress = progress ? progress->get() : nullptr;
  return desc;
}

inline hf_skin_desc Skin::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_skin_desc>();
  desc.at_rest = at_rest ? 1 : 0;
  desc.positions = c.array(positions, false, "positions", {prefix + "vertex_count", "3"});
  desc.triangles = c.array(triangles, false, "triangles", {prefix + "triangle_count", "3"});
  desc.joints = c.array(joints, false, "joints", {prefix + "vertex_count", prefix + "influence_count"});
  desc.weights = c.array(weights, false, "weights", {prefix + "vertex_count", prefix + "influence_count"});
  desc.vertex_count = c.count(prefix + "vertex_count", 0);
  desc.triangle_count = c.count(prefix + "triangle_count", 0);
  desc.influence_count = c.count(prefix + "influence_count", 0);
  return desc;
}

inline hf_skeleton_desc SkeletonOptions::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const std::vector<std::string>& names, const std::vector<uint32_t>& parents, const std::vector<float>& rest) const {
  auto desc = make<hf_skeleton_desc>();
  desc.parents = c.array(parents, true, "parents", {prefix + "joint_count"});
  desc.rest = c.array(rest, true, "rest", {prefix + "joint_count", "10"});
  desc.inverse_binds = c.array(inverse_binds, false, "inverse_binds", {prefix + "joint_count", "16"});
  desc.up = c.array(up, false, "up", {"3"});
  desc.forward = c.array(forward, false, "forward", {"3"});
  desc.roles = c.array(roles, false, "roles", {prefix + "joint_count"});
  desc.sides = c.array(sides, false, "sides", {prefix + "joint_count"});
  desc.travels = c.array(travels, false, "travels", {prefix + "travel_count", "3"});
  desc.names = c.text(names);
  desc.progress = progress ? progress->get() : nullptr;
  if (skin) desc.skin = c.keep(skin->fill(c, "skin."));
  desc.joint_count = c.count(prefix + "joint_count", 0);
  desc.travel_count = c.count(prefix + "travel_count", 0);
  return desc;
}

inline hf_transfer_desc TransferOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_transfer_desc>();
  desc.mode = mode;
  desc.cluster_count = cluster_count;
  desc.ground = ground;
  desc.kernel_width = kernel_width;
  desc.scale = scale;
  desc.alignment_angle = alignment_angle;
  desc.source_rest = c.view(source_rest, false, "source_rest", {"source.vertex_count", "3"});
  desc.target_rest = c.view(target_rest, false, "target_rest", {"target.vertex_count", "3"});
  if (source_axes) std::copy(source_axes->begin(), source_axes->end(), desc.source_axes);
  if (target_axes) std::copy(target_axes->begin(), target_axes->end(), desc.target_axes);
  return desc;
}

inline hf_pairs_desc Pairs::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const std::vector<std::vector<uint32_t>>& source_vertices,
    const std::vector<std::vector<uint32_t>>& target_vertices, const std::vector<uint32_t>& flags) const {
  auto desc = make<hf_pairs_desc>();
  c.lists(source_vertices, true, &desc.source_counts, &desc.source_vertices, "source_vertices",
      {prefix + "pair_count"});
  c.lists(target_vertices, true, &desc.target_counts, &desc.target_vertices, "target_vertices",
      {prefix + "pair_count"});
  desc.flags = c.array(flags, false, "flags", {prefix + "pair_count"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.pair_count = c.count(prefix + "pair_count", 1);
  return desc;
}

inline hf_transfer_dials TransferDials::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_transfer_dials>();
  desc.stride = stride;
  desc.hip_height_share = hip_height_share;
  desc.neck_follow = neck_follow;
  desc.tail_follow = tail_follow;
  desc.arm_space = arm_space;
  desc.long_follow = long_follow;
  return desc;
}

inline hf_transfer_frame TransferFrame::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const Reals& source_positions) const {
  auto desc = make<hf_transfer_frame>();
  desc.source_positions = c.view(source_positions, true, "source_positions", {"source.vertex_count", "3"});
  desc.hold_pairs = c.array(hold_pairs, false, "hold_pairs", {prefix + "hold_count"});
  desc.hold_positions = c.array(hold_positions, false, "hold_positions", {prefix + "hold_count", "3"});
  desc.hold_count = c.count(prefix + "hold_count", 0);
  return desc;
}

inline hf_joints_desc Joints::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_joints_desc>();
  desc.heads = c.array(heads, false, "heads", {prefix + "joint_count", "3"});
  desc.tails = c.array(tails, false, "tails", {prefix + "joint_count", "3"});
  desc.axes = c.array(axes, false, "axes", {prefix + "joint_count", "3"});
  desc.parents = c.array(parents, false, "parents", {prefix + "joint_count"});
  desc.deforms = c.array(deforms, false, "deforms", {prefix + "joint_count"});
  desc.sources = c.array(sources, false, "sources", {prefix + "joint_count"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.joint_count = c.count(prefix + "joint_count", 0);
  return desc;
}

inline hf_pins_desc Pins::fill([[maybe_unused]] Call& c, [[maybe_unused]] const std::string& prefix,
    const std::vector<uint32_t>& vertices) const {
  auto desc = make<hf_pins_desc>();
  desc.vertices = c.array(vertices, false, "vertices", {prefix + "pin_count"});
  desc.places = c.array(places, false, "places", {prefix + "pin_count"});
  desc.points = c.array(points, false, "points", {prefix + "pin_count", "3"});
  desc.radii = c.array(radii, false, "radii", {prefix + "pin_count"});
  desc.joints = c.array(joints, false, "joints", {prefix + "pin_count", prefix + "influence_count"});
  desc.weights = c.array(weights, false, "weights", {prefix + "pin_count", prefix + "influence_count"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.pin_count = c.count(prefix + "pin_count", 0);
  desc.influence_count = c.count(prefix + "influence_count", 0);
  return desc;
}

inline hf_weights_transfer_desc WeightsTransferOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_weights_transfer_desc>();
  desc.distance = distance;
  desc.angle = angle;
  desc.influence_count = influence_count;
  c.known("influence_count", influence_count ? influence_count : 4);
  desc.joints = c.array(joints, false, "joints", {"source.vertex_count", prefix + "source_influence_count"});
  desc.weights = c.array(weights, false, "weights", {"source.vertex_count", prefix + "source_influence_count"});
  desc.progress = progress ? progress->get() : nullptr;
  desc.source_influence_count = c.count(prefix + "source_influence_count", 0);
  return desc;
}

inline hf_weights_mirror_desc WeightsMirrorOptions::fill([[maybe_unused]] Call& c,
    [[maybe_unused]] const std::string& prefix) const {
  auto desc = make<hf_weights_mirror_desc>();
  desc.to = to;
  desc.distance = distance;
  desc.angle = angle;
  desc.influence_count = influence_count;
  c.known("influence_count", influence_count ? influence_count : 4);
  desc.heads = c.array(heads, false, "heads", {prefix + "joint_count", "3"});
  desc.partners = c.array(partners, false, "partners", {prefix + "joint_count"});
  desc.plane = c.array(plane, false, "plane", {"6"});
  desc.joints = c.array(joints, false, "joints", {"vertex_count", prefix + "source_influence_count"});
  desc.weights = c.array(weights, false, "weights", {"vertex_count", prefix + "source_influence_count"});
  desc.names = c.text(names);
  desc.progress = progress ? progress->get() : nullptr;
  desc.joint_count = c.count(prefix + "joint_count", 0);
  desc.source_influence_count = c.count(prefix + "source_influence_count", 0);
  return desc;
}

}  // namespace hf

#endif
