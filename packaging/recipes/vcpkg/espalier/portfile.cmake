vcpkg_check_linkage(ONLY_DYNAMIC_LIBRARY)  # parts register themselves when their library is loaded

vcpkg_download_distfile(ARCHIVE
    URLS "@URL@/espalier-${VERSION}.tar.gz"
    FILENAME "espalier-${VERSION}.tar.gz"
    SHA512 @SHA512@
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${ARCHIVE}")

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS FEATURES look ESPALIER_LOOK)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS ${FEATURE_OPTIONS} -DESPALIER_TESTS=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME Espalier CONFIG_PATH lib/cmake/Espalier)
vcpkg_fixup_pkgconfig()
vcpkg_copy_tools(TOOL_NAMES espalier AUTO_CLEAN)

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/studio/dist/LICENSES.txt")
