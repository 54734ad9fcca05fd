/* hf/base.h - result codes, error details, memory and thread hooks, progress, version.
 *
 * Rules for every function of hf:
 * - It returns an hf_result: HF_OK (0) or a negative code. Functions that cannot fail return their value.
 * - It borrows its inputs for the call. It writes outputs to memory of the caller, and hands out nothing to be freed.
 * - A failed call changes nothing. A batch is done whole or not at all.
 * - Structs start with struct_size. HF_INIT(type) is a struct of defaults: every field but the size is zero.
 * - Arrays out: you pass a capacity and read a count. The count is also written with HF_ERROR_TOO_SMALL. Pass NULL
 *   arrays to ask for the count alone; that succeeds.
 * - Flags are int32_t: 0 is no, 1 is yes.
 * - Different handles can be used from different threads at once. Functions that "read" one handle can run on it at the
 *   same time. A call that overlaps a "change" of the same handle returns HF_ERROR_BUSY.
 *
 * Codes that every function with such an argument can return are not repeated at the functions:
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_BUSY, HF_ERROR_REENTRANT,
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_TOO_SMALL (a stride below the size of a row, a capacity below the count),
 * HF_ERROR_EMPTY (a list of no entries). `index` of the error detail is the position in the list, if not said otherwise.
 *
 * The library prints nothing and keeps no global state but its handle table. It starts only the threads you grant. It
 * leaves the floating-point environment, locale, signals and rand() of the host as they were.
 * - fork: a child can use the handles it inherited, if no other thread was inside a call. Library threads stay with the
 *   parent; calls of the child work without them.
 * - Unloading: when all handles are destroyed the library holds no memory, no thread and no hook, and can be unloaded.
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

/* Version of these headers; hf_version_get answers that of the loaded library. */
#define HF_VERSION_MAJOR 0
#define HF_VERSION_MINOR 1
#define HF_VERSION_PATCH 0

/* Result of a call. Blocks: 1..99 arguments and state, 100..199 resources, 200..299 numerical, 300.. internal. */
typedef int32_t hf_result;
enum {
  HF_OK = 0,
  /* arguments and state */
  HF_ERROR_INVALID_ARGUMENT = -1, /* a value outside what the function documents */
  HF_ERROR_NULL_POINTER = -2,     /* a required pointer is NULL */
  HF_ERROR_INVALID_HANDLE = -3,   /* a handle is NULL, destroyed or of another kind */
  HF_ERROR_INVALID_DESC = -4,     /* struct_size is too small, or a byte is set that this version does not know */
  HF_ERROR_OUT_OF_RANGE = -5,     /* an index beyond its array; the detail names it */
  HF_ERROR_NON_FINITE = -6,       /* NaN or infinity in an input; the detail names where */
  HF_ERROR_EMPTY = -7,            /* nothing to work on: no vertices, no triangles, an empty list */
  HF_ERROR_DUPLICATE_SITE = -8,   /* the vertex carries a site already, or is named twice in one batch */
  HF_ERROR_NO_SUCH_SITE = -9,     /* no site of that number in the solver */
  HF_ERROR_CONFLICT = -10, /* contradicting values: on welded copies of a vertex, or linearly dependent hard sites */
  HF_ERROR_NO_SITES = -11, /* the solver has no site at all; add one before solving */
  HF_ERROR_NO_SUCH_HANDLE = -12, /* no handle of that number in the pose */
  HF_ERROR_NO_SUCH_PAIR = -13,   /* no pair of that number in the transfer */
  HF_ERROR_OVERLAP = -14,        /* two handles claim one vertex */
  HF_ERROR_UNSUPPORTED = -15,    /* not in this build or not for this object; the detail says what to use */
  HF_ERROR_BUSY = -16,           /* another thread is changing this handle */
  HF_ERROR_REENTRANT = -17,      /* called from inside a callback of the same handle */
  HF_ERROR_TOO_SMALL = -18,      /* a capacity or stride is too small */
  HF_ERROR_NO_RECORD = -19,      /* nothing to undo or redo */
  /* resources */
  HF_ERROR_OUT_OF_MEMORY = -100, /* the allocator refused; the handle is as before */
  HF_ERROR_TOO_LARGE = -101,     /* beyond a limit; the detail names the limit */
  HF_ERROR_CANCELLED = -102,     /* cancelled through the progress object */
  /* numerical */
  HF_ERROR_NOT_POSITIVE_DEFINITE = -200, /* the matrix has a pivot that is not positive: report it with the mesh */
  HF_ERROR_INACCURATE = -201,            /* the certificate of a solve failed */
  /* internal */
  HF_ERROR_INTERNAL = -300 /* a fault of the library; destroy the handle */
};

#define HF_NO_INDEX 0xFFFFFFFFu
#define HF_MESSAGE_SIZE 256

/* A struct of defaults: hf_surface_desc desc = HF_INIT(hf_surface_desc); */
#ifdef __cplusplus
#define HF_INIT(type)                                        \
  ([] {                                                      \
    type hf_made{};                                          \
    hf_made.struct_size = static_cast<uint32_t>(sizeof(type)); \
    return hf_made;                                          \
  }())
#else
#define HF_INIT(type) ((type){.struct_size = (uint32_t)sizeof(type)})
#endif

/* Details of the last failed call on this thread. */
typedef struct hf_error_detail {
  hf_result code;
  uint32_t index;    /* vertex, triangle, site, handle or position in a list; HF_NO_INDEX for none */
  char function[48]; /* the public function that failed */
  char message[HF_MESSAGE_SIZE]; /* one line: what is wrong and what to do; UTF-8, zero-terminated */
} hf_error_detail;

/* Copies the detail of the last failed call of this thread; all zero before the first failure. A successful call leaves
 * it as it was. The detail lies in memory of its own, so it also reports that memory ran out. Thread safety: any
 * thread. Since 0.1. */
HF_API hf_result hf_error_get_detail(hf_error_detail* out_detail);

/* A constant English name of a code, such as "HF_ERROR_BUSY"; "unknown" for others. Never NULL. Thread safety: any
 * thread. Since 0.1. */
HF_API const char* hf_result_get_name(hf_result result);

/* Version of the loaded library: major * 1000000 + minor * 1000 + patch. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_version_get(void);

/* Your allocator, for a surface and everything made from it. Set both functions, or neither (then malloc).
 * allocate returns `size` bytes aligned to `alignment`, or NULL to refuse. `alignment` is a power of two; `size` need
 * not be a multiple of it. release takes back a block with the same size and alignment, and must not throw.
 * Both are called from the thread of the call, and from worker threads if the desc grants any. A C++ exception out of
 * allocate ends the call with HF_ERROR_INTERNAL (std::bad_alloc: HF_ERROR_OUT_OF_MEMORY); the object is as before. */
typedef struct hf_allocator {
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* block, size_t size, size_t alignment);
  void* user;
} hf_allocator;

/* Your job system. run calls job(job_data, i) for i = 0 .. count - 1, on any threads, in any order, and returns when all
 * have returned. Leave run NULL and the library makes thread_count - 1 threads of its own. The library does the jobs
 * that run leaves out, and does a repeated job once. A C++ exception may leave run after all started jobs have returned;
 * the call then ends with HF_ERROR_INTERNAL. */
typedef struct hf_job_runner {
  void (*run)(void* user, uint32_t count, void (*job)(void* job_data, uint32_t index), void* job_data);
  void* user;
} hf_job_runner;

/* Progress of a long call. Any thread can poll and cancel it. Use one object for one call at a time. */
typedef struct hf_progress_object* hf_progress;

/* Creates a progress object. Sets *out_progress to NULL first. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_progress_create(hf_progress* out_progress);
/* Destroys it. Ignores NULL and destroyed handles. A call that still uses it keeps it alive. Thread safety: any thread.
 * Since 0.1. */
HF_API void hf_progress_destroy(hf_progress progress);
/* Writes the fraction done of the running call, 0 to 1. After a call it stays where the call ended, also when it was
 * cancelled; the next call starts at 0. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_progress_get_fraction(hf_progress progress, float* out_fraction);
/* Stops the running call, or the next one given this object, with HF_ERROR_CANCELLED. Thread safety: any thread.
 * Since 0.1. */
HF_API hf_result hf_progress_cancel(hf_progress progress);

#ifdef __cplusplus
}
#endif
#endif
