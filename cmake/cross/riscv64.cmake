# Linux on RISC-V: Debian's cross compiler, run by qemu-user.
#   cmake -B build/riscv64 -DCMAKE_TOOLCHAIN_FILE=cmake/cross/riscv64.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(hf_triple riscv64-linux-gnu)
set(hf_runner qemu-riscv64 -L /usr/riscv64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
