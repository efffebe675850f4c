# A thin front door: each target installs what it needs, builds what it needs and runs one thing. CMake does the work.
.DEFAULT_GOAL := help
SHELL := /bin/bash
.PHONY: help demo test unit bench fuzz lint format docs site evidence dependencies build program python viewer viewer-engine viewer-engine-test viewer-test

# Brings the packages; `make INSTALL=true ...` where they come from elsewhere.
INSTALL ?= tools/install_dependencies.sh
# Compilers at once: as many as there are cores, fewer where memory is short.
JOBS ?= $(shell tools/job_count.sh)
# Debian's Python: the one that h5py, pandas and matplotlib are installed for.
PYTHON ?= /usr/bin/python3

help:  ## List these targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-18s %s\n", $$1, $$2}' Makefile

demo: program  ## Screen the sample layouts under the norm of the road into demo/results.h5
	@mkdir -p demo
	build/release/bin/holdfast screen -c configs/demo.ini --layouts configs/layouts \
	  --norm road -o demo/results.h5 --overwrite
	@cat examples/next_steps.txt

test: build  ## Build and run all tests
	ctest --preset release -j $(JOBS)

unit: dependencies  ## Build and run the fast tests of the C++ sources, less than a minute of them
	@cmake --preset release -DBUILD_TESTING=ON > /dev/null
	cmake --build --preset release -j $(JOBS) --target holdfast_tests holdfast_plugins
	build/release/bin/holdfast_tests "~[slow]~[.]"

bench: program  ## Measure throughput on this machine
	@$(INSTALL) --test
	cmake --build --preset release -j $(JOBS) --target holdfast_plugins
	$(PYTHON) bench/candidates.py 64 build/bench/candidates --boxes 20 150
	build/release/bin/holdfast bench --layouts build/bench/candidates --accelerations configs/accelerations/road_brake_0g8.txt \
	  --engine bullet-stock --classes 50 100 --csv build/bench/measured.csv
	$(PYTHON) bench/plot.py build/bench/measured.csv build/bench/measured.svg

# Seconds that each fuzz target runs.
FUZZ_SECONDS ?= 60
fuzz:  ## Feed the readers made-up files, FUZZ_SECONDS each (60), with Clang's sanitizers
	@$(INSTALL) --dev
	@cmake --preset fuzz > /dev/null
	cmake --build --preset fuzz -j $(JOBS)
	@for reader in layout table json acceleration config request; do \
	  mkdir -p build/fuzz/found/$$reader; \
	  echo "fuzz: $$reader"; \
	  build/fuzz/bin/$${reader}_fuzz -max_total_time=$(FUZZ_SECONDS) -max_len=2048 -timeout=10 -rss_limit_mb=2048 \
	    -print_final_stats=1 -verbosity=0 -artifact_prefix=build/fuzz/$$reader- build/fuzz/found/$$reader \
	    tests/fuzz/corpus/$$reader 2>&1 | tail -5; \
	  test "$${PIPESTATUS[0]}" = 0 || exit 1; \
	done

# Folders that clang-tidy reads; all when empty.
LINT_FOLDERS ?=
lint:  ## Check format, names, likely bugs and who includes whom
	@$(INSTALL) --dev
	@cmake --preset lint > /dev/null
	tools/lint.sh build/lint $(JOBS) $(LINT_FOLDERS)

format:  ## Format all sources in place
	@$(INSTALL) --dev
	git ls-files -z --cached --others --exclude-standard '*.c' '*.h' '*.cpp' '*.hpp' | xargs -0 -r clang-format -i

python:  ## Build the Python package into build/release/python
	@$(INSTALL) --python
	@cmake --preset release -DHOLDFAST_PYTHON=ON > /dev/null
	cmake --build --preset release -j $(JOBS) --target holdfast_python
	@echo 'The package is built: export PYTHONPATH=$(CURDIR)/build/release/python'

# npm asks its registry for nothing once this is there.
VIEWER_PACKAGES := viewer/node_modules/.package-lock.json
$(VIEWER_PACKAGES): viewer/package-lock.json
	@$(INSTALL) --viewer
	npm --prefix viewer ci --no-audit --no-fund
	@touch $@

viewer: $(VIEWER_PACKAGES)  ## Build the page that shows results files, with the engine where it is built
	node viewer/build.mjs

# The node modules that Debian's emscripten needs are where another node than Debian's does not look.
EMSCRIPTEN := NODE_PATH=/usr/share/nodejs
viewer-engine:  ## Build the native engine as WebAssembly, for the page: build/viewer/engine.mjs
	@$(INSTALL) --viewer-engine
	@$(EMSCRIPTEN) emcmake cmake -S viewer/engine -B build/viewer/engine -G Ninja > /dev/null
	$(EMSCRIPTEN) cmake --build build/viewer/engine -j $(JOBS)

viewer-engine-test: program viewer-engine $(VIEWER_PACKAGES)  ## Compare its bits with the program's, in node and in a browser
	@$(INSTALL) --viewer-test
	node --test tests/viewer/test_engine.mjs tests/viewer/test_engine_loads.mjs tests/viewer/test_engine_browser.mjs

viewer-test: program viewer  ## Check the page's sources, and test it alone and in a browser
	@$(INSTALL) --viewer-test
	npm --prefix viewer run check
	node viewer/build.mjs --tests
	node tests/viewer/results.mjs build/release/bin/holdfast build/viewer/results
	node --test build/viewer/tests/

docs: program  ## Write the generated pages of docs/ and the files made of outcome_fields.h again, and make the site build/site
	tools/outcome_types.py
	build/release/bin/holdfast --config-page > docs/reference/config.md
	build/release/bin/holdfast --norms-page > docs/reference/norms.md
	build/release/bin/holdfast --containers-page > docs/reference/containers.md
	build/release/bin/holdfast --results-page > docs/reference/results_file.md
	python3 tools/commands_page.py build/release/bin/holdfast > docs/reference/commands.md
	python3 tools/parameters_page.py build/release/bin/holdfast > docs/physics/parameters.md
	! command -v dot > /dev/null || dot -Tsvg docs/develop/world_flow.dot -o docs/develop/world_flow.svg
	@$(MAKE) --no-print-directory site

site:  ## Make the site build/site of the pages of docs/ as they are
	@$(INSTALL) --docs
	tools/site_source.py build/site_source
	mkdocs build --strict --clean --quiet
	@echo 'The site is built: build/site/index.html'

evidence: program  ## Write the tables and pictures of README.md and docs/ that come from runs again
	@$(INSTALL) --test
	$(PYTHON) tools/evidence.py build/release/bin/holdfast

dependencies:  ## Install the packages that building, tests, examples and benchmarks need
	@$(INSTALL) --test

build: dependencies  ## Build everything into build/release
	@cmake --preset release -DBUILD_TESTING=ON > /dev/null
	cmake --build --preset release -j $(JOBS)

program:  ## Build the program alone, without plug-ins and tests, into build/release
	@$(INSTALL)
	@cmake --preset release -DBUILD_TESTING=OFF > /dev/null
	cmake --build --preset release -j $(JOBS) --target holdfast
