# Packages of Debian, a component each: ./dev packages. What a package needs is found by dpkg-shlibdeps.
option(ESPALIER_DEBIAN "what Debian's packages have besides: copyright, changelogs, notes for lintian" OFF)
if(NOT ESPALIER_DEBIAN)
  return()
endif()
if(NOT CMAKE_INSTALL_PREFIX STREQUAL /usr OR NOT ESPALIER_LOOK OR NOT ESPALIER_PYTHON)
  message(FATAL_ERROR "-DESPALIER_DEBIAN=ON needs -DCMAKE_INSTALL_PREFIX=/usr -DESPALIER_PYTHON=ON and -DESPALIER_LOOK=ON")
endif()

set(CPACK_COMPONENTS_ALL program runtime look development python data doc)
set(program_PACKAGE espalier)
set(runtime_PACKAGE libespalier${soversion})  # Debian names libraries after their SONAME
set(look_PACKAGE libespalier-look${soversion})
set(development_PACKAGE libespalier-dev)
set(python_PACKAGE python3-espalier)
set(data_PACKAGE espalier-data)
set(doc_PACKAGE espalier-doc)

# The maintainer is who builds, as for all tools of Debian.
set(maintainer "The Espalier developers <espalier@packages.invalid>")
if(DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBEMAIL}")
  if(DEFINED ENV{DEBFULLNAME})
    set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  endif()
endif()
set(release 1)
string(TIMESTAMP DEBIAN_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, if that is set
set(DEBIAN_MAINTAINER ${maintainer})
set(DEBIAN_VERSION ${PROJECT_VERSION}-${release})
set(debian ${PROJECT_BINARY_DIR}/debian)
configure_file(packaging/debian/changelog.in ${debian}/changelog.Debian @ONLY)
configure_file(packaging/debian/copyright.in ${debian}/copyright.head @ONLY)
execute_process(COMMAND sed -e "s/^$/./" -e "s/^/ /" ${PROJECT_SOURCE_DIR}/studio/dist/LICENSES.txt
  OUTPUT_FILE ${debian}/copyright.page COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND cat ${debian}/copyright.head ${debian}/copyright.page OUTPUT_FILE ${debian}/copyright
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip -9nc ${debian}/changelog.Debian OUTPUT_FILE ${debian}/changelog.Debian.gz)
execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE ${debian}/changelog.gz)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(package ${${component}_PACKAGE})
  install(FILES ${debian}/copyright ${debian}/changelog.Debian.gz ${debian}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  set(overrides ${PROJECT_SOURCE_DIR}/packaging/debian/${component}.lintian-overrides)
  if(EXISTS ${overrides})
    configure_file(${overrides} ${debian}/${package} @ONLY)
    install(FILES ${debian}/${package} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${component})
  endif()
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS OFF)
endforeach()
# Debian's man pages are compressed, and its manual is found below /usr/share/doc.
install(CODE "file(GLOB pages \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/espalier*.1)
  if(pages)
    execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()" COMPONENT program)
install(CODE "file(CREATE_LINK ../../espalier/docs \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/doc/espalier-doc/manual SYMBOLIC)" COMPONENT doc)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE ${release})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${maintainer})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
foreach(component IN ITEMS PROGRAM RUNTIME LOOK PYTHON)
  set(CPACK_DEBIAN_${component}_PACKAGE_SHLIBDEPS ON)
endforeach()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LOOK_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)

# --- what each needs, and says of itself -----------------------------------------------------------------------------
set(CPACK_COMPONENT_PROGRAM_DEPENDS runtime look data)
set(CPACK_COMPONENT_LOOK_DEPENDS runtime)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime look)
set(CPACK_COMPONENT_PYTHON_DEPENDS runtime look)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS espalier-doc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, paraview, python3-espalier")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS libglm-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "espalier-doc, libopenvdb-dev")
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "espalier, python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-openvdb, python3-tqdm, python3-vtk9, python3-xarray")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)
set(CPACK_DEBIAN_LOOK_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)
set(CPACK_DEBIAN_DOC_PACKAGE_DEPENDS python3:any)  # scripts of the manual
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/packaging/debian/python/postinst;${PROJECT_SOURCE_DIR}/packaging/debian/python/prerm")

# Lines of at most 80 characters, as Debian wants them.
set(what "Espalier simulates the growth of plants with L-systems. As the plants
grow, they exchange information with a simulated environment: they ask for
the light, the water or the free space where they are, and their next step
depends on the answers.")
# describe(COMPONENT SUMMARY TEXT)
function(describe component summary text)
  set(CPACK_COMPONENT_${component}_DESCRIPTION "${summary}\n${what}\n\n${text}" PARENT_SCOPE)
endfunction()
describe(PROGRAM "simulator of plants that grow and interact with their environment"
  "This package has the program, which grows, draws, measures and exports
plants, and a studio in the browser.")
describe(RUNTIME "simulator of plants - growing library" "This package has the libraries that grow plants.")
describe(LOOK "simulator of plants - library that reads and draws runs"
  "This package has the library that reads, measures, draws and exports
recorded runs.")
describe(DEVELOPMENT "simulator of plants - development files"
  "This package has headers, and files for CMake and pkg-config.")
describe(PYTHON "simulator of plants - module of Python" "This package has the module espalier.")
describe(DATA "simulator of plants - models and environments"
  "This package has the library of models, scenes and their data.")
describe(DOC "simulator of plants - manual" "This package has the manual and its pictures.")
include(CPack)
