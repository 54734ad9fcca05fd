# Install rules: headers, both libraries, find_package(hf) and pkg-config.
include(CMakePackageConfigHelpers)

install(TARGETS hf hf_static EXPORT hf_targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/hf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT hf_targets NAMESPACE hf:: FILE hfTargets.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hf)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hfConfig.cmake.in ${PROJECT_BINARY_DIR}/hfConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hf)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hfConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hfConfig.cmake ${PROJECT_BINARY_DIR}/hfConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hf)
# the prefix seen from hf.pc, so that an installation may be moved or made with cmake --install --prefix
file(RELATIVE_PATH hf_pc_prefix "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
configure_file(${PROJECT_SOURCE_DIR}/cmake/hf.pc.in ${PROJECT_BINARY_DIR}/hf.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/hf.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
