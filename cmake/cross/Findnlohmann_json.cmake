# For cross builds: the headers of nlohmann-json, which are the same on every system; see FindTinyGLTF.cmake.
find_file(nlohmann_json_HEADER nlohmann/json.hpp PATHS ${PROJECT_BINARY_DIR}/debian-headers NO_DEFAULT_PATH
  NO_CMAKE_FIND_ROOT_PATH)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(nlohmann_json REQUIRED_VARS nlohmann_json_HEADER)
if(nlohmann_json_FOUND AND NOT TARGET nlohmann_json::nlohmann_json)
  add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED GLOBAL)
  target_include_directories(nlohmann_json::nlohmann_json SYSTEM INTERFACE ${PROJECT_BINARY_DIR}/debian-headers)
endif()
