# The Python package: the extension _espalier beside links to the files of python/espalier, ready to import from
# <build>/python.
option(ESPALIER_PYTHON "the Python module espalier (needs pybind11 and numpy)" OFF)
if(NOT ESPALIER_PYTHON)
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)  # the one that Debian's numpy and pybind11 belong to
endif()
find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 CONFIG REQUIRED)

file(GLOB python_sources CONFIGURE_DEPENDS src/python/*.cpp)
pybind11_add_module(espalier_python NO_EXTRAS ${python_sources})
# Parts register themselves in tables that the libraries and the extension share: they must be visible.
set_target_properties(espalier_python PROPERTIES OUTPUT_NAME _espalier CXX_VISIBILITY_PRESET default
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/espalier)
target_compile_options(espalier_python PRIVATE -Wno-attributes)
compile_lightly(espalier_python)
target_include_directories(espalier_python PRIVATE src)
target_link_libraries(espalier_python PRIVATE espalier_options OpenVDB::openvdb espalier_library)

file(GLOB package_files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/python/espalier python/espalier/*.py
  python/espalier/*.pyi python/espalier/py.typed)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/python/espalier)
foreach(name IN LISTS package_files)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/espalier/${name} ${PROJECT_BINARY_DIR}/python/espalier/${name} SYMBOLIC)
endforeach()
