#!/usr/bin/env bash
# tools/foreign/run.sh [ROW...]: the golden files decode to the same bits whatever the machine, compiler and flags; prints what was tried.
# Rows: all of the table below by default. Foreign machines are emulated by qemu-user; their zstd is fetched from Debian.
# SPDX-License-Identifier: MIT
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

out=build-foreign
jobs=${JOBS:-1}
rooms=(base mesh coding connectivity predict metrics container codecs)
fronts=(decode level levels shown_frames io/frames)

# name  Debian's architecture  compiler  flags  emulator
table=(
    "gcc-O0       amd64  g++                    -O0                 "
    "gcc-O3       amd64  g++                    -O3                 "
    "gcc-native   amd64  g++                    -O3,-march=native   "
    "clang-O0     amd64  clang++                -O0                 "
    "clang-O3     amd64  clang++                -O3                 "
    "clang-native amd64  clang++                -O3,-march=native   "
    "aarch64      arm64  aarch64-linux-gnu-g++  -O2                 qemu-aarch64"
    "s390x        s390x  s390x-linux-gnu-g++    -O2                 qemu-s390x"
)

# Headers and static libraries of zstd and xxHash for another architecture, unpacked into a folder and not installed.
sysroot() {
    local arch=$1 folder=$PWD/$out/sysroot-$1 state=$PWD/$out/apt-$1
    if [ ! -e "$folder/done" ]; then
        mkdir -p "$state"/{lists/partial,cache/archives/partial} "$folder"
        : >"$state/status"
        local apt=(apt-get -qq -o APT::Architecture="$arch" -o APT::Architectures="$arch" -o Dir::State="$state"
            -o Dir::State::lists="$state/lists" -o Dir::State::status="$state/status" -o Dir::Cache="$state/cache"
            -o Acquire::Languages=none -o APT::Sandbox::User=root)
        "${apt[@]}" update
        (cd "$state" && "${apt[@]}" download libzstd-dev libxxhash-dev)
        for package in "$state"/*.deb; do dpkg -x "$package" "$folder"; done
        touch "$folder/done"
    fi
    echo "$folder"
}

# objects COMPILER FLAGS FOLDER ROOT: a room is one source; what decoding does not call is left out by the linker, and linalg, which
# only encoders call, is not even compiled.
objects() {
    local compiler=$1 flags=$2 folder=$3 root=$4 name
    local common=(-std=c++20 -ffp-contract=off -fno-math-errno -ffunction-sections -fdata-sections -DEIGEN_DONT_PARALLELIZE
        -DEIGEN_MPL2_ONLY -DNDEBUG -w -Wno-psabi -I. -Isrc -isystem /usr/include/eigen3 -isystem "$out/headers")
    [ -z "$root" ] || common+=(-isystem "$root/usr/include")
    mkdir -p "$folder" "$out/headers"
    ln -sfn /usr/include/nlohmann "$out/headers/nlohmann"
    for name in "${rooms[@]}"; do
        find "src/meshreel/$name" -maxdepth 1 -name '*.cpp' ! -name '*shapes.cpp' ! -name 'space_time.cpp' | sort | sed 's/.*/#include "&"/' >"$folder/$name.cpp"
    done
    for name in "${fronts[@]}"; do echo "#include \"src/meshreel/$name.cpp\"" >"$folder/${name//\//_}_front.cpp"; done
    cp tools/foreign/golden_files.cpp "$folder/golden_files.cpp"
    printf '%s\n' "$folder"/*.cpp | sed 's/\.cpp$//' |
        xargs -P "$jobs" -I{} $(command -v ccache) "$compiler" "${common[@]}" ${flags//,/ } -c {}.cpp -o {}.o
}

# row NAME ARCH COMPILER FLAGS EMULATOR: one line of the result.
row() {
    local name=$1 arch=$2 compiler=$3 flags=$4 emulator=${5:-} root="" folder=$out/$1 said libraries
    local label; label=$(printf '%-13s %-6s %-22s %-18s %-13s' "$name" "$arch" "$compiler" "${flags//,/ }" "${emulator:--}")
    if ! command -v "$compiler" >/dev/null || { [ -n "$emulator" ] && ! command -v "$emulator" >/dev/null; }; then
        echo "$label not here"; return 0
    fi
    libraries=(-lzstd -lxxhash)
    if [ "$arch" != amd64 ]; then
        root=$(sysroot "$arch")
        libraries=("$(find "$root" -name libzstd.a)" "$(find "$root" -name libxxhash.a)")
    fi
    rm -rf "$folder"
    objects "$compiler" "$flags" "$folder" "$root" || return 1
    "$compiler" "$folder"/*.o -o "$folder/golden_files" -static -pthread -Wl,--gc-sections,--unresolved-symbols=ignore-all "${libraries[@]}" || return 1
    if said=$($emulator "$folder/golden_files" tests/golden 2>&1); then
        echo "$label $(tail -n 1 <<<"$said")"
    else
        echo "$label FAILED: $(tail -n 3 <<<"$said" | cut -c1-300)"; return 1
    fi
}

failed=0
for line in "${table[@]}"; do
    read -r name arch compiler flags emulator <<<"$line"
    [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
    row "$name" "$arch" "$compiler" "$flags" "$emulator" || failed=1
done
exit $failed
