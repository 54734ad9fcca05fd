// hf/hf.hpp - a thin C++17 wrapper over hf.h: handles that destroy themselves, failures as exceptions, vectors for
// arrays.
//
// Header only; every function forwards to the C function of the same name and nothing else happens here. The namespace
// is hfpp, because the library's own inner namespace is hf and its tests see both.
//
//   hfpp::Solver solver(positions, triangles);
//   auto sites = solver.add_sites({0, 41}, {0.0, 1.0});
//   std::vector<float> field = solver.solve();
#ifndef HF_HF_HPP
#define HF_HF_HPP

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hf/hf.h"

namespace hfpp {

// What a failing call reported. what() is "function: message (HF_ERROR_...)".
class Error : public std::runtime_error {
 public:
  explicit Error(const hf_error_detail& detail)
      : std::runtime_error(std::string(detail.function) + ": " + detail.message + " (" + hf_result_name(detail.code) +
                           ")"),
        code_(detail.code),
        index_(detail.index) {}
  hf_result code() const noexcept { return code_; }
  uint32_t index() const noexcept { return index_; }

 private:
  hf_result code_;
  uint32_t index_;
};

inline void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_get_error_detail(&detail);
  throw Error(detail);
}

// A desc with every byte zero but its size.
template <class Desc>
Desc make() {
  Desc desc;
  hf_init_desc(&desc, static_cast<uint32_t>(sizeof(Desc)));
  return desc;
}

// Owns one handle; moves, never copies.
template <class Raw, void (*destroy)(Raw)>
class Handle {
 public:
  Handle() noexcept = default;
  explicit Handle(Raw raw) noexcept : raw_(raw) {}
  Handle(Handle&& other) noexcept : raw_(std::exchange(other.raw_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      destroy(raw_);
      raw_ = std::exchange(other.raw_, nullptr);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { destroy(raw_); }
  Raw get() const noexcept { return raw_; }
  explicit operator bool() const noexcept { return raw_ != nullptr; }

 private:
  Raw raw_ = nullptr;
};

class Progress {
 public:
  Progress() {
    hf_progress raw = nullptr;
    check(hf_progress_create(&raw));
    handle_ = Handle<hf_progress, hf_progress_destroy>(raw);
  }
  float fraction() const {
    float value = 0;
    check(hf_progress_get(handle_.get(), &value));
    return value;
  }
  void cancel() { check(hf_progress_cancel(handle_.get())); }
  hf_progress get() const noexcept { return handle_.get(); }

 private:
  Handle<hf_progress, hf_progress_destroy> handle_;
};

class Solver {
 public:
  explicit Solver(const hf_create_desc& desc)
      : channels_(desc.channel_count ? desc.channel_count : 1), vertices_(desc.vertex_count) {
    hf_solver raw = nullptr;
    check(hf_create(&desc, &raw));
    handle_ = Handle<hf_solver, hf_destroy>(raw);
  }
  // xyz per vertex, three vertices per triangle.
  Solver(const std::vector<float>& positions, const std::vector<uint32_t>& triangles)
      : Solver(mesh(positions, triangles)) {}

  hf_solver get() const noexcept { return handle_.get(); }
  Solver clone() const {
    hf_solver raw = nullptr;
    check(hf_clone(get(), &raw));
    return Solver(raw, channels_, vertices_);
  }

  // Hard sites at vertices; values: channel_count per site. Returns their numbers.
  std::vector<uint32_t> add_sites(const std::vector<uint32_t>& vertices, const std::vector<double>& values) {
    need(values.size(), vertices.size() * channels_, "values");
    auto desc = make<hf_sites_desc>();
    desc.site_count = size(vertices), desc.vertices = vertices.data(), desc.values = values.data();
    return add_sites(desc);
  }
  std::vector<uint32_t> add_sites(const hf_sites_desc& desc) {
    std::vector<uint32_t> numbers(desc.site_count);
    check(hf_add_sites(get(), &desc, numbers.data()));
    return numbers;
  }
  void remove_sites(const std::vector<uint32_t>& sites) { check(hf_remove_sites(get(), size(sites), sites.data())); }
  void move_sites(const std::vector<uint32_t>& sites, const std::vector<uint32_t>& vertices) {
    auto to = make<hf_sites_desc>();
    to.site_count = size(vertices), to.vertices = vertices.data();
    check(hf_move_sites(get(), size(sites), sites.data(), &to));
  }
  void set_site_values(const std::vector<uint32_t>& sites, const std::vector<double>& values) {
    need(values.size(), sites.size() * channels_, "values");
    check(hf_set_site_values(get(), size(sites), sites.data(), values.data()));
  }
  uint32_t site_count() const noexcept { return hf_get_site_count(get()); }
  void record() { check(hf_record(get())); }
  void undo() { check(hf_undo(get())); }
  void redo() { check(hf_redo(get())); }

  std::vector<float> solve(hf_solve_info* info = nullptr) const {
    std::vector<float> field(size_t{vertices_} * channels_);
    check(hf_solve(get(), field.data(), 0, info));
    return field;
  }
  std::vector<double> solve_f64(hf_solve_info* info = nullptr) const {
    std::vector<double> field(size_t{vertices_} * channels_);
    check(hf_solve_f64(get(), field.data(), 0, info));
    return field;
  }
  std::vector<double> solve_at(const std::vector<uint32_t>& vertices) const {
    std::vector<double> values(vertices.size() * channels_);
    check(hf_solve_at(get(), size(vertices), vertices.data(), values.data()));
    return values;
  }
  hf_mesh_report mesh_report() const {
    auto report = make<hf_mesh_report>();
    check(hf_get_mesh_report(get(), &report));
    return report;
  }
  hf_statistics statistics() const {
    auto statistics = make<hf_statistics>();
    check(hf_get_statistics(get(), &statistics));
    return statistics;
  }

 private:
  Solver(hf_solver raw, uint32_t channels, uint32_t vertices)
      : handle_(raw), channels_(channels), vertices_(vertices) {}
  static hf_create_desc mesh(const std::vector<float>& positions, const std::vector<uint32_t>& triangles) {
    auto desc = make<hf_create_desc>();
    if (positions.size() % 3 != 0 || triangles.size() % 3 != 0)
      throw std::invalid_argument("positions and triangles hold three numbers each");
    desc.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    desc.triangle_count = static_cast<uint32_t>(triangles.size() / 3);
    desc.positions = positions.data(), desc.triangles = triangles.data();
    return desc;
  }
  static uint32_t size(const std::vector<uint32_t>& list) { return static_cast<uint32_t>(list.size()); }
  static void need(size_t given, size_t wanted, const char* name) {
    if (given != wanted)
      throw std::invalid_argument(std::string(name) + ": " + std::to_string(given) + " given, " +
                                  std::to_string(wanted) + " needed");
  }

  Handle<hf_solver, hf_destroy> handle_;
  uint32_t channels_ = 1, vertices_ = 0;
};

class Pose {
 public:
  explicit Pose(const Solver& solver, const hf_pose_desc* desc = nullptr)
      : vertices_(solver.mesh_report().vertex_count) {
    hf_pose raw = nullptr;
    check(hf_pose_create(solver.get(), desc, &raw));
    handle_ = Handle<hf_pose, hf_pose_destroy>(raw);
  }
  hf_pose get() const noexcept { return handle_.get(); }
  Pose clone() const {
    hf_pose raw = nullptr;
    check(hf_pose_clone(get(), &raw));
    return Pose(raw, vertices_);
  }
  // One region of vertices per handle.
  std::vector<uint32_t> add_handles(const std::vector<std::vector<uint32_t>>& regions) {
    std::vector<uint32_t> counts, vertices, numbers(regions.size());
    for (const auto& region : regions) {
      counts.push_back(static_cast<uint32_t>(region.size()));
      vertices.insert(vertices.end(), region.begin(), region.end());
    }
    auto desc = make<hf_handles_desc>();
    desc.handle_count = static_cast<uint32_t>(regions.size());
    desc.region_counts = counts.data(), desc.region_vertices = vertices.data();
    check(hf_pose_add_handles(get(), &desc, numbers.data()));
    return numbers;
  }
  void remove_handles(const std::vector<uint32_t>& handles) {
    check(hf_pose_remove_handles(get(), static_cast<uint32_t>(handles.size()), handles.data()));
  }
  void set_transform(uint32_t handle, const hf_transform& transform) {
    check(hf_pose_set_transforms(get(), 1, &handle, &transform));
  }
  uint32_t handle_count() const noexcept { return hf_pose_get_handle_count(get()); }
  hf_handle_info handle(uint32_t number) const {
    auto info = make<hf_handle_info>();
    check(hf_pose_get_handle(get(), number, &info));
    return info;
  }
  std::vector<float> deform(hf_deform_info* info = nullptr) {
    std::vector<float> positions(size_t{vertices_} * 3);
    auto desc = make<hf_deform_desc>();
    desc.positions = positions.data();
    check(hf_deform(get(), &desc, info));
    return positions;
  }

 private:
  Pose(hf_pose raw, uint32_t vertices) : handle_(raw), vertices_(vertices) {}
  Handle<hf_pose, hf_pose_destroy> handle_;
  uint32_t vertices_ = 0;
};

class Transfer {
 public:
  Transfer(const Solver& source, const Solver& target, const hf_transfer_desc* desc = nullptr)
      : source_vertices_(source.mesh_report().vertex_count), target_vertices_(target.mesh_report().vertex_count) {
    hf_transfer raw = nullptr;
    check(hf_transfer_create(source.get(), target.get(), desc, &raw));
    handle_ = Handle<hf_transfer, hf_transfer_destroy>(raw);
  }
  hf_transfer get() const noexcept { return handle_.get(); }
  uint32_t add_pair(const std::vector<uint32_t>& source, const std::vector<uint32_t>& target, uint32_t flags = 0) {
    const uint32_t source_count = static_cast<uint32_t>(source.size()),
                   target_count = static_cast<uint32_t>(target.size());
    auto desc = make<hf_pairs_desc>();
    desc.pair_count = 1, desc.flags = &flags;
    desc.source_counts = &source_count, desc.source_vertices = source.data();
    desc.target_counts = &target_count, desc.target_vertices = target.data();
    uint32_t number = HF_NO_INDEX;
    check(hf_transfer_add_pairs(get(), &desc, &number));
    return number;
  }
  void remove_pair(uint32_t pair) { check(hf_transfer_remove_pairs(get(), 1, &pair)); }
  // One posed frame of the source, in its own vertex order.
  std::vector<float> apply(const std::vector<float>& source_positions) {
    if (source_positions.size() != size_t{source_vertices_} * 3)
      throw std::invalid_argument("source_positions: three numbers for each vertex of the source are needed");
    std::vector<float> positions(size_t{target_vertices_} * 3);
    auto frame = make<hf_transfer_frame>();
    frame.source_positions = source_positions.data(), frame.target_positions = positions.data();
    check(hf_transfer_apply(get(), &frame));
    return positions;
  }

 private:
  Handle<hf_transfer, hf_transfer_destroy> handle_;
  uint32_t source_vertices_ = 0, target_vertices_ = 0;
};

}  // namespace hfpp

#endif
