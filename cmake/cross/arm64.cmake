# Linux on 64-bit ARM: Debian's cross compiler, run by qemu-user.
#   cmake -B build/arm64 -DCMAKE_TOOLCHAIN_FILE=cmake/cross/arm64.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(hf_triple aarch64-linux-gnu)
set(hf_runner qemu-aarch64 -L /usr/aarch64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
