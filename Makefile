# The commands to remember.
.PHONY: build demo check test tsan fuzz foreign bench bench-ablation bench-effort bench-ledger bench-plan bench-rate bench-scale bench-search bench-surfaces wasm page picture bench-browser figures format docs clean

build:          ## the command: build/meshreel
	cmake --preset release
	cmake --build build --target meshreel-cli

demo:           ## a sample animation through the whole road, a table and a picture
	./demo

check:          ## everything that CI checks
	./check

test:           ## the fast tests of a development build
	cmake --preset dev
	cmake --build build-dev
	ctest --test-dir build-dev --output-on-failure -LE slow -j2

fuzz:           ## every fuzz target for a minute of the processor, or FUZZ_SECONDS=...; then all decoders of what was found; KEEP=1: into fuzz/ledger.csv
	tools/fuzz.py $(or $(FUZZ_SECONDS),60) $(if $(KEEP),--keep)
	reference/differential.py build-fuzz/golden_files build-fuzz/corpus/fuzz_reel
	[ ! -e build-wasm/meshreel-all.wasm ] || node js/test/differential.mjs build-fuzz/golden_files build-fuzz/corpus/fuzz_reel

tsan:           ## the tests whose names speak of threads, under the thread sanitizer
	cmake --preset tsan
	cmake --build build-tsan -j$(or $(JOBS),2) --target test_threads test_codecs test_properties test_metrics test_mesh test_linalg test_distort test_player
	ctest --test-dir build-tsan --output-on-failure --no-tests=error -R 'Thread'

foreign:        ## the golden files under other compilers, flags and machines (qemu-user)
	tools/foreign/run.sh

bench:          ## speeds and memory; KEEP=1: into docs/benchmarks.md
	cmake --preset bench
	cmake --build build-bench
	build-bench/bench/bench_sequences --csv build-bench/speeds.csv
	build-bench/bench/bench_player >build-bench/player.txt && cat build-bench/player.txt
	build-bench/bench/bench_measures --only walker -n 21 >build-bench/measures.txt && cat build-bench/measures.txt
	build-bench/bench/bench_space_time
	$(if $(KEEP),lab/take.py speeds build-bench/speeds.csv && lab/take.py player build-bench/player.txt)
	$(if $(KEEP),lab/take.py measures build-bench/measures.txt && lab/tables.py)

bench-ablation: ## what each idea of the default codec is worth: docs/ablation.md, its picture, lab/results/ablation.csv
	tools/install.sh --with-figures
	cmake --preset release
	cmake --build build --target meshreel-cli
	lab/ablation.py $(if $(DATA),--data $(DATA)) && lab/tables.py

bench-effort: build ## the table of docs/effort.md
	bench/effort.py --write

bench-ledger: build ## exact sizes beside lab/ledger.csv; REASON="why they change" renews it
	lab/ledger.py $(if $(REASON),--renew --reason "$(REASON)")

bench-plan:    ## everyone side by side: make bench-plan PLAN=lab/plans/codecs.toml; docs/lab.md; KEEP=1 renews lab/results
	tools/install.sh --with-figures --with-peers
	cmake --preset release -DMESHREEL_BUILD_LAB=ON
	cmake --build build
	lab/bench.py $(or $(PLAN),lab/plans/everyone.toml) $(if $(DATA),--data $(DATA)) $(if $(KEEP),--keep)

bench-scale: build  ## how cost grows with V and F: the table of docs/benchmarks.md
	bench/scale.py >build/scale.txt && cat build/scale.txt
	lab/take.py scale build/scale.txt && lab/tables.py

bench-search: build ## what looking for a target costs, in encodes
	bench/search.py

bench-surfaces: build ## distances of surfaces beside MeshLab (tools/install.sh --with-meshlab)
	bench/surfaces.py

bench-rate: build   ## rates at given errors beside what they must be; the README's table
	bench/rate.py --keep && lab/tables.py

wasm:           ## the decoder for JavaScript into js/dist (tools/install.sh --with-wasm)
	wasm/build.sh
	node js/build.mjs

page:           ## the page of play and export into js/dist, with the decoder (tools/install.sh --with-wasm)
	tools/install.sh --with-wasm
	wasm/build.sh
	node js/build.mjs
	node js/play/build.mjs

picture: build page ## docs/play.png, the first picture of the README
	node js/play/picture.mjs

bench-browser: build page ## frame time, memory and time to the first frame in Chromium: docs/browser-speed.md; DATA=FOLDER of dance
	tools/install.sh --with-peers
	node bench/browser.mjs $(DATA)

figures:        ## the thesis' tables and figures, measured: docs/thesis-figures.md; DATA=FOLDER where the sequences are elsewhere
	tools/install.sh --with-figures
	cmake --preset release -DMESHREEL_BUILD_LAB=ON
	cmake --build build --target meshreel-cli meshreel-lab
	lab/figures.py $(if $(DATA),--data $(DATA))

format:         ## clang-format on every source
	git ls-files '*.h' '*.cpp' | xargs clang-format -i

docs:           ## the pages that are made from the code
	tools/deviations.py
	lab/tables.py

clean:
	rm -rf build build-* demo-out
