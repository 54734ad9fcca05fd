# Linux on 32-bit x86: Debian's cross compiler, run by qemu-user.
#   cmake -B build/i686 -DCMAKE_TOOLCHAIN_FILE=cmake/cross/i686.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(hf_triple i686-linux-gnu)
set(hf_runner qemu-i386 -L /usr/i686-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
