#!/usr/bin/env bash
# Installs from Debian what is missing and asks nothing: for ./demo; --check: for ./check too; --with-blender: Blender for its tests;
# --with-foreign: other machines for make foreign; --with-meshlab: MeshLab and a screen for it, for its tests and bench; --with-figures: what make figures draws with;
# --with-wasm: Emscripten, Chromium and what js/ is tested with; --with-peers: what the lab compares meshreel with, from Debian and npm.
# SPDX-License-Identifier: MIT
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

packages=(
    g++ cmake ninja-build pkg-config python3
    libeigen3-dev libcli11-dev libfmt-dev nlohmann-json3-dev libcpp-httplib-dev libxxhash-dev libzstd-dev libpng-dev
)
check_packages=(
    git libgtest-dev libgmock-dev ccache clang clang-format libclang-rt-14-dev universal-ctags python3-numpy
)
peer_packages=(draco libdraco-dev libzfp1 libfpzip1 libzstd1 zstd xz-utils python3-numpy)
gltf_validator=2.0.0-dev.3.10

want_check=no want_peers=no want_wasm=no
for option in "$@"; do
    case $option in
        --check) want_check=yes; packages+=("${check_packages[@]}") ;;
        --with-blender) packages+=(blender python3-numpy) ;;
        --with-meshlab) packages+=(meshlab xvfb xauth libgl1-mesa-dri) ;;
        --with-foreign) packages+=(g++-aarch64-linux-gnu g++-s390x-linux-gnu qemu-user) ;;
        --with-figures) packages+=(python3-matplotlib) ;;
        --with-wasm) want_wasm=yes; packages+=(emscripten chromium) ;;
        --with-peers) want_peers=yes; packages+=("${peer_packages[@]}") ;;
        *) echo "usage: tools/install.sh [--check] [--with-blender] [--with-meshlab] [--with-figures] [--with-foreign] [--with-wasm] [--with-peers]" >&2; exit 1 ;;
    esac
done
# Whoever has a Node of his own keeps it.
if [ $want_check = yes ] || [ $want_peers = yes ] || [ $want_wasm = yes ]; then
    command -v node >/dev/null || packages+=(nodejs)
    command -v npm >/dev/null || packages+=(npm)
fi

missing=()
for package in "${packages[@]}"; do
    state=$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | head -n 1 || true)
    [ "$state" = installed ] || missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
    echo "installing: ${missing[*]}" >&2
    as_root=(env)
    [ "$(id -u)" -eq 0 ] || as_root=(sudo env)
    export_quiet=(DEBIAN_FRONTEND=noninteractive NEEDRESTART_MODE=a)
    "${as_root[@]}" "${export_quiet[@]}" apt-get update -q >&2
    "${as_root[@]}" "${export_quiet[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}" >&2
fi

if [ $want_check = yes ] && [ ! -d "$root/node_modules/gltf-validator" ]; then
    npm install --prefix "$root" --no-save --no-package-lock --no-audit --no-fund --loglevel=error \
        "gltf-validator@$gltf_validator" >&2
fi

if [ $want_peers = yes ]; then
    npm ci --prefix "$root/lab/peers" --no-audit --no-fund --loglevel=error >&2
fi

if [ $want_wasm = yes ] && { [ ! -d "$root/js/node_modules/playwright-core" ] || [ ! -d "$root/js/node_modules/esbuild" ]; }; then
    npm install --prefix "$root/js" --no-package-lock --no-audit --no-fund --loglevel=error >&2
fi
