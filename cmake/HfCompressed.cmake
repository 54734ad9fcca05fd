# Compressed glTF: Draco (Apache-2.0) and meshoptimizer (MIT), each used where it is found. Without one,
# files that need it are refused with a sentence that names its package.
option(HF_GLTF_DRACO "Read Draco compressed glTF where Draco is found" ON)
option(HF_GLTF_MESHOPT "Read meshopt compressed glTF where meshoptimizer is found" ON)

# A shared library of one source that has Draco inside and shows none of it. Draco carries a tinygltf of its own; in one
# program with the tinygltf of hf_gltf, either would call into the other.
function(hf_add_draco_library name source)
  add_library(${name} SHARED ${source})
  hf_target_defaults(${name})
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET default)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE nlohmann_json::nlohmann_json draco::draco_static)
  target_link_options(${name} PRIVATE $<$<PLATFORM_ID:Linux>:-Wl,--exclude-libs,ALL>)
endfunction()

macro(hf_find_compressed)
  find_package(nlohmann_json REQUIRED)
  if(HF_GLTF_DRACO)
    find_package(draco QUIET CONFIG)
  endif()
  if(HF_GLTF_MESHOPT)
    find_package(meshoptimizer QUIET CONFIG)
  endif()
endmacro()

# The encoders, for tests: defines HF_GLTF_DRACO and HF_GLTF_MESHOPT where there are any.
macro(hf_use_encoders target)
  hf_find_compressed()
  if(TARGET draco::draco_static)
    if(NOT TARGET hf_tests_draco)
      hf_add_draco_library(hf_tests_draco ${PROJECT_SOURCE_DIR}/tests/support/draco_encode.cpp)
    endif()
    target_compile_definitions(${target} PRIVATE HF_GLTF_DRACO)
    target_link_libraries(${target} PRIVATE hf_tests_draco)
  endif()
  if(TARGET meshoptimizer::meshoptimizer)
    target_compile_definitions(${target} PRIVATE HF_GLTF_MESHOPT)
    target_link_libraries(${target} PRIVATE meshoptimizer::meshoptimizer)
  endif()
endmacro()
