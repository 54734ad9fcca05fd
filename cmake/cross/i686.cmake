# Linux on 32-bit x86: Debian's cross compiler. The programs run on this processor itself where its kernel takes 32-bit
# programs, else by qemu-user. (qemu-user 7.2 hangs in pthread_create of glibc 2.36.)
#   cmake -B build/i686 -DCMAKE_TOOLCHAIN_FILE=cmake/cross/i686.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(hf_triple i686-linux-gnu)
set(hf_runner /usr/i686-linux-gnu/lib/ld-linux.so.2 --library-path /usr/i686-linux-gnu/lib)
execute_process(COMMAND ${hf_runner} --version RESULT_VARIABLE hf_code OUTPUT_QUIET ERROR_QUIET)
if(NOT hf_code EQUAL 0)
  set(hf_runner qemu-i386 -L /usr/i686-linux-gnu)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
