// A constant of the search for links that the environment can replace: HF_LINK_<name>=<value>. For hf_link_trials only.
#pragma once
#include <cstdlib>
#include <string>

namespace hf_inner {

template <class Number>
Number trial(const char* name, Number standard) {
  const char* const given = std::getenv((std::string("HF_LINK_") + name).c_str());
  return given ? static_cast<Number>(std::strtod(given, nullptr)) : standard;
}

}  // namespace hf_inner
