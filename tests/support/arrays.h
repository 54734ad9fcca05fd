/* Arrays of tests as hf takes them. What a call writes to is as long as the mesh: the test has made it so. Lengths are
 * tested in tests/api/array_test.c. */
#ifndef HF_TESTS_SUPPORT_ARRAYS_H
#define HF_TESTS_SUPPORT_ARRAYS_H

#include <hf/hf.h>

enum { ROOM = 1 << 24 };

/* An array to write, for a field of a struct. */
#define ROWS_OUT(numbers) HF_ARRAY_OUT(numbers, ROOM)

/* OUT(numbers), OUT_ROWS(numbers, stride): an array to write, as an argument. */
#ifdef __cplusplus
struct OutRows {
  hf_array_out array;
  operator const hf_array_out*() const { return &array; }
};
template <class T>
OutRows OUT_ROWS(T* numbers, uint32_t stride) {
  return {{numbers, ROOM, stride, HF_TYPE_OF(numbers), 0}};
}
#define OUT(numbers) OUT_ROWS(numbers, 0)
#else
#define OUT_ROWS(numbers, stride) (&(hf_array_out){(numbers), ROOM, (stride), HF_TYPE_OF(numbers), 0})
#define OUT(numbers) OUT_ROWS(numbers, 0)
#endif

#endif
