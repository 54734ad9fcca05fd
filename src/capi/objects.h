// What stands behind the handles.
#pragma once
#include <atomic>
#include <memory>

#include "base/progress.h"
#include "capi/handle_table.h"
#include "field/scalar_field.h"

namespace hf_inner::capi {

struct ProgressObject final : Object {
  ProgressObject() noexcept : Object(Kind::progress) {}
  Progress progress;
};

struct SolverObject final : Object {
  SolverObject(std::shared_ptr<const Core> core, EngineKind engine, double penalty, std::int32_t channels,
               std::uint32_t site_limit)
      : Object(Kind::solver),
        site_limit(site_limit),
        memory(core->memory),
        field(std::move(core), engine, penalty, channels, site_limit),
        given_count(memory.get()) {}
  SolverObject(const SolverObject& other)
      : Object(Kind::solver),
        site_limit(other.site_limit),
        memory(other.memory),
        field(other.field),
        given_count(other.given_count, memory.get()),
        site_count(other.field.sites().count()) {}
  const std::uint32_t site_limit;
  std::shared_ptr<Memory> memory;  // outlives everything below
  ScalarField field;
  Vector<std::uint32_t> given_count;  // vertices as given, by component
  std::atomic<std::uint32_t> site_count{
      0};  // of the last finished change: may be read while another thread changes the field
};

}  // namespace hf_inner::capi
