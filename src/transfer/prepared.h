// Data that a transfer derives from its pairs (Transfer::Prepared), shared by its files.
#pragma once
#include <algorithm>

#include "transfer/transfer.h"

namespace hf_inner {

// A cluster's motion for the blend: columns of the matrix and the shift, one number of padding each.
struct BlendColumns {
  double m[4][4] = {};
};

inline Vec3 region_mean(Span<const std::int32_t> region, const Vec3* points) noexcept {
  Vec3 sum;
  for (const std::int32_t v : region) sum = sum + points[v];
  return (1.0 / static_cast<double>(region.size())) * sum;
}

inline double lowest(Span<const std::int32_t> region, const Vec3* points, Vec3 up) noexcept {
  double low = no_height;
  for (const std::int32_t v : region) low = std::min(low, dot(points[v], up));
  return low;
}

inline double smooth_step(double low, double high, double x) noexcept {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

inline Vec3 up_of(const Mat3& axes) noexcept { return {axes(1, 0), axes(1, 1), axes(1, 2)}; }

// Everything derived from the pairs, and the last frame. It is made completely or not at all.
struct Transfer::Prepared {
  explicit Prepared(Memory& memory)
      : source_leak(&memory),
        target_leak(&memory),
        limb_angle(&memory),
        confidence(&memory),
        limb_turn(&memory),
        aligned(&memory),
        cluster_turn(&memory),
        clusters(memory),
        source_rotations(memory),
        translations(memory),
        refit(memory),
        anchors(&memory),
        posed(&memory),
        given(&memory),
        rotations(&memory),
        matrices(&memory),
        shifts(&memory),
        cluster_goals(&memory),
        goals(&memory),
        loose(&memory),
        holds(&memory),
        given_hold(&memory),
        rides(&memory),
        columns(&memory),
        blended(&memory),
        source_owner(&memory),
        rest_lows(&memory),
        source_lows(&memory),
        target_lows(&memory),
        touch(&memory),
        deepest(&memory) {}
  struct Anchor {
    std::uint32_t number = 0, flags = 0;
    bool is_foot = false;
    std::int32_t cluster = 0;  // of largest weight on the region
    Vec3 source_rest, target_rest;
  };

  Buffer<double> source_field, target_field;
  // per pair, in the order of numbers_
  Vector<double> source_leak, target_leak, limb_angle, confidence;
  Vector<Quaternion> limb_turn;  // D_h
  Vector<std::uint8_t> aligned;
  Vector<Quaternion> cluster_turn;  // D_h^w
  Clusters clusters;
  SourceRotations source_rotations;
  Translations translations;
  Refit refit;
  Vector<Anchor> anchors;
  double scale = 1;  // s in inner units
  double source_ground = 0, target_ground = 0;
  Vec3 target_centroid;
  // the last frame
  Vector<Vec3> posed;                   // source, inner units
  Vector<Quaternion> given, rotations;  // from the source, and as refitted
  Vector<Mat3> matrices;
  Vector<Vec3> shifts, cluster_goals, goals;
  Vector<Anchor> loose;     // pairs without an anchor: only holds move them.
  Vector<Hold> holds;       // of this round; room for one per pair and vertex row.
  Vector<Hold> given_hold;  // of the caller, per row; share 0 = none.
  // the surface over the ground
  Vector<std::int32_t> rides;  // per target vertex: row of the region it moves with, or -1.
  Vector<BlendColumns> columns;
  Vector<Vec3> blended;               // posed target, inner units.
  double lift = 0;                    // of everything, along up.
  Vector<std::int32_t> source_owner;  // per source vertex: cluster whose centre is nearest.
  // Per cluster: lowest scaled height of its source vertices over the ground, at rest and now. Lowest height of its
  // target vertices. Area that touches the ground now and not at rest.
  Vector<double> rest_lows, source_lows, target_lows, touch;
  double source_low = 0;  // of all, along up
  struct Sunk {
    double depth = 0;
    std::int32_t vertex = -1;
  };
  Vector<Sunk> deepest;  // per row of a region, then per cluster
  std::int32_t held_vertices[vertex_rows] = {};
};

}  // namespace hf_inner
