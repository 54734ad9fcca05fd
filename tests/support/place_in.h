/* A place in a triangle of a list of corners, for tests in C and C++. */
#ifndef PLACE_IN_H
#define PLACE_IN_H

#include "hf/hf.h"

/* count: triangles of the list; beyond it the corners are HF_NO_INDEX. weights: three. */
static inline hf_place place_in(const uint32_t* corners, uint32_t count, uint32_t triangle, const double* weights) {
  hf_place place = {{HF_NO_INDEX, HF_NO_INDEX, HF_NO_INDEX}, 0, {weights[0], weights[1], weights[2]}};
  for (int k = 0; k < 3 && triangle < count; ++k) place.corners[k] = corners[3 * (size_t)triangle + (size_t)k];
  return place;
}

#endif
