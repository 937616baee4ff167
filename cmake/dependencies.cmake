# What Espalier stands on.
find_package(TBB CONFIG REQUIRED)  # before OpenVDB, whose own FindTBB leaves half an export set behind
cmake_path(CONVERT "$ENV{CMAKE_PREFIX_PATH}" TO_CMAKE_PATH_LIST prefixes)
find_path(OPENVDB_CMAKE_DIR FindOpenVDB.cmake REQUIRED
  PATHS ${CMAKE_PREFIX_PATH} ${prefixes} ${CMAKE_SYSTEM_PREFIX_PATH} PATH_SUFFIXES share/openvdb
  lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB lib/cmake/OpenVDB lib64/cmake/OpenVDB)
list(APPEND CMAKE_MODULE_PATH ${OPENVDB_CMAKE_DIR})
find_package(OpenVDB REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(EXPAT REQUIRED)
find_package(glm REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_library(LZ4_LIBRARY lz4 REQUIRED)
find_path(EMBREE_INCLUDE_DIR NAMES embree3/rtcore.h embree4/rtcore.h REQUIRED)
find_library(EMBREE_LIBRARY NAMES embree3 embree4 REQUIRED)

if(ESPALIER_LOOK)
  find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMath
    CommonTransforms FiltersCore FiltersGeneral FiltersSources IOXML IOGeometry IOPLY IOImage IOExport
    ChartsCore InteractionStyle InteractionWidgets RenderingAnnotation RenderingCore RenderingContext2D
    RenderingContextOpenGL2 RenderingFreeType RenderingOpenGL2 RenderingUI RenderingVolume RenderingVolumeOpenGL2)
  find_package(Boost 1.74 REQUIRED)  # Beast and Asio are headers
  find_package(LibLZMA REQUIRED)  # frames of pages
  find_package(Qhull REQUIRED)  # convex hulls
  find_path(CMARK_INCLUDE_DIR cmark.h REQUIRED)  # Markdown of lessons; its CMake package wants the program, too
  find_library(CMARK_LIBRARY cmark REQUIRED)
  find_path(VPX_INCLUDE_DIR vpx/vpx_encoder.h REQUIRED)  # films; it has no CMake package
  find_library(VPX_LIBRARY vpx REQUIRED)
  find_package(NLopt REQUIRED)  # searches for parameters
  find_package(OpenGL QUIET COMPONENTS EGL)  # pictures without a display
endif()
