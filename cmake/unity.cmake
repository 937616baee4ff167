# A first build from nothing takes far less time if neighbouring files are compiled at once, and a small change then takes
# longer. Nothing is said of shadows then: a local name may be that of something unnamed of a neighbour.
option(ESPALIER_UNITY "compile several files at once: those of a folder, and of small folders together" OFF)
set(files_at_once 10)  # more need more memory than `./dev` counts on, and leave cores idle at the end
# GCC first looks for memory that it no longer needs when it has used half a gigabyte: a tenth of its time is saved so.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
# `compile_together(target N)`: N files at once.
function(compile_together target)
  if(ARGC GREATER 1)
    set(files_at_once ${ARGV1})
  endif()
  if(NOT ESPALIER_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    file(STRINGS ${source} found REGEX "^#include .*openvdb" LIMIT_COUNT 1)
    if(found AND folder MATCHES "^src")
      set(folder openvdb)  # four seconds of headers, which are read once for all of a target that need them
    endif()
    list(APPEND folders ${folder})
    list(APPEND of_${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    list(LENGTH of_${folder} files)
    if(files LESS 6)
      list(APPEND of_small ${of_${folder}})
    else()
      compile_at_once(${folder} ${of_${folder}})
    endif()
  endforeach()
  compile_at_once(small ${of_small})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# In as few parts of one size as there must be.
function(compile_at_once group)
  list(LENGTH ARGN files)
  if(files LESS 2)
    return()
  endif()
  math(EXPR parts "(${files} + ${files_at_once} - 1) / ${files_at_once}")
  set(i 0)
  foreach(source IN LISTS ARGN)
    math(EXPR part "${i} * ${parts} / ${files}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
    math(EXPR i "${i} + 1")
  endforeach()
endfunction()

# What these define in unnamed namespaces has the names of their neighbours'. Files of open folders are always alone.
file(GLOB alone src/environment/given/*.cpp src/environment/leaf/*.cpp src/environment/light/*.cpp
  src/environment/soil/*.cpp src/environment/space/*.cpp src/turtle/stages/*.cpp src/language/notations/*.cpp
  src/timeline/recorders/*.cpp src/formats/exporters/*.cpp)
set_source_files_properties(${alone} src/language/side_files/curve_file.cpp src/archive/meshes/limb_level_set.cpp
  src/turtle/walk/string_walk.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# Headers of others that most files include are read once. A compiler cache is worth more than that, and keeps nothing that
# was compiled with precompiled headers.
if(ESPALIER_UNITY AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompile ON)
endif()
set(headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numbers> <optional> <set> <span>
  <sstream> <string> <string_view> <utility> <vector> <fmt/format.h> <fmt/ranges.h> <glm/common.hpp> <glm/geometric.hpp>
  <glm/trigonometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <tbb/parallel_for.h> <tbb/parallel_reduce.h>)

# For a target whose definitions are those of `first`, or more, and whose options are the same. `first` holds the headers, and
# what else is given with it. The namespaces must come before all else that a file includes.
function(precompile_headers target first)
  if(NOT precompile)
    return()
  endif()
  set_target_properties(${target} PROPERTIES HAS_STATIONS ON)
  if(target STREQUAL first)
    target_precompile_headers(${target} PRIVATE ${stations} ${headers} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${first})
  endif()
endfunction()

# Options of single files, which precompiled headers do not have.
function(compile_with options)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options};-include;${stations}"
    SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# GCC 14 takes no precompiled header of other options for the processor, two of which -O3 sets and -O1 does not.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-munroll-only-small-loops has_small_loops)
set(light_options -O1 $<$<BOOL:${has_small_loops}>:-munroll-only-small-loops;-mvzeroupper>)

# A test spends its time in the libraries.
function(compile_quickly target)
  if(ESPALIER_UNITY)
    target_compile_options(${target} PRIVATE ${light_options})
  endif()
endfunction()

# The command line and the server of the studio only hand work on, and models are read once a run; at -O3, half of the
# compilation of these went into that.
function(compile_lightly target)
  target_compile_options(${target} PRIVATE ${light_options})
endfunction()
