// Skin weights: from bones, carried and mirrored.
#include <algorithm>
#include <cmath>

#include "setting.h"

namespace invariance {
namespace {

constexpr std::uint32_t joint_count = 5;

// A chain through the middle of the box along its longest side, and where its bones end.
struct Chain {
  std::vector<double> heads, tails;
  std::vector<std::uint32_t> parents;
  hf_joints_desc desc = HF_INIT(hf_joints_desc);
  explicit Chain(const Setting& s, std::uint32_t count = joint_count) {
    const Vec size = s.body.high - s.body.low;
    const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    const auto at = [&](double share) {
      Vec p = 0.5 * (s.body.low + s.body.high);
      p[axis] = s.body.low[axis] + share * size[axis];
      return s.place(p);
    };
    for (std::uint32_t b = 0; b < count; ++b) {
      const Vec head = at((b + 0.03) / count), tail = at((b + 1.03) / count);
      heads.insert(heads.end(), head.begin(), head.end());
      tails.insert(tails.end(), tail.begin(), tail.end());
      parents.push_back(b == 0 ? HF_NO_INDEX : b - 1);
    }
    desc.joint_count = count;
    desc.heads = heads.data();
    desc.tails = tails.data();
    desc.parents = parents.data();
  }
};

struct Received {
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
  hf_weights_out desc = HF_INIT(hf_weights_out);
  explicit Received(std::size_t vertices) : joints(4 * vertices), weights(4 * vertices) {
    desc.vertex_capacity = static_cast<std::uint32_t>(vertices);
    desc.joints = joints.data();
    desc.weights = weights.data();
  }
};

// Weights of every bone at every vertex of the body.
std::vector<double> table(const Setting& s, const Received& received) {
  std::vector<double> out(received.joints.size() / 4 * joint_count, 0);
  for (std::size_t i = 0; i < received.joints.size(); ++i)
    out[i / 4 * joint_count + received.joints[i]] += static_cast<double>(received.weights[i]);
  return s.gather(out, joint_count);
}

void add_skeleton(Measured& out, const Setting& s, const std::string& name, std::uint32_t bones) {
  const Chain chain(s, bones);
  Owned<hf_weights, hf_weights_destroy> made;
  ok(hf_weights_create(s.surface(), &chain.desc, 4, made.out()));
  Received received(s.copy.points.size());
  ok(hf_weights_get(made, &received.desc));
  out.add(name, table(s, received));
}

// Weights that follow the height of the body, two bones a vertex: what an artist has painted.
struct Painted {
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
  Painted(const Body& body, const std::vector<std::uint32_t>& origin) {
    for (const std::uint32_t v : origin) {
      const Vec p = v == none ? body.low : body.points[v];
      const double height = (joint_count - 1.001) * (p[1] - body.low[1]) / std::max(body.high[1] - body.low[1], 1e-9);
      const double x = (p[0] - body.low[0]) / body.diagonal;
      const double place = std::clamp(height + 0.2 * std::sin(6 * x), 0.0, joint_count - 1.001);
      const auto bone = static_cast<std::uint32_t>(place);
      joints.insert(joints.end(), {bone, bone + 1});
      // a vertex that was added has no weights
      const double share = place - bone;
      weights.push_back(v == none ? 0.0F : static_cast<float>(1 - share));
      weights.push_back(v == none ? 0.0F : static_cast<float>(share));
    }
  }
};

// Clothes: the body a hundredth larger, in the frame of the copy.
Copy clothes(const Setting& s) {
  Copy out = plain_copy(s.body);
  out.form = Form::doubles;
  const Vec centre = 0.5 * (s.body.low + s.body.high);
  out.scale = s.copy.scale;
  for (Vec& p : out.points) p = s.place(centre + 1.01 * (p - centre));
  if (s.copy.mirrored) {
    for (auto& t : out.triangles) std::swap(t[1], t[2]);
  }
  return out;
}

std::vector<double> carried(const Setting& from, const Setting& to, const Painted& painted) {
  hf_weights_transfer_desc d = HF_INIT(hf_weights_transfer_desc);
  d.source_influence_count = 2;
  d.joints = painted.joints.data();
  d.weights = painted.weights.data();
  d.distance = from.size(0.05 * from.body.diagonal);
  Received received(to.copy.points.size());
  ok(hf_weights_transfer(from.surface(), to.surface(), &d, &received.desc, nullptr));
  return table(to, received);
}

}  // namespace

// Many bones and two: how many there are must not decide what a small piece is.
Measured measure_weights(const Setting& s) {
  Measured out;
  add_skeleton(out, s, "five bones", joint_count);
  add_skeleton(out, s, "two bones", 2);
  return out;
}

Measured measure_carry_from(const Setting& s) {
  const Copy worn = clothes(s);
  const Setting to(s.body, worn);
  Measured out;
  out.add("weights", carried(s, to, Painted(s.body, s.copy.origin)));
  return out;
}

Measured measure_carry_to(const Setting& s) {
  const Copy worn = clothes(s);
  const Setting from(s.body, worn);
  Measured out;
  out.add("weights", carried(from, s, Painted(s.body, worn.origin)));
  return out;
}

Measured measure_mirror(const Setting& s) {
  const Chain chain(s);
  const Painted painted(s.body, s.copy.origin);
  const Vec centre = s.place(0.5 * (s.body.low + s.body.high)), normal = s.turn({1, 0, 0});
  const double plane[] = {centre[0], centre[1], centre[2], normal[0], normal[1], normal[2]};
  hf_weights_mirror_desc d = HF_INIT(hf_weights_mirror_desc);
  d.joint_count = joint_count;
  d.heads = chain.heads.data();
  d.plane = plane;
  d.source_influence_count = 2;
  d.joints = painted.joints.data();
  d.weights = painted.weights.data();
  Received received(s.copy.points.size());
  ok(hf_weights_mirror(s.surface(), &d, &received.desc, nullptr, nullptr, nullptr, nullptr));
  Measured out;
  out.add("weights", table(s, received));
  return out;
}

}  // namespace invariance
