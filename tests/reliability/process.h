// Counts of the kernel for this process.
#ifndef HF_TESTS_RELIABILITY_PROCESS_H
#define HF_TESTS_RELIABILITY_PROCESS_H

#include <dirent.h>

namespace reliability {

// Entries of a folder, such as /proc/self/fd or /proc/self/task; 0 when it cannot be read.
inline unsigned entries(const char* folder) {
  unsigned count = 0;
  if (DIR* d = opendir(folder)) {
    while (readdir(d)) ++count;
    closedir(d);
  }
  return count;
}

}  // namespace reliability

#endif
