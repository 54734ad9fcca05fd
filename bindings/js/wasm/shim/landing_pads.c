/* Catches by type in builds with threads. clang 14 writes the context of landing pads as one global. The libunwind of its
 * emscripten has one for each thread, so no type matched, and every refused call was "an unknown exception". This is that file
 * with one context. Two threads that catch by type at one moment would share it: only the page's Worker does. */
#include <threads.h>
#undef thread_local
#define thread_local
#include "Unwind-wasm.c"
