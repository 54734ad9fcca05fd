/* hf/base.h - result codes, error detail, memory and thread hooks, progress, version.
 *
 * Conventions of every function in these headers:
 * - Returns an hf_result: HF_OK (0) or a negative code; getters that cannot fail return their value.
 * - Inputs are borrowed for the call. Outputs are written to the caller's memory; nothing is handed out to be freed.
 * - After a failure nothing has changed, unless the function says otherwise; batches are all or nothing.
 * - Descs start with struct_size (set it with HF_INIT or by hand); zero is the default of every other field.
 * - Threads: different handles may be used at the same time from different threads; functions that only read one handle
 * may run at the same time on it; a call that overlaps a change of the same handle answers HF_ERROR_BUSY.
 * - The library prints nothing, keeps no global state but its handle table, starts no thread that was not granted, and
 *   leaves the floating-point environment, locale, signals and rand() of the host as they were.
 * - fork: a child may use handles it inherited and make its own, if no call was under way on another thread when it was
 *   forked; threads of an inherited object stay behind, the child's calls work without them.
 * - Unloading: with all handles destroyed the library holds no memory, no thread and no hook, and may be unloaded.
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

/* Result of a call. Blocks: 1..99 arguments and state, 100..199 resources, 200..299 numerical, 300.. internal. */
typedef int32_t hf_result;
enum {
  HF_OK = 0,
  /* arguments and state */
  HF_ERROR_INVALID_ARGUMENT = -1, /* a value outside what the function documents */
  HF_ERROR_NULL_POINTER = -2,     /* a required pointer is NULL */
  HF_ERROR_INVALID_HANDLE = -3,   /* NULL, stale, foreign or destroyed handle */
  HF_ERROR_INVALID_DESC = -4,     /* struct_size unknown, or bytes set that this version does not know */
  HF_ERROR_OUT_OF_RANGE = -5,     /* an index beyond its array; the detail names it */
  HF_ERROR_NON_FINITE = -6,       /* NaN or infinity in an input; the detail names where */
  HF_ERROR_EMPTY = -7,            /* nothing to work on: no vertices, no triangles, empty region */
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
  HF_ERROR_TOO_SMALL = -18,      /* the caller's buffer or stride is too small */
  HF_ERROR_NO_RECORD = -19,      /* nothing to undo or redo */
  /* resources */
  HF_ERROR_OUT_OF_MEMORY = -100, /* the allocator refused; the handle is as before */
  HF_ERROR_TOO_LARGE = -101,     /* beyond a limit of the library or of the desc; the detail names the limit */
  HF_ERROR_CANCELLED = -102,     /* cancelled through the progress object */
  /* numerical */
  HF_ERROR_NOT_POSITIVE_DEFINITE = -200, /* the matrix lost definiteness: report it with the mesh */
  HF_ERROR_INACCURATE = -201,            /* the certificate of a solve failed */
  /* internal */
  HF_ERROR_INTERNAL = -300 /* a fault of the library; the handle should be destroyed */
};

#define HF_NO_INDEX 0xFFFFFFFFu
#define HF_MESSAGE_SIZE 256

/* Sets every byte of a desc to zero and its struct_size. */
#define HF_INIT(desc) hf_init_desc(&(desc), (uint32_t)sizeof(desc))
HF_API void hf_init_desc(void* desc, uint32_t struct_size);

/* What the last failing call on this thread was about. */
typedef struct hf_error_detail {
  hf_result code;
  uint32_t index;    /* vertex, triangle, site, handle or component the message is about; HF_NO_INDEX for none */
  char function[48]; /* the public function that failed */
  char message[HF_MESSAGE_SIZE]; /* one line: what is wrong and what to do; UTF-8, zero-terminated */
} hf_error_detail;

/* Copies the detail of the last failing call of the calling thread. A successful call leaves it as it was; before the
 * first failure it is all zero. The detail is kept preallocated, so running out of memory reports too. Returns HF_OK or
 * HF_ERROR_NULL_POINTER. Thread safety: any thread; the detail is per thread. Since 0.1. */
HF_API hf_result hf_get_error_detail(hf_error_detail* out_detail);

/* A constant English name of a code, such as "HF_ERROR_BUSY"; "unknown" for others. Never NULL. Thread safety: any
 * thread. Since 0.1. */
HF_API const char* hf_result_name(hf_result result);

/* Version of the library that is loaded: major * 1000000 + minor * 1000 + patch. Thread safety: any thread. Since 0.1.
 */
HF_API uint32_t hf_get_version(void);

/* Memory of a solver and all that is made from it. Both functions, or neither (then malloc).
 * allocate: returns `size` bytes aligned to `alignment`, a power of two that need not divide it, or NULL to refuse.
 * release: takes back a block with the size and alignment it was asked with; must not throw.
 * Called from the thread of the call, and from worker threads when the desc grants any. An exception of a C++ host that
 * leaves allocate ends the call with HF_ERROR_INTERNAL (std::bad_alloc: HF_ERROR_OUT_OF_MEMORY), the object as before. */
typedef struct hf_allocator {
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* block, size_t size, size_t alignment);
  void* user;
} hf_allocator;

/* The host's own job system. run must call job(job_data, i) for i = 0 .. count - 1, on any threads, in any order, and
 * return when all of them have returned. NULL run: the library makes thread_count - 1 threads of its own for the
 * object. An exception that leaves run, after all jobs it has started have returned, ends the call with
 * HF_ERROR_INTERNAL. Jobs that run leaves out are done by the library, those it repeats are done once. */
typedef struct hf_job_runner {
  void (*run)(void* user, uint32_t count, void (*job)(void* job_data, uint32_t index), void* job_data);
  void* user;
} hf_job_runner;

/* Progress of a long call, polled and cancelled from any thread; one object for one call at a time. */
typedef struct hf_progress_object* hf_progress;

/* Creates a progress object. *out_progress is set to NULL first. Returns HF_OK, HF_ERROR_NULL_POINTER,
 * HF_ERROR_OUT_OF_MEMORY. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_progress_create(hf_progress* out_progress);
/* Destroys it; NULL and stale handles are ignored. A call that still uses it keeps it alive. Thread safety: any thread.
 * Since 0.1. */
HF_API void hf_progress_destroy(hf_progress progress);
/* Writes the fraction done of the running call, 0 to 1. Granularity: phases of hf_create (weld, operator, ordering,
 * analysis, factorisation). Returns HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER. Thread safety: any thread.
 * Since 0.1. */
HF_API hf_result hf_progress_get(hf_progress progress, float* out_fraction);
/* Asks the running call, or the next one given this object, to stop with HF_ERROR_CANCELLED. Returns HF_OK or
 * HF_ERROR_INVALID_HANDLE. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_progress_cancel(hf_progress progress);

#ifdef __cplusplus
}
#endif
#endif
