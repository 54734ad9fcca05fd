// The data a pose derives from its handles (Pose::Layout), shared by its files.
#pragma once
#include "deform/pose.h"

namespace hf_inner::deform {

struct Pose::Layout {
  explicit Layout(const Handles& list, std::shared_ptr<solve::SiteSolver> solver, const surface::Core& core,
                  Memory& memory)
      : handles(list, &memory),
        sites(std::move(solver)),
        reach(core.mesh, handles, memory),
        fields(0, 0, memory),
        weights(memory),
        boxes(&memory) {}
  Handles handles;
  std::shared_ptr<solve::SiteSolver> sites;
  std::shared_ptr<solve::SiteSolver>
      plain_sites;  // the same on the core whose factor this core extends; null: not made yet
  Reach reach;
  HandleFields fields;
  ClusterWeights weights;
  Vector<BlendBox> boxes;  // of the clusters at rest
  std::shared_ptr<const Groups> groups;
  std::shared_ptr<const SmoothSystem> smooth;       // null: with a scheme
  std::shared_ptr<const PoseScheme::System> rigid;  // null: without one
};

}  // namespace hf_inner::deform
