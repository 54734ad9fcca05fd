// Pairs that come and go: no factorisation, the same result as made at once, failures that change nothing, odd regions.
#include <gtest/gtest.h>

#include <new>

#include "base/error.h"
#include "peers/paper_transfer.h"
#include "support/full.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

template <class Call>
hf_result code_of(Call&& call, uint32_t* index = nullptr) {
  try {
    call();
  } catch (const hf_inner::Error& error) {
    if (index) *index = error.index();
    EXPECT_GT(std::string(error.what()).size(), 10u);
    return error.code();
  }
  return HF_OK;
}

TEST(TransferPairs, AddingAndRemovingPairsFactorisesNothingAndEqualsATransferMadeAtOnce) {
  const Animals& a = animals();
  const std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  const std::vector<Vec3> posed = a.horse.posed(a.walk, 0.4);
  hf_inner::transfer::Transfer edited(a.horse.core, a.bull.core, {});
  const uint32_t source_before = edited.source_counters().factorisations,
                 target_before = edited.target_counters().factorisations;
  std::vector<uint32_t> numbers(inputs.size());
  // a random walk over pair sets, a frame after every step
  std::vector<char> present(inputs.size(), 0);
  uint32_t state = 7;
  for (int step = 0; step < 60; ++step) {
    state = state * 1664525u + 1013904223u;
    const size_t i = (state >> 16) % inputs.size();
    const size_t count = static_cast<size_t>(std::count(present.begin(), present.end(), 1));
    if (present[i] && count > 1) {
      edited.remove_pairs({&numbers[i], 1});
      present[i] = 0;
    } else if (!present[i]) {
      edited.add_pairs({&inputs[i], 1}, &numbers[i]);
      present[i] = 1;
    }
    const std::vector<Vec3> out = frame_of(edited, posed);
    if (step % 6 != 0) continue;
    hf_inner::transfer::Transfer fresh(a.horse.core, a.bull.core, {});
    std::vector<std::pair<uint32_t, hf_inner::transfer::PairInput>> ordered;
    for (size_t k = 0; k < inputs.size(); ++k) {
      if (present[k]) ordered.emplace_back(numbers[k], inputs[k]);
    }
    std::sort(ordered.begin(), ordered.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    std::vector<hf_inner::transfer::PairInput> now;
    for (const auto& entry : ordered) now.push_back(entry.second);
    add(fresh, now);
    EXPECT_EQ(largest_distance(out, frame_of(fresh, posed)), 0) << "step " << step;
  }
  EXPECT_EQ(edited.source_counters().factorisations, source_before);
  EXPECT_EQ(edited.target_counters().factorisations, target_before);
  EXPECT_GT(edited.source_counters().path_solves, 0u);
}

TEST(TransferPairs, BadPairsAreNamedAndChangeNothing) {
  const Animals& a = animals();
  const std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  const std::vector<Vec3> posed = a.horse.posed(a.walk, 0.4);
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  std::vector<Vec3> out(static_cast<size_t>(a.bull.core->size()));
  EXPECT_EQ(code_of([&] { transfer.apply(posed.data(), out.data()); }), HF_ERROR_EMPTY);
  EXPECT_EQ(code_of([&] { transfer.cluster_count(); }), HF_ERROR_EMPTY);
  EXPECT_EQ(code_of([&] { transfer.add_pairs({}, nullptr); }), HF_ERROR_EMPTY);
  add(transfer, inputs);
  const std::vector<Vec3> before = frame_of(transfer, posed);

  int32_t free_vertex = 0;
  const auto taken = [&](int32_t v) {
    return std::any_of(inputs.begin(), inputs.end(), [&](const hf_inner::transfer::PairInput& input) {
      return std::count(input.source.begin(), input.source.end(), v) +
                 std::count(input.target.begin(), input.target.end(), v) >
             0;
    });
  };
  while (taken(free_vertex)) ++free_vertex;
  const int32_t out_of_range[] = {free_vertex, free_vertex, a.bull.core->size()};
  uint32_t index = 0;
  hf_inner::transfer::PairInput bad;
  EXPECT_EQ(code_of([&] { transfer.add_pairs({&bad, 1}, nullptr); }, &index), HF_ERROR_EMPTY);
  EXPECT_EQ(index, 0u);
  bad.source = {&free_vertex, 1};
  EXPECT_EQ(code_of([&] { transfer.add_pairs({&bad, 1}, nullptr); }), HF_ERROR_EMPTY);
  bad.target = {out_of_range, 3};
  EXPECT_EQ(code_of([&] { transfer.add_pairs({&bad, 1}, nullptr); }, &index), HF_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(index, 2u);
  bad.target = inputs[2].target;
  EXPECT_EQ(code_of([&] { transfer.add_pairs({&bad, 1}, nullptr); }, &index), HF_ERROR_CONFLICT);
  EXPECT_EQ(index, 0u);
  bad.target = {&free_vertex, 1};
  bad.flags = 1u << 20;
  EXPECT_EQ(code_of([&] { transfer.add_pairs({&bad, 1}, nullptr); }), HF_ERROR_INVALID_ARGUMENT);
  const std::vector<hf_inner::transfer::PairInput> many(300, inputs[0]);
  EXPECT_EQ(code_of([&] { transfer.add_pairs({many.data(), many.size()}, nullptr); }), HF_ERROR_TOO_LARGE);
  const uint32_t twice[] = {1, 1}, absent[] = {0, 99};
  EXPECT_EQ(code_of([&] { transfer.remove_pairs({twice, 2}); }, &index), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(code_of([&] { transfer.remove_pairs({absent, 2}); }, &index), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(code_of([&] { transfer.pair_info(99); }), HF_ERROR_NOT_FOUND);
  std::vector<Vec3> broken = posed;
  broken[5].y = std::nan("");
  EXPECT_EQ(code_of([&] { transfer.apply(broken.data(), out.data()); }, &index), HF_ERROR_NON_FINITE);
  EXPECT_EQ(index, static_cast<std::uint32_t>(transfer.source().mesh.given_of_inner[5]));

  EXPECT_EQ(transfer.pair_count(), inputs.size());
  EXPECT_EQ(largest_distance(frame_of(transfer, posed), before), 0.0);
}

TEST(TransferPairs, BadOptionsAreRefused) {
  const Animals& a = animals();
  const auto refused = [&](auto&& change) {
    hf_inner::transfer::TransferOptions options;
    change(options);
    return code_of([&] { hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options); });
  };
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions&) {}), HF_OK);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.mode = 7; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.cluster_count = 513; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.kernel_width = 0.6; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.kernel_width = -1; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.scale = -1; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.scale = 1e7; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.scale = std::nan(""); }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.kernel_width = std::nan(""); }),
            HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.alignment_angle = std::nan(""); }),
            HF_ERROR_NON_FINITE);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) { o.source_axes[0] = 1; }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused([](hf_inner::transfer::TransferOptions& o) {
              const double mirrored[9] = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
              std::copy_n(mirrored, 9, o.target_axes);
            }),
            HF_ERROR_INVALID_ARGUMENT);
}

// Fails the allocation number `fail_at`, counted from when it is armed, and all after it: a refused one is asked again
// once kept blocks are given back.
struct Faults {
  int64_t count = 0, fail_at = -1;
  static void* allocate(void* user, size_t size, size_t alignment) {
    auto* self = static_cast<Faults*>(user);
    if (self->fail_at >= 0 && self->count++ >= self->fail_at) return nullptr;
    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
  }
  static void release(void*, void* block, size_t, size_t alignment) {
    ::operator delete(block, std::align_val_t(alignment));
  }
};

TEST(TransferPairs, WhenMemoryRunsOutAtAnyAllocationTheTransferStaysAsItWas) {
  const Animals& a = animals();
  Faults faults;
  const World world(1, {Faults::allocate, Faults::release, &faults});
  Body horse = a.horse, bull = a.bull;
  horse.build(world);
  bull.build(world);
  const std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  const std::vector<hf_inner::transfer::PairInput> first(inputs.begin(), inputs.begin() + 6),
      rest(inputs.begin() + 6, inputs.end());
  const std::vector<Vec3> posed = horse.posed(a.walk, 0.4);
  hf_inner::transfer::Transfer transfer(horse.core, bull.core, {});
  add(transfer, first);
  const std::vector<Vec3> with_six = frame_of(transfer, posed);
  std::vector<uint32_t> numbers(rest.size());
  add(transfer, rest, numbers.data());
  const std::vector<Vec3> with_all = frame_of(transfer, posed);
  transfer.remove_pairs({numbers.data(), numbers.size()});

  uint32_t faulted = 0;
  for (int64_t n = 0;; n += 1 + n / (hf_test::is_full() ? 40 : 12)) {  // every one at first, then samples
    std::vector<Vec3> out(with_all.size());
    uint32_t stage = 0;
    horse.core->memory->release_kept();
    bull.core->memory->release_kept();
    faults.count = 0;
    faults.fail_at = n;
    bool failed = false;
    try {
      add(transfer, rest, numbers.data());
      stage = 1;
      transfer.apply(posed.data(), out.data());
      stage = 2;
      transfer.remove_pairs({numbers.data(), numbers.size()});
      stage = 3;
      transfer.apply(posed.data(), out.data());
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    faults.fail_at = -1;
    if (!failed) {
      EXPECT_EQ(largest_distance(out, with_six), 0.0);
      break;
    }
    ++faulted;
    const bool all_there = stage == 1 || stage == 2;
    ASSERT_EQ(transfer.pair_count(), all_there ? 8u : 6u) << n;
    ASSERT_LT(largest_distance(frame_of(transfer, posed), all_there ? with_all : with_six), 1e-9) << n;
    if (all_there) transfer.remove_pairs({numbers.data(), numbers.size()});
  }
  EXPECT_GT(faulted, 50u);
}

TEST(TransferPairs, OnePairMovesTheWholeTargetRigidly) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  const std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  transfer.add_pairs({&inputs[0], 1}, nullptr);
  EXPECT_EQ(transfer.cluster_count(), 1);
  const std::vector<Vec3> out = frame_of(transfer, a.horse.posed(a.walk, 0.3)), rest = a.bull.rest();
  EXPECT_NEAR(hf_inner::norm(out[0] - out[100]), hf_inner::norm(rest[0] - rest[100]), 1e-9);
}

TEST(TransferPairs, OddRegionsGiveFiniteResultsAndKeepTheRules) {
  const Animals& a = animals();
  std::vector<int32_t> everything(static_cast<size_t>(a.horse.core->size())), half;
  for (size_t v = 0; v < everything.size(); ++v) everything[v] = static_cast<int32_t>(v);
  for (int32_t v = 0; v < a.bull.core->size() / 2; ++v) half.push_back(v);
  const int32_t single = 3, doubled[] = {9, 9, 9};
  hf_inner::transfer::PairInput all_on_source, single_vertices;
  all_on_source.source = {everything.data(), everything.size()};
  all_on_source.target = {half.data(), half.size()};
  single_vertices.source = {&single, 1};
  single_vertices.target = {doubled, 3};
  for (const hf_inner::transfer::PairInput& input : {all_on_source, single_vertices}) {
    for (const bool paper : {false, true}) {
      hf_inner::transfer::TransferOptions options;
      if (paper) options.scheme = hf_inner::peers::paper_clusters();
      hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options);
      transfer.add_pairs({&input, 1}, nullptr);
      EXPECT_LT(largest_distance(frame_of(transfer, a.horse.rest()), a.bull.rest()), 1e-6);
      for (const Vec3& p : frame_of(transfer, a.horse.posed(a.walk, 0.3))) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    }
  }
  // all vertices of the target shared among two pairs
  hf_inner::transfer::PairInput two[2];
  std::vector<int32_t> front, back, other_half;
  for (int32_t v = 0; v < a.horse.core->size(); ++v)
    (a.horse.core->mesh.positions[static_cast<size_t>(v)].z > 0 ? front : back).push_back(v);
  for (int32_t v = a.bull.core->size() / 2; v < a.bull.core->size(); ++v) other_half.push_back(v);
  two[0].source = {front.data(), front.size()};
  two[0].target = {half.data(), half.size()};
  two[1].source = {back.data(), back.size()};
  two[1].target = {other_half.data(), other_half.size()};
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  transfer.add_pairs({two, 2}, nullptr);
  EXPECT_LT(largest_distance(frame_of(transfer, a.horse.rest()), a.bull.rest()), 1e-6);
  EXPECT_EQ(transfer.cluster_count(), 2);
}

TEST(TransferPairs, APairSaysItsFlagsItsLeakAndHowSureItIs) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  std::vector<uint32_t> numbers(a.pairs.names.size());
  add(transfer, a.pairs.inputs(), numbers.data());
  for (size_t i = 0; i < numbers.size(); ++i) {
    const hf_inner::transfer::PairInfo info = transfer.pair_info(numbers[i]);
    EXPECT_EQ(info.flags, a.pairs.flags[i]);
    EXPECT_LT(info.source_leak, 1e-9);
    EXPECT_LT(info.target_leak, 1e-9);
    EXPECT_GT(info.confidence, 0.3) << a.pairs.names[i];
    EXPECT_LE(info.confidence, 1.0);
    if (info.flags & HF_PAIR_TRUNK) {
      EXPECT_LT(info.alignment_angle, 0) << a.pairs.names[i];
    }
  }
}

TEST(TransferPairs, PairsThatComeAndGoLeaveNoMemoryBehind) {
  const Animals& a = animals();
  const std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, inputs);
  uint64_t before = 0;
  for (int i = 0; i < 60; ++i) {
    const uint32_t last = static_cast<uint32_t>(inputs.size()) - 1;
    transfer.remove_pairs({&last, 1});
    uint32_t number = 0;
    transfer.add_pairs({&inputs.back(), 1}, &number);
    EXPECT_EQ(number, last);
    if (i == 10) before = a.world.memory->live_bytes();
  }
  EXPECT_LE(a.world.memory->live_bytes(), before + before / 100);
}

// Kernels of the source: M = sum q g' with slopes that sum to zero and a trace of 1 at rest; the broad ones reach
// further than the narrow ones and stay local.
TEST(TransferPairs, KernelsOfTheSourceAreNormalisedAndLocal) {
  const Animals& a = animals();
  const size_t width = a.pairs.names.size();
  hf_inner::Memory memory;
  std::vector<uint32_t> numbers(width);
  std::vector<hf_inner::Span<const int32_t>> source, target;
  for (size_t i = 0; i < width; ++i) {
    numbers[i] = static_cast<uint32_t>(i);
    source.push_back({a.pairs.source[i].data(), a.pairs.source[i].size()});
    target.push_back({a.pairs.target[i].data(), a.pairs.target[i].size()});
  }
  hf_inner::transfer::PairFields from(a.horse.core), to(a.bull.core);
  from.add({numbers.data(), width}, {source.data(), width}, "source");
  to.add({numbers.data(), width}, {target.data(), width}, "target");
  const auto n = static_cast<size_t>(a.horse.core->size()), m = static_cast<size_t>(a.bull.core->size());
  std::vector<double> source_field(n * width), target_field(m * width), leaks(width);
  from.solve({numbers.data(), width}, source_field.data(), leaks.data());
  to.solve({numbers.data(), width}, target_field.data(), leaks.data());
  const auto source_area = hf_inner::transfer::area_shares(a.horse.core->mesh, memory),
             target_area = hf_inner::transfer::area_shares(a.bull.core->mesh, memory);
  for (const bool paper : {false, true}) {
    hf_inner::transfer::ClusterOptions options;
    const auto scheme = hf_inner::peers::paper_clusters();
    if (paper) options.scheme = scheme.get();
    const hf_inner::transfer::Clusters clusters = hf_inner::transfer::make_clusters(
        options, static_cast<int32_t>(width), {source_field.data(), source_field.size()}, source_area, *a.horse.core,
        {target_field.data(), target_field.size()}, target_area, a.bull.core->mesh, memory, *a.world.jobs);
    ASSERT_GT(clusters.count, 20);
    double narrow_radius = 0, broad_radius = 0;
    for (const hf_inner::transfer::SourceKernels* kernels : {&clusters.narrow, &clusters.broad}) {
      for (size_t c = 0; c < static_cast<size_t>(clusters.count); ++c) {
        Vec3 sum, centre;
        double trace = 0, largest = 0, radius = 0;
        const auto first = static_cast<size_t>(kernels->start[c]), last = static_cast<size_t>(kernels->start[c + 1]);
        const auto point = [&](size_t i) {
          return a.horse.core->mesh.positions[static_cast<size_t>(kernels->vertex[i])];
        };
        for (size_t i = first; i < last; ++i) {
          sum = sum + kernels->slope[i];
          trace += hf_inner::dot(point(i), kernels->slope[i]);
          largest = std::max(largest, hf_inner::norm(kernels->slope[i]));
          centre = centre + (1.0 / static_cast<double>(last - first)) * point(i);
        }
        for (size_t i = first; i < last; ++i)
          radius += hf_inner::norm(point(i) - centre) / static_cast<double>(last - first);
        EXPECT_LT(hf_inner::norm(sum), 1e-9 * std::max(largest, 1.0)) << c;
        EXPECT_NEAR(trace, 1.0, 1e-9) << c;
        (kernels == &clusters.narrow ? narrow_radius : broad_radius) += radius / clusters.count;
      }
    }
    EXPECT_GT(broad_radius, 1.2 * narrow_radius) << paper;
    EXPECT_LT(broad_radius, paper ? 0.2 : 0.12) << paper;  // of the box
    std::printf("kernels: mean radius %.3f narrow, %.3f broad, of the box\n", narrow_radius, broad_radius);
  }
}

}  // namespace
