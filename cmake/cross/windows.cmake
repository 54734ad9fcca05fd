# Windows x64: Debian's MinGW-w64 with POSIX threads (std::thread), run by Wine.
#   cmake -B build/windows -DCMAKE_TOOLCHAIN_FILE=cmake/cross/windows.cmake
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(hf_triple x86_64-w64-mingw32)
set(hf_suffix -posix)
set(hf_runner wine)
set(CMAKE_RC_COMPILER ${hf_triple}-windres)
# programs run where no MinGW is
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
