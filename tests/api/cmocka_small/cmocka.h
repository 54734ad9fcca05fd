/* The part of cmocka that the tests of the public ABI use, for systems that have no cmocka: Windows, cross builds. A
 * failed check prints its place and leaves the test. C99. */
#ifndef HF_CMOCKA_SMALL_H
#define HF_CMOCKA_SMALL_H

#include <setjmp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef void (*CMUnitTestFunction)(void** state);
typedef int (*CMFixtureFunction)(void** state);
struct CMUnitTest {
  const char* name;
  CMUnitTestFunction test_func;
};

/* Runs the tests one after the other, prints how each went, and returns how many failed. setup and teardown: NULL or
 * called once; their failure fails everything. */
int small_run(const char* name, const struct CMUnitTest* tests, size_t count, CMFixtureFunction setup,
              CMFixtureFunction teardown);
void small_fail(const char* file, int line, const char* format, ...);
void small_skip(void);
void small_same_number(uintmax_t got, uintmax_t expected, const char* what, const char* file, int line);
void small_same_text(const char* got, const char* expected, const char* what, const char* file, int line);
void small_same_bytes(const void* got, const void* expected, size_t size, const char* what, const char* file, int line);

#define cmocka_unit_test(function) \
  { #function, function }
#define cmocka_run_group_tests(tests, setup, teardown) \
  small_run(#tests, tests, sizeof(tests) / sizeof((tests)[0]), setup, teardown)
#define cmocka_run_group_tests_name(name, tests, setup, teardown) \
  small_run(name, tests, sizeof(tests) / sizeof((tests)[0]), setup, teardown)

#define fail_msg(...) small_fail(__FILE__, __LINE__, __VA_ARGS__)
#define skip() small_skip()
#define print_message(...) ((void)printf(__VA_ARGS__))
#define print_error(...) ((void)printf(__VA_ARGS__))
#define assert_true(c) ((c) ? (void)0 : small_fail(__FILE__, __LINE__, "not true: %s", #c))
#define assert_false(c) (!(c) ? (void)0 : small_fail(__FILE__, __LINE__, "not false: %s", #c))
#define assert_null(p) assert_true((p) == NULL)
#define assert_non_null(p) assert_true((p) != NULL)
#define assert_ptr_equal(a, b) assert_true((const void*)(a) == (const void*)(b))
#define assert_ptr_not_equal(a, b) assert_true((const void*)(a) != (const void*)(b))
#define assert_int_equal(a, b) small_same_number((uintmax_t)(a), (uintmax_t)(b), #a " is " #b, __FILE__, __LINE__)
#define assert_int_not_equal(a, b) assert_true((uintmax_t)(a) != (uintmax_t)(b))
#define assert_string_equal(a, b) small_same_text(a, b, #a " is " #b, __FILE__, __LINE__)
#define assert_float_equal(a, b, epsilon) assert_true(fabs((double)(a) - (double)(b)) <= (epsilon)) /* <math.h> */
#define assert_memory_equal(a, b, size) small_same_bytes(a, b, size, #a " is " #b, __FILE__, __LINE__)

#endif
