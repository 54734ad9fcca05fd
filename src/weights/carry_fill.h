// Fills in the weights of a surface of which some vertices have weights: one solve with those vertices as sites.
#pragma once
#include "surface/surface.h"
#include "weights/solution.h"
#include "weights/weight_rows.h"

namespace hf_inner::weights {

struct FilledWeights {
  explicit FilledWeights(Memory& memory)
      : joints(&memory), weights(&memory), origin(&memory), nearest_of_isolated(&memory) {}
  std::int32_t influences = 0;
  Vector<std::uint32_t> joints;  // [inner vertex][influences]
  Vector<float> weights;
  Vector<Origin> origin;              // by inner vertex
  Vector<Index> nearest_of_isolated;  // by Mesh::isolated
  std::uint32_t by_origin[8] = {};    // vertices of the caller, by Origin
  std::uint32_t pieces_guessed = 0;   // pieces without a vertex that has weights
};

// A surface of which some vertices have weights.
struct Fill {
  Fill(std::shared_ptr<const surface::Core> target, Memory& memory, const surface::Surface* whose = nullptr)
      : core(std::move(target)), surface(whose), known(memory), origin(&memory) {}
  std::shared_ptr<const surface::Core> core;
  const surface::Surface*
      surface;            // where the bi-harmonic core comes from, if there is something to solve; null: core solves
  WeightRows known;       // by inner vertex
  Vector<Origin> origin;  // of the known ones
};

// By component: whether a vertex of it is known.
Vector<std::uint8_t> known_pieces(const mesh::Mesh& mesh, const WeightRows& known, Memory& memory);

// guessed: rows for every vertex of pieces without a known one. influences: 4 or 8.
FilledWeights fill_weights(const Fill& fill, const WeightRows& guessed, std::int32_t influences);

}  // namespace hf_inner::weights
