# macOS on Apple's and Intel's processors: Zig's clang with the headers of the system inside (Python's package ziglang).
# What it makes is checked, never run: there is no macOS here.
#   cmake -B build/macos-arm64 -DCMAKE_TOOLCHAIN_FILE=cmake/cross/macos.cmake -DHF_ZIG=FOLDER/zig -DHF_MACOS_PROCESSOR=arm64
set(HF_ZIG zig CACHE FILEPATH "The program zig")
set(HF_MACOS_PROCESSOR arm64 CACHE STRING "arm64 or x86_64")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES HF_ZIG HF_MACOS_PROCESSOR)
set(CMAKE_SYSTEM_NAME Darwin)
set(CMAKE_SYSTEM_PROCESSOR ${HF_MACOS_PROCESSOR})
# the oldest macOS the library asks for: 11, the first one on Apple's processors
set(hf_macos_target ${HF_MACOS_PROCESSOR}-macos.11.0)
string(REPLACE arm64 aarch64 hf_macos_target ${hf_macos_target})
set(CMAKE_C_COMPILER ${HF_ZIG} cc -target ${hf_macos_target})
set(CMAKE_CXX_COMPILER ${HF_ZIG} c++ -target ${hf_macos_target})
set(CMAKE_FIND_ROOT_PATH ${CMAKE_CURRENT_LIST_DIR})
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Headers that are the same on every system are Debian's own.
set(EIGEN3_INCLUDE_DIR /usr/include/eigen3 CACHE PATH "Folder that holds Eigen/Core")
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
