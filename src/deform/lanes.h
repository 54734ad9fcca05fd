// Loops over four numbers that lie together, compiled for AVX2 too and chosen when the program starts: nothing is
// contracted, so the bits are those of the plain build. Clones need the dynamic linker's help (glibc), and sanitizers
// cannot run before it.
#pragma once

#if defined(__GLIBC__) && defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define HF_FOUR_LANES __attribute__((target_clones("avx2", "default")))
#else
#define HF_FOUR_LANES
#endif
