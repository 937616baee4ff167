# What every file of the sanitizer and fuzzer builds is compiled and linked with.
set(ESPALIER_SANITIZE "" CACHE STRING "sanitizers, such as address,undefined or thread")
if(ESPALIER_SANITIZE)
  target_compile_options(espalier_options INTERFACE -fsanitize=${ESPALIER_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(espalier_options INTERFACE -fsanitize=${ESPALIER_SANITIZE})
endif()

option(ESPALIER_FUZZ "libFuzzer programs (needs clang)" OFF)
if(ESPALIER_FUZZ)
  target_compile_options(espalier_options INTERFACE
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_definitions(espalier_options INTERFACE FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
  target_link_options(espalier_options INTERFACE -fsanitize=address,undefined)
  target_compile_options(OpenVDB::openvdb INTERFACE -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitizers.ignore)
  # The fuzzer has nothing to learn from how far an unknown word is from each known one; counting that took half of its time.
  compile_with(-fno-sanitize=fuzzer-no-link src/base/text.cpp)
endif()
