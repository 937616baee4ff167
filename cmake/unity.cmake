# A first build from nothing takes two thirds of the time if neighbouring files are compiled at once, and a small change
# then takes longer.
option(ESPALIER_UNITY "compile several files of a station at once" OFF)
function(compile_together target)
  if(ESPALIER_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()
# What these define in unnamed namespaces has the names of their neighbours'. Files of open folders are always alone.
file(GLOB alone src/language/notations/*.cpp src/timeline/recorders/*.cpp src/formats/exporters/*.cpp)
set_source_files_properties(${alone} src/language/side_files/curve_file.cpp src/archive/meshes/limb_level_set.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# A test spends its time in the libraries.
function(compile_quickly target)
  if(ESPALIER_UNITY)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# The command line and the server of the studio only hand work on; at -O3, half of their compilation went into that.
function(compile_lightly target)
  target_compile_options(${target} PRIVATE -O1)
endfunction()
