# What pages load, and the program that compares it with the native one.
set_source_files_properties(src/geometry/grid_operations.cpp PROPERTIES COMPILE_DEFINITIONS ESPALIER_GRID_LIBRARY="")
target_sources(espalier_base PRIVATE web/module/toml_library.cpp web/module/no_programs.cpp)
set(grows ${GROW_STATIONS} ${GRID_STATIONS})

include(cmake/same_bytes.cmake)
foreach(program IN ITEMS same_bytes growth_times)
  target_link_libraries(${program} PRIVATE ${grows})
  set_target_properties(${program} PROPERTIES SUFFIX .js)
  target_link_options(${program} PRIVATE -sNODERAWFS=1 -sENVIRONMENT=node -sEXIT_RUNTIME=1 -sALLOW_MEMORY_GROWTH=1
    -sMAXIMUM_MEMORY=4GB -sTOTAL_STACK=8MB)
endforeach()

# The session of the studio, as a worker's module.
add_executable(espalier_web web/module/session.cpp web/src/app/program_data.cpp src/app/look/studio_documents.cpp
  src/app/look/gallery_page.cpp src/app/model_arguments.cpp src/app/model_library.cpp)
set_target_properties(espalier_web PROPERTIES OUTPUT_NAME espalier SUFFIX .js)
target_include_directories(espalier_web PRIVATE src)
target_link_libraries(espalier_web PRIVATE espalier_options ${grows} ${LOOK_STATIONS} espalier_studio
  nlohmann_json::nlohmann_json)
set(module_options --no-entry -sMODULARIZE=1 -sEXPORT_NAME=createEspalier -sDYNAMIC_EXECUTION=0 -sALLOW_MEMORY_GROWTH=1
  -sMAXIMUM_MEMORY=4GB -sTOTAL_STACK=8MB -sFORCE_FILESYSTEM=1 -sEXPORTED_RUNTIME_METHODS=FS,ccall,UTF8ToString,HEAPU8)
target_link_options(espalier_web PRIVATE ${module_options} -sENVIRONMENT=worker,node)

# Models and worlds for programs in JavaScript. Its loader gets the bytes of the module, so that one file works in pages,
# workers and node.
add_executable(espalier_npm EXCLUDE_FROM_ALL web/module/library.cpp web/src/app/program_data.cpp
  src/app/look/studio_documents.cpp src/app/look/gallery_page.cpp src/app/model_arguments.cpp src/app/model_library.cpp)
set_target_properties(espalier_npm PROPERTIES OUTPUT_NAME core SUFFIX .mjs)
target_include_directories(espalier_npm PRIVATE src)
target_link_libraries(espalier_npm PRIVATE espalier_options ${grows} ${LOOK_STATIONS} nlohmann_json::nlohmann_json)
target_link_options(espalier_npm PRIVATE ${module_options} -sENVIRONMENT=web,worker -sEXPORT_ES6=1 -sUSE_ES6_IMPORT_META=0)
