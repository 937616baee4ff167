# Compiled for this machine and for pages: prints digests of what grows, which `./dev web --check` compares, and the processor
# times of growths, which bench/web.bench.cpp compares.
foreach(program IN ITEMS same_bytes growth_times)
  add_executable(${program} EXCLUDE_FROM_ALL tests/web/${program}.cpp web/src/app/program_data.cpp
    src/app/look/studio_documents.cpp src/app/look/gallery_page.cpp src/app/model_arguments.cpp src/app/model_library.cpp)
  target_include_directories(${program} PRIVATE src)
  target_link_libraries(${program} PRIVATE espalier_options nlohmann_json::nlohmann_json)
endforeach()
