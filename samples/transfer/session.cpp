// See session.h.
#include "transfer/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "common/peers.h"
#include "common/rigid_parts.h"
#include "gltf/animate.h"
#include "gltf/landmarks.h"
#include "transfer/posed_region.h"

namespace samples {

using namespace hf_gltf;
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void copy_axes(const Axes& axes, double (&rows)[9]) {
  for (int c = 0; c < 3; ++c) {
    rows[c] = axes.right[c];
    rows[3 + c] = axes.up[c];
    rows[6 + c] = axes.forward[c];
  }
}

}  // namespace

glm::dvec3 take_travel(const std::vector<double>& times, const glm::dvec3& up, const std::vector<uint8_t>& loose,
                       std::vector<std::vector<double>>& poses) {
  if (poses.size() < 2 || !(times.back() > times.front())) return glm::dvec3(0);
  glm::dvec3 travel = middle_of(poses.back(), loose) - middle_of(poses.front(), loose);
  travel -= glm::dot(travel, up) * up;
  for (size_t f = 0; f < poses.size(); ++f) {
    const glm::dvec3 part = (times[f] - times.front()) / (times.back() - times.front()) * travel;
    for (size_t i = 0; i < poses[f].size(); ++i) poses[f][i] -= part[static_cast<int>(i % 3)];
  }
  return travel;
}

Session::Session(const Model& source, const Model& target, const PairsFile& pairs, uint32_t threads, bool links,
                 ProgressBar& bar, bool ground, bool rigid)
    : source_(source),
      target_(target),
      file_(pairs),
      source_flat_(flatten(source)),
      target_flat_(flatten(target)),
      source_finder_(source, source_flat_, pairs.source_axes),
      target_finder_(target, target_flat_, pairs.target_axes),
      source_known_(know_body(source, source_flat_)),
      target_known_(know_body(target, target_flat_)),
      ground_(ground && pairs.settings.ground),
      rigid_(rigid) {
  try {
    create(threads, links, bar);
  } catch (...) {
    hf_transfer_destroy(transfer_);
    throw;
  }
}

Session::~Session() { hf_transfer_destroy(transfer_); }

void Session::create(uint32_t threads, bool links, ProgressBar& bar) {
  const ModelLinks source_links(&source_, source_flat_), target_links(&target_, target_flat_);
  const auto start = std::chrono::steady_clock::now();
  bar.begin("factorising " + source_.name);
  source_surface_ = std::make_unique<FlatSurface>(source_flat_, source_.name, threads, file_.settings.paper,
                                                  links ? &source_links.desc : nullptr);
  bar.end(std::to_string(source_mesh().welded_vertex_count) + " vertices after welding");
  bar.begin("factorising " + target_.name);
  target_surface_ = std::make_unique<FlatSurface>(target_flat_, target_.name, threads, file_.settings.paper,
                                                  links ? &target_links.desc : nullptr);
  bar.end(std::to_string(target_mesh().welded_vertex_count) + " vertices after welding");
  setup_ms_ = milliseconds_since(start);

  const TransferSettings& settings = file_.settings;
  hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
  desc.mode = settings.stretch ? HF_TRANSFER_STRETCH : HF_TRANSFER_FIELDS;
  desc.cluster_count = settings.clusters;
  desc.kernel_width = settings.width;
  // the paper measures the legs by its fields
  const double legs = settings.paper ? 0.0 : leg_scale(source_known_, target_known_);
  desc.scale = settings.scale > 0 ? settings.scale : legs;
  if (settings.scale > 0 || legs > 0) scale_from_ = settings.scale > 0 ? "the pairs file" : "the legs of the skeletons";
  desc.alignment_angle = settings.alignment_degrees * degree;
  desc.ground = ground_ ? HF_GROUND_KEEP : HF_GROUND_OFF;
  copy_axes(file_.source_axes, desc.source_axes);
  copy_axes(file_.target_axes, desc.target_axes);
  check(create_transfer(settings.paper, source_surface_->get(), target_surface_->get(), desc, &transfer_),
        "the transfer");
  if (rigid_) keep_rigid(target_links);
  set_dials(file_.dials);
  bar.begin("pairs, fields and clusters");
  add(file_.pairs);
  prepare();
  bar.end(std::to_string(live_.size()) + " pairs, " + std::to_string(cluster_count()) + " clusters");
}

void Session::keep_rigid(const ModelLinks& skin) {
  const std::vector<uint32_t> vertices = rigid_vertices(target_flat_, rigid_parts(target_flat_, target_, skin));
  check(hf_transfer_set_rigid_pieces(transfer_, static_cast<uint32_t>(vertices.size()), vertices.data()),
        "the rigid pieces");
  rigid_count_ = vertices.size();
}

uint32_t Session::joint_count() const {
  hf_skin_info info = HF_INIT(hf_skin_info);
  check(hf_transfer_get_skin(transfer_, &info), "the skin");
  return info.joint_count;
}

void Session::set_dials(const TransferDials& dials) {
  hf_transfer_dials set = HF_INIT(hf_transfer_dials);
  set.stride = dials.stride;
  set.hip_height_share = dials.hip_height_share;
  set.neck_follow = dials.neck_follow;
  set.tail_follow = dials.tail_follow;
  set.arm_space = dials.arm_space_degrees * degree;
  set.long_follow = dials.long_follow;
  check(hf_transfer_set_dials(transfer_, &set), "the dials");
  file_.dials = dials;
}

void Session::add(const std::vector<PairEntry>& entries) {
  if (entries.empty()) return;
  const size_t before = live_.size();
  std::vector<Region> source, target;
  for (const Live& live : live_) {
    source.push_back(live.source);
    target.push_back(live.target);
  }
  for (const PairEntry& entry : entries) {
    for (const Live& live : live_) {
      if (live.entry.name == entry.name) throw std::runtime_error("there is a pair \"" + entry.name + "\" already");
    }
  }
  add_regions(entries, source_finder_, target_finder_, source, target);
  std::vector<uint32_t> source_counts, target_counts, source_vertices, target_vertices, flags, numbers(entries.size());
  for (size_t i = 0; i < entries.size(); ++i) {
    const auto &a = source[before + i].vertices, &b = target[before + i].vertices;
    source_counts.push_back(static_cast<uint32_t>(a.size()));
    target_counts.push_back(static_cast<uint32_t>(b.size()));
    source_vertices.insert(source_vertices.end(), a.begin(), a.end());
    target_vertices.insert(target_vertices.end(), b.begin(), b.end());
    flags.push_back(entries[i].flags());
  }
  hf_pairs_desc desc = HF_INIT(hf_pairs_desc);
  desc.pair_count = static_cast<uint32_t>(entries.size());
  desc.source_counts = source_counts.data();
  desc.source_vertices = source_vertices.data();
  desc.target_counts = target_counts.data();
  desc.target_vertices = target_vertices.data();
  desc.flags = flags.data();
  check(hf_transfer_add_pairs(transfer_, &desc, numbers.data()), "the pairs");
  for (size_t i = 0; i < entries.size(); ++i)
    live_.push_back({entries[i], source[before + i], target[before + i], numbers[i]});
}

void Session::edit(const EditsFile& edits) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<uint32_t> numbers;
  std::vector<Live> left = live_;
  for (const std::string& name : edits.remove) {
    const auto found =
        std::find_if(left.begin(), left.end(), [&](const Live& live) { return live.entry.name == name; });
    if (found == left.end()) throw std::runtime_error("there is no pair \"" + name + "\" to remove");
    numbers.push_back(found->number);
    left.erase(found);
  }
  if (!numbers.empty()) {
    check(hf_transfer_remove_pairs(transfer_, static_cast<uint32_t>(numbers.size()), numbers.data()), "removing pairs");
    live_.swap(left);
  }
  add(edits.add);
  edit_ms_ = milliseconds_since(start);
  prepare();
}

// Solves the fields and so on, by asking for the scale.
void Session::prepare() {
  const auto start = std::chrono::steady_clock::now();
  hf_transfer_info info = HF_INIT(hf_transfer_info);
  check(hf_transfer_get_info(transfer_, &info), "the transfer");
  prepare_ms_ = milliseconds_since(start);
  scale_ = info.scale;
  sinking_.resize(target_flat_.vertex_count());
  check(hf_transfer_get_sinking(transfer_, sinking_.data()), "the parts that sink");
  for (size_t v = 0; v < sinking_.size(); ++v) sinking_[v] |= target_flat_.loose[v];
  source_hangs_ = hanging(true);
  target_hangs_ = hanging(false);
}

void Session::apply(const std::vector<double>& posed, std::vector<double>& out) {
  out.resize(3 * target_flat_.positions.size());
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed.data(), posed.size() / 3);
  frame.target_positions = HF_ARRAY_OUT(out.data(), out.size() / 3);
  check(hf_transfer_apply(transfer_, &frame), "a frame");
}

// The pairs of these names are put in again with these flags; the regions stay.
void Session::change_flags(const std::vector<PairEntry>& entries) {
  bool changed = false;
  for (const PairEntry& entry : entries) {
    const auto live =
        std::find_if(live_.begin(), live_.end(), [&](const Live& other) { return other.entry.name == entry.name; });
    if (live == live_.end() || live->entry.flags() == entry.flags()) continue;
    check(hf_transfer_remove_pairs(transfer_, 1, &live->number), "pair \"" + entry.name + "\"");
    const auto source_count = static_cast<uint32_t>(live->source.vertices.size()),
               target_count = static_cast<uint32_t>(live->target.vertices.size());
    const uint32_t flags = entry.flags();
    hf_pairs_desc desc = HF_INIT(hf_pairs_desc);
    desc.pair_count = 1;
    desc.flags = &flags;
    desc.source_counts = &source_count;
    desc.source_vertices = live->source.vertices.data();
    desc.target_counts = &target_count;
    desc.target_vertices = live->target.vertices.data();
    check(hf_transfer_add_pairs(transfer_, &desc, &live->number), "pair \"" + entry.name + "\"");
    live->entry = entry;
    changed = true;
  }
  if (changed) prepare();
}

std::vector<PairEntry> Session::found_contacts(const std::vector<std::vector<double>>& poses) const {
  const std::vector<double> source_rest = double_positions(source_flat_.positions),
                            target_rest = double_positions(target_flat_.positions);
  const glm::dvec3 &up = file_.source_axes.up, &target_up = file_.target_axes.up;
  const double ground = lowest_of(source_rest, up, source_hangs_),
               target_ground = lowest_of(target_rest, target_up, target_hangs_);
  const bool has_feet = std::any_of(live_.begin(), live_.end(), [](const Live& live) { return live.entry.foot; });
  std::vector<PairEntry> out;
  for (const Live& live : live_) {
    if (live.entry.foot || live.entry.trunk || live.entry.anchor || live.entry.contact_given) continue;
    PairEntry entry = live.entry;
    const double rest = lowest_of(live.source, source_rest, up) - ground,
                 target = lowest_of(live.target, target_rest, target_up) - target_ground;
    if (rest < 0.02 * source_finder_.diagonal() && target < 0.02 * target_finder_.diagonal()) {
      if (!has_feet) {
        entry.foot = true;
        out.push_back(entry);
      }
      continue;
    }
    entry.contact = rest >= 0.1 * source_finder_.diagonal() &&
                    std::any_of(poses.begin(), poses.end(), [&](const std::vector<double>& pose) {
                      return lowest_of(live.source, pose, up) - ground <= 0.15 * rest;
                    });
    out.push_back(entry);
  }
  return out;
}

std::vector<PairEntry> Session::named_contacts(const std::vector<std::string>& names) const {
  std::vector<PairEntry> out;
  for (const std::string& name : names) {
    const Live* found = nullptr;
    std::string known;
    for (const Live& live : live_) {
      known += (known.empty() ? "" : ", ") + live.entry.name;
      if (live.entry.name == name) found = &live;
    }
    // a joint stands for the pair that holds most of its vertices
    size_t most = 0;
    for (const Live& live : live_) {
      size_t own = 0;
      for (const uint32_t v : live.source.vertices) own += source_finder_.owner_name(v) == name;
      if (!found && own > most) most = own;
    }
    for (const Live& live : live_) {
      size_t own = 0;
      for (const uint32_t v : live.source.vertices) own += source_finder_.owner_name(v) == name;
      if (!found && most > 0 && own == most) found = &live;
    }
    if (!found)
      throw std::runtime_error("--contacts: \"" + name +
                               "\" is neither a pair nor a joint of the source with a pair; pairs are " + known);
    PairEntry entry = found->entry;
    // what stands at rest is a foot
    const double rest = lowest_of(found->source, double_positions(source_flat_.positions), file_.source_axes.up) -
                        lowest_of(double_positions(source_flat_.positions), file_.source_axes.up, source_hangs_);
    (rest < 0.02 * source_finder_.diagonal() ? entry.foot : entry.contact) = true;
    out.push_back(entry);
  }
  return out;
}

std::vector<std::string> Session::set_contacts(const std::vector<std::string>& names,
                                               const std::vector<std::vector<double>>& poses) {
  if (stretches() || (names.empty() && !file_.settings.ground) || (names.size() == 1 && names.front() == "none"))
    return {};
  const std::vector<PairEntry> entries = names.empty() ? found_contacts(poses) : named_contacts(names);
  if (!entries.empty()) change_flags(entries);
  std::vector<std::string> out;
  for (const PairEntry& entry : entries) {
    if (entry.foot || entry.contact)
      out.push_back("\"" + entry.name + "\" " +
                    (entry.foot ? "stands on the ground" : "touches the ground now and then"));
  }
  return out;
}

PlayedClip Session::play(const Animation& animation, double rate, ProgressBar& bar) {
  const std::vector<double> times = rate < 0 ? key_times(animation) : frame_times(animation, rate);
  SurfacePoser surface(source_, source_flat_);
  std::vector<std::vector<double>> poses;
  for (const double time : times) poses.push_back(double_positions(surface.at(animation, time)));
  return play(animation.name, times, std::move(poses), bar);
}

PlayedClip Session::play(const std::string& name, const std::vector<double>& times,
                         std::vector<std::vector<double>> poses, ProgressBar& bar) {
  PlayedClip out;
  out.clip.name = name;
  if (in_place_) {
    const glm::dmat3 source(file_.source_axes.right, file_.source_axes.up, file_.source_axes.forward),
        target(file_.target_axes.right, file_.target_axes.up, file_.target_axes.forward);
    const glm::dvec3 travel = take_travel(times, file_.source_axes.up, source_flat_.loose, poses);
    out.travel = file_.dials.stride * scale_ * (target * glm::transpose(source) * travel);
  }
  const uint32_t joints = stretches() ? 0 : joint_count();
  std::vector<double> pivots(3 * joints), rotations(4 * joints), places(3 * joints), target;
  hf_skin_info info = HF_INIT(hf_skin_info);
  info.joint_capacity = joints;
  info.pivots = pivots.data();
  info.rotations = rotations.data();
  info.translations = places.data();
  bar.begin("transferring \"" + name + "\"");
  double inside = 0;
  for (size_t f = 0; f < times.size(); ++f) {
    const auto start = std::chrono::steady_clock::now();
    apply(poses[f], target);
    inside += milliseconds_since(start);
    if (!stretches()) check(hf_transfer_get_skin(transfer_, &info), "the skin");
    out.clip.times.push_back(times[f]);
    for (uint32_t j = 0; j < joints; ++j) {
      const double* q = rotations.data() + 4 * j;
      const glm::dquat rotation(q[3], q[0], q[1], q[2]);
      const glm::dvec3 pivot(pivots[3 * j], pivots[3 * j + 1], pivots[3 * j + 2]),
          place(places[3 * j], places[3 * j + 1], places[3 * j + 2]);
      out.clip.rotations.push_back(rotation);
      out.clip.translations.push_back(place - rotation * pivot);
    }
    out.source_frames.push_back(std::move(poses[f]));
    out.target_frames.push_back(target);
    bar.update(static_cast<double>(f + 1) / static_cast<double>(times.size()));
  }
  out.frame_ms = inside / static_cast<double>(times.size());
  out.feet = feet_of(out);
  out.gap = largest_gap(out.target_frames);
  bar.end(std::to_string(times.size()) + " frames");
  return out;
}

std::vector<LimbMotion> Session::limbs_of(const PlayedClip& played) const {
  const double box = target_mesh().bounding_box_diagonal;
  const glm::dmat3 source_axes(file_.source_axes.right, file_.source_axes.up, file_.source_axes.forward),
      target_axes(file_.target_axes.right, file_.target_axes.up, file_.target_axes.forward);
  const glm::dmat3 to_target = target_axes * glm::transpose(source_axes);
  std::vector<LimbMotion> out;
  const size_t frames = played.source_frames.size();
  std::vector<glm::dvec3> source_body, target_body;
  for (size_t f = 0; f < frames; ++f) {
    source_body.push_back(middle_of(played.source_frames[f], source_flat_.loose));
    target_body.push_back(middle_of(played.target_frames[f], target_flat_.loose));
  }
  for (const Live& live : live_) {
    if (live.entry.trunk || frames == 0) continue;
    std::vector<glm::dvec3> from, to;
    glm::dvec3 from_mean(0), to_mean(0);
    for (size_t f = 0; f < frames; ++f) {
      from.push_back(scale_ * (to_target * (centre_of(live.source, played.source_frames[f]) - source_body[f])));
      to.push_back(centre_of(live.target, played.target_frames[f]) - target_body[f]);
      from_mean += from.back() / static_cast<double>(frames);
      to_mean += to.back() / static_cast<double>(frames);
    }
    double ff = 0, tt = 0, ft = 0;
    for (size_t f = 0; f < frames; ++f) {
      const glm::dvec3 a = from[f] - from_mean, b = to[f] - to_mean;
      ff += glm::dot(a, a);
      tt += glm::dot(b, b);
      ft += glm::dot(a, b);
    }
    out.push_back({live.entry.name, std::sqrt(ff / static_cast<double>(frames)) / box,
                   std::sqrt(tt / static_cast<double>(frames)) / box,
                   ff > 0 && tt > 0 ? ft / std::sqrt(ff * tt) : 1.0});
  }
  return out;
}

double Session::largest_gap(const std::vector<std::vector<double>>& frames) const {
  double out = 0;
  for (const std::vector<double>& frame : frames) {
    const hf_array posed = HF_ARRAY(frame.data(), frame.size() / 3);
    hf_gaps_info info = HF_INIT(hf_gaps_info);
    if (hf_surface_measure_gaps(target_surface(), &posed, 0, nullptr, &info) != HF_OK || info.link_count == 0) return 0;
    out = std::max(out, info.worst / target_mesh().bounding_box_diagonal);
  }
  return out;
}

SkinDescription Session::skin() {
  const uint32_t joints = joint_count();
  SkinDescription out;
  std::vector<double> pivots(3 * joints);
  out.vertex_joints.resize(size_t{4} * target_flat_.vertex_count());
  out.vertex_weights.resize(out.vertex_joints.size());
  hf_skin_info info = HF_INIT(hf_skin_info);
  info.influence_count = 4;
  info.joint_capacity = joints;
  info.vertex_capacity = target_flat_.vertex_count();
  info.pivots = pivots.data();
  info.vertex_joints = out.vertex_joints.data();
  info.vertex_weights = out.vertex_weights.data();
  check(hf_transfer_get_skin(transfer_, &info), "the skin");
  for (uint32_t j = 0; j < joints; ++j)
    out.joints.push_back({"cluster_" + std::to_string(j), {pivots[3 * j], pivots[3 * j + 1], pivots[3 * j + 2]}});
  return out;
}

std::vector<PairReport> Session::pairs() {
  std::vector<PairReport> out;
  for (const Live& live : live_) {
    hf_pair_info info = HF_INIT(hf_pair_info);
    check(hf_transfer_get_pair(transfer_, live.number, &info), "pair \"" + live.entry.name + "\"");
    PairReport report;
    report.name = live.entry.name;
    report.source_vertices = live.source.vertices.size();
    report.target_vertices = live.target.vertices.size();
    report.anchor = live.entry.anchor || live.entry.foot;
    report.foot = live.entry.foot;
    report.trunk = live.entry.trunk;
    report.contact = live.entry.contact;
    report.alignment_share = info.alignment_share;
    report.crossed = info.crossed != 0;
    report.source_leak = info.source_leak;
    report.target_leak = info.target_leak;
    report.confidence = info.confidence;
    report.alignment_degrees = info.alignment_angle < 0 ? -1 : info.alignment_angle / degree;
    out.push_back(report);
  }
  return out;
}

// The axes of the file hold, whatever the skeletons say.
std::vector<std::string> Session::other_axes() const {
  std::vector<std::string> out;
  const auto look = [&](const Model& model, const Axes& axes, const KnownBody& known) {
    const bool other = glm::dot(axes.up, known.axes.up) < 0.5 || glm::dot(axes.forward, known.axes.forward) < 0.5;
    if (known.knows_axes() && other)
      out.push_back(model.name + ": up " + axis_name(axes.up) + ", forward " + axis_name(axes.forward) +
                    " are taken as given; its skeleton says up " + axis_name(known.axes.up) + " (" + known.up_why +
                    "), forward " + axis_name(known.axes.forward) + " (" + known.forward_why + ")");
  };
  look(source_, file_.source_axes, source_known_);
  look(target_, file_.target_axes, target_known_);
  return out;
}

std::vector<std::string> Session::warnings() {
  std::vector<std::string> out = other_axes();
  for (const Model* model : {&source_, &target_}) {
    for (const std::string& warning : model->warnings) out.push_back(model->name + ": " + warning);
  }
  bool feet = false, trunk = false;
  size_t crossed = 0;
  for (const PairReport& pair : pairs()) {
    feet = feet || pair.foot;
    trunk = trunk || (pair.trunk && pair.anchor);
    if (pair.confidence < 0.3 && !stretches())
      out.push_back("pair \"" + pair.name +
                    "\": few source vertices are behind its clusters; the motion there may be coarse");
    if (pair.source_leak > 1e-6 || pair.target_leak > 1e-6)
      out.push_back("pair \"" + pair.name + "\": its fields leak; report it with the model");
    if (pair.crossed && !proposed_) {  // of the program's own proposals the user changes nothing
      ++crossed;
      out.push_back("pair \"" + pair.name +
                    "\" lies on one side of the source and on the other of the target: left and right are crossed");
    }
    if (pair.alignment_share > 0) {
      char text[256];
      std::snprintf(text, sizeof text,
                    "pair \"%s\": the limb points %.0f degrees elsewhere at rest; %.0f %% of that is aligned with the "
                    "source; \"align\": false keeps its own direction",
                    pair.name.c_str(), pair.alignment_degrees, 100 * pair.alignment_share);
      out.emplace_back(text);
    }
  }
  const struct {
    double value;
    uint32_t flag;
    const char *dial, *kind;
  } turned[] = {{file_.dials.hip_height_share, HF_PAIR_TRUNK, "hip_height_share", "a trunk pair"},
                {file_.dials.neck_follow, HF_PAIR_NECK, "neck_follow", "of the limb \"neck\""},
                {file_.dials.tail_follow, HF_PAIR_TAIL, "tail_follow", "of the limb \"tail\""},
                {file_.dials.arm_space_degrees, HF_PAIR_ARM, "arm_space_degrees", "of the limb \"arm\""}};
  for (const auto& dial : turned)
    if (dial.value != 0 && std::none_of(live_.begin(), live_.end(),
                                        [&](const Live& live) { return (live.entry.flags() & dial.flag) != 0; }))
      out.push_back(std::string("dial ") + dial.dial + " turns nothing: no pair is " + dial.kind);
  if (crossed > 1)
    out.push_back(std::to_string(crossed) +
                  " pairs are crossed: exchange their sides, or look at source_axes and target_axes (forward)");
  if (feet && !trunk)
    out.push_back(
        "feet are anchored but no trunk pair is: the trunk may float; give withers and rump with \"trunk\" and "
        "\"anchor\"");
  for (const bool is_source : {true, false}) {
    std::vector<uint32_t> reached;
    for (const Live& live : live_) {
      const std::vector<uint32_t>& region = is_source ? live.source.vertices : live.target.vertices;
      reached.insert(reached.end(), region.begin(), region.end());
    }
    const std::string sentence =
        is_source ? unreached_sentence(source_surface(), reached, "pair", "give no motion")
                  : unreached_sentence(target_surface(), reached, "pair", "follow the parts beside them");
    if (!sentence.empty()) out.push_back((is_source ? source_ : target_).name + ": " + sentence);
  }
  return out;
}

hf_transfer_info Session::info() const {
  hf_transfer_info out = HF_INIT(hf_transfer_info);
  check(hf_transfer_get_info(transfer_, &out), "the transfer");
  return out;
}

hf_transfer_statistics Session::statistics() const {
  hf_transfer_statistics out = HF_INIT(hf_transfer_statistics);
  check(hf_transfer_get_statistics(transfer_, &out), "the transfer");
  return out;
}

hf_surface_report Session::mesh_report(hf_surface surface) {
  hf_surface_report out = HF_INIT(hf_surface_report);
  check(hf_surface_get_report(surface, &out), "mesh report");
  return out;
}

}  // namespace samples
