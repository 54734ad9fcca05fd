// A refused call changes nothing: random calls on one kind of object, with refused memory, cancels and bad arguments.
//
// A subject is an object under test with its clones. Its table of commands makes the calls. The driver hashes all that
// can be seen of the subject before and after every call that fails, and compares the end with a fresh object.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../support/place_in.h"
#include "hf/hf.h"

namespace unchanged {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15u + 1) {}
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>((engine_() >> 16) % n); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  double real(double low, double high) { return low + (high - low) * (below(1u << 30) / double(1u << 30)); }
  // Mostly below n, now and then beyond.
  std::uint32_t index(std::uint32_t n) { return one_in(24) ? (one_in(2) ? n : HF_NO_INDEX) : below(n ? n : 1); }
  // Mostly an ordinary number, now and then one that is refused.
  double number();
  template <class T>
  T pick(std::initializer_list<T> of) {
    return of.begin()[below(static_cast<std::uint32_t>(of.size()))];
  }
  // A struct whose size is wrong now and then.
  template <class T>
  T* spoiled(T& desc) {
    if (one_in(60)) desc.struct_size = pick({0u, 3u, std::uint32_t(sizeof(T)) + 5000u});
    return one_in(100) ? nullptr : &desc;
  }

 private:
  std::mt19937_64 engine_;
};

// What can be seen of a subject: named hashes (FNV-1a).
class State {
 public:
  void begin(const std::string& part) { parts_.push_back({part, 1469598103934665603u}); }
  void add(const void* bytes, std::size_t size);
  template <class T>
  void add(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    add(&value, sizeof value);
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    add(list.data(), list.size() * sizeof(T));
  }
  // The first part that differs, or nothing.
  std::string difference(const State& other) const;
  std::uint64_t last() const { return parts_.back().second; }

 private:
  std::vector<std::pair<std::string, std::uint64_t>> parts_;
};

// Counts, refuses, and cancels a progress object at an allocation.
struct Allocator {
  std::size_t live_blocks = 0, live_bytes = 0, calls = 0, refuse_at = 0, refused = 0, refused_size = 0, mismatches = 0,
              cancel_at = 0;
  std::size_t numeric_bytes =
      0;  // of these, in blocks of 64-byte alignment: arrays of numbers, work buffers among them
  bool refuse_on = false;
  hf_progress progress = nullptr;
  hf_allocator hooks();
  void disarm() {
    refuse_at = cancel_at = 0;
    refuse_on = false;
  }
};

struct Shape {
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;
  std::uint32_t vertices() const { return static_cast<std::uint32_t>(positions.size() / 3); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(triangles.size() / 3); }
};
const std::vector<Shape>& shapes();  // a sheet, a cut sheet with an island, a torus, a tube

// One surface, and what its calls are given.
struct World {
  Allocator memory;
  const Shape* shape = nullptr;
  hf_surface surface = nullptr;
  hf_surface graph = nullptr;  // of the subject, which works on it instead; it destroys it
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  ~World() { hf_surface_destroy(surface); }
  // The progress object of a cancelled call, else none.
  hf_progress progress() const { return memory.progress; }
};

// An object under test, what its model knows, and clones that are kept to go back to. No call edits a kept clone: it
// has the bits it was made with, whatever becomes of the object.
template <class Handle, void (*destroy)(Handle), class Known>
struct Clonable : Known {
  struct Destroy {
    void operator()(Handle gone) const { destroy(gone); }
  };
  Handle handle = nullptr;
  std::unique_ptr<std::remove_pointer_t<Handle>, Destroy> owner;
  std::uint64_t bits = 0;  // of a clone when it was made
  std::vector<Clonable> kept;
  Clonable(Handle made, const Known& known) : Known(known), handle(made), owner(made) {}
};
struct Nothing {};  // known of an object

class Subject;
constexpr hf_result skipped = 1;  // the call makes no sense now

struct Command {
  const char* name;
  std::uint32_t weight;
  hf_result (*call)(Subject& subject, Random& random);  // one call of the library
  bool caches = false;  // a refused call may keep parts of its work for the next one, or drop those it replaced
};

class Subject {
 public:
  explicit Subject(World& given) : world(given) {}
  virtual ~Subject() = default;
  Subject(const Subject&) = delete;
  virtual const std::vector<Command>& commands() const = 0;
  // Counts and statistics, whose reading changes nothing; without sweeps, which a refused solve counts too.
  virtual void glance(State& state) = 0;
  // All else: fields, lists, and what would come next.
  virtual void look(State& state) = 0;
  // Compares with a fresh object of the same state. Empty: they agree.
  virtual std::string compare_fresh() { return {}; }
  // What the model finds wrong after a call, the first fault of all.
  std::string wrong;
  World& world;

 protected:
  void expect(bool holds, const std::string& what) {
    if (!holds && wrong.empty()) wrong = what;
  }
  // Clones one of the branches. The clone is another branch, or is kept. bits: a hash of what can be seen of a branch.
  template <class Handle, void (*destroy)(Handle), class Known, class Bits>
  hf_result clone(std::vector<Clonable<Handle, destroy, Known>>& branches, Random& random,
                  hf_result (*call)(Handle, Handle*), Bits&& bits) {
    Clonable<Handle, destroy, Known>& b = branches[random.below(static_cast<std::uint32_t>(branches.size()))];
    Handle made = b.handle;
    const hf_result result = call(b.handle, &made);
    if (result != HF_OK) return expect(made == nullptr, "a refused clone is no NULL"), result;
    Clonable<Handle, destroy, Known> fresh(made, b);
    world.memory.disarm();
    fresh.bits = bits(fresh);
    expect(fresh.bits == bits(b), "a clone has other bits");
    (branches.size() > 2 || random.one_in(2) ? b.kept : branches).push_back(std::move(fresh));
    return result;
  }
  // The clone that was kept last becomes the object: undo.
  template <class B, class Bits>
  hf_result go_back(std::vector<B>& branches, Random& random, Bits&& bits) {
    B& b = branches[random.below(static_cast<std::uint32_t>(branches.size()))];
    if (b.kept.empty()) return skipped;
    world.memory.disarm();
    for (const B& clone : b.kept) expect(bits(clone) == clone.bits, "a kept clone has other bits than the object had");
    B last = std::move(b.kept.back());
    b.kept.pop_back();
    last.kept = std::move(b.kept);
    b = std::move(last);
    expect(bits(b) == b.bits, "a clone has other bits when its object is gone");
    return HF_OK;
  }
};

struct Kind {
  const char* name;
  std::unique_ptr<Subject> (*make)(World& world, Random& random);
  double share;  // of all calls; less where a call takes longer
};
const std::vector<Kind>& kinds();
std::unique_ptr<Subject> make_solvers(World& world, Random& random);
std::unique_ptr<Subject> make_poses(World& world, Random& random);
std::unique_ptr<Subject> make_transfers(World& world, Random& random);
std::unique_ptr<Subject> make_regions(World& world, Random& random);
std::unique_ptr<Subject> make_directions(World& world, Random& random);
std::unique_ptr<Subject> make_analysis(World& world, Random& random);
std::unique_ptr<Subject> make_quads(World& world, Random& random);
std::unique_ptr<Subject> make_weights(World& world, Random& random);

struct Tally {
  std::uint64_t calls = 0, done = 0, invalid = 0, memory = 0, cancelled = 0, internal = 0, fresh = 0, failures = 0;
};

// Plays sequence `number` of a kind, only the steps that are set (empty: all). Returns what went wrong, or nothing.
std::string play(const Kind& kind, std::uint64_t number, const std::vector<bool>& steps, Tally& tally,
                 std::string* log = nullptr);
std::uint32_t step_count(std::uint64_t number);

// Largest difference of two fields over the largest value of the first; infinite where either is not finite.
double difference(const std::vector<double>& a, const std::vector<double>& b);

std::string text(double value);

// Structs whose times stand still between two looks.
template <class T>
void add_struct(State& state, const T& value) {
  state.add(&value, sizeof value);
}

}  // namespace unchanged
