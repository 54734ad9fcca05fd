// A C++ host whose allocator throws. The exception must not leave the library: every call returns a code, and the
// host's own exceptions go on working. Returns 0 when that holds.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "hf/hf.h"

namespace {

long until_throw = -1, live = 0;

void* allocate(void*, std::size_t size, std::size_t alignment) {
  if (until_throw >= 0 && until_throw-- == 0) throw std::runtime_error("a fault of the host");
  char* block = static_cast<char*>(std::malloc(size + alignment + sizeof(void*)));
  if (!block) return nullptr;
  const auto at = (reinterpret_cast<std::uintptr_t>(block) + sizeof(void*) + alignment - 1) / alignment * alignment;
  reinterpret_cast<void**>(at)[-1] = block;
  ++live;
  return reinterpret_cast<void*>(at);
}

void release(void*, void* block, std::size_t, std::size_t) {
  --live;
  std::free(static_cast<void**>(block)[-1]);
}

}  // namespace

int main() {
  const float positions[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0};
  const std::uint32_t triangles[] = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5};
  unsigned refused = 0, wrong = 0;
  for (long at = 0; at < 400; ++at) {
    hf_surface_desc mesh = HF_INIT(hf_surface_desc);
    mesh.positions = HF_ARRAY(positions, 6);
    mesh.triangles = HF_ARRAY(triangles, 4);
    mesh.allocator.allocate = allocate;
    mesh.allocator.release = release;
    hf_surface surface = nullptr;
    until_throw = at;
    const hf_result result = hf_surface_create(&mesh, &surface);
    until_throw = -1;
    if (result == HF_OK) hf_surface_destroy(surface);
    refused += result == HF_ERROR_INTERNAL;
    wrong += result != HF_OK && result != HF_ERROR_INTERNAL;
  }
  bool caught = false;
  try {
    throw std::runtime_error("the host's own");
  } catch (const std::exception&) {
    caught = true;
  }
  std::printf("%u calls refused, %u wrong answers, %ld blocks left\n", refused, wrong, live);
  return refused > 20 && wrong == 0 && live == 0 && caught ? 0 : 1;
}
