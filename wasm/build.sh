#!/usr/bin/env bash
# Builds the decoder for JavaScript with Debian's Emscripten: build-wasm/meshreel.wasm (what `meshreel encode` writes unless told
# otherwise) and build-wasm/meshreel-all.wasm (every codec). tools/install.sh --with-wasm installs what it needs.
# SPDX-License-Identifier: MIT
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export NODE_PATH=/usr/share/nodejs

out=build-wasm
sysroot=/usr/share/emscripten/cache/sysroot
mkdir -p $out/include
cp /usr/include/xxhash.h $out/include/

rooms=(
    wasm/*.cpp src/meshreel/level.cpp
    src/meshreel/base/{exact,limits,result,text}.cpp
    src/meshreel/mesh/{animation,cells,charts,coarse_surface,coarse_to_fine,corner_table,frame_mix,reorder,surface_part}.cpp
    src/meshreel/coding/*.cpp src/meshreel/predict/*.cpp src/meshreel/connectivity/*.cpp
    src/meshreel/container/{attributes,chunks,fields,package,segments,stream,stream_head,unpack_words,unsqueeze,word_walk}.cpp
    src/meshreel/codecs/*.cpp
)
encoder='connectivity/decimation_plan|codecs/(choice|number_source)\.'
[ "${1:-}" != --sources ] || { printf '%s\n' "${rooms[@]}" | grep -vE "$encoder"; exit; } # for the fuzzer, fuzz/CMakeLists.txt
others='codecs/(average|basis|coddyac|decimated|lossless|lsp|pca_codec|rbfp)\.|coding/(huffman|number_line)\.|predict/(lsp|rbf)\.|connectivity/decimation\.'

features=(bulk-memory sign-ext nontrapping-fptoint) # which all browsers have since 2021

# build NAME LEAVE-OUT DEFINES...: one translation unit, so that the linker sees all of it at once.
build() {
    local name=$1 without=$2; shift 2
    printf '%s\n' "${rooms[@]}" | grep -vE "$without" | sed 's|.*|#include "../&"|' > $out/$name.cpp
    # -Oz alone would keep Emscripten from inlining anything, and be twice as large.
    em++ -std=c++20 -Oz -sINLINING_LIMIT=0 -flto "${features[@]/#/-m}" -ffp-contract=off -fno-exceptions -fno-rtti -fvisibility=hidden \
        -Wall -Wextra -Werror -Wno-unused-function -DNDEBUG -DMESHREEL_DECODER_ALONE "$@" \
        -Iwasm/libcxx -Iwasm/stand_in -Iwasm -Isrc -I$out/include -c $out/$name.cpp -o $out/$name.o
    wasm-ld-14 $out/$name.o $sysroot/lib/wasm32-emscripten/crt1_reactor.o -o $out/$name.linked.wasm \
        -L$sysroot/lib/wasm32-emscripten -lc++-noexcept -lc++abi-noexcept -lc-optz -lc -lcompiler_rt -lstandalonewasm-memgrow \
        --allow-undefined --no-entry --export=_initialize --lto-O2 -O2 -mllvm -disable-lsr --gc-sections \
        --stack-first -z stack-size=262144 --max-memory=2147483648
    wasm-opt --low-memory-unused --enable-bulk-memory --enable-sign-ext --enable-nontrapping-float-to-int \
        --strip-debug --strip-producers -Oz --flatten --rereloop -Oz --flatten --rereloop -Oz $out/$name.linked.wasm -o $out/$name.wasm
    echo "$out/$name.wasm: $(stat -c %s $out/$name.wasm) bytes, $(gzip -9c $out/$name.wasm | wc -c) gzipped"
}

build meshreel "$encoder|$others" -DMESHREEL_REEL_ALONE
build meshreel-all "$encoder"
