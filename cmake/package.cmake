# What is installed, and how other projects find it.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Espalier)
set(ESPALIER_DATA_DIR ${CMAKE_INSTALL_DATADIR}/espalier)
file(RELATIVE_PATH to_libraries ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})

set_target_properties(espalier_library PROPERTIES EXPORT_NAME espalier)
set_target_properties(espalier_core PROPERTIES EXPORT_NAME core)
set(libraries espalier_core espalier_library)
if(ESPALIER_LOOK)
  set_target_properties(espalier_look PROPERTIES EXPORT_NAME look)
  list(APPEND libraries espalier_look)
  # Beside the libraries, in a folder of its own: only the program opens it.
  set_target_properties(espalier_look_commands PROPERTIES INSTALL_RPATH $ORIGIN/..)
  install(TARGETS espalier_look_commands DESTINATION ${CMAKE_INSTALL_LIBDIR}/espalier COMPONENT program)
endif()

foreach(library IN LISTS libraries)
  set_target_properties(${library} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${soversion} INSTALL_RPATH $ORIGIN)
  target_compile_features(${library} INTERFACE cxx_std_20)
  target_include_directories(${library} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${library} INTERFACE $<INSTALL_INTERFACE:glm::glm>)
endforeach()
set_target_properties(espalier_program PROPERTIES INSTALL_RPATH $ORIGIN/${to_libraries})

# Components, so that packages can have a part each.
install(TARGETS espalier_program COMPONENT program)
foreach(library IN LISTS libraries)
  set(part runtime)
  if(library STREQUAL espalier_look)
    set(part look)
  endif()
  install(TARGETS ${library} EXPORT EspalierTargets LIBRARY COMPONENT ${part} NAMELINK_COMPONENT development)
endforeach()
install(EXPORT EspalierTargets NAMESPACE Espalier:: DESTINATION ${package} COMPONENT development)
configure_file(cmake/version.h.in ${CMAKE_CURRENT_BINARY_DIR}/version.h)
install(DIRECTORY include/espalier TYPE INCLUDE COMPONENT development)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier COMPONENT development)
install(DIRECTORY models environments DESTINATION ${ESPALIER_DATA_DIR} COMPONENT data)
# The manual; the studio shows the pictures of its gallery, and pages name the scripts.
install(DIRECTORY docs DESTINATION ${ESPALIER_DATA_DIR} USE_SOURCE_PERMISSIONS COMPONENT doc
  PATTERN developer EXCLUDE PATTERN docs/site EXCLUDE)
install(FILES LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

configure_package_config_file(cmake/EspalierConfig.cmake.in EspalierConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS ESPALIER_DATA_DIR)
write_basic_package_version_file(EspalierConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/EspalierConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/EspalierConfigVersion.cmake
  DESTINATION ${package} COMPONENT development)

file(RELATIVE_PATH ESPALIER_PREFIX_OF_PC ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/espalier.pc.in espalier.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/espalier.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
