# Linux on IBM Z, which is big-endian: Debian's cross compiler, run by qemu-user.
#   cmake -B build/s390x -DCMAKE_TOOLCHAIN_FILE=cmake/cross/s390x.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR s390x)
set(hf_triple s390x-linux-gnu)
set(hf_runner qemu-s390x -L /usr/s390x-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
