// A pose: handles on one surface, which can be added and removed, and the deformation that follows them. The object
// behind hf_pose_* and hf_deform.
//
// A Layout holds what depends only on the handles' regions: sites, fields, cluster weights and the reduced system. It
// is immutable and shared by clones. A State changes every frame. From the transforms of the handles it computes the
// transforms of the clusters, then vertices and normals.
//
// After an exception the pose is as before. Repeated deform() calls allocate nothing. Results do not depend on the
// number of threads. If handles are added and then removed again, layout and solver state are restored bit for bit; the
// pose keeps the layout before the last change for this.
#pragma once
#include <cstdint>
#include <memory>

#include "deform/blend_box.h"
#include "deform/crossfade.h"
#include "deform/limbs.h"
#include "deform/normals.h"
#include "deform/pose_scheme.h"
#include "deform/pose_solver.h"
#include "deform/refine.h"
#include "deform/rigid_pieces.h"

namespace hf_inner::deform {

// Options of a pose. Zeros mean defaults; hf_pose_desc gives the ranges.
struct PoseOptions {
  std::uint32_t band_count = 0;       // 2 to 64
  std::uint32_t iteration_count = 0;  // 1 to 1000
  std::uint32_t group_count = 0;      // 1 to 2000
  // The next two are of baselines alone.
  std::uint32_t rim_site_count = 0;          // sites per handle on its boundary ring; 0: all its vertices
  std::shared_ptr<const PoseScheme> scheme;  // null: the reduced energy of pose_solver.h
};

// The motion p -> rotation (p - centroid) + centroid + translation, in the unit of the caller's mesh. The quaternion
// need not be normalised. All zeros mean the identity.
struct HandleTransform {
  Quaternion rotation;
  Vec3 translation;
};

// Returns the motion p -> M p as a HandleTransform about the centroid. matrix: 16 numbers by columns. Throws
// HF_ERROR_NON_FINITE, or HF_ERROR_INVALID_ARGUMENT for a motion that is not rigid within rigid_tolerance; index:
// position.
HandleTransform rigid_transform(const double* matrix, Vec3 centroid, std::uint32_t position);

struct HandleKind {
  bool in_place = false;   // the handle starts on the posed surface
  bool free_turn = false;  // its rotation is part of the solve (free_turns.h)
};

struct HandleReport {
  std::uint32_t vertex_count = 0, site_count = 0, component = 0;
  Vec3 centroid;  // in the unit of the caller's mesh
  double leak = 0;
};

struct DeformRequest {
  bool normals = false;
  std::uint32_t iteration_count = 0;  // 0: the pose's own
  bool restart = false;               // forget the last pose, also full turns beyond 180 degrees
  std::uint32_t refine = 0;           // full-mesh steps on top (refine.h); need a second-order operator
  bool refine_from_last = false;      // the steps go on from the last frame's surface (Followed)
  bool surface = true;                // false: no vertices are written; ask blended() for those wanted
  float* packed_positions = nullptr;  // three per inner vertex, or null
  Normal* packed_normals = nullptr;   // per inner vertex, or null; if given, normals are written here
};

// Throws HF_ERROR_INVALID_ARGUMENT for an iteration_count above most_iterations.
void check_request(const DeformRequest& request);

struct DeformReport {
  Span<const Vec3> positions;     // per inner vertex, in the unit and frame of the caller's mesh
  Span<const Normal> normals;     // unit; empty when not asked for
  bool packed_positions = false;  // the request's packed_positions were written
  std::uint32_t iteration_count = 0, cluster_count = 0, unreached_vertex_count = 0;
  double last_change = 0, solve_ms = 0, blend_ms = 0, normal_ms = 0, refine_ms = 0;
};

class Pose {
 public:
  // core: one of harmonic fields that has its factor; the caller sees to it. Throws HF_ERROR_INVALID_ARGUMENT for
  // options out of range.
  static std::shared_ptr<Pose> make(std::shared_ptr<const surface::Core> core, const PoseOptions& options);
  std::shared_ptr<Pose> clone() const;

  // Adds handles at rest, or in place: the posed surface stays where it stands (crossfade.h). Region r holds
  // vertices[start[r] .. start[r + 1]), which are inner vertices; Mesh::none stands for an isolated vertex and is an
  // error. out_numbers: empty or one per region. Throws HF_ERROR_EMPTY, _OUT_OF_RANGE, _INVALID_ARGUMENT or _OVERLAP
  // (index: position in vertices), or _TOO_LARGE.
  void add_handles(Span<const std::uint32_t> start, Span<const std::int32_t> vertices, Span<std::uint32_t> out_numbers,
                   const HandleKind& kind = {});
  // Throws HF_ERROR_EMPTY or _NO_SUCH_HANDLE (index: position; also for a number named twice).
  void remove_handles(Span<const std::uint32_t> numbers);
  // Throws HF_ERROR_EMPTY, _NO_SUCH_HANDLE or _NON_FINITE (index: position). The rotation of a free handle is where the
  // next solve starts.
  void set_transforms(Span<const std::uint32_t> numbers, Span<const HandleTransform> transforms);

  // Frees the rotations of handles, or gives them: where they stand. With in_place the surface stays where it is, as
  // after add_handles. Throws HF_ERROR_EMPTY, _NO_SUCH_HANDLE (index: position), or HF_ERROR_UNSUPPORTED with a
  // scheme.
  void set_free_turns(Span<const std::uint32_t> numbers, bool free_turn, bool in_place = true);
  bool free_turn(std::uint32_t number) const;

  // Sets how much of the surface follows handles: 1 all of it, 0 their limbs (holds.h). Throws HF_ERROR_EMPTY,
  // _NO_SUCH_HANDLE (index: position), or HF_ERROR_UNSUPPORTED in the paper's mode.
  void set_following(Span<const std::uint32_t> numbers, double following);
  double following(std::uint32_t number) const;

  // Sets how many full-mesh steps every frame takes on the limbs of handles (limbs.h); 0: none. Throws HF_ERROR_EMPTY
  // or _NOT_FOUND (index: position).
  void set_limb_steps(Span<const std::uint32_t> numbers, std::uint32_t steps);
  std::uint32_t limb_steps(std::uint32_t number) const;
  bool keeps_limbs() const noexcept { return state_ && state_->limbs; }

  // Solves the pose and writes the surface. Throws HF_ERROR_EMPTY when the pose has no handle. The returned spans stay
  // valid until the next change of the pose.
  DeformReport deform(const DeformRequest& request);

  std::uint32_t handle_count() const noexcept;
  HandleReport handle(std::uint32_t number) const;              // HF_ERROR_NOT_FOUND
  FieldColumn<const double> field(std::uint32_t number) const;  // per inner vertex
  const surface::Core& core() const noexcept { return *core_; }
  const PoseOptions& options() const noexcept { return options_; }
  // The clusters (overlapping bands of vertices) as joints: their weights, and their transforms as of the last
  // deform(), in the unit of the scaled mesh. Null before the first handle is added.
  const ClusterWeights* weights() const noexcept;
  Span<const Affine> cluster_transforms() const noexcept;
  bool posed() const noexcept { return posed_; }  // transforms() holds a pose
  // The surface of the last frame is the blend of clusters plus this share of crossfade().offset. Needs a handle.
  double crossfade_share() const noexcept { return state_->crossfade ? state_->share : 0; }
  const Crossfade* crossfade() const noexcept { return state_->crossfade.get(); }
  // A box that holds the surface of that blend, isolated vertices included. Relative to the mesh's centre, in the unit
  // of the caller's mesh. Needs a handle.
  BlendBox blend_box() const noexcept;
  // Counts the changes of weights and offsets.
  std::uint32_t blend_revision() const noexcept { return blend_revision_; }

  // The pieces that every frame makes rigid; null: none.
  void set_rigid(std::shared_ptr<const RigidPieces> rigid);
  // Throws for regions that add_handles would refuse.
  void check_regions(Span<const std::uint32_t> start, Span<const std::int32_t> vertices) const;

  // Returns this pose on another core of the same mesh, with its handles and their transforms. rest: of that core.
  std::shared_ptr<Pose> on(std::shared_ptr<const surface::Core> core, std::shared_ptr<const Rest> rest) const;
  std::shared_ptr<const Rest> rest_on(const surface::Core& core) const;

  // ---- for layers of handles (pose_stack.h), whose poses must depend only on the arguments of these calls ----

  // Returns a pose without handles that shares the data prepared from the mesh.
  std::shared_ptr<Pose> without_handles() const;
  Span<const std::int32_t> region(std::uint32_t number) const;  // inner vertices
  std::uint32_t position_of(std::uint32_t number) const {
    return static_cast<std::uint32_t>(require(number, HF_NO_INDEX));
  }
  const Rest& rest() const noexcept { return *rest_; }
  HandleTransform transform(std::uint32_t number) const;                                        // as it was set
  Span<const Vec3> surface() const noexcept { return {positions_.data(), positions_.size()}; }  // of the last deform
  // Throws HF_ERROR_NON_FINITE with this index for a bad transform. scale: the mesh's scale.
  static void check_transform(const HandleTransform& transform, std::uint32_t index, double scale);
  // take_start() stores the rotations of the given surface (inner vertices, in the mesh's given frame) as the start of
  // deform_from(). prepare_start() allocates the memory for it; take_start() allocates nothing.
  void prepare_start();
  void take_start(Span<const Vec3> surface) noexcept;
  // Solves from the stored start of the pose `start`. It ignores what this pose solved before. turns: one rotation
  // vector per handle, in the order in which handles were added; the start is turned by them first. The bits depend
  // only on start, transforms, turns and request.
  DeformReport deform_from(const Pose& start, Span<const Vec3> turns, const DeformRequest& request);
  // The state that a frame changes, to restore when the frame fails. whole = false: only the tables that a frame makes
  // at its first use.
  struct Kept;
  std::shared_ptr<Kept> keep(bool whole);
  void put_back(Kept& kept) noexcept;
  // Returns one vertex of the last pose, in the unit and frame of the caller's mesh.
  Vec3 blended(std::int32_t vertex) const noexcept;

  Pose(std::shared_ptr<const surface::Core> core, const PoseOptions& options,
       std::shared_ptr<const Rest> rest);  // for make_owner_in; call make() instead

 private:
  struct Layout;
  struct HandleState {
    Quaternion rotation;  // as the caller set it
    Vec3 translation;     // in the unit of the scaled mesh
    Vec3 turn;            // rotation vector of the motion so far, with full turns
    Quaternion solved;    // rotation in the last solve
    Vec3 solved_turn;
    bool free_turn = false;        // the last solve found rotation and turn
    double following = 1;          // below 1: the rest of the surface is held back (holds.h)
    std::uint32_t limb_steps = 0;  // full-mesh steps on its limb (limbs.h)
  };
  struct State {
    explicit State(Memory& memory) : handles(&memory), transforms(&memory), smooth(memory) {}
    State(const State& other, Memory& memory)
        : handles(other.handles, &memory),
          transforms(other.transforms, &memory),
          columns(memory, other.columns.size()),
          smooth(other.smooth, memory),
          rigid(other.rigid ? other.rigid->clone(memory) : nullptr),
          started(other.started),
          changed(other.changed),
          stands(other.stands),
          share(other.share),
          last_change(other.last_change),
          idle_iterations(other.idle_iterations),
          crossfade(other.crossfade),
          limbs(other.limbs) {
      if (other.followed) followed = make_shared_in<Followed>(memory, *other.followed, memory);
      if (other.without) without = other.without->clone();
    }
    Vector<HandleState> handles;  // like Layout::handles
    Vector<Affine> transforms;    // per cluster (handle or overlapping band of vertices)
    Buffer<double> columns;       // scratch of the blend
    SmoothState smooth;
    std::shared_ptr<PoseScheme::State> rigid;  // null: without a scheme
    bool started = false;                      // a solved pose exists, from which to continue
    bool changed = true;                       // transforms or handles changed since the last solve
    bool stands = false;                       // handles were added in place, and none has moved since
    double share = 0;                          // of the offsets of the crossfade, in the last frame
    double last_change = 0;
    std::uint32_t idle_iterations = 0;           // iterations since the last change
    std::shared_ptr<const Crossfade> crossfade;  // null: the surface follows from the transforms
    std::shared_ptr<Followed> followed;          // null: full-mesh steps begin at the blended pose
    std::shared_ptr<const Limbs> limbs;          // null: no limb takes steps of its own
    std::shared_ptr<Pose> without;  // without the handles that are held back; null: nothing is, or rest is meant
  };

  Memory& memory() const noexcept { return *core_->memory; }
  std::int32_t find(std::uint32_t number) const noexcept;
  std::int32_t require(std::uint32_t number, std::uint32_t position) const;
  void check_free_turn(bool free_turn) const;
  std::shared_ptr<const Groups> meet(const Layout& layout) const;
  // sites: an engine that holds the handles of `present`.
  std::shared_ptr<const Layout> make_layout(const Handles& handles, std::shared_ptr<solve::SiteSolver> sites,
                                            const Handles& present,
                                            std::shared_ptr<solve::SiteSolver> plain_sites = nullptr) const;
  std::shared_ptr<const Layout> make_layout_on(const Handles& handles, const Layout& before,
                                               const surface::Core& from) const;
  std::shared_ptr<const Layout> make_layout(const Handles& handles) const;
  // Returns a state for `layout` (handles and the clusters they make). Handles and clusters of the present state keep
  // their motions, so the surface does not jump.
  std::shared_ptr<State> carry_over(const Layout& layout, bool free_turn = false) const;
  void prepare_turns(const Layout& layout, State& state) const;
  void prepare_holds(const Layout& layout, State& state) const;
  void prepare_limbs(const Layout& layout, State& state) const;
  bool pull_to_others(State& state, const DeformRequest& request) const;
  Vec3 carried(const State& state, std::size_t k) const noexcept;
  void approach(State& state) noexcept;
  void start_turns(State& state) const noexcept;
  void take_turns(State& state) const noexcept;
  void follow_turns(State& state, Span<Vec3> turns, bool whole) const noexcept;
  RigidMotion fit_region(const Handle& handle) const;
  void fit_new_handles(const Layout& layout, State& state) const;
  void keep_in_place(const Layout& layout, State& state, bool fades_at_rest);
  void place_handles(const Layout& layout, State& state) const noexcept;
  Span<const RigidMotion> placed(const State& state) const noexcept;
  double fade_crossfade() noexcept;
  void make_refinement(const Layout& layout, std::uint32_t steps, const Followed* followed);
  void refine(const Layout& layout, const State& state, std::uint32_t steps, const Limbs* limbs, Vec3* positions);
  void install(std::shared_ptr<const Layout> layout, std::shared_ptr<State> state) noexcept;
  bool restore_previous(const Handles& remaining);
  void solve_smooth(std::uint32_t iterations) noexcept;
  void solve_rigid(std::uint32_t iterations) noexcept;
  void prepare(const DeformRequest& request);
  void write_surface(const DeformRequest& request, DeformReport& report);
  void ensure_surface() const;
  void make_rigid() const noexcept;

  std::shared_ptr<const surface::Core> core_;
  PoseOptions options_;
  std::shared_ptr<const Rest> rest_;
  std::shared_ptr<const Groups> groups_;
  std::shared_ptr<const Layout> layout_;  // null: no handle
  std::shared_ptr<State> state_;
  std::shared_ptr<const Layout> previous_layout_;  // layout before the last handles were added
  std::shared_ptr<const State> previous_state_;
  std::shared_ptr<Pose> brought_;  // during a move to another core: the pose without the handles that are held back
  mutable Buffer<Vec3> positions_;
  std::shared_ptr<const RigidPieces> rigid_;
  mutable Buffer<Vec3> rigid_scratch_;
  Buffer<Normal> normals_;
  Buffer<NormalSum> normal_sums_;
  Buffer<Vec3> turns_;                  // scratch for handle_limit handles
  mutable Vector<RigidMotion> placed_;  // the same
  bool posed_ = false;                  // there is a last pose
  std::uint32_t refined_ = 0;           // full-mesh steps it had
  std::uint32_t blend_revision_ = 0;
  mutable bool stale_ = false;              // positions_ are older than the last pose, which only wrote transforms
  std::shared_ptr<Refinement> refinement_;  // made at the first refined frame
  GroupStart start_;
  SolveReport report_;
};

}  // namespace hf_inner::deform
