# The growing half and the studio's session for pages: what they stand on there, and which files stand for others.
#
# - A file web/src/X stands for src/X, which is not compiled then; a header web/include/X comes before all others.
# - Headers of libraries that are headers alone are linked into the build's own folder: what else is in /usr/include belongs
#   to the machine that compiles.
set(web ${PROJECT_SOURCE_DIR}/web)
set(web_headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${web_headers})
function(take_headers name header)
  find_path(${name}_HEADERS ${name}/${header} REQUIRED NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include /usr/local/include
    PATH_SUFFIXES ${ARGN})
  file(CREATE_LINK ${${name}_HEADERS}/${name} ${web_headers}/${name} SYMBOLIC)
endfunction()
take_headers(glm glm.hpp)
take_headers(fmt format.h)
take_headers(toml++ toml.h)
take_headers(nlohmann json.hpp)
take_headers(Eigen Core eigen3)

# Under the names that the stations know; what has no counterpart here has a file of its own in web/src.
foreach(library TBB::tbb OpenVDB::openvdb EXPAT::EXPAT PNG::PNG ZLIB::ZLIB fmt::fmt glm::glm tomlplusplus::tomlplusplus
    nlohmann_json::nlohmann_json Eigen3::Eigen Boost::headers)
  add_library(${library} INTERFACE IMPORTED)
endforeach()

set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")  # -O3 makes the module larger and no faster; links have this, too
# Debian's emscripten looks for packages of node where this says.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
# Before all targets: options of the project, because its headers must come first.
include_directories(BEFORE web/src web/include)
include_directories(SYSTEM ${web_headers})
add_compile_definitions(FMT_HEADER_ONLY)
add_compile_options("SHELL:-include ${web}/include/web_gaps.h" -fwasm-exceptions)
add_link_options(-fwasm-exceptions)

# What is done once a model or a message must be small, and not fast. The linker sees all of it at once: a fifth less is
# sent. With -Oz alone, emscripten would leave all that is to be inlined to a pass that knows less.
add_compile_options(-Oz -finline-functions -flto -mnontrapping-fptoint -msign-ext)
add_link_options(-flto)
# Fast, and not small: what is done for every module, leaf or voxel.
set(fast "^base/(math|number|random|sobol)" "^lsystem/" "^turtle/walk/" "^environment/light/(canopy|shade)/"
  "^environment/soil/(grid|linear|richards|solutes)/" "^environment/leaf/(gas|leaves)/"
  "^environment/(exchange|space/(markers|neighbours))/" "^geometry/grids/" "^studio/packets/" "^timeline/frames/"
  "^turtle/symbols/")
list(JOIN fast "|" fast)

# What pages do without: files of OpenVDB, functions for other processors, the server and recorded runs. Of the half that
# looks they have what the studio's session shows.
set(left_out "^geometry/grids/(vdb_file|vdb_tree|vdb_bytes|written_grid)[.]"
  "^base/platform_windows[.]" "_columns_(256|512)[.]" "^studio/(server/|lesson/|growth/(recording|recorded_frame)[.])"
  "^(archive|formats|picture)/")
set(kept "^picture/light/sky_light[.]" "^archive/(recorded_run|joined_pieces|facet_areas|frame_rows|xml)[.]"
  "^formats/(export|glb|growth_nodes|map_place|mesh_files|textures|usd_[a-z]+)[.]"
  "^formats/exporters/(csv|gltf|mtg|obj|ply|rsml|stl|usd)[.]"
  "^archive/meshes/(axis_lines|axis_tree|bark|limbs|mesh_pieces|outline_cost|reduction|surface_mesh|tubes)[.]")
list(JOIN left_out "|" left_out)
list(JOIN kept "|" kept)

# Changes a list of a station's sources.
function(choose_web_sources the_list)
  foreach(source IN LISTS ${the_list})
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src OUTPUT_VARIABLE name)
    if(EXISTS ${web}/src/${name})
      set(source ${web}/src/${name})
    elseif(name MATCHES "${left_out}" AND NOT name MATCHES "${kept}")
      continue()
    endif()
    list(APPEND chosen ${source})
    if(name MATCHES "${fast}")
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -include ${stations})
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
  set(${the_list} ${chosen} PARENT_SCOPE)
endfunction()
