# What the toolchain files of this folder share: Debian's GCC for another system, and a program that runs what it makes.
# A file sets hf_triple (the compiler's prefix) and hf_runner before it includes this one.
set(CMAKE_C_COMPILER ${hf_triple}-gcc${hf_suffix})
set(CMAKE_CXX_COMPILER ${hf_triple}-g++${hf_suffix})
set(CMAKE_CROSSCOMPILING_EMULATOR ${hf_runner})
set(CMAKE_FIND_ROOT_PATH /usr/${hf_triple})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Headers that are the same on every system are Debian's own.
set(EIGEN3_INCLUDE_DIR /usr/include/eigen3 CACHE PATH "Folder that holds Eigen/Core")
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
