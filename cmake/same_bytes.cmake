# Prints digests of what grows; compiled for this machine and for pages, which `./dev web --check` compares.
add_executable(same_bytes EXCLUDE_FROM_ALL tests/web/same_bytes.cpp web/src/app/program_data.cpp
  src/app/look/studio_documents.cpp src/app/look/gallery_page.cpp src/app/model_arguments.cpp src/app/model_library.cpp)
target_include_directories(same_bytes PRIVATE src)
target_link_libraries(same_bytes PRIVATE espalier_options nlohmann_json::nlohmann_json)
