// Plays a sequence of unchanged.h: arms a fault, makes the call, compares what can be seen.
#include <cmath>

#include "unchanged.h"

namespace unchanged {
namespace {

// Work buffers that a surface keeps (8 in either of two pools) are no part of an object. So arrays of
// numbers may grow by them, and nothing else may.
constexpr std::size_t work_bytes = 256u << 10;

struct Memory {  // of the host, after kept blocks are given back: they go with any object that is destroyed
  std::size_t plain, numeric;
  explicit Memory(const World& world) {
    hf_solver passing = nullptr;
    hf_solver_desc own = HF_INIT(hf_solver_desc);
    own.field_kind = world.desc.field_kind;  // its factor is there
    hf_create(world.graph ? world.graph : world.surface, &own, &passing);
    hf_solver_destroy(passing);
    numeric = world.memory.numeric_bytes;
    plain = world.memory.live_bytes - numeric;
  }
};

bool make_surface(World& world, Random& random) {
  world.shape = &shapes()[random.below(static_cast<std::uint32_t>(shapes().size()))];
  hf_surface_desc& d = world.desc;
  d.positions = HF_ARRAY(world.shape->positions.data(), world.shape->vertices());
  d.triangles = HF_ARRAY(world.shape->triangles.data(), world.shape->count());
  d.operator_kind = random.pick({0, 0, 1, 2});
  d.field_kind = random.pick({0, 0, 0, 1});
  d.memory_limit_mb = random.one_in(4) ? 1 : 0;
  d.allocator = world.memory.hooks();
  return hf_surface_create(&d, &world.surface) == HF_OK;
}

void look_at_surface(World& world, State& state) {
  hf_surface_info info = HF_INIT(hf_surface_info);
  hf_surface_report report = HF_INIT(hf_surface_report);
  std::vector<std::uint32_t> components(world.shape->vertices());
  state.begin("surface");
  state.add(hf_surface_get_info(world.surface, &info));
  add_struct(state, info);
  state.add(hf_surface_get_report(world.surface, &report));
  add_struct(state, report);
  state.add(hf_surface_get_components(world.surface, world.shape->vertices(), components.data(), nullptr));
  state.add(components);
}

// What the next call meets.
struct Fault {
  enum Cause { none, memory, cancel } cause = none;
  std::size_t at = 0;
  bool on = false;
  Fault(Random& random) {
    const std::uint32_t dice = random.below(100);
    cause = dice < 50 ? none : dice < 85 ? memory : cancel;
    at = static_cast<std::size_t>(std::exp(random.real(0, 6.5)));
    on = random.one_in(3);
    if (cause == cancel && random.one_in(5)) at = 0;  // before the call
  }
  void arm(Allocator& a) const {
    if (cause == memory) {
      a.refuse_at = a.calls + at;
      a.refuse_on = on;
    }
    if (cause != cancel) return;
    hf_progress_create(&a.progress);
    if (at == 0)
      hf_progress_cancel(a.progress);
    else
      a.cancel_at = a.calls + at;
  }
  void disarm(Allocator& a) const {
    a.disarm();
    hf_progress_destroy(a.progress);
    a.progress = nullptr;
  }
};

const Command& choose(const std::vector<Command>& table, Random& random) {
  std::uint32_t sum = 0;
  for (const Command& command : table) sum += command.weight;
  std::uint32_t dice = random.below(sum);
  for (const Command& command : table) {
    if (dice < command.weight) return command;
    dice -= command.weight;
  }
  return table.back();
}

// Whether the code can come from what was done.
std::string check_code(hf_result result, const Fault& fault, bool refused, const World& world) {
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  const std::string said = std::string(hf_result_get_name(result)) + ": " + detail.message;
  if (result == HF_ERROR_INTERNAL) return said;
  if (result == HF_ERROR_OUT_OF_MEMORY) {
    const bool limit = std::strncmp(detail.message, "memory_limit_mb is", 18) == 0;
    if (limit ? world.desc.memory_limit_mb == 0 : !refused) return said + " without a reason";
  }
  if (result == HF_ERROR_CANCELLED && fault.cause != Fault::cancel) return said + " without a cancel";
  return {};
}

void count(hf_result result, Tally& tally) {
  if (result == HF_OK)
    ++tally.done;
  else if (result == HF_ERROR_OUT_OF_MEMORY)
    ++tally.memory;
  else if (result == HF_ERROR_CANCELLED)
    ++tally.cancelled;
  else
    ++tally.invalid;
  tally.internal += result == HF_ERROR_INTERNAL;
}

class Player {
 public:
  Player(World& world, Subject& subject, Tally& tally) : world_(world), subject_(subject), tally_(tally) {}

  std::string step(Random& random, std::string* log) {
    const Fault fault(random);
    const Command& command = choose(subject_.commands(), random);
    if (!seen_) look();
    State before;
    subject_.glance(before);
    const Memory held(world_);
    const std::size_t refused = world_.memory.refused;
    fault.arm(world_.memory);
    const hf_result result = command.call(subject_, random);
    fault.disarm(world_.memory);
    if (result == skipped) return {};
    ++tally_.calls;
    count(result, tally_);
    const bool ran_out = world_.memory.refused > refused;
    if (log)
      *log += std::string("    ") + command.name + " -> " + hf_result_get_name(result) +
              (ran_out ? " (an allocation refused)" : "") + "\n";
    if (!subject_.wrong.empty()) return std::string(command.name) + ": " + subject_.wrong;
    if (result == HF_OK) return seen_ = false, std::string();
    std::string fault_found = check_code(result, fault, ran_out, world_);
    if (fault_found.empty()) fault_found = compare(before, held, command.caches);
    if (fault_found.empty()) return {};
    return std::string(command.name) + " (" + hf_result_get_name(result) + "): " + fault_found;
  }

 private:
  void look() {
    state_ = State();
    look_at_surface(world_, state_);
    subject_.look(state_);
    seen_ = true;
  }
  std::string compare(const State& before, const Memory& held, bool caches) {
    State after;
    subject_.glance(after);
    const Memory now(world_);
    std::string part = before.difference(after);
    if (!part.empty()) return part + " changed";
    if (now.plain != held.plain && !caches)
      return "memory changed from " + std::to_string(held.plain) + " to " + std::to_string(now.plain) + " bytes";
    if (now.numeric > held.numeric + work_bytes && !caches)
      return "arrays grew from " + std::to_string(held.numeric) + " to " + std::to_string(now.numeric) + " bytes";
    const State seen = state_;
    look();
    part = seen.difference(state_);
    return part.empty() ? std::string() : part + " changed";
  }

  World& world_;
  Subject& subject_;
  Tally& tally_;
  State state_;
  bool seen_ = false;
};

std::string play_on(World& world, const Kind& kind, std::uint64_t number, const std::vector<bool>& steps, Tally& tally,
                    std::string* log) {
  Random set_up(number * 1000);
  if (!make_surface(world, set_up)) return "the surface is refused";
  const std::unique_ptr<Subject> subject = kind.make(world, set_up);
  if (!subject) return {};  // not within the memory limit
  Player player(world, *subject, tally);
  for (std::uint32_t i = 0; i < step_count(number); ++i) {
    if (!steps.empty() && !steps[i]) continue;
    Random random(number * 1000 + i + 1);
    const std::string fault = player.step(random, log);
    if (!fault.empty()) return fault;
  }
  if (world.desc.memory_limit_mb) return {};  // a second object may not have room
  ++tally.fresh;
  return subject->compare_fresh();
}

}  // namespace

std::uint32_t step_count(std::uint64_t number) { return 10 + static_cast<std::uint32_t>(number * 7 % 50); }

std::string play(const Kind& kind, std::uint64_t number, const std::vector<bool>& steps, Tally& tally,
                 std::string* log) {
  Allocator left;
  std::string fault;
  {
    World world;
    fault = play_on(world, kind, number, steps, tally, log);
    hf_surface_destroy(world.surface);
    left = world.memory;
  }
  if (fault.empty() && (left.live_blocks || left.live_bytes || left.mismatches))
    fault = std::to_string(left.live_blocks) + " blocks are left, " + std::to_string(left.mismatches) + " mismatches";
  return fault;
}

}  // namespace unchanged
