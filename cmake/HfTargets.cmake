# What every target of the house shares: language level, warnings, sanitizers, reproducible floating point.

include(HfHardening)

# Results must not depend on the compiler's mood: no contraction of a*b+c unless the code asks for it (kernels use FMA
# intrinsics), no -ffast-math, no -march=native.
function(hf_target_defaults target)
  target_compile_features(${target} PRIVATE cxx_std_17)
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF C_STANDARD 99 C_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic $<$<BOOL:${HF_WARNINGS_AS_ERRORS}>:-Werror>
    $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
  hf_harden(${target})
  if(HF_SANITIZE)
    # -O1 -g1: reports name functions and lines; with more, unrolled kernels and Eigen's templates take minutes each to compile
    target_compile_options(${target} PRIVATE -O1 $<$<CXX_COMPILER_ID:GNU,Clang>:-g1> -fsanitize=${HF_SANITIZE}
      -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PRIVATE -fsanitize=${HF_SANITIZE})
  endif()
endfunction()
