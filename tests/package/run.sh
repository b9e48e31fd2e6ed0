#!/usr/bin/env bash
# Installs a build into a temporary prefix, then builds and runs the README's program outside the tree: run.sh BUILD_FOLDER COMPILER.
# SPDX-License-Identifier: MIT
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 compiler=$2
outside=$(mktemp -d)
trap 'rm -rf "$outside"' EXIT

cmake --install "$build" --prefix "$outside/prefix" --component development
cp "$here/CMakeLists.txt" "$outside"
sed -n '/^```cpp$/,/^```$/p' "$here/../../README.md" | sed '/^```/d' >"$outside/main.cpp"

# Two frames of two triangles for it to read.
cd "$outside"
for frame in 0 1; do
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 %s\nf 1 2 3\nf 2 4 3\n' $frame >walk.000$frame.obj
done

echo "by find_package"
cmake -G Ninja -S . -B build -DCMAKE_PREFIX_PATH="$outside/prefix" -DCMAKE_CXX_COMPILER="$compiler"
cmake --build build
build/outside
test -s walk.reel && rm walk.reel

echo "by pkg-config, from a prefix that was moved"
mv prefix moved
pc=$(find "$outside/moved" -name meshreel.pc -printf '%h')
# shellcheck disable=SC2046
"$compiler" main.cpp -o by_pkg_config $(PKG_CONFIG_PATH=$pc pkg-config --static --cflags --libs meshreel)
./by_pkg_config
test -s walk.reel
