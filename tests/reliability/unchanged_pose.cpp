// Poses of both modes: handles on layers, transforms, frames, skins, clones.
#include <algorithm>
#include <cmath>

#include "support/arrays.h"
#include "support/peers.h"
#include "unchanged.h"

namespace unchanged {
namespace {

struct Handle {
  std::uint32_t number, layer;
  std::vector<std::uint32_t> region;  // empty: by a point
  double point[3] = {0, 0, 0}, radius = 0;
  hf_transform transform = {{0, 0, 0, 1}, {0, 0, 0}};
  bool free_rotation = false;
  double following = 1;
  std::int32_t limb_refine = 0;
  std::vector<std::uint32_t> rigid;  // of the pose when it was added: it took all of such a piece
  std::vector<double> matrix;        // 16 numbers instead of the transform, or none
};

struct PoseBranch {
  hf_pose handle = nullptr;
  std::vector<Handle> handles;       // in the order they were added
  std::vector<std::uint32_t> rigid;  // a vertex or more of each rigid piece
};

class Poses final : public Subject {
 public:
  Poses(World& given, Random& random) : Subject(given) {
    mode_ = random.pick({POSE_SMOOTH, POSE_SMOOTH, POSE_PAPER});
    desc_.band_count = random.pick({0u, 4u});
    desc_.iteration_count = random.pick({0u, 3u, 10u});
    rim_site_count_ = random.pick({0u, 0u, 3u});
    desc_.group_count = random.pick({0u, 20u});
    branches_.resize(1);
    if (create(&branches_[0].handle) != HF_OK) branches_.clear();
  }
  ~Poses() override {
    for (PoseBranch& b : branches_) hf_pose_destroy(b.handle);
  }
  bool ready() const { return !branches_.empty(); }

  void glance(State& state) override {
    for (const PoseBranch& b : branches_) {
      hf_pose_info info = HF_INIT(hf_pose_info);
      state.begin("info of a pose");
      state.add(hf_pose_get_info(b.handle, &info));
      add_struct(state, info);
      state.add(hf_pose_get_handle_count(b.handle));
    }
  }
  void look(State& state) override {
    for (const PoseBranch& b : branches_) {
      for (const Handle& h : b.handles) {
        hf_handle_info info = HF_INIT(hf_handle_info);
        std::vector<float> field(world.shape->vertices());
        state.begin("a handle");
        state.add(hf_pose_get_handle(b.handle, h.number, &info));
        add_struct(state, info);
        state.begin("the field of a handle");
        state.add(hf_pose_get_field(b.handle, h.number, OUT(field.data())));
        state.add(field);
      }
      look_at_skin(b, state);
      look_at_frame(b, state);
    }
  }
  std::string compare_fresh() override {
    for (const PoseBranch& b : branches_) {
      const std::string fault = compare_fresh(b);
      if (!fault.empty()) return fault;
    }
    return {};
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct PoseCalls;
  PoseBranch& any(Random& random) { return branches_[random.below(static_cast<std::uint32_t>(branches_.size()))]; }

  void look_at_skin(const PoseBranch& b, State& state) const {
    hf_skin_info skin = HF_INIT(hf_skin_info);
    state.begin("skin of a pose");
    state.add(hf_pose_get_skin(b.handle, &skin));
    const std::size_t joints = skin.joint_count, vertices = skin.vertex_count;
    std::vector<double> numbers(14 * joints);
    std::vector<std::uint32_t> of(4 * vertices);
    std::vector<float> weights(4 * vertices);
    skin.joint_capacity = skin.joint_count;
    skin.vertex_capacity = skin.vertex_count;
    skin.pivots = numbers.data();
    skin.rotations = skin.pivots + 3 * joints;
    skin.translations = skin.rotations + 4 * joints;
    skin.axes = skin.translations + 3 * joints;
    skin.vertex_joints = of.data();
    skin.vertex_weights = weights.data();
    if (joints > 0) state.add(hf_pose_get_skin(b.handle, &skin));
    state.add(numbers);
    state.add(of);
    state.add(weights);
  }
  // The next frame, as a clone makes it: what is kept of the last one shows there.
  void look_at_frame(const PoseBranch& b, State& state) const {
    hf_pose copy = nullptr;
    std::vector<double> positions(3 * world.shape->vertices());
    std::vector<float> normals(positions.size());
    hf_deform_desc frame = HF_INIT(hf_deform_desc);
    frame.positions = ROWS_OUT(positions.data());
    frame.normals = ROWS_OUT(normals.data());
    state.begin("the next frame of a pose");
    state.add(hf_pose_clone(b.handle, &copy));
    state.add(hf_pose_deform(copy, &frame, nullptr));
    state.add(positions);
    state.add(normals);
    hf_pose_destroy(copy);
    copy = nullptr;
    state.begin("full-mesh steps from the last frame of a pose");
    frame.refine = frame.refine_from_last = 1;
    state.add(hf_pose_clone(b.handle, &copy));
    state.add(hf_pose_deform(copy, &frame, nullptr));
    state.add(positions);
    state.add(normals);
    hf_pose_destroy(copy);
  }
  std::string compare_fresh(const PoseBranch& b) const;
  // The frame of a pose that starts from its fields.
  hf_result frame_of(hf_pose pose, std::int32_t refine, std::int32_t from_last, std::vector<double>& out) const {
    out.assign(3 * world.shape->vertices(), 0.0);
    hf_deform_desc frame = HF_INIT(hf_deform_desc);
    frame.positions = ROWS_OUT(out.data());
    frame.restart = 1;
    frame.iteration_count = 5;
    frame.refine = refine;
    frame.refine_from_last = from_last;
    return hf_pose_deform(pose, &frame, nullptr);
  }

  std::uint32_t number(const PoseBranch& b, Random& random) const {
    if (b.handles.empty() || random.one_in(15)) return random.below(20);
    return b.handles[random.below(static_cast<std::uint32_t>(b.handles.size()))].number;
  }
  // A quaternion of any length, and a way of about an edge.
  hf_transform transform(Random& random) const {
    hf_transform t;
    for (double& q : t.rotation) q = random.real(-1, 1);
    if (random.one_in(6)) std::fill_n(t.rotation, 4, 0.0);
    for (double& x : t.translation) x = random.real(-1, 1);
    if (random.one_in(25)) t.translation[random.below(3)] = random.number();
    if (random.one_in(25)) t.rotation[random.below(4)] = random.number();
    return t;
  }

  hf_result create(hf_pose* out) const {
    return mode_ == POSE_PAPER ? hf_peer_pose_create(world.surface, &desc_, rim_site_count_, out)
                               : hf_pose_create(world.surface, &desc_, out);
  }

  hf_pose_desc desc_ = HF_INIT(hf_pose_desc);
  std::int32_t mode_ = POSE_SMOOTH;
  std::uint32_t rim_site_count_ = 0;  // of the paper's
  std::vector<PoseBranch> branches_;
};

// Adds handles of one layer, all by regions or all by points.
hf_result add_to(hf_pose pose, const std::vector<Handle>& handles, std::uint32_t* out) {
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  std::vector<std::uint32_t> counts, vertices;
  std::vector<double> points, radii;
  for (const Handle& h : handles) {
    counts.push_back(static_cast<std::uint32_t>(h.region.size()));
    radii.push_back(h.radius);
    vertices.insert(vertices.end(), h.region.begin(), h.region.end());
    points.insert(points.end(), h.point, h.point + 3);
  }
  desc.handle_count = static_cast<std::uint32_t>(handles.size());
  desc.layer = handles[0].layer;
  if (vertices.empty()) {
    desc.points = points.data();
    desc.radii = radii.data();
  } else {
    desc.region_counts = counts.data();
    desc.region_vertices = vertices.data();
  }
  return hf_pose_add_handles(pose, &desc, out);
}

hf_result make_rigid(hf_pose pose, const std::vector<std::uint32_t>& pieces) {
  return hf_pose_set_rigid_pieces(pose, static_cast<std::uint32_t>(pieces.size()), pieces.data());
}

// Gives a fresh pose the handles of a branch, one by one or in batches, and their transforms.
hf_result fill(hf_pose fresh, const PoseBranch& b, bool batches) {
  hf_result result = HF_OK;
  std::vector<std::uint32_t> numbers(b.handles.size());
  for (std::size_t first = 0, last = 0; first < b.handles.size() && result == HF_OK; first = last) {
    const Handle& h = b.handles[first];
    std::vector<Handle> batch;
    while (last < b.handles.size() && (batch.empty() || batches) && b.handles[last].layer == h.layer &&
           b.handles[last].region.empty() == h.region.empty() && b.handles[last].rigid == h.rigid)
      batch.push_back(b.handles[last++]);
    result = make_rigid(fresh, h.rigid);
    if (result == HF_OK) result = add_to(fresh, batch, &numbers[first]);
  }
  for (std::size_t i = 0; i < numbers.size() && result == HF_OK; ++i) {
    const Handle& h = b.handles[i];
    if (h.free_rotation) result = hf_pose_set_free_rotations(fresh, 1, &numbers[i], 1);
    if (result == HF_OK && h.following < 1) result = hf_pose_set_following(fresh, 1, &numbers[i], h.following);
    if (result == HF_OK && h.limb_refine > 0) result = hf_pose_set_limb_refine(fresh, 1, &numbers[i], h.limb_refine);
    if (result != HF_OK) break;
    result = h.matrix.empty() ? hf_pose_set_transform(fresh, numbers[i], &h.transform)
                              : hf_pose_set_matrices(fresh, 1, &numbers[i], h.matrix.data());
  }
  return result == HF_OK ? make_rigid(fresh, b.rigid) : result;
}

// A free handle alone in its component keeps the rotation that it had, which is not in the model.
bool has_lone_free_handle(const PoseBranch& b) {
  const auto component = [&](const Handle& h) {
    hf_handle_info info = HF_INIT(hf_handle_info);
    return hf_pose_get_handle(b.handle, h.number, &info) == HF_OK ? info.component : HF_NO_INDEX;
  };
  return std::any_of(b.handles.begin(), b.handles.end(), [&](const Handle& h) {
    return h.free_rotation && std::none_of(b.handles.begin(), b.handles.end(), [&](const Handle& other) {
             return &other != &h && other.layer <= h.layer && component(other) == component(h);
           });
  });
}

// A frame with restart has the bits of a fresh pose with the same handles and transforms (hf/pose.h).
std::string Poses::compare_fresh(const PoseBranch& b) const {
  if (b.handles.empty() || has_lone_free_handle(b)) return {};
  for (const auto& [refine, from_last] : {std::pair{0, 0}, std::pair{3, 0}, std::pair{2, 1}}) {
    hf_pose fresh = nullptr, copy = nullptr;
    std::vector<double> here, there;
    hf_result result = create(&fresh);
    if (result == HF_OK) result = fill(fresh, b, refine > 0);
    if (result == HF_OK) result = frame_of(fresh, refine, from_last, there);
    if (result == HF_OK) result = hf_pose_clone(b.handle, &copy);
    if (result == HF_OK) result = frame_of(copy, refine, from_last, here);
    hf_pose_destroy(fresh);
    hf_pose_destroy(copy);
    if (result != HF_OK) return std::string("a fresh pose: ") + hf_result_get_name(result);
    if (here != there) return "a fresh pose differs by " + text(difference(here, there));
  }
  return {};
}

struct PoseCalls {
  static Poses& of(Subject& s) { return static_cast<Poses&>(s); }

  static hf_result add(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    const bool near = random.one_in(3);
    const std::uint32_t count = 1 + random.below(2), n = s.world.shape->vertices();
    std::vector<Handle> fresh(count);
    std::vector<std::uint32_t> counts(count), vertices, out(count);
    std::vector<double> points, radii;
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.layer = random.one_in(30) ? 8 : random.pick({0u, 0u, 0u, 1u, 2u});
    for (std::uint32_t i = 0; i < count; ++i) {
      Handle& h = fresh[i];
      h.layer = desc.layer;
      if (near) {
        const std::uint32_t v = random.below(n);
        for (int k = 0; k < 3; ++k) h.point[k] = static_cast<double>(s.world.shape->positions[3 * v + k]);
        h.radius = random.pick({0.0, 0.9, 1.2, -1.0});
        points.insert(points.end(), h.point, h.point + 3);
        radii.push_back(h.radius);
      } else {
        const std::uint32_t first = random.below(n), size = 1 + random.below(4);
        for (std::uint32_t k = 0; k < size; ++k) h.region.push_back(random.one_in(40) ? n : (first + k) % n);
        counts[i] = size;
        vertices.insert(vertices.end(), h.region.begin(), h.region.end());
      }
    }
    desc.handle_count = count;
    desc.progress = s.world.progress();
    if (near) {
      desc.points = points.data();
      desc.radii = radii.data();
    } else {
      desc.region_counts = counts.data();
      desc.region_vertices = vertices.data();
    }
    const hf_result result = hf_pose_add_handles(b.handle, random.spoiled(desc), out.data());
    if (result != HF_OK) return result;
    for (std::uint32_t i = 0; i < count; ++i) {
      fresh[i].number = out[i];
      fresh[i].rigid = b.rigid;
      b.handles.push_back(fresh[i]);
    }
    return result;
  }
  static hf_result add_at(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    Handle h;
    const std::uint32_t v = random.below(s.world.shape->vertices());
    for (std::size_t k = 0; k < 3; ++k) h.point[k] = static_cast<double>(s.world.shape->positions[3 * v + k]);
    if (random.one_in(20)) h.point[random.below(3)] = random.number();
    h.layer = 0;
    h.radius = random.pick({0.0, 0.9, 1.2, random.number()});
    const hf_result result =
        hf_pose_add_handle_at(b.handle, random.one_in(50) ? nullptr : h.point, h.radius, &h.number);
    h.rigid = b.rigid;
    if (result == HF_OK) b.handles.push_back(h);
    return result;
  }
  static hf_result propose(Subject& subject, Random& random) {
    Poses& s = of(subject);
    std::vector<double> joints(3 * random.below(5));
    std::vector<std::uint32_t> parents(joints.size() / 3);
    for (double& x : joints) x = random.number();
    for (std::uint32_t i = 0; i < parents.size(); ++i) parents[i] = i == 0 ? HF_NO_INDEX : random.index(i);
    hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
    desc.joint_count = static_cast<std::uint32_t>(parents.size());
    desc.joints = joints.data();
    if (!random.one_in(20)) desc.parents = parents.data();
    desc.up[random.below(3)] = random.number();
    desc.least_length_share = random.one_in(12) ? -1.0 : random.pick({0.0, 0.2});
    desc.limit = random.one_in(12) ? 70000u : random.pick({0u, 3u});
    desc.progress = s.world.progress();
    std::vector<hf_handle_proposal> found(random.below(40));
    std::uint32_t count = 0;
    return hf_surface_propose_handles(s.world.surface, random.spoiled(desc), static_cast<std::uint32_t>(found.size()),
                                      found.data(), &count);
  }
  static hf_result remove(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    std::vector<std::uint32_t> list(1 + random.below(2));
    for (std::uint32_t& n : list) n = s.number(b, random);
    const hf_result result = hf_pose_remove_handles(b.handle, static_cast<std::uint32_t>(list.size()), list.data());
    if (result != HF_OK) return result;
    const auto gone = [&](const Handle& h) { return std::find(list.begin(), list.end(), h.number) != list.end(); };
    b.handles.erase(std::remove_if(b.handles.begin(), b.handles.end(), gone), b.handles.end());
    return result;
  }
  static hf_result place(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    std::vector<std::uint32_t> list(1 + random.below(3));
    std::vector<hf_transform> to(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      list[i] = s.number(b, random);
      to[i] = s.transform(random);
    }
    const hf_result result =
        hf_pose_set_transforms(b.handle, static_cast<std::uint32_t>(list.size()), list.data(), to.data());
    if (result != HF_OK) return result;
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (Handle& h : b.handles)
        if (h.number == list[i]) {
          h.transform = to[i];
          h.matrix.clear();
        }
    }
    return result;
  }
  static hf_result matrices(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    const std::uint32_t number = s.number(b, random);
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    m[random.below(16)] = random.pick({0.5, 2.0, random.number()});  // hardly ever a rigid motion
    const hf_result result = hf_pose_set_matrices(b.handle, 1, &number, m);
    for (Handle& h : b.handles)
      if (result == HF_OK && h.number == number) h.matrix.assign(m, m + 16);
    return result;
  }
  static hf_result free(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    const std::uint32_t number = s.number(b, random);
    const std::int32_t wanted = random.pick({0, 1, 1, 1, 2});
    hf_result result = hf_pose_set_free_rotations(b.handle, 1, &number, wanted);
    for (Handle& h : b.handles) {
      if (result != HF_OK || h.number != number) continue;
      // a rotation that is given starts where the handle stands; a fresh pose needs one that is known
      const bool known = h.free_rotation && wanted == 0;
      h.free_rotation = wanted == 1;
      if (!known) continue;
      h.transform = {{0, 0, 0.6, 0.8}, {0.1, -0.2, 0.3}};
      h.matrix.clear();
      result = hf_pose_set_transform(b.handle, number, &h.transform);
    }
    return result;
  }
  static hf_result follow(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    const std::uint32_t number = s.number(b, random);
    const double wanted = random.pick({0.0, 0.2, 0.7, 1.0, 1.5});
    const hf_result result = hf_pose_set_following(b.handle, 1, &number, wanted);
    for (Handle& h : b.handles) {
      if (result == HF_OK && h.number == number) h.following = wanted;
    }
    return result;
  }
  static hf_result keep_limb(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    const std::uint32_t number = s.number(b, random);
    const std::int32_t wanted = random.pick({0, 1, 3, 65});
    const hf_result result = hf_pose_set_limb_refine(b.handle, 1, &number, wanted);
    for (Handle& h : b.handles) {
      if (result == HF_OK && h.number == number) h.limb_refine = wanted;
    }
    return result;
  }
  static hf_result rigid(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    std::vector<std::uint32_t> list(random.below(3));
    for (std::uint32_t& v : list) v = random.index(s.world.shape->vertices());
    const hf_result result = make_rigid(b.handle, list);
    if (result == HF_OK) b.rigid = list;
    return result;
  }
  static hf_result deform(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    std::vector<double> positions(3 * s.world.shape->vertices());
    std::vector<float> normals(positions.size());
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    hf_deform_info info = HF_INIT(hf_deform_info);
    desc.positions = ROWS_OUT(positions.data());
    if (random.one_in(2)) desc.normals = ROWS_OUT(normals.data());
    desc.iteration_count = random.pick({0u, 0u, 1u, 7u, 2000u});
    desc.restart = random.pick({0, 0, 0, 1, 2});
    desc.refine = random.pick({0, 0, 1, 3});
    desc.refine_from_last = random.pick({0, 0, 0, 1, 1, 2});
    desc.first_vertex = random.pick({0u, 0u, 0u, 3u, 5000u});
    if (random.one_in(10)) desc.positions.stride = 7;
    if (random.one_in(5)) return hf_deform(b.handle, normals.data(), random.spoiled(info));
    return hf_pose_deform(b.handle, random.spoiled(desc), random.spoiled(info));
  }
  static hf_result clone(Subject& subject, Random& random) {
    Poses& s = of(subject);
    PoseBranch& b = s.any(random);
    if (s.branches_.size() > 1) return skipped;
    PoseBranch fresh = b;
    const hf_result result = hf_pose_clone(b.handle, &fresh.handle);
    if (result != HF_OK) return s.expect(fresh.handle == nullptr, "a refused clone is no NULL"), result;
    return s.branches_.push_back(fresh), result;
  }
  static hf_result make(Subject& subject, Random& random) {
    Poses& s = of(subject);
    hf_pose_desc desc = HF_INIT(hf_pose_desc);
    const std::int32_t mode = random.pick({POSE_SMOOTH, POSE_PAPER});
    desc.band_count = random.pick({0u, 1u, 64u});
    desc.group_count = random.below(3000);
    hf_pose made = s.branches_[0].handle;
    const hf_result result = create_pose_with(mode, s.world.surface, random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused pose is no NULL");
    return hf_pose_destroy(made), result;
  }
  static hf_result destroy(Subject& subject, Random&) {
    Poses& s = of(subject);
    if (s.branches_.size() < 2) return skipped;
    hf_pose_destroy(s.branches_.back().handle);
    s.branches_.pop_back();
    return HF_OK;
  }
  static hf_result read(Subject& subject, Random& random) {
    Poses& s = of(subject);
    const PoseBranch& b = s.any(random);
    hf_handle_info info = HF_INIT(hf_handle_info);
    hf_skin_info skin = HF_INIT(hf_skin_info);
    std::vector<float> field(s.world.shape->vertices());
    if (random.one_in(3)) return hf_pose_get_handle(b.handle, s.number(b, random), random.spoiled(info));
    if (random.one_in(2))
      return hf_pose_get_field(b.handle, s.number(b, random), OUT_ROWS(field.data(), random.pick({0u, 2u})));
    skin.influence_count = random.pick({0u, 4u, 5u, 8u});
    return hf_pose_get_skin(b.handle, random.spoiled(skin));
  }
};

const std::vector<Command>& Poses::commands() const {
  static const std::vector<Command> table = {
      {"hf_pose_add_handles", 8, PoseCalls::add},
      {"hf_pose_remove_handles", 3, PoseCalls::remove},
      {"hf_pose_set_transforms", 5, PoseCalls::place},
      {"hf_pose_set_matrices", 1, PoseCalls::matrices},
      {"hf_pose_set_free_rotations", 4, PoseCalls::free},
      {"hf_pose_set_following", 3, PoseCalls::follow},
      {"hf_pose_set_limb_refine", 3, PoseCalls::keep_limb},
      {"hf_pose_set_rigid_pieces", 2, PoseCalls::rigid},
      {"hf_pose_deform", 8, PoseCalls::deform},
      {"hf_pose_clone", 2, PoseCalls::clone},
      {"hf_pose_create", 1, PoseCalls::make},
      {"hf_pose_destroy", 1, PoseCalls::destroy},
      {"reading a pose", 2, PoseCalls::read},
      {"hf_pose_add_handle_at", 3, PoseCalls::add_at},
      {"hf_surface_propose_handles", 2, PoseCalls::propose},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_poses(World& world, Random& random) {
  auto made = std::make_unique<Poses>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
