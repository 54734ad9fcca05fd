#include <cmocka.h>
#include <stdarg.h>
#include <string.h>

static jmp_buf leave;
enum { PASSED, FAILED, SKIPPED };

void small_fail(const char* file, int line, const char* format, ...) {
  va_list rest;
  va_start(rest, format);
  printf("%s:%d: error: ", file, line);
  vprintf(format, rest);
  printf("\n");
  va_end(rest);
  fflush(stdout);
  longjmp(leave, FAILED);
}

void small_skip(void) { longjmp(leave, SKIPPED); }

void small_same_number(uintmax_t got, uintmax_t expected, const char* what, const char* file, int line) {
  if (got != expected)
    small_fail(file, line, "%s: 0x%llx != 0x%llx", what, (unsigned long long)got, (unsigned long long)expected);
}

void small_same_text(const char* got, const char* expected, const char* what, const char* file, int line) {
  if (strcmp(got, expected) != 0) small_fail(file, line, "%s: \"%s\" != \"%s\"", what, got, expected);
}

void small_same_bytes(const void* got, const void* expected, size_t size, const char* what, const char* file,
                      int line) {
  if (memcmp(got, expected, size) != 0) small_fail(file, line, "%s: other bytes", what);
}

int small_run(const char* name, const struct CMUnitTest* tests, size_t count, CMFixtureFunction setup,
              CMFixtureFunction teardown) {
  void* state = NULL;
  volatile int failed = 0;
  printf("%s: %u tests\n", name, (unsigned)count);
  if (setup && setup(&state) != 0) {
    printf("the setup failed\n");
    return (int)count;
  }
  for (size_t i = 0; i < count; ++i) {
    static const char* const said[] = {"passed", "FAILED", "skipped"};
    void* own = state;
    volatile int result = PASSED;
    fflush(stdout);
    const int left = setjmp(leave);
    if (left == PASSED)
      tests[i].test_func(&own);
    else
      result = left;
    if (result == FAILED) ++failed;
    printf("%-8s %s\n", said[result], tests[i].name);
  }
  if (teardown && teardown(&state) != 0) ++failed;
  printf("%d of %u failed\n", failed, (unsigned)count);
  fflush(stdout);
  return failed;
}
