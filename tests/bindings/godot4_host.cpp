// A host without Godot: godot4_host LIBRARY. It loads the add-on's library for Godot 4 and calls hf_godot_init. With
// every function there it must succeed; with one missing it must fail and name that one.
#include <cstdio>
#include <cstring>
#include <string>

#include "../../bindings/godot/src/godot4.h"
#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace {

const char* missing = "";
std::string said;

void print_error(const char*, const char* message, const char*, const char*, int32_t, uint8_t) { said = message; }
void nothing() {}

godot4::Function find(const char* name) {
  if (std::strcmp(name, missing) == 0) return nullptr;
  if (std::strcmp(name, "print_error_with_message") == 0) return reinterpret_cast<godot4::Function>(print_error);
  return nothing;  // loading calls none of the others
}

using Init = uint8_t (*)(godot4::FindFunction, void*, godot4::Initialization*);

Init entry_of(const char* path) {
#if defined(_WIN32)
  HMODULE library = LoadLibraryA(path);
  return library ? reinterpret_cast<Init>(reinterpret_cast<void*>(GetProcAddress(library, "hf_godot_init"))) : nullptr;
#else
  void* library = dlopen(path, RTLD_NOW);
  if (!library) std::fprintf(stderr, "%s\n", dlerror());
  return library ? reinterpret_cast<Init>(dlsym(library, "hf_godot_init")) : nullptr;
#endif
}

}  // namespace

int main(int count, char** arguments) {
  const Init init = count == 2 ? entry_of(arguments[1]) : nullptr;
  if (!init) return std::fprintf(stderr, "no hf_godot_init in %s\n", count == 2 ? arguments[1] : "LIBRARY"), 1;
  int token = 0, functions = 0, failed = 0;
  godot4::Initialization initialization{};
  if (init(find, &token, &initialization) != 1 || initialization.least != godot4::scene_level ||
      !initialization.initialize || !initialization.deinitialize || !said.empty())
    failed += std::printf("FAILED with every function: %s\n", said.c_str()) > 0;

#define HF_GODOT4_NAME(result, name, parameters) #name,
  for (const char* name : {HF_GODOT4_FUNCTIONS(HF_GODOT4_NAME)}) {
    missing = name;
    said.clear();
    ++functions;
    const bool can_say = std::strcmp(name, "print_error_with_message") != 0;
    if (init(find, &token, &initialization) != 0 || (can_say && said.find(name) == std::string::npos))
      failed += std::printf("FAILED without %s: %s\n", name, said.c_str()) > 0;
  }
  std::printf("%d functions, each missing once: %d failed\n", functions, failed);
  return failed > 0;
}
