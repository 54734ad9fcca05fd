/* hf/base.h - check results, pass your allocator and threads, follow progress, read the version.
 *
 * Rules for every function of hf:
 * - It returns an hf_result: HF_OK (0) or a negative code. Functions that cannot fail return their value.
 * - It uses your input arrays only during the call. It writes outputs to your memory, so you never free memory of the
 *   library.
 * - A failed call changes nothing. A call with a batch of edits does all of them or none.
 * - Structs start with struct_size. HF_INIT(type) is a struct of defaults: every field but the size is zero.
 * - Output arrays: you pass a capacity and read a count. A call that fails with HF_ERROR_TOO_SMALL writes the count
 *   too. To ask for the count alone, pass NULL arrays; such a call succeeds. An array with a row per vertex of the
 *   mesh, or per entry of an input list, takes no capacity. Its comment gives the length.
 * - An hf_array views an array of yours, such as an attribute of a vertex buffer. An hf_array_out views an array that
 *   the library writes. Rows can have a stride. Numbers are float or double, indices are uint32_t or uint16_t. The
 *   comment of an hf_array gives its rows, the numbers per row and its types.
 * - Flags are int32_t: 0 is no, 1 is yes.
 * - Threads can use different objects at once. Functions that "read" an object can run on that object at the same time.
 *   A call on an object that another thread is just changing returns HF_ERROR_BUSY.
 *
 * Some errors are not repeated at each function. Every function with such an argument can return them:
 * - HF_ERROR_INVALID_OBJECT, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_BUSY, HF_ERROR_REENTRANT and
 *   HF_ERROR_OUT_OF_MEMORY.
 * - HF_ERROR_TOO_SMALL: a stride is below the size of a row. Or a capacity or an hf_array_out is below the count.
 * - HF_ERROR_INVALID_ARGUMENT: an hf_array has a type or a count that its comment does not give.
 * - HF_ERROR_EMPTY: a list has no entries.
 * The `index` of the error detail is the position in the list, unless the function says otherwise.
 *
 * The library prints nothing and keeps no global state but its table of objects. It starts no more threads than
 * thread_count allows. It leaves the floating-point environment, locale, signals and rand() of the host as they were.
 * - fork: a child process can use its inherited objects if no other thread was inside a call. The library's threads
 *   exist in the parent only; calls of the child work without them.
 * - Unloading: you can unload the library when all objects are destroyed. It then holds no memory, thread or callback.
 */
#ifndef HF_BASE_H
#define HF_BASE_H

#include <stddef.h>
#include <stdint.h>

#if defined(HF_STATIC)
#define HF_API
#elif defined(_WIN32)
#if defined(HF_BUILDING)
#define HF_API __declspec(dllexport)
#else
#define HF_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define HF_API __attribute__((visibility("default")))
#else
#define HF_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Version of these headers. hf_version_get returns the version of the loaded library. */
#define HF_VERSION_MAJOR 0
#define HF_VERSION_MINOR 1
#define HF_VERSION_PATCH 0

/* Result of a call. The codes -1 to -99 report arguments and state, -100 to -199 resources. The codes -200 to -299
 * report numerical failures, and codes from -300 down internal faults. */
typedef int32_t hf_result;
enum {
  HF_OK = 0,

  HF_ERROR_INVALID_ARGUMENT = -1, /* a value outside the documented range */
  HF_ERROR_NULL_POINTER = -2,     /* a required pointer is NULL */
  HF_ERROR_INVALID_OBJECT = -3,   /* an object is NULL, destroyed or of another kind */
  HF_ERROR_INVALID_DESC = -4,     /* struct_size is too small, or a byte is set that this version does not know */
  HF_ERROR_OUT_OF_RANGE = -5,     /* an index beyond its array; the detail names it */
  HF_ERROR_NON_FINITE = -6,       /* NaN or infinity in an input; the detail names where */
  HF_ERROR_EMPTY = -7,            /* nothing to work on: a mesh without triangles, an empty list, no site, no handle */
  HF_ERROR_NOT_FOUND = -8,        /* no site, handle or pair of that number */
  HF_ERROR_DUPLICATE = -9,        /* a thing is there already, or is named twice in one batch */
  HF_ERROR_CONFLICT = -10,        /* contradicting values on welded copies, linearly dependent hard sites, or regions
                                     that overlap */
  HF_ERROR_UNSUPPORTED = -11,     /* not in this build or not for this object; the detail says what to use */
  HF_ERROR_BUSY = -12,            /* another thread is changing this object */
  HF_ERROR_REENTRANT = -13,       /* called from inside a callback of the same object */
  HF_ERROR_TOO_SMALL = -14,       /* a capacity or stride is too small */

  HF_ERROR_OUT_OF_MEMORY = -100, /* the allocator refused; the object is as before */
  HF_ERROR_TOO_LARGE = -101,     /* beyond a limit; the detail names the limit */
  HF_ERROR_CANCELLED = -102,     /* cancelled through the progress object */

  HF_ERROR_NOT_POSITIVE_DEFINITE = -200, /* the matrix has a pivot that is not positive: report it with the mesh */
  HF_ERROR_INACCURATE = -201,            /* hf_solver_certify: the field fails its equations */

  HF_ERROR_INTERNAL = -300 /* a fault of the library; destroy the object */
};

#define HF_NO_INDEX 0xFFFFFFFFu
#define HF_MESSAGE_SIZE 256

/* HF_INIT makes a struct of defaults: hf_surface_desc desc = HF_INIT(hf_surface_desc); */
#ifdef __cplusplus
#define HF_INIT(type)                                          \
  ([] {                                                        \
    type hf_made{};                                            \
    hf_made.struct_size = static_cast<uint32_t>(sizeof(type)); \
    return hf_made;                                            \
  }())
#else
#define HF_INIT(type) ((type){.struct_size = (uint32_t)sizeof(type)})
#endif

/* ---- arrays ---- */

/* Selects the type of the numbers in an array. */
enum hf_type {
  HF_TYPE_PLAIN = 0,  /* float; uint32_t in an array of indices */
  HF_TYPE_DOUBLE = 1, /* double instead of float */
  HF_TYPE_UINT16 = 2  /* uint16_t instead of uint32_t */
};

/* An array of yours that the library reads: packed numbers, an attribute of a vertex buffer, an accessor of glTF. The
 * library reads it during the call only. The data can have any alignment. NULL data with a count of 0 means no array.
 * HF_ARRAY fills the struct for packed rows. */
typedef struct hf_array {
  const void* data;
  uint32_t count;    /* rows */
  uint32_t stride;   /* bytes from row to row; 0 = packed */
  int32_t type;      /* HF_TYPE_* */
  uint32_t reserved; /* 0 */
} hf_array;

/* An array of yours that the library writes. Its rules are the rules of hf_array. It can have more rows than the
 * library writes. HF_ARRAY_OUT fills the struct for packed rows. */
typedef struct hf_array_out {
  void* data;
  uint32_t count;    /* rows that it has room for */
  uint32_t stride;   /* bytes from row to row; 0 = packed */
  int32_t type;      /* HF_TYPE_* */
  uint32_t reserved; /* 0 */
} hf_array_out;

/* HF_ARRAY and HF_ARRAY_OUT view packed rows: desc.positions = HF_ARRAY(xyz, vertex_count). They take the type from the
 * pointer: float, double, uint32_t or uint16_t. With float rows[100][3], pass a pointer to the first number: rows[0].
 * If rows are not packed, set the stride afterwards. In C you can write &HF_ARRAY_OUT(x, n) in a call. C++ has no
 * address of a temporary: name the array first. */
#define HF_TYPE_OF(numbers)                   \
  (sizeof(*(numbers)) == 4   ? HF_TYPE_PLAIN  \
   : sizeof(*(numbers)) == 8 ? HF_TYPE_DOUBLE \
   : sizeof(*(numbers)) == 2 ? HF_TYPE_UINT16 \
                             : -1)
#ifdef __cplusplus
#define HF_ARRAY(numbers, rows) (hf_array{(numbers), static_cast<uint32_t>(rows), 0, HF_TYPE_OF(numbers), 0})
#define HF_ARRAY_OUT(numbers, rows) (hf_array_out{(numbers), static_cast<uint32_t>(rows), 0, HF_TYPE_OF(numbers), 0})
#else
#define HF_ARRAY(numbers, rows) ((hf_array){(numbers), (uint32_t)(rows), 0, HF_TYPE_OF(numbers), 0})
#define HF_ARRAY_OUT(numbers, rows) ((hf_array_out){(numbers), (uint32_t)(rows), 0, HF_TYPE_OF(numbers), 0})
#endif

/* ---- errors ---- */

/* Details of the last failed call on this thread. */
typedef struct hf_error_detail {
  hf_result code;
  uint32_t index;                /* vertex, triangle, site, handle or position in a list; HF_NO_INDEX for none */
  char function[48];             /* the public function that failed */
  char message[HF_MESSAGE_SIZE]; /* one line: the fault and its mend; UTF-8, zero-terminated */
} hf_error_detail;

/* Copies the detail of the last failed call of this thread. It is all zero before the first failure, and successful
 * calls do not change it. The library never allocates memory for the detail, so it can also report that memory ran out.
 * Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_error_get_detail(hf_error_detail* out_detail);

/* Returns the constant English name of a code, such as "HF_ERROR_BUSY", or "unknown" for a number that is no code.
 * Never returns NULL. Thread safety: any thread. Since 0.1. */
HF_API const char* hf_result_get_name(hf_result result);

/* Returns the version of the loaded library: major * 1000000 + minor * 1000 + patch. Thread safety: any thread. Since
 * 0.1. */
HF_API uint32_t hf_version_get(void);

/* Your allocator, which serves a surface and everything made from it. Set both functions, or neither; then the library
 * uses malloc. The function `allocate` returns `size` bytes aligned to `alignment`, or NULL to refuse. The alignment is
 * a power of two; `size` need not be a multiple of it. The function `release` gets a block back with the size and
 * alignment it was allocated with, and must not throw. The library calls both from the thread of the API call, and from
 * worker threads if thread_count allows any. If allocate throws a C++ exception, the API call returns
 * HF_ERROR_INTERNAL, or HF_ERROR_OUT_OF_MEMORY for std::bad_alloc. The object is then as before. */
typedef struct hf_allocator {
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* block, size_t size, size_t alignment);
  void* user;
} hf_allocator;

/* Your job system. run must call job(job_data, i) for i = 0 .. count - 1, on any threads and in any order. It returns
 * when all these calls have returned. A surface with thread_count 0 or 1 gives it no jobs, because calls are divided
 * into about thread_count jobs. If run is NULL, the library makes thread_count - 1 threads of its own. The
 * library itself does the jobs that run leaves out, and does a repeated job only once. The function run may throw a C++
 * exception after all started jobs have returned; the API call then returns HF_ERROR_INTERNAL. */
typedef struct hf_job_runner {
  void (*run)(void* user, uint32_t count, void (*job)(void* job_data, uint32_t index), void* job_data);
  void* user;
} hf_job_runner;

/* Reports the progress of a long call. Any thread can poll the object and cancel the call through it. Use one object
 * for one call at a time. If a cancel may come after the end of the call, make a new object for the next call. */
typedef struct hf_progress_object* hf_progress;

/* Creates a progress object. Sets *out_progress to NULL first. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_progress_create(hf_progress* out_progress);
/* Destroys a progress object. Ignores NULL and destroyed objects. The object stays valid for a call that still uses it.
 * Thread safety: any thread. Since 0.1. */
HF_API void hf_progress_destroy(hf_progress progress);
/* Writes how much of the running call is done. out_fraction: receives 0 to 1. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_progress_get_fraction(hf_progress progress, double* out_fraction);
/* Stops the call that uses this object, or the next one that does. That call returns HF_ERROR_CANCELLED. Thread safety:
 * any thread. Since 0.1. */
HF_API hf_result hf_progress_cancel(hf_progress progress);

#ifdef __cplusplus
}
#endif
#endif
