// Reads named chains from JSON, finds their joints by name and writes them into the models.
#include "gltf/named_chains.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "gltf/node_match.h"
#include "skeleton/character.h"

namespace hf_gltf {
namespace {

using hf_inner::skeleton::Role;

// Parts that come in two, one on each side of the body.
bool has_sides(Role role) {
  return role == Role::shoulder || role == Role::arm || role == Role::hand || role == Role::finger ||
         role == Role::leg || role == Role::foot || role == Role::toe || role == Role::wing;
}

bool is_in_the_middle(Role role) {
  return role == Role::spine || role == Role::neck || role == Role::head || role == Role::jaw || role == Role::tail;
}

// Reads a side, a part and perhaps a number: "left arm", "right leg 2", "tail". Returns false for any other name.
bool read_name(NamedChain& chain) {
  std::istringstream words(chain.name);
  std::string word, number, more;
  words >> word;
  chain.side = word == "left" ? 1 : word == "right" ? 2 : 0;
  if (chain.side != 0) words >> word;
  if (words >> number && number.find_first_not_of("0123456789") != std::string::npos) return false;
  if (words >> more) return false;
  for (std::int32_t r = 0; r < hf_inner::skeleton::role_count; ++r) {
    if (word != role_name(static_cast<Role>(r))) continue;
    chain.part = word;
    const Role role = static_cast<Role>(r);
    return chain.side != 0 ? !is_in_the_middle(role) : !has_sides(role);
  }
  return false;
}

std::vector<std::string> read_joints(const JsonReader& json) {
  std::vector<std::string> out;
  for (size_t i = 0; i < json.size(); ++i) out.push_back(json.at(i).string());
  if (out.empty()) json.fail("the chain has no joint; name one or more");
  return out;
}

void say(const std::vector<NamedChain>& chains, std::vector<std::string> NamedChain::*side, Model& model) {
  for (const NamedChain& chain : chains) {
    const std::string where = chain.where + ": chain \"" + chain.name + "\": ";
    for (const std::string& name : chain.*side) {
      const std::vector<int> nodes = nodes_named(model, name);
      if (nodes.empty())
        throw std::runtime_error(where + model.name + " has no joint \"" + name + "\"; --joints FILE lists them");
      if (nodes.size() > 1) throw std::runtime_error(where + model.name + " has " + several_joints(name, nodes));
      for (const SaidJoint& other : model.said)
        if (other.node == nodes[0])
          throw std::runtime_error(where + "joint \"" + name + "\" of " + model.name + " is in chain \"" + other.chain +
                                   "\" already");
      model.said.push_back({nodes[0], chain.part, chain.side, chain.name});
    }
  }
}

}  // namespace

std::vector<NamedChain> read_chains(const JsonReader& json) {
  std::vector<NamedChain> out;
  for (size_t i = 0; i < json.size(); ++i) {
    const JsonReader entry = json.at(i);
    entry.expect_only({"name", "both", "source", "target"});
    NamedChain chain;
    chain.name = entry.at("name").string();
    chain.where = entry.path();
    if (!read_name(chain))
      entry.at("name").fail(
          "expected a side, a part and perhaps a number, such as \"left arm\", \"right leg 2\" or "
          "\"tail\"; found \"" +
          chain.name + "\"");
    for (const NamedChain& other : out)
      if (other.name == chain.name)
        entry.at("name").fail("the name \"" + chain.name + "\" is taken by an earlier chain; append a number");
    if (entry.has("both") && (entry.has("source") || entry.has("target")))
      entry.fail("give \"both\", or \"source\" and \"target\", but not all");
    if (!entry.has("both") && !entry.has("source") && !entry.has("target"))
      entry.fail("give \"both\", \"source\" or \"target\": the joints of the chain");
    if (entry.has("both")) chain.source = chain.target = read_joints(entry.at("both"));
    if (entry.has("source")) chain.source = read_joints(entry.at("source"));
    if (entry.has("target")) chain.target = read_joints(entry.at("target"));
    out.push_back(std::move(chain));
  }
  return out;
}

void say_chains(const std::vector<NamedChain>& chains, Model& source, Model& target) {
  say(chains, &NamedChain::source, source);
  say(chains, &NamedChain::target, target);
}

}  // namespace hf_gltf
