// Memory, jobs, float environment: what every room stands on.
#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/float_environment.h"
#include "base/hypotenuse.h"
#include "base/jobs.h"
#include "base/memory.h"

namespace {

TEST(Hypotenuse, is_that_of_the_c_library_to_two_units_wherever_it_lies) {
  const double parts[] = {0, 1, 3, 4, 0.1, 1e-3, 1e-154, 1e-160, 5e-324, 1e-308, 1e150, 1e154, 1e160, 1.2e308};
  for (const double a : parts) {
    for (const double b : parts) {
      const double right = std::hypot(a, b), unit = std::nextafter(right, HUGE_VAL) - right;
      EXPECT_LE(std::fabs(hf_inner::hypotenuse(a, b) - right), 2 * unit) << a << " " << b;
      EXPECT_EQ(hf_inner::hypotenuse(-a, b), hf_inner::hypotenuse(b, a)) << a << " " << b;
    }
  }
  EXPECT_EQ(hf_inner::hypotenuse(3, 4), 5);
  EXPECT_EQ(hf_inner::hypotenuse(HUGE_VAL, 1), HUGE_VAL);
  EXPECT_EQ(hf_inner::hypotenuse(1.7e308, 1.7e308), HUGE_VAL);
}

TEST(Memory, counts_live_and_peak_bytes_and_gives_everything_back) {
  hf_inner::Memory memory;
  {
    hf_inner::Buffer<double> buffer(memory, 1024);  // sizes that are not rounded
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % hf_inner::Buffer<double>::alignment, 0u);
    hf_inner::Vector<int> vector(12, 7, &memory);
    EXPECT_EQ(memory.live_bytes(), 8192u + 48u);
  }
  EXPECT_EQ(memory.live_bytes(), 0u);
  EXPECT_EQ(memory.peak_bytes(), 8240u);
}

TEST(Memory, refuses_beyond_its_limit_and_stays_usable) {
  hf_inner::Memory memory(hf_allocator{}, 1024);
  EXPECT_THROW(hf_inner::Buffer<double>(memory, 129), std::bad_alloc);
  EXPECT_EQ(memory.live_bytes(), 0u);
  hf_inner::Buffer<double> fits(memory, 128);
  EXPECT_THROW(fits.allocate(memory, 1u << 20), std::bad_alloc);
  EXPECT_EQ(fits.size(), 128u);
  EXPECT_THROW(hf_inner::Buffer<double>(memory, SIZE_MAX / 4), std::bad_alloc);
}

TEST(Memory, refuses_a_block_whose_rounded_size_overflows) {
  hf_inner::Memory memory;
  const volatile std::size_t bytes = SIZE_MAX - 8;
  EXPECT_THROW(static_cast<void>(memory.allocate(bytes, 64)), std::bad_alloc);
  EXPECT_EQ(memory.live_bytes(), 0u);
}

TEST(Memory, an_owner_may_be_the_last_to_know_it) {
  struct Owner {
    explicit Owner(std::shared_ptr<hf_inner::Memory> m) : memory(std::move(m)) {}
    std::shared_ptr<hf_inner::Memory> memory;
  };
  auto memory = std::make_shared<hf_inner::Memory>();
  auto owner = hf_inner::make_owner_in<Owner>(memory, memory);
  std::weak_ptr<hf_inner::Memory> watch = memory;
  memory.reset();
  owner.reset();  // the block is released through a Memory that still lives
  EXPECT_TRUE(watch.expired());
}

TEST(JobRunner, calls_every_index_once_for_any_number_of_threads) {
  for (const std::uint32_t threads : {1u, 2u, 5u}) {
    hf_inner::JobRunner jobs(threads);
    for (int round = 0; round < 50; ++round) {
      std::vector<std::atomic<int>> calls(137);
      jobs.for_each(137, [&](std::uint32_t i) { ++calls[i]; });
      for (const auto& count : calls) EXPECT_EQ(count, 1);
    }
  }
}

TEST(JobRunner, takes_nested_and_simultaneous_batches) {
  hf_inner::JobRunner jobs(3);
  std::atomic<int> sum{0};
  std::vector<std::thread> callers;
  for (int t = 0; t < 4; ++t) {
    callers.emplace_back([&] {
      jobs.for_each(20, [&](std::uint32_t) { jobs.for_each(5, [&](std::uint32_t i) { sum += static_cast<int>(i); }); });
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 4 * 20 * 10);
}

TEST(JobRunner, rethrows_the_exception_of_a_job) {
  hf_inner::JobRunner jobs(2);
  EXPECT_THROW(jobs.for_each(50,
                             [&](std::uint32_t i) {
                               if (i == 31) hf_inner::fail(HF_ERROR_CANCELLED, i, "job %u", i);
                             }),
               hf_inner::Error);
  int calls = 0;
  jobs.for_each(1, [&](std::uint32_t) { ++calls; });
  EXPECT_EQ(calls, 1);
}

TEST(JobRunner, works_with_a_host_that_runs_jobs_backwards_or_leaves_some_out) {
  for (const bool lazy : {false, true}) {
    hf_job_runner host{};
    bool flag = lazy;
    host.user = &flag;
    host.run = [](void* user, std::uint32_t count, void (*job)(void*, std::uint32_t), void* data) {
      for (std::uint32_t i = count; i-- > (*static_cast<bool*>(user) ? count / 2 : 0);) job(data, i);
    };
    hf_inner::JobRunner jobs(4, host);
    std::vector<int> calls(40, 0);
    jobs.for_each(40, [&](std::uint32_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(40, 1));
  }
}

TEST(JobRunner, does_batches_of_a_job_alone_when_the_host_takes_one_at_a_time) {
  hf_job_runner host{};
  struct Taken {
    bool now = false, twice = false;
  } taken;
  host.user = &taken;
  host.run = [](void* user, std::uint32_t count, void (*job)(void*, std::uint32_t), void* data) {
    Taken& own = *static_cast<Taken*>(user);
    own.twice = own.twice || own.now;
    own.now = true;
    for (std::uint32_t i = 0; i < count; ++i) job(data, i);
    own.now = false;
  };
  hf_inner::JobRunner jobs(4, host);
  std::vector<int> calls(30, 0);
  jobs.for_each(3, [&](std::uint32_t i) { jobs.for_each(10, [&](std::uint32_t k) { ++calls[10 * i + k]; }); });
  EXPECT_EQ(calls, std::vector<int>(30, 1));
  EXPECT_FALSE(taken.twice);
  jobs.for_each(30, [&](std::uint32_t i) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(30, 2));
}

TEST(FloatEnvironment, restores_rounding_traps_and_flags) {
  std::fesetround(FE_UPWARD);
  std::feclearexcept(FE_ALL_EXCEPT);
  {
    const hf_inner::FloatEnvironment inside;
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
    volatile double zero = 0;
    volatile double infinity = 1 / zero;
    EXPECT_GT(infinity, 0);
  }
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO), 0);
  std::fesetround(FE_TONEAREST);
}

TEST(Error, keeps_a_long_message_within_its_buffer) {
  try {
    hf_inner::fail(HF_ERROR_INTERNAL, 3, "%s", std::string(1000, 'x').c_str());
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(std::string(error.what()).size(), hf_inner::Error::message_size - 1);
    EXPECT_EQ(error.index(), 3u);
  }
}

}  // namespace
