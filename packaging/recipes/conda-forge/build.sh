#!/usr/bin/env bash
set -euo pipefail

cmake ${CMAKE_ARGS} -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DESPALIER_UNITY=ON -DESPALIER_TESTS=OFF \
    -DESPALIER_PYTHON=ON -DESPALIER_PYTHON_DIR="${SP_DIR}" -DPython_EXECUTABLE="${PYTHON}"
cmake --build build --parallel "${CPU_COUNT}"
cmake --install build
