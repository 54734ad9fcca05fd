// The library leaves the properties of its host unchanged. Each property is read before and after a run of the whole
// API (whole_api.h). A host with floating-point traps, flush-to-zero or another rounding mode gets the same bits as any
// other.
//
// The runs include ENGINE_UPDOWN and METIS in builds that have them. Threads are counted without these, because
// Debian's CHOLMOD keeps OpenMP threads after its first use.
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cfenv>
#include <clocale>
#include <cstring>
#include <memory_resource>
#include <string>
#include <thread>

#include "process.h"
#include "report.h"
#include "whole_api.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace reliability;

extern "C" char** environ;

namespace {

template <class T>
void put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// One property as bytes.
struct Property {
  const char* name;
  void (*read)(std::string& out);
};

void read_float_control(std::string& out) {
  put(out, fegetround());
  put(out, fegetexcept());
#if defined(__SSE2__)
  put(out, _mm_getcsr());  // masks, rounding, FTZ, DAZ, and the sticky flags
#endif
#if defined(__x86_64__) || defined(__i386__)
  unsigned short word = 0;
  __asm__ volatile("fnstcw %0" : "=m"(word));
  put(out, word);
#endif
}
void read_signals(std::string& out) {
  for (int s = 1; s < 65; ++s) {
    struct sigaction action;
    std::memset(&action, 0, sizeof action);
    if (sigaction(s, nullptr, &action) != 0) continue;
    put(out, action.sa_handler);
    put(out, action.sa_flags);
    for (int i = 1; i < 65; ++i) put(out, sigismember(&action.sa_mask, i));
  }
  sigset_t mask;
  sigemptyset(&mask);
  pthread_sigmask(SIG_BLOCK, nullptr, &mask);
  for (int i = 1; i < 65; ++i) put(out, sigismember(&mask, i));
  stack_t stack;
  std::memset(&stack, 0, sizeof stack);
  sigaltstack(nullptr, &stack);
  put(out, stack.ss_sp);
  put(out, stack.ss_size);
  struct itimerval timer;
  for (int which = 0; which < 3; ++which) {
    std::memset(&timer, 0, sizeof timer);
    getitimer(which == 0 ? ITIMER_REAL : which == 1 ? ITIMER_VIRTUAL : ITIMER_PROF, &timer);
    put(out, timer.it_interval);
  }
}
void read_locale(std::string& out) {
  out = std::setlocale(LC_ALL, nullptr);
  out += std::localeconv()->decimal_point;
}
void read_descriptors(std::string& out) {
  for (int d = 0; d < 256; ++d) {
    struct stat file;
    const int flags = fcntl(d, F_GETFD);
    put(out, flags);
    if (flags >= 0 && fstat(d, &file) == 0) {
      put(out, file.st_dev);
      put(out, file.st_ino);
      put(out, fcntl(d, F_GETFL));
    }
  }
}
void read_threads(std::string& out) { put(out, entries("/proc/self/task")); }
void read_process(std::string& out) {
  char folder[4096];
  if (getcwd(folder, sizeof folder)) out += folder;
  const mode_t mask = umask(0);
  umask(mask);
  put(out, mask);
  for (const auto limit : {RLIMIT_STACK, RLIMIT_CORE, RLIMIT_NOFILE, RLIMIT_AS, RLIMIT_DATA}) {
    struct rlimit now;
    getrlimit(limit, &now);
    put(out, now.rlim_cur);
    put(out, now.rlim_max);
  }
  put(out, getpriority(PRIO_PROCESS, 0));
  cpu_set_t cores;
  std::memset(&cores, 0, sizeof cores);
  sched_getaffinity(0, sizeof cores, &cores);
  put(out, cores);
}
void read_environment(std::string& out) {
  for (char** variable = environ; *variable; ++variable) {
    out += *variable;
    out += '\n';
  }
}

constexpr Property properties[] = {
    {"float environment", read_float_control},   {"signals", read_signals}, {"locale", read_locale},
    {"descriptors", read_descriptors},           {"threads", read_threads}, {"process", read_process},
    {"environment variables", read_environment},
};

unsigned unexpected;
Outcome run(const Scene& scene, bool paper_engine) {
  Options options;
  options.paper_engine = paper_engine;
  const Outcome outcome = run_whole_api(scene, options);
  if (outcome.unexpected > 0) fprintf(stderr, "%s answered %s\n", outcome.first, hf_result_get_name(outcome.got));
  unexpected += outcome.unexpected;
  return outcome;
}

unsigned changed_properties(const Scene& scene, bool paper_engine) {
  unsigned changed = 0;
  std::string before[sizeof properties / sizeof *properties], after;
  for (std::size_t i = 0; i < sizeof properties / sizeof *properties; ++i) properties[i].read(before[i]);
  run(scene, paper_engine);
  for (std::size_t i = 0; i < sizeof properties / sizeof *properties; ++i) {
    after.clear();
    properties[i].read(after);
    if (after == before[i] || (paper_engine && properties[i].read == read_threads)) continue;
    ++changed;
    fprintf(stderr, "changed: %s\n", properties[i].name);
  }
  return changed;
}

// Compares random numbers of the host with and without a run of the library in between.
unsigned changed_draws(const Scene& scene) {
  int plain[6];
  long wide[6], own[6];
  unsigned changed = 0;
  srand(7);
  srand48(7);
  srandom(9);
  for (int i = 0; i < 6; ++i) {
    own[i] = random();
    wide[i] = lrand48();
  }
  srand(7);
  srand48(7);
  for (int i = 0; i < 6; ++i) {
    plain[i] = rand();
    wide[i] = lrand48();
  }
  srand(7);
  srand48(7);
  for (int i = 0; i < 6; ++i) {
    if (i == 3) run(scene, true);
    changed += rand() != plain[i];
    changed += lrand48() != wide[i];
  }
  srandom(9);
  for (int i = 0; i < 6; ++i) {
    if (i == 3) run(scene, true);
    changed += random() != own[i];
    lrand48();
  }
  return changed;
}

// Bytes that reach standard output and standard error during a run.
double printed_bytes(const Scene& scene) {
  FILE* file = tmpfile();
  if (!file) return -1;
  fflush(stdout);
  fflush(stderr);
  const int out = dup(1), err = dup(2);
  dup2(fileno(file), 1);
  dup2(fileno(file), 2);
  run(scene, true);
  fflush(stdout);
  fflush(stderr);
  dup2(out, 1);
  dup2(err, 2);
  close(out);
  close(err);
  const double bytes = static_cast<double>(lseek(fileno(file), 0, SEEK_END));
  fclose(file);
  return bytes;
}

// Runs under other floating-point settings. Counts those that give other bits or change the settings.
unsigned different_runs(const Scene& scene, std::uint64_t expected) {
  unsigned different = 0;
  const auto check = [&](const char* name, void (*set)()) {
    std::fenv_t host;
    std::string before, after;
    fegetenv(&host);
#if defined(__SSE2__)
    const unsigned control = _mm_getcsr();
#endif
    set();
    read_float_control(before);
    const Outcome outcome = run_whole_api(scene);
    read_float_control(after);
    fesetenv(&host);
#if defined(__SSE2__)
    _mm_setcsr(control);
#endif
    unexpected += outcome.unexpected;
    if (outcome.hash == expected && before == after) return;
    ++different;
    fprintf(stderr, "%s: %s%s\n", name, outcome.hash == expected ? "" : "other bits ",
            before == after ? "" : "settings changed");
  };
  check("upward", [] { fesetround(FE_UPWARD); });
  check("downward", [] { fesetround(FE_DOWNWARD); });
  check("towards zero", [] { fesetround(FE_TOWARDZERO); });
  check("flags raised", [] { feraiseexcept(FE_INVALID | FE_OVERFLOW); });
  check("traps", [] {
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT);
  });
#if defined(__SSE2__)
  check("flush to zero", [] { _mm_setcsr(_mm_getcsr() | 0x8040u); });
  check("flush to zero, upward, traps", [] {
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
    fesetround(FE_UPWARD);
    _mm_setcsr(_mm_getcsr() | 0x8040u);
  });
#endif
  return different;
}

// Counts the answers that change when the default memory resource of a C++ host refuses everything.
unsigned answers_from_the_default_resource(const Scene& scene, std::uint64_t expected) {
  std::pmr::memory_resource* before = std::pmr::set_default_resource(std::pmr::null_memory_resource());
  const Outcome outcome = run_whole_api(scene);
  std::pmr::set_default_resource(before);
  if (outcome.unexpected > 0) fprintf(stderr, "%s answered %s\n", outcome.first, hf_result_get_name(outcome.got));
  return outcome.unexpected + (outcome.hash != expected);
}

// The job system of a host whose threads have floating-point settings of their own. Counts jobs that change the
// settings, and answers with other bits. `jobs` receives the number of jobs.
struct HostJobs {
  std::atomic<unsigned> jobs{0}, changed{0};
};
void run_under_other_settings(void* user, std::uint32_t count, void (*job)(void*, std::uint32_t), void* data) {
  std::thread([=] {
    HostJobs& seen = *static_cast<HostJobs*>(user);
    fesetround(FE_UPWARD);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040u);
#endif
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::string before, after;
      read_float_control(before);
      job(data, i);
      read_float_control(after);
      ++seen.jobs;
      seen.changed += before != after;
    }
    fedisableexcept(FE_ALL_EXCEPT);
  }).join();
}
unsigned different_jobs(const Scene& scene, std::uint64_t expected, unsigned& jobs) {
  HostJobs seen;
  const hf_job_runner runner = {run_under_other_settings, &seen};
  Options options;
  options.threads = 4;
  options.runner = &runner;
  const Outcome outcome = run_whole_api(scene, options);
  if (outcome.unexpected > 0) fprintf(stderr, "%s answered %s\n", outcome.first, hf_result_get_name(outcome.got));
  jobs = seen.jobs;
  return seen.changed + outcome.unexpected + (outcome.hash != expected);
}

}  // namespace

int main() {
  const Scene scene = make_scene();
  // first without the paper's engine, while the process has one thread
  unsigned changed = changed_properties(scene, false);
  const Outcome plain = run(scene, true);
  changed += changed_properties(scene, true);
  // a locale with a decimal comma, where there is one
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    changed += changed_properties(scene, true);
    changed += run(scene, true).hash != plain.hash;
    break;
  }
  std::setlocale(LC_ALL, "C");
  report_at_least("HOST_CALLS", plain.calls, 150);
  report_at_most("HOST_PROPERTIES_CHANGED", changed, 0);
  report_at_most("HOST_RANDOM_DRAWS_CHANGED", changed_draws(scene), 0);
  report_at_most("HOST_BYTES_PRINTED", printed_bytes(scene), 0);
  report_at_most("HOST_ANSWERS_FROM_ITS_DEFAULT_RESOURCE", answers_from_the_default_resource(scene, plain.hash), 0);
  report_at_most("HOST_FLOAT_SETTINGS_WITH_OTHER_RESULTS", different_runs(scene, plain.hash), 0);
  unsigned jobs = 0;
  report_at_most("HOST_JOBS_UNDER_ITS_FLOAT_SETTINGS_THAT_DIFFER", different_jobs(scene, plain.hash, jobs), 0);
  report_at_least("HOST_JOBS", jobs, 100);
  report_at_most("HOST_UNEXPECTED_ANSWERS", unexpected, 0);
  return report_status();
}
