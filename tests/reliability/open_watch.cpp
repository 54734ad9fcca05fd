#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "open_watch.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/types.h>

#include <cstdio>

namespace hostile {
namespace {

std::vector<std::string>& names() {
  static std::vector<std::string> list;
  return list;
}
bool watching = false;

void note(const char* name) {
  if (!watching || !name) return;
  char real[PATH_MAX];
  names().push_back(realpath(name, real) ? real : name);
}

template <class Function>
Function next(const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  if (!found) abort();
  return reinterpret_cast<Function>(found);
}

mode_t mode_of(int flags, va_list list) {
  const bool made = (flags & O_CREAT) || (flags & O_TMPFILE) == O_TMPFILE;
  return made ? static_cast<mode_t>(va_arg(list, unsigned)) : 0;
}

}  // namespace

std::vector<std::string> opened() {
  watching = true;
  std::vector<std::string> list;
  list.swap(names());
  return list;
}

}  // namespace hostile

extern "C" {
using OpenFunction = int (*)(const char*, int, ...);
using OpenAtFunction = int (*)(int, const char*, int, ...);
using StreamFunction = FILE* (*)(const char*, const char*);

#define HF_WATCH_OPEN(name)                                                           \
  __attribute__((visibility("default"))) int name(const char* path, int flags, ...) { \
    va_list list;                                                                     \
    va_start(list, flags);                                                            \
    const mode_t mode = hostile::mode_of(flags, list);                                \
    va_end(list);                                                                     \
    hostile::note(path);                                                              \
    static const OpenFunction real = hostile::next<OpenFunction>(#name);              \
    return real(path, flags, mode);                                                   \
  }
#define HF_WATCH_OPENAT(name)                                                                     \
  __attribute__((visibility("default"))) int name(int folder, const char* path, int flags, ...) { \
    va_list list;                                                                                 \
    va_start(list, flags);                                                                        \
    const mode_t mode = hostile::mode_of(flags, list);                                            \
    va_end(list);                                                                                 \
    hostile::note(path);                                                                          \
    static const OpenAtFunction real = hostile::next<OpenAtFunction>(#name);                      \
    return real(folder, path, flags, mode);                                                       \
  }
#define HF_WATCH_STREAM(name)                                                             \
  __attribute__((visibility("default"))) FILE* name(const char* path, const char* mode) { \
    hostile::note(path);                                                                  \
    static const StreamFunction real = hostile::next<StreamFunction>(#name);              \
    return real(path, mode);                                                              \
  }

HF_WATCH_OPEN(open)
HF_WATCH_OPEN(open64)
HF_WATCH_OPENAT(openat)
HF_WATCH_OPENAT(openat64)
HF_WATCH_STREAM(fopen)
HF_WATCH_STREAM(fopen64)
}
