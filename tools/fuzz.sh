#!/usr/bin/env bash
# Builds every fuzz target and runs each for some seconds (default 10): tools/fuzz.sh [SECONDS [SEED [TARGET...]]].
# The same seed, the same inputs. FUZZ_JOBS: how many at once, default one a core. FUZZ_WITHOUT: targets to leave out, a regular
# expression. At most 512 MB each, 120 s an input (of the clock: a busy machine stretches them).
# Ends with a table: runs, processor seconds, what is covered of the code that the target holds, the corpus, findings.
# SPDX-License-Identifier: MIT
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export seconds=${1:-10} seed=${2:-0}
shift $(($# < 2 ? $# : 2))
jobs=${FUZZ_JOBS:-$(nproc)}
export out=build-fuzz
export ASAN_OPTIONS=quarantine_size_mb=16:allocator_may_return_null=0 # as much as fits into 512 MB
mapfile -t targets < <(if [ $# -gt 0 ]; then printf '%s\n' "$@"; else basename -s _fuzz.cpp -a fuzz/*_fuzz.cpp; fi |
    grep -vxE "${FUZZ_WITHOUT:-none}" | sed 's/^/fuzz_/')
[ ${#targets[@]} -gt 0 ] || { echo "fuzz: there are no targets"; exit 1; }

cmake --preset fuzz >/dev/null
cmake --build $out --target "${targets[@]}" golden_files -j"$jobs"

# What a target starts from: its own seeds, and for those that read whole files the small golden ones.
seeds_of() {
    local seeds=fuzz/seeds/${1#fuzz_}
    [ -d "$seeds" ] && echo "$seeds"
    case $1 in
        fuzz_reel | fuzz_reel_threads | fuzz_player | fuzz_wasm_boundary)
            mkdir -p $out/golden
            find tests/golden -name '*.reel' -size -8k -exec cp -u {} $out/golden/ \;
            echo $out/golden ;;
    esac
}

run_one() {
    local name=$1 corpus=$out/corpus/$1 log=$out/$1.log cpu
    local folders=("$corpus")
    mapfile -t -O 1 folders < <(seeds_of "$name")
    mkdir -p "$corpus"
    TIMEFORMAT='cpu_seconds %U %S'
    if { time "$out/fuzz/$name" -max_total_time="$seconds" -seed="$seed" -timeout=120 -report_slow_units=120 -rss_limit_mb=512 -max_len=8192 \
        -print_final_stats=1 -artifact_prefix="$out/crash-$name-" "${folders[@]}"; } >"$log" 2>&1; then
        echo "fuzz: $name: $(awk '/number_of_executed_units/ {print $2}' "$log") runs, nothing found"
    else
        echo "fuzz: $name: FAILED, see $log"; tail -n 40 "$log"; return 1
    fi
}

# A line of the table: coverage in counters of edges, of those in the program.
tell_one() {
    awk -v name="${1#fuzz_}" -v found="$(find $out -maxdepth 1 -name "crash-$1-*" | wc -l)" '
        /INFO: Loaded 1 modules/ { for (i = 1; i < NF; i++) if ($i ~ /^\(/) break; gsub(/[^0-9]/, "", $i); all = $i }
        / cov: / { for (i = 1; i < NF; i++) { if ($i == "cov:") cov = $(i + 1); if ($i == "corp:") corp = $(i + 1) } }
        /number_of_executed_units/ { runs = $2 }
        /peak_rss_mb/ { rss = $2 }
        /^cpu_seconds/ { cpu = $2 + $3 }
        END { sub(/\/.*/, "", corp)
              printf "%-26s %10d %8.1f %8d %6.1f %% %7d %6d %9d\n", name, runs, cpu, cov, all ? 100 * cov / all : 0, corp, rss, found }' $out/"$1".log
}
export -f run_one seeds_of

status=0
printf '%s\0' "${targets[@]}" | xargs -0 -r -P"$jobs" -I{} bash -c 'run_one "$@"' _ {} || status=1
printf '%-26s %10s %8s %8s %8s %7s %6s %9s\n' target runs "CPU s" edges "of all" corpus MB findings | tee $out/table.txt
for target in "${targets[@]}"; do tell_one "$target"; done | tee -a $out/table.txt
exit $status
