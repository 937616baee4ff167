# A station's sources as OBJECT libraries, because parts register themselves: a static archive would drop them without a
# word. The folders named by <station>_GRIDS need OpenVDB and Eigen, and become a library of their own.
set(geometry_GRIDS grids rays)
set(environment_GRIDS given leaf light soil space)

# Eigen adds in the order of the source: vectors of another processor would add in another, and fuse.
set_source_files_properties(src/environment/soil/linear/steady.cpp src/analysis/least_squares.cpp
  src/study/fit/abc.cpp PROPERTIES
  COMPILE_DEFINITIONS EIGEN_DONT_VECTORIZE)

# Loops over square roots and quotients become vectors only if nobody reads errno or the exception flags; values stay.
compile_with("-fno-math-errno;-fno-trapping-math"
  src/environment/light/shade/ball_shadows.cpp src/environment/light/shade/balls_along.cpp)

# Functions of columns, and leaves side by side, for each width of vectors (src/base/math_lanes.h,
# src/environment/leaf/gas/lanes.h): compiled alone, each for its processors.
foreach(name src/base/math_columns src/environment/leaf/gas/leaf_columns)
  set_source_files_properties(${name}_256.cpp ${name}_512.cpp
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$" AND NOT WIN32)  # GCC for Windows does not align its stack
    set_source_files_properties(${name}_256.cpp PROPERTIES COMPILE_OPTIONS -mavx2)
    set_source_files_properties(${name}_512.cpp PROPERTIES COMPILE_OPTIONS -mavx512f)
    set_source_files_properties(${name}.cpp PROPERTIES COMPILE_DEFINITIONS ESPALIER_WIDE_MATH)
  endif()
endforeach()

function(add_objects name)
  add_library(${name} OBJECT ${ARGN})
  target_include_directories(${name} PRIVATE src)
  target_link_libraries(${name} PUBLIC espalier_options)
  precompile_headers(${name} espalier_headers)
endfunction()
if(precompile)
  file(CONFIGURE OUTPUT headers.cpp CONTENT "")
  add_objects(espalier_headers ${PROJECT_BINARY_DIR}/headers.cpp)
endif()

# Lists it in GROW_STATIONS or LOOK_STATIONS, and what needs OpenVDB in GRID_STATIONS.
function(add_station station)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/${station}/*.cpp)
  foreach(room IN LISTS ${station}_GRIDS)
    file(GLOB_RECURSE of_room CONFIGURE_DEPENDS src/${station}/${room}/*.cpp)
    list(REMOVE_ITEM sources ${of_room})
    list(APPEND of_grids ${of_room})
  endforeach()
  if(EMSCRIPTEN)
    choose_web_sources(sources)
    choose_web_sources(of_grids)
  endif()
  add_objects(espalier_${station} ${sources})
  target_link_libraries(espalier_${station} PUBLIC ${${station}_NEEDS})
  if(station IN_LIST GROW)
    list(APPEND GROW_STATIONS espalier_${station})
  elseif(station IN_LIST LOOK)
    list(APPEND LOOK_STATIONS espalier_${station})
  endif()
  compile_together(espalier_${station})
  if(of_grids)
    add_objects(espalier_${station}_grids ${of_grids})
    target_link_libraries(espalier_${station}_grids PUBLIC OpenVDB::openvdb Eigen3::Eigen ${${station}_GRIDS_NEED})
    compile_together(espalier_${station}_grids)
    list(APPEND GRID_STATIONS espalier_${station}_grids)
  endif()
  return(PROPAGATE GROW_STATIONS LOOK_STATIONS GRID_STATIONS)
endfunction()
