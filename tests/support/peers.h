/* Whether the library at hand was built with the paper's engine and with METIS (HF_WITH_GPL). A test asks at run time: the
 * same program runs with what ships and with the library that has its peers. */
#ifndef HF_TESTS_SUPPORT_PEERS_H
#define HF_TESTS_SUPPORT_PEERS_H

#include <hf/hf.h>

static inline int has_peers(void) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t triangle[] = {0, 1, 2};
  hf_surface surface;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions, 3);
  desc.triangles = HF_ARRAY(triangle, 1);
  desc.ordering = HF_ORDERING_METIS;
  if (hf_surface_create(&desc, &surface) != HF_OK) return 0;
  hf_surface_destroy(surface);
  return 1;
}

#endif
