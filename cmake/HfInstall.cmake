# Install rules: headers, the library or both (BUILD_SHARED_LIBS), licences, find_package(hf) and pkg-config.
include(CMakePackageConfigHelpers)

install(TARGETS ${hf_installed} EXPORT hf_targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
set(hf_left_header)
if(NOT HF_WITH_PEERS)
  set(hf_left_header PATTERN peers.h EXCLUDE)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/hf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${hf_left_header})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/cmake/licences.txt DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(EXPORT hf_targets NAMESPACE hf:: FILE hfTargets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hf)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hfConfig.cmake.in ${PROJECT_BINARY_DIR}/hfConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hf)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hfConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hfConfig.cmake ${PROJECT_BINARY_DIR}/hfConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hf)
# the prefix seen from hf.pc, so that an installation may be moved or made with cmake --install --prefix
file(RELATIVE_PATH hf_pc_prefix "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
# what a program that links the archive adds: behind `pkg-config --static`
set(hf_pc_libraries ${hf_cxx_runtime} ${CMAKE_THREAD_LIBS_INIT})
if(HF_WITH_GPL)
  list(PREPEND hf_pc_libraries cholmod)
endif()
list(TRANSFORM hf_pc_libraries PREPEND -l REGEX "^[^-/]")
list(JOIN hf_pc_libraries " " hf_pc_libraries)
set(hf_pc_public)
set(hf_pc_definitions)
if(hf_preferred STREQUAL "hf_static")  # there is nothing but the archive
  set(hf_pc_public " ${hf_pc_libraries}")
  set(hf_pc_definitions " -DHF_STATIC")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/hf.pc.in ${PROJECT_BINARY_DIR}/hf.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/hf.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
# pkg-config's --static adds libraries and lets the linker take libhf.so all the same; this one names the archive
if("hf_static" IN_LIST hf_installed)
  set(hf_archive ${CMAKE_STATIC_LIBRARY_PREFIX}hf${CMAKE_STATIC_LIBRARY_SUFFIX})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/hf_static.pc.in ${PROJECT_BINARY_DIR}/hf_static.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/hf_static.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
