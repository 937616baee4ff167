# The Python package: the extensions _espalier, and _recorded, which reads runs, beside links to the files of
# python/espalier, ready to import from <build>/python.
option(ESPALIER_PYTHON "the Python module espalier (needs pybind11 and numpy)" OFF)
if(NOT ESPALIER_PYTHON)
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)  # the one that Debian's numpy and pybind11 belong to
endif()
find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 CONFIG REQUIRED)
set(ESPALIER_PYTHON_HEADERS "" CACHE PATH "headers of another Python than this one, and its pybind11: packaging/newer-python")

# Where the package is installed: for the prefix /usr the folder of the system's packages, as Debian has one.
set(ESPALIER_PYTHON_DIR "" CACHE STRING "folder of Python's modules, absolute or below the prefix; empty: Python's own")
set(site_packages ${ESPALIER_PYTHON_DIR})
if(NOT site_packages)
  string(CONCAT ask "import sys, sysconfig as s\n"
    "system = sys.argv[1] == '/usr' and 'deb_system' in s.get_scheme_names()\n"
    "names = dict.fromkeys(('base', 'platbase', 'installed_base'), '')\n"
    "print(s.get_path('platlib', 'deb_system' if system else s.get_default_scheme(), names).replace('/local/', '/')[1:])")
  execute_process(COMMAND ${Python_EXECUTABLE} -c ${ask} ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE site_packages
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()
get_filename_component(package_folder ${site_packages}/espalier ABSOLUTE BASE_DIR ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH package_to_libraries ${package_folder} ${CMAKE_INSTALL_FULL_LIBDIR})

# A module asks for no library of Python: the headers decide for which one it is.
function(compile_for_other_python target)
  file(GLOB other LIST_DIRECTORIES ON RELATIVE ${ESPALIER_PYTHON_HEADERS}/usr/include ${ESPALIER_PYTHON_HEADERS}/usr/include/python3.*)
  string(REPLACE "python3." "cpython-3" tag ${other})
  target_include_directories(${target} BEFORE PRIVATE ${ESPALIER_PYTHON_HEADERS}/usr/include ${ESPALIER_PYTHON_HEADERS}/usr/include/${other})
  set_target_properties(${target} PROPERTIES SUFFIX .${tag}-${CMAKE_LIBRARY_ARCHITECTURE}.so)
endfunction()

# Parts register themselves in tables that the libraries and the extensions share: they must be visible.
function(add_extension name folder)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  pybind11_add_module(espalier_python${name} NO_EXTRAS ${sources})
  set_target_properties(espalier_python${name} PROPERTIES OUTPUT_NAME ${name} CXX_VISIBILITY_PRESET default
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/espalier INSTALL_RPATH $ORIGIN/${package_to_libraries})
  target_compile_options(espalier_python${name} PRIVATE -Wno-attributes)
  if(ESPALIER_PYTHON_HEADERS)
    compile_for_other_python(espalier_python${name})
  endif()
  compile_lightly(espalier_python${name})
  target_include_directories(espalier_python${name} PRIVATE src)
  target_link_libraries(espalier_python${name} PRIVATE espalier_options OpenVDB::openvdb ${ARGN})
  install(TARGETS espalier_python${name} DESTINATION ${site_packages}/espalier COMPONENT python)
endfunction()

add_extension(_espalier src/python espalier_library)
add_custom_target(espalier_python DEPENDS espalier_python_espalier)
if(ESPALIER_LOOK)
  add_extension(_recorded src/python/recorded espalier_look espalier_library)
  add_dependencies(espalier_python espalier_python_recorded)
endif()

file(GLOB package_files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/python/espalier python/espalier/*.py
  python/espalier/*.pyi python/espalier/py.typed)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/python/espalier)
foreach(name IN LISTS package_files)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/espalier/${name} ${PROJECT_BINARY_DIR}/python/espalier/${name} SYMBOLIC)
endforeach()
install(DIRECTORY python/espalier DESTINATION ${site_packages} COMPONENT python
  FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
