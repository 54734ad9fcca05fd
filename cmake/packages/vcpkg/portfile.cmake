# HF_SOURCE_URL in the environment names the archive until one is published; the hash stays. On Windows vcpkg shows the
# variable to ports only when VCPKG_KEEP_ENV_VARS names it. An archive in the folder of downloads needs no address.
if(DEFINED ENV{HF_SOURCE_URL})
  set(url "$ENV{HF_SOURCE_URL}")
elseif(EXISTS "${DOWNLOADS}/hf-${VERSION}-source.tar.gz")
  set(url "hf-${VERSION}-source.tar.gz")
else()  # vcpkg would take the file's name for a host and blame the proxy
  message(FATAL_ERROR "hf-${VERSION}-source.tar.gz is not published: set HF_SOURCE_URL to its address, or put it into ${DOWNLOADS}")
endif()
vcpkg_download_distfile(archive URLS "${url}" FILENAME "hf-${VERSION}-source.tar.gz" SHA512 @SHA512@)
vcpkg_extract_source_archive(source ARCHIVE "${archive}")
vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS -DCMAKE_UNITY_BUILD=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME hf CONFIG_PATH lib/cmake/hf)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")  # projects without CMake get folders from vcpkg, no HF_STATIC
  vcpkg_replace_string("${CURRENT_PACKAGES_DIR}/include/hf/base.h" "#if defined(HF_STATIC)" "#if 1")
endif()
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${source}/LICENSE")
