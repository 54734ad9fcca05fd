// Carries weights from one surface to another: clothes, hair, levels of detail, new topology.
//
// A vertex gets the weights of the nearest point of the source within a distance, among the points whose normal agrees.
// One solve with these vertices as sites fills in the others (Abdrashitov, Raichstat, Monsen, Hill 2023). Pieces
// without a match take the weights of the nearest points.
#pragma once
#include "weights/carry_fill.h"
#include "weights/carry_match.h"

namespace hf_inner::weights {

// Weights by vertex of the caller, a view of the caller's arrays.
struct GivenWeights {
  std::uint32_t influences = 0;
  const std::uint32_t* joints = nullptr;  // [vertex][influences]
  const float* weights = nullptr;
};

struct MatchOptions {
  double distance = 0;  // inner unit of the source
  double cosine = 1;    // normals agree from this cosine on
  std::int32_t influences = 4;
};

// Reads the rows of the inner vertices. takes(v): whether vertex v has weights; others get empty rows.
template <class Takes>
WeightRows read_rows(const mesh::Mesh& mesh, const GivenWeights& given, Takes&& takes, Memory& memory) {
  WeightRows rows(memory);
  Poller poller;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    poller.due();
    const std::size_t first = at(mesh.given_of_inner[at(v)]) * given.influences;
    for (std::size_t i = first; takes(v) && i < first + given.influences; ++i) {
      if (given.weights[i] > 0) rows.add(static_cast<Index>(given.joints[i]), static_cast<double>(given.weights[i]));
    }
    rows.close();
  }
  return rows;
}

// The place and normal of a vertex of the target on the source.
struct Probe {
  Vec3 place, normal;
};

// Finds the match of every vertex for which probe(v, out) is true. any: the nearest point, of any normal and distance.
template <class ProbeOf>
Vector<Match> find_matches(const WeightedShape& source, const surface::Core& target, const MatchOptions& options,
                           bool any, ProbeOf&& probe) {
  // Vertices in one thread's job, some 0.2 ms. A transfer to 17,424 vertices takes 75 ms on two threads; half and
  // double change it by 2 ms at most.
  constexpr std::size_t piece = 256;
  const double within = any ? HUGE_VAL : options.distance * options.distance, cosine = any ? -1 : options.cosine;
  Vector<Match> out(at(target.size()), target.memory.get());
  for_ranges(*target.jobs, out.size(), piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Probe p;
      if (probe(static_cast<Index>(v), p)) out[v] = source.find(p.place, p.normal, within, cosine);
    }
  });
  return out;
}

// source, skin: of the surface with weights. target: a core of the other. surface: as in Fill. Throws HF_ERROR_EMPTY if
// no vertex of the source has weights.
FilledWeights transfer_weights(const mesh::Mesh& source, const mesh::SkinShape& skin, const GivenWeights& given,
                               std::shared_ptr<const surface::Core> target, const MatchOptions& options,
                               const surface::Surface* surface = nullptr);

}  // namespace hf_inner::weights
