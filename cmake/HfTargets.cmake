# What every target of the house shares: language level, warnings, sanitizers, reproducible floating point.

include(HfHardening)

# Warnings, and no contraction of a * b + c, by the compiler's own names. clang-cl takes Clang's names behind /clang:.
set(hf_compile_options)
if(MSVC)
  list(APPEND hf_compile_options /W4 /permissive- /utf-8 /fp:precise $<$<BOOL:${HF_WARNINGS_AS_ERRORS}>:/WX>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    list(APPEND hf_compile_options $<$<COMPILE_LANGUAGE:CXX>:/clang:-ffp-contract=off>)
  endif()
else()
  list(APPEND hf_compile_options -Wall -Wextra -Wpedantic $<$<BOOL:${HF_WARNINGS_AS_ERRORS}>:-Werror>
    $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
  # the registers of the 387 keep more digits than a double has
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86)$")
    list(APPEND hf_compile_options -msse2 -mfpmath=sse)
  endif()
  if(MINGW)  # printf as C99 has it, not as the C library of Windows has it
    list(APPEND hf_compile_options -D__USE_MINGW_ANSI_STDIO=1)
  endif()
endif()

# GCC collects garbage when its heap has grown to so many kB, 131072 by default: this trades memory for its time in a build with
# tests. Code is the same. With 524288 it takes 5 to 12 % less for a file of tests and 3 % less for a room, and up to 40 % more
# memory (1.0 GB for gltf_test). Twice that changes neither.
set(hf_compiler_heap)
if(HF_BUILD_TESTS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT HF_SANITIZE)
  set(hf_compiler_heap $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=524288>)
endif()

# Results must not depend on the compiler's mood: no contraction of a*b+c unless the code asks for it (kernels use FMA
# intrinsics), no -ffast-math, no -march=native.
function(hf_target_defaults target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  # A parent project without a build type would compile the library without optimisation: a frame takes 45 times as long.
  if(NOT MSVC AND NOT HF_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:>:-O2>)
  endif()
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF C_STANDARD 99 C_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE ${hf_compile_options} ${hf_compiler_heap})
  hf_harden(${target})
  if(HF_SANITIZE)
    # -O1 -g1: reports name functions and lines; with more, unrolled kernels and Eigen's templates take minutes each to compile
    # a fuzzer runs millions of times; operands of comparisons do not help it to find calls, and took a third of its time
    set(level -O1)
    if(HF_SANITIZE MATCHES "fuzzer")
      set(level -O2 -fno-sanitize-coverage=trace-cmp)
    endif()
    # GCC sees less through instrumented code and warns of values that are set (its manual says so)
    target_compile_options(${target} PRIVATE ${level} $<$<CXX_COMPILER_ID:GNU,Clang>:-g1> -fsanitize=${HF_SANITIZE}
      -fno-omit-frame-pointer -fno-sanitize-recover=all $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PRIVATE -fsanitize=${HF_SANITIZE})
  endif()
endfunction()
