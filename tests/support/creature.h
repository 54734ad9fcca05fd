// The creatures of samples/assets, each made once for the program: one takes a second.
#ifndef HF_TESTS_SUPPORT_CREATURE_H
#define HF_TESTS_SUPPORT_CREATURE_H

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "assets/creature.h"

namespace hf_test {

inline const samples::Creature& creature(const std::string& name, std::uint32_t vertices) {
  static std::map<std::pair<std::string, std::uint32_t>, samples::Creature> made;
  auto found = made.find({name, vertices});
  if (found == made.end()) found = made.emplace(std::pair(name, vertices), samples::make_creature(name, vertices)).first;
  return found->second;
}

}  // namespace hf_test

#endif
