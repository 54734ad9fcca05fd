// Steps of skin weights, and of weights that are carried or mirrored.
#include "golden_scene.h"

namespace golden {

using hf::check;
using hf::make;

namespace {

// Room for the weights of a surface, and the weight of one joint at every vertex.
struct Column {
  explicit Column(size_t vertices, uint32_t influence_count)
      : joints(vertices * influence_count), shares(joints.size()), out(make<hf_weights_out>()), each(influence_count) {
    out.vertex_capacity = static_cast<uint32_t>(vertices);
    out.joints = joints.data();
    out.weights = shares.data();
  }
  Doubles of(uint32_t joint) const {
    Doubles column(joints.size() / each, 0.0);
    for (size_t i = 0; i < joints.size(); ++i) {
      if (joints[i] == joint) column[i / each] += static_cast<double>(shares[i]);
    }
    return column;
  }
  Numbers joints;
  std::vector<float> shares;
  hf_weights_out out;
  size_t each;
};

std::optional<std::string> lines_of(const Json& step) {
  if (!step.contains("names")) return {};
  std::string lines;
  for (const Json& name : step["names"]) lines += name.get<std::string>() + "\n";
  return lines;
}

}  // namespace

Result Scene::run_weights(const Json& step, const std::string& what) {
  if (what == "transfer_weights" || what == "mirror") return run_carried(step, what);
  Result result;
  Object& on = objects_[step["on"]];
  hf_weights weights = on.weights.get();
  const size_t n = on.vertex_count;
  const auto numbers_of = [&](auto&& call) {
    uint32_t size = 0;
    check(call(0, nullptr, &size));
    Numbers found(size);
    check(call(size, found.data(), &size));
    result.array.emplace(found.begin(), found.end());
  };
  if (what == "weights" || what == "set_joints") {
    const auto heads = doubles(step, "heads"), tails = doubles(step, "tails"), axes = doubles(step, "axes");
    const auto parents = numbers(step, "parents"), sources = numbers(step, "sources");
    std::vector<int32_t> deforms = step.value("deforms", std::vector<int32_t>{});
    auto desc = make<hf_joints_desc>();
    desc.joint_count = heads ? static_cast<uint32_t>(heads->size() / 3) : 1u;
    desc.heads = data(heads);
    desc.tails = data(tails);
    desc.axes = data(axes);
    desc.parents = data(parents);
    desc.sources = data(sources);
    desc.deforms = deforms.empty() ? nullptr : deforms.data();
    if (what == "set_joints") {
      check(hf_weights_set_joints(weights, &desc));
    } else {
      hf_weights raw = nullptr;
      check(hf_weights_create(on.surface.get(), &desc, step["options"].value("influence_count", 0u), &raw));
      Object& made = objects_[step["as"]];
      made.weights = hf::Handle<hf_weights, hf_weights_destroy>(raw);
      made.vertex_count = n;
    }
  } else if (what == "set_pins") {
    const auto vertices = numbers(step, "vertices"), joints = numbers(step, "joints");
    const auto given = doubles(step, "weights");
    const std::vector<float> shares(given->begin(), given->end());
    auto desc = make<hf_pins_desc>();
    desc.pin_count = count(vertices);
    desc.vertices = data(vertices);
    desc.influence_count = desc.pin_count ? count(joints) / desc.pin_count : 0;
    desc.joints = data(joints);
    desc.weights = shares.data();
    check(hf_weights_set_pins(weights, &desc));
  } else if (what == "set_locks") {
    const auto joints = numbers(step, "joints");
    check(hf_weights_set_locks(weights, count(joints), data(joints), nullptr));
  } else if (what == "record_weights") {
    on.weights_history.record(hf::clone_of(on.weights, hf_weights_clone));
  } else if (what == "undo_weights") {
    on.weights_history.undo(on.weights);
  } else if (what == "redo_weights") {
    on.weights_history.redo(on.weights);
  } else if (what == "clone_weights") {
    hf_weights raw = nullptr;
    check(hf_weights_clone(weights, &raw));
    Object& made = objects_[step["as"]];
    made.weights = hf::Handle<hf_weights, hf_weights_destroy>(raw);
    made.vertex_count = n;
  } else if (what == "weights_info") {
    auto info = make<hf_weights_info>();
    check(hf_weights_get_info(weights, &info));
    result.fields = {{"vertex_count", info.vertex_count},
                     {"joint_count", info.joint_count},
                     {"informed_count", info.informed_count},
                     {"pin_count", info.pin_count}};
  } else if (what == "joint_flags") {
    numbers_of([&](uint32_t capacity, uint32_t* flags, uint32_t* size) {
      return hf_weights_get_joints(weights, capacity, flags, nullptr, size);
    });
  } else if (what == "helpers") {
    const auto lines = lines_of(step);
    numbers_of([&](uint32_t capacity, uint32_t* reasons, uint32_t* size) {
      return hf_weights_get_helpers(weights, lines ? lines->c_str() : nullptr, capacity, reasons, size);
    });
  } else {
    auto ask = make<hf_weights_out>();
    check(hf_weights_get(weights, &ask));
    Column found(n, ask.influence_count);
    check(hf_weights_get(weights, &found.out));
    result.array = found.of(step["joint"]);
  }
  return result;
}

Result Scene::run_carried(const Json& step, const std::string& what) {
  Object& on = objects_[step["on"]];
  const Object& source = what == "transfer_weights" ? objects_[step["source"]] : on;
  const auto joints = numbers(step, "joints");
  const auto given = doubles(step, "weights", joints->size());
  const std::vector<float> shares(given->begin(), given->end());
  const uint32_t each = count(joints) / static_cast<uint32_t>(source.vertex_count);
  Column found(on.vertex_count, 4);
  if (what == "transfer_weights") {
    auto desc = make<hf_weights_transfer_desc>();
    desc.source_influence_count = each;
    desc.joints = data(joints);
    desc.weights = shares.data();
    check(hf_weights_transfer(source.surface.get(), on.surface.get(), &desc, &found.out, nullptr));
  } else {
    const auto heads = doubles(step, "heads"), plane = doubles(step, "plane", 6);
    const auto lines = lines_of(step);
    auto desc = make<hf_weights_mirror_desc>();
    desc.joint_count = static_cast<uint32_t>(heads->size() / 3);
    desc.heads = data(heads);
    desc.plane = data(plane);
    desc.names = lines ? lines->c_str() : nullptr;
    desc.to = step.value("to", 0);
    desc.source_influence_count = each;
    desc.joints = data(joints);
    desc.weights = shares.data();
    check(hf_weights_mirror(on.surface.get(), &desc, &found.out, nullptr, nullptr, nullptr, nullptr));
  }
  Result result;
  result.array = found.of(step["joint"]);
  return result;
}

}  // namespace golden
