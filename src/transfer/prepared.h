// The data that a transfer derives from its pairs (Transfer::Prepared), shared by the files of Transfer.
#pragma once
#include <algorithm>
#include <cmath>

#include "mesh/places.h"
#include "transfer/gradients.h"
#include "transfer/levers.h"
#include "transfer/transfer.h"

namespace hf_inner::transfer {

// A cluster's motion as the blend reads it: three matrix columns and the shift, each padded to four numbers.
struct BlendColumns {
  double m[4][4] = {};
};

inline bool is_finite(Vec3 p) noexcept { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

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

// Everything computed from the pairs of regions, and the last frame. It is made completely or not at all.
struct Transfer::Prepared {
  explicit Prepared(Memory& memory)
      : source_leak(&memory),
        target_leak(&memory),
        limb_angle(&memory),
        confidence(&memory),
        limb_turn(&memory),
        aligned(&memory),
        cluster_turn(&memory),
        neck(memory),
        tail(memory),
        arms{DialLimb(memory), DialLimb(memory)},
        dialled_turn(&memory),
        stiff(&memory),
        excess(&memory),
        dial_holds(&memory),
        clusters(memory),
        source_rotations(memory),
        translations(memory),
        refit(memory),
        slack(memory),
        levers(memory),
        gradients(memory),
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
        source_hangs(&memory),
        sinks(&memory),
        rises(&memory),
        needs(&memory),
        forces(&memory),
        block_needs(&memory),
        hold_forces(&memory),
        rigid_motions(&memory) {}
  struct Anchor {
    std::uint32_t number = 0, flags = 0;
    bool is_foot = false;
    std::int32_t cluster = 0;  // cluster of vertices with the largest weight on the region
    double fallen = 0;         // of the last frame, from 0 to 1: with the body, and as far as a foot itself
    Vec3 source_rest, target_rest;
  };

  Buffer<double> source_field, target_field;
  // The next arrays have one entry per pair, in the order of numbers_.
  Vector<double> source_leak, target_leak, limb_angle, confidence;
  Vector<deform::Quaternion> limb_turn;     // turns the target's limb at rest to the source's direction
  Vector<double> aligned;                   // the share of that turn that the limb makes, 0 to 1
  Vector<deform::Quaternion> cluster_turn;  // the part of its limb's turn that a cluster makes
  // A limb that a dial turns: the share of each cluster in it, the cluster at its root, and the turn that takes its
  // rest direction to the source's.
  struct DialLimb {
    explicit DialLimb(Memory& memory) : share(&memory) {}
    Vector<double> share;
    std::int32_t root = -1;  // -1: no pair has the flag
    deform::Quaternion turn;
  };
  DialLimb neck, tail, arms[2];             // arms: right and left, whose turn is one radian away from the body
  Vector<deform::Quaternion> dialled_turn;  // cluster_turn after the dials
  Vector<double> stiff;                     // per cluster: how far it keeps the rotation of its limb's root
  Vector<Vec3> excess;                      // per anchor: how far the dials move its goal in this frame
  Vec3 body_excess;                         // and the whole body
  double hip_height = 0;                    // mean rest height of the trunk's anchors over the ground
  double body_rise = 0;                     // how far the dials raise them in this frame
  Vector<Hold> dial_holds;
  Clusters clusters;
  SourceRotations source_rotations;
  Translations translations;
  Refit refit;
  Slack slack;
  Levers levers;        // HF_TRANSFER_FIELDS only
  Gradients gradients;  // HF_TRANSFER_STRETCH only
  Vector<Anchor> anchors;
  double scale = 1;  // target lengths over source lengths, in inner units
  double source_ground = 0, target_ground = 0;
  Vec3 target_centroid;
  // The state of the last frame.
  Vector<Vec3> posed;                           // source, inner units
  Vector<deform::Quaternion> given, rotations;  // rotations from the source, and after turning to fit neighbours
  Vector<Mat3> matrices;
  Vector<Vec3> shifts, cluster_goals, goals;
  Vector<Anchor> loose;     // pairs whose target region does not follow the source's path
  Vector<Hold> holds;       // this round's constraints: room for one per pair and held vertex
  Vector<Hold> given_hold;  // constraint of the caller per region; share 0: none
  // Data that keeps the surface above the ground.
  Vector<std::int32_t> rides;  // by target vertex: the region it moves with, or -1
  Vector<BlendColumns> columns;
  Vector<Vec3> blended;               // posed target, inner units.
  Vector<std::int32_t> source_owner;  // per source vertex: cluster whose centre is nearest.
  // Four arrays with one entry per cluster. The arrays rest_lows and source_lows hold the lowest scaled height of the
  // cluster's source vertices over the ground, at rest and now. The array target_lows holds the lowest height of the
  // cluster's target vertices. touch: the cluster's area if the cluster touches the ground now but not at rest.
  Vector<double> rest_lows, source_lows, target_lows, touch;
  double source_low = 0;              // lowest height of the source vertices that do not hang below its feet at rest
  Vector<std::uint8_t> source_hangs;  // per source vertex: 1 if it does
  Vector<std::uint8_t> sinks;         // per target vertex: 1 if it may stay under the ground
  Vector<double> rises;               // per cluster: how far it is raised
  Vector<double> needs, forces;       // per vertex: how far it must rise, and the force that raises it
  Vector<double> block_needs;         // the largest need of some adjacent vertices
  Vector<double> hold_forces;         // per constraint of the frame: the force that keeps it in place
  Vector<deform::RigidMotion> rigid_motions;  // of rigid pieces in the last frame, in the caller's units
};

}  // namespace hf_inner::transfer
