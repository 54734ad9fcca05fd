# Compiler and linker flags that make memory faults harder to exploit: hf_harden(TARGET), for targets that ship.
#
# Every flag is asked of the compiler first; one it does not know is left out. They change no result of the library.
include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)
include(CheckPIESupported)

option(HF_HARDEN "Guard stacks, returns and C library calls; write-protect what the loader fills in" ON)

set(hf_hardening_compile)
set(hf_hardening_link)
# sanitizers and counters check more, and do not go with all of these; a WebAssembly module is guarded by its host
if(HF_HARDEN AND NOT HF_SANITIZE AND NOT HF_COVERAGE AND NOT EMSCRIPTEN AND NOT MSVC)
  set(flags -fstack-protector-strong -fstack-clash-protection -fcf-protection=full)
  if(MINGW)  # Windows has stack probes of its own, and GCC 12 fails on functions that never return with both
    list(REMOVE_ITEM flags -fstack-clash-protection)
  endif()
  foreach(flag ${flags})
    string(MAKE_C_IDENTIFIER "HF_HAVE${flag}" known)
    check_cxx_compiler_flag("-Werror ${flag}" ${known})
    if(${known})
      list(APPEND hf_hardening_compile ${flag})
    endif()
  endforeach()
  if(MINGW AND "-fstack-protector-strong" IN_LIST hf_hardening_compile)  # the linker adds libssp, which holds the guard
    list(APPEND hf_hardening_link -fstack-protector-strong)
  endif()
  # calls of the C library are checked against the size of their buffer; it works in optimised code only
  foreach(flag -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3)
    list(APPEND hf_hardening_compile $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:${flag}>)
  endforeach()
  foreach(flag relro now noexecstack)
    check_linker_flag(CXX "-Wl,-z,${flag}" HF_HAVE_Z_${flag})
    if(HF_HAVE_Z_${flag})
      list(APPEND hf_hardening_link "-Wl,-z,${flag}")
    endif()
  endforeach()
  check_pie_supported(LANGUAGES C CXX)
elseif(HF_HARDEN AND MSVC)
  set(hf_hardening_compile /GS /guard:cf)
  set(hf_hardening_link /guard:cf /DYNAMICBASE /NXCOMPAT)
endif()

# hf_unguard(TARGET SOURCE): no stack guard, for kernels. Their sizes are checked before, and the guard was a sixth of
# the instructions of a kernel on a small supernode.
function(hf_unguard target source)
  if("-fstack-protector-strong" IN_LIST hf_hardening_compile)
    set_property(SOURCE ${source} TARGET_DIRECTORY ${target} APPEND PROPERTY COMPILE_OPTIONS -fno-stack-protector)
  endif()
endfunction()

function(hf_harden target)
  target_compile_options(${target} PRIVATE ${hf_hardening_compile})
  get_target_property(type ${target} TYPE)
  if(type MATCHES "EXECUTABLE|SHARED_LIBRARY|MODULE_LIBRARY")
    target_link_options(${target} PRIVATE ${hf_hardening_link})
  endif()
  if(HF_HARDEN AND type STREQUAL "EXECUTABLE")
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
endfunction()
