# Linux on 32-bit ARM: Debian's cross compiler, run by qemu-user.
#   cmake -B build/armhf -DCMAKE_TOOLCHAIN_FILE=cmake/cross/armhf.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(hf_triple arm-linux-gnueabihf)
set(hf_runner qemu-arm -L /usr/arm-linux-gnueabihf)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
