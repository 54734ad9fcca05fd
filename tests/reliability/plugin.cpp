// A plug-in of a host that uses the library. unload.cpp loads, runs and unloads it.
#include "whole_api.h"

extern "C" __attribute__((visibility("default"))) int hf_plugin_run(const void* scene, std::uint64_t* hash) {
  reliability::Options options;
  options.threads = 3;
  options.paper_engine = false;
  const reliability::Outcome outcome =
      reliability::run_whole_api(*static_cast<const reliability::Scene*>(scene), options);
  *hash = outcome.hash;
  return static_cast<int>(outcome.unexpected);
}
