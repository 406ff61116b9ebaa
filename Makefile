# A thin front of CMake; `make help` lists it. Any other word is a CMake target:
#   make bhateja2016-fig08        make PROFILE=paper bhateja2016-fig02
PROFILE ?= quick
ROOMS := files simulator sweeps fitting figures cli
PRESETS := release portable debug asan-ubsan tsan bench

MAKEFLAGS += --no-builtin-rules
.NOTPARALLEL:  # ninja spreads the work; two of them in one folder would fight
.SUFFIXES:
.DEFAULT_GOAL := main-job

# Both profiles of every chain are declared in CMake, so switching between them rebuilds nothing.
ifeq ($(PROFILE),quick)
  suffix :=
else ifeq ($(PROFILE),paper)
  suffix := -paper
else ifeq ($(PROFILE),standard)
  suffix := -standard
else
  $(error PROFILE is quick, standard (of sun2006) or paper, not "$(PROFILE)")
endif
with_profile = $1$(if $(filter main-job report sweep-% fit-% bhateja2016 bhateja2016-% sun2006 sun2006-% trade trade-bias trade-pareto trade-orders-table trade-column-table,$1),$(suffix))

sources = $(shell git ls-files -- '*.cpp' '*.hpp')

.PHONY: main-job
main-job: build/release/.configured  ## (default) Bhateja 2016: sweep, fits, Fig. 2, Fig. 8, Table III
	cmake --build --preset release --target $(call with_profile,$@)

.PHONY: build
build: build/release/.configured  ## everything, tests included
	cmake --build --preset release

.PHONY: test
test: build  ## build and pass the default tests (CTEST_ARGS="-R store" chooses)
	ctest --preset release --parallel $(shell nproc) $(CTEST_ARGS)

.PHONY: test-oracle
test-oracle: build  ## the same scenes in LAMMPS; skipped with the reason where lmp is missing
	ctest --preset oracle $(CTEST_ARGS)

.PHONY: $(PRESETS:%=test-%)
$(PRESETS:%=test-%): test-%: build/%/.configured
	cmake --build --preset $*
	ctest --preset $* --parallel $(shell nproc) $(CTEST_ARGS)

.PHONY: bench
bench: build/bench/.configured  ## speed, as ratios to what runs beside it
	cmake --build --preset bench --target run-bench

.PHONY: trade
trade: build/release/.configured  ## what accuracy costs: bias and CPU time of every numerical setting
	cmake --build --preset release --target $(call with_profile,$@)

.PHONY: extremes
extremes: build/release/.configured  ## scenes at the ends of every range, run to failure
	cmake --build --preset release --target $@

.PHONY: refit
refit: build/release/.configured  ## refit and replot everything from data/, without running a bed
	cmake --build --preset release --target $@

.PHONY: claims
claims: build/release/.configured  ## the papers' claims: our number, its error, a verdict for each
	cmake --build --preset release --target $@

.PHONY: packages deps deps-oracle
packages:
	@$(if $(SKIP_PACKAGES),:,cmake/packages.sh apt.txt)
deps:  ## install missing packages of apt.txt (as root; else print the line to run)
	@cmake/packages.sh apt.txt
deps-oracle:  ## the same for apt-optional.txt (lammps)
	@cmake/packages.sh apt-optional.txt

.PHONY: configure
configure: build/release/.configured  ## packages and CMake alone

build/%/.configured: CMakePresets.json | packages
	cmake --preset $*
	@touch $@

.PHONY: format tidy
format:  ## clang-format every source
	clang-format -i $(sources)
tidy: build/release/.configured  ## clang-tidy over the rooms
	run-clang-tidy -quiet -p build/release -extra-arg=-Wno-unknown-warning-option '$(CURDIR)/($(subst $() ,|,$(ROOMS)))/'

.PHONY: clean
clean:  ## remove the builds (finished beds stay in build/cache)
	rm -rf $(PRESETS:%=build/%)

.PHONY: help
help:  ## this list
	@awk -F ':.*## ' '/^[a-z][^=]*:.*## / { printf "  make %-15s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))
	@echo "  make test-PRESET     the default tests in another build: debug, asan-ubsan, tsan, portable"
	@echo "  make TARGET          any CMake target, for instance bhateja2016-fig08"
	@echo "  PROFILE=quick|standard|paper  how much to simulate (standard: sun2006; now $(PROFILE))"

.DEFAULT:
	@$(MAKE) --no-print-directory configure
	cmake --build --preset release --target $(call with_profile,$@)
