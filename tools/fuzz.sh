#!/usr/bin/env bash
# Builds every fuzz target and runs each for some seconds (default 10): tools/fuzz.sh [SECONDS [SEED]]; the same seed, the same inputs.
# SPDX-License-Identifier: MIT
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-10} seed=${2:-0}
jobs=$(nproc)

cmake --preset fuzz >/dev/null
cmake --build build-fuzz --target fuzz_all -j"$jobs"

run_one() {
    local target=$1 seconds=$2 seed=$3 name; name=$(basename "$target")
    local corpus=build-fuzz/corpus/$name seeds=fuzz/seeds/${name#fuzz_} log=build-fuzz/$name.log
    local folders=("$corpus")
    [ -d "$seeds" ] && folders+=("$seeds")
    mkdir -p "$corpus"
    if "$target" -max_total_time="$seconds" -seed="$seed" -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=1024 -print_final_stats=1 \
        -artifact_prefix="build-fuzz/crash-$name-" "${folders[@]}" >"$log" 2>&1; then
        echo "fuzz: $name: $(awk '/number_of_executed_units/ {print $2}' "$log") runs, nothing found"
    else
        echo "fuzz: $name: FAILED, see $log"; tail -n 40 "$log"; return 1
    fi
}
export -f run_one
[ -n "$(find build-fuzz/fuzz -maxdepth 1 -name "fuzz_*" -type f -perm -u+x)" ] || { echo "fuzz: there are no targets"; exit 1; }
find build-fuzz/fuzz -maxdepth 1 -name 'fuzz_*' -type f -perm -u+x -print0 | sort -z |
    xargs -0 -r -P"$jobs" -I{} bash -c 'run_one "$@"' _ {} "$seconds" "$seed"
