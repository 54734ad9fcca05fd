/* Prints the figures of reliability, one line each: `NAME value target`. Every command of this folder uses it and exits
 * with report_status(), which is 1 when any figure missed its target. C99 and C++; one thread. */
#ifndef HF_RELIABILITY_REPORT_H
#define HF_RELIABILITY_REPORT_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int report_missed_;

/* A figure that must be `target` or more. NaN misses. */
static inline void report_at_least(const char* name, double value, double target) {
  printf("%s %.10g >=%.10g\n", name, value, target);
  if (!(value >= target)) {
    report_missed_ = 1;
    fprintf(stderr, "%s: missed\n", name);
  }
  fflush(stdout);
}

/* A figure that must be `target` or less. NaN misses. */
static inline void report_at_most(const char* name, double value, double target) {
  printf("%s %.10g <=%.10g\n", name, value, target);
  if (!(value <= target)) {
    report_missed_ = 1;
    fprintf(stderr, "%s: missed\n", name);
  }
  fflush(stdout);
}

/* The exit code of the command. */
static inline int report_status(void) { return report_missed_; }

/* Whether to run the long form: with --full, or HF_FULL_TESTS in the environment (tests/run --full sets it). */
static inline int report_full(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--full") == 0) return 1;
  }
  return getenv("HF_FULL_TESTS") != NULL;
}

#endif
