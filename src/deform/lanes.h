// HF_FOUR_LANES also compiles a function for AVX2. The program picks the version when it starts.
//
// The loops work on four adjacent numbers and use no fused multiply-adds, so the bits are those of the plain build. The
// choice needs glibc's dynamic linker. It runs before sanitizers can, so sanitizer builds leave it out.
#pragma once

#if defined(__GLIBC__) && defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define HF_FOUR_LANES __attribute__((target_clones("avx2", "default")))
#else
#define HF_FOUR_LANES
#endif
