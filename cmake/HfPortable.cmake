# HF_PORTABLE: beside hf, the same library for any Linux since 2014: portable/libhf.so. It asks for glibc 2.17 and libgcc_s;
# the C++ runtime is inside. It is linked of the same objects, so it gives the same bits. cmake/packages ships it.
#
# Only three names of a newer glibc are left, those of threads. They kept their form when they moved from libpthread to libc
# in glibc 2.34, and libc still answers to the old names. A stand-in for the old libpthread gives the linker these.
set(hf_old_glibc_x86_64 GLIBC_2.2.5)  # the first glibc of the processor names what was there from the start
set(hf_old_glibc_aarch64 GLIBC_2.17)

function(hf_add_portable)
  if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT DEFINED hf_old_glibc_${CMAKE_SYSTEM_PROCESSOR})
    message(FATAL_ERROR "HF_PORTABLE knows the old glibc of Linux on x86_64 and aarch64 alone")
  endif()
  set(version ${hf_old_glibc_${CMAKE_SYSTEM_PROCESSOR}})
  set(folder ${PROJECT_BINARY_DIR}/portable)
  file(WRITE ${folder}/threads.map.in "${version} { global: pthread_create; pthread_join; };\n")
  file(WRITE ${folder}/threads.c.in "int pthread_create(void) { return 0; }\nint pthread_join(void) { return 0; }\n")
  # libstdc++ asks glibc 2.32 and later whether one thread runs alone. An older one cannot say; "no" is always right.
  file(WRITE ${folder}/single.c.in "__attribute__((visibility(\"hidden\"))) char __libc_single_threaded = 0;\n")
  foreach(name threads.map threads.c single.c)
    configure_file(${folder}/${name}.in ${folder}/${name} COPYONLY)
  endforeach()

  add_library(hf_old_threads SHARED ${folder}/threads.c)
  set_target_properties(hf_old_threads PROPERTIES OUTPUT_NAME pthread SOVERSION 0 LIBRARY_OUTPUT_DIRECTORY ${folder}/stand_in)
  target_compile_options(hf_old_threads PRIVATE -fno-builtin -w)
  target_link_options(hf_old_threads PRIVATE -nostdlib -Wl,--version-script=${folder}/threads.map)

  add_library(hf_portable SHARED ${hf_parts} ${folder}/single.c)
  hf_target_defaults(hf_portable)
  set_target_properties(hf_portable PROPERTIES OUTPUT_NAME hf VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
    LIBRARY_OUTPUT_DIRECTORY ${folder})
  add_dependencies(hf_portable hf_old_threads)
  # not as a linked target: nothing may look for the stand-in when the library is loaded
  target_link_options(hf_portable PRIVATE -static-libstdc++ -Wl,--exclude-libs,ALL -Wl,--gc-sections -Wl,--no-undefined
    -Wl,--version-script=${PROJECT_SOURCE_DIR}/src/capi/exports.map -Wl,--push-state,--no-as-needed $<TARGET_FILE:hf_old_threads>
    -Wl,--pop-state)
endfunction()
