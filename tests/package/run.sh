#!/usr/bin/env bash
# Installs a build into a temporary prefix, then builds and runs a project outside the tree: run.sh BUILD_FOLDER COMPILER.
# SPDX-License-Identifier: MIT
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 compiler=$2
outside=$(mktemp -d)
trap 'rm -rf "$outside"' EXIT

cmake --install "$build" --prefix "$outside/prefix" --component development
cp "$here/CMakeLists.txt" "$here/main.cpp" "$outside"

echo "by find_package"
cmake -S "$outside" -B "$outside/build" -DCMAKE_PREFIX_PATH="$outside/prefix" -DCMAKE_CXX_COMPILER="$compiler"
cmake --build "$outside/build"
"$outside/build/outside"

echo "by pkg-config, from a prefix that was moved"
mv "$outside/prefix" "$outside/moved"
pc=$(find "$outside/moved" -name meshreel.pc -printf '%h')
# shellcheck disable=SC2046
"$compiler" "$outside/main.cpp" -o "$outside/by_pkg_config" \
    $(PKG_CONFIG_PATH=$pc pkg-config --static --cflags --libs meshreel)
"$outside/by_pkg_config"
