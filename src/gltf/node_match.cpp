// See node_match.h.
#include "gltf/node_match.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "gltf/animate.h"

namespace hf_gltf {
namespace {

// Nodes that a search below unmatched parents may visit, all together. Such a search is for skeletons that differ by a
// joint between; a file made for it would cost the square of its nodes.
constexpr size_t most_visits = 4000000;
// Children of one name times children of that name there: above it their order alone decides.
constexpr size_t most_compared = 10000;
// Directions that agree to this share of a right angle are as good as each other, and the order decides.
constexpr double direction_step = 0.02;

std::string plain(const std::string& name) { return name.substr(name.rfind(':') + 1); }

// Joints of skins and the nodes above them; all nodes where there is no skin.
std::vector<char> skeleton_of(const Model& model) {
  std::vector<char> out(model.nodes.size(), model.skins.empty() ? 1 : 0);
  for (const Skin& skin : model.skins)
    for (const int node : with_parents(model, skin.joints)) out[static_cast<size_t>(node)] = 1;
  return out;
}

class Matcher {
 public:
  Matcher(const Model& from, const std::vector<int>& nodes, const Model& to)
      : from_(from), to_(to), order_(with_parents(from, nodes)), taken_(to.nodes.size(), 0) {
    match_.there.assign(from.nodes.size(), -1);
    match_.shared.assign(from.nodes.size(), 0);
  }

  NodeMatch run() {
    const std::vector<char> skeleton = skeleton_of(to_);
    for (size_t n = 0; n < to_.nodes.size(); ++n)
      if (skeleton[n]) candidates_.push_back(static_cast<int>(n));
    count_shared();
    match_unique([](const Node& node) { return node.name; });
    match_unique([](const Node& node) { return plain(node.name); });
    match_above();
    match_below();
    // a node that is no joint, such as a weapon
    candidates_.clear();
    for (size_t n = 0; n < to_.nodes.size(); ++n)
      if (!skeleton[n] && !taken_[n]) candidates_.push_back(static_cast<int>(n));
    match_unique([](const Node& node) { return node.name; });
    match_unique([](const Node& node) { return plain(node.name); });
    return std::move(match_);
  }

 private:
  const Node& node_of(int n) const { return from_.nodes[static_cast<size_t>(n)]; }
  const Node& node_there(int n) const { return to_.nodes[static_cast<size_t>(n)]; }
  int& there(int n) { return match_.there[static_cast<size_t>(n)]; }

  void take(int node, int other) {
    there(node) = other;
    taken_[static_cast<size_t>(other)] = 1;
  }

  void count_shared() {
    std::map<std::string, std::pair<size_t, size_t>> count;
    for (const int n : order_) ++count[plain(node_of(n).name)].first;
    for (const int n : candidates_) ++count[plain(node_there(n).name)].second;
    for (const int n : order_) {
      const auto& [here, other] = count[plain(node_of(n).name)];
      match_.shared[static_cast<size_t>(n)] = here > 1 || other > 1;
    }
  }

  template <class Name>
  void match_unique(Name name) {
    struct Nodes {
      int node = -1, other = -1;
      size_t nodes = 0, others = 0;
    };
    std::map<std::string, Nodes> by_name;
    for (const int n : order_) {
      if (there(n) >= 0) continue;
      Nodes& entry = by_name[name(node_of(n))];
      entry.node = n;
      ++entry.nodes;
    }
    for (const int n : candidates_) {
      if (taken_[static_cast<size_t>(n)]) continue;
      Nodes& entry = by_name[name(node_there(n))];
      entry.other = n;
      ++entry.others;
    }
    for (const auto& [text, entry] : by_name)
      if (!text.empty() && entry.nodes == 1 && entry.others == 1) take(entry.node, entry.other);
  }

  // The parents of nodes that are matched, while they have the same name.
  void match_above() {
    for (auto n = order_.rbegin(); n != order_.rend(); ++n) {
      const int up = node_of(*n).parent;
      if (there(*n) < 0 || up < 0 || there(up) >= 0) continue;
      const int other = node_there(there(*n)).parent;
      if (other < 0 || taken_[static_cast<size_t>(other)]) continue;
      if (plain(node_of(up).name) == plain(node_there(other).name)) take(up, other);
    }
  }

  void match_below() {
    std::map<std::pair<int, std::string>, std::vector<int>> groups;  // by parent and name
    std::vector<char> wanted(from_.nodes.size(), 0);
    for (const int n : order_) wanted[static_cast<size_t>(n)] = 1;
    const auto add = [&](int n) {
      if (wanted[static_cast<size_t>(n)] && there(n) < 0)
        groups[{node_of(n).parent, plain(node_of(n).name)}].push_back(n);
    };
    for (const int n : order_) {
      if (node_of(n).parent < 0) add(n);
      for (const int child : node_of(n).children) add(child);
    }
    for (const int n : order_) {
      if (there(n) >= 0) continue;
      const std::string name = plain(node_of(n).name);
      const auto group = groups.find({node_of(n).parent, name});
      if (group == groups.end()) continue;
      const std::vector<int> nodes = std::move(group->second);
      groups.erase(group);
      int above = node_of(n).parent;
      while (above >= 0 && there(above) < 0) above = node_of(above).parent;
      assign(nodes, named_below(above < 0 ? -1 : there(above), name));
    }
  }

  // Nodes of a name that are not taken: the children of a node; where none has it, the next below it. -1: the roots.
  std::vector<int> named_below(int above, const std::string& name) {
    std::vector<int> level, out;
    if (above >= 0) {
      level = node_there(above).children;
    } else {
      for (const int n : candidates_)
        if (node_there(n).parent < 0) level.push_back(n);
    }
    while (out.empty() && !level.empty()) {
      visits_ += level.size();
      if (visits_ > most_visits) return {};
      std::vector<int> next;
      for (const int n : level) {
        const bool open = !taken_[static_cast<size_t>(n)];
        if (open && plain(node_there(n).name) == name) out.push_back(n);
        // nodes below a taken node are found from there
        if (open || above < 0) next.insert(next.end(), node_there(n).children.begin(), node_there(n).children.end());
      }
      level.swap(next);
    }
    return out;
  }

  void assign(const std::vector<int>& nodes, const std::vector<int>& others) {
    if (nodes.size() * others.size() > most_compared) {
      for (size_t i = 0; i < nodes.size() && i < others.size(); ++i) take(nodes[i], others[i]);
      return;
    }
    struct Choice {
      double apart;
      size_t node, other;
    };
    std::vector<Choice> choices;
    for (size_t i = 0; i < nodes.size(); ++i)
      for (size_t k = 0; k < others.size(); ++k)
        choices.push_back({apart(node_of(nodes[i]), node_there(others[k])), i, k});
    std::stable_sort(choices.begin(), choices.end(),
                     [](const Choice& a, const Choice& b) { return a.apart < b.apart; });
    for (const Choice& choice : choices)
      if (there(nodes[choice.node]) < 0 && !taken_[static_cast<size_t>(others[choice.other])])
        take(nodes[choice.node], others[choice.other]);
  }

  // First whether the prefixes differ, then the directions.
  static double apart(const Node& a, const Node& b) {
    const glm::dvec3 p(rest_translation(a)), q(rest_translation(b));
    const double lengths = glm::length(p) * glm::length(q);
    const double off = lengths > 0 ? 1 - glm::dot(p, q) / lengths : 1;
    return std::round(off / direction_step) + (a.name == b.name ? 0.0 : 4 / direction_step);
  }

  const Model &from_, &to_;
  const std::vector<int> order_;  // parents first
  std::vector<int> candidates_;   // nodes of `to`
  std::vector<char> taken_;
  NodeMatch match_;
  size_t visits_ = 0;
};

}  // namespace

glm::dvec3 rest_translation(const Node& node) { return node.matrix ? glm::dvec3((*node.matrix)[3]) : node.translation; }

NodeMatch match_nodes(const Model& from, const std::vector<int>& nodes, const Model& to) {
  return Matcher(from, nodes, to).run();
}

std::vector<int> nodes_named(const Model& model, const std::string& name) {
  std::vector<char> is_joint(model.nodes.size(), 0);
  for (const Skin& skin : model.skins)
    for (const int joint : skin.joints) is_joint[static_cast<size_t>(joint)] = 1;
  std::vector<int> joints, others;
  for (size_t n = 0; n < model.nodes.size(); ++n)
    if (model.nodes[n].name == name) (is_joint[n] ? joints : others).push_back(static_cast<int>(n));
  if (!joints.empty() || !others.empty()) return joints.empty() ? others : joints;
  const int number = node_number(name);
  if (number >= 0 && static_cast<size_t>(number) < model.nodes.size()) return {number};
  return {};
}

std::string several_joints(const std::string& name, const std::vector<int>& nodes) {
  constexpr size_t most_shown = 8;
  std::string numbers;
  for (size_t i = 0; i < nodes.size() && i < most_shown; ++i)
    numbers += (i > 0 ? ", #" : "#") + std::to_string(nodes[i]);
  if (nodes.size() > most_shown) numbers += ", ...";
  return std::to_string(nodes.size()) + " joints \"" + name + "\"; name one by its number: " + numbers;
}

int node_number(const std::string& name) {
  int number = -1;
  const auto end = name.data() + name.size();
  if (name.size() < 2 || name[0] != '#' || std::from_chars(name.data() + 1, end, number).ptr != end) return -1;
  return number;
}

}  // namespace hf_gltf
