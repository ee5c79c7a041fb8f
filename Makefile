# Thin wrappers around the CMake presets. Each first sets up a bare Debian 12 (tools/setup.sh).

export CMAKE_CXX_COMPILER_LAUNCHER ?= $(shell command -v ccache)
JOBS ?= $(shell nproc)
# More options of cmake for `make test`.
CONFIGURE ?=
# What users run; tests and benchmarks are built on request.
PROGRAMS = fairway_command fairway_check

.PHONY: help setup build demo test bench tidy reproduce install package try-package site clean

help:
	@echo "make demo       build, run the demonstration, print where the results are"
	@echo "make test       build and run every test"
	@echo "make build      build/release/bin/fairway"
	@echo "make bench      build and print the benchmark table"
	@echo "make tidy       clang-tidy on every file (half an hour)"
	@echo "make reproduce  redraw the papers' figures on the project's own maps"
	@echo "make install    install to PREFIX (default /usr/local)"
	@echo "make package    Debian packages, in build/package/packages"
	@echo "make try-package  install them in a fresh Debian and try them there (as root)"
	@echo "make site       the documentation as a site, build/site/index.html"
	@echo "make clean      remove build/ and out/"

setup:
	@tools/setup.sh packages.apt
	@command -v npm >/dev/null 2>&1 || tools/setup.sh tools/packages-web.apt

build: setup
	cmake --preset release
	cmake --build --preset release --parallel $(JOBS) --target $(PROGRAMS)

demo: build
	build/release/bin/fairway run demo/contract.toml -o out/contract --force
	build/release/bin/fairway run demo/track.toml -o out/track --force
	build/release/bin/fairway run demo/town.toml -o out/town --force
	build/release/bin/fairway run demo/street.toml -o out/street --force
	build/release/bin/fairway run demo/demo.toml -o out/demo --force

test: setup
	cmake --preset release $(CONFIGURE)
	cmake --build --preset release --parallel $(JOBS)
	ctest --preset release --parallel $(JOBS)

bench: setup
	@tools/setup.sh tools/packages-bench.apt
	cmake --preset bench
	cmake --build --preset bench --parallel $(JOBS)
	cmake --build --preset bench --target run_bench

tidy: setup
	@tools/setup.sh tools/packages-ci.apt
	cmake --preset release -B build/separate -DFAIRWAY_WEB=OFF
	git ls-files 'fairway/*.cpp' 'check/*.cpp' | grep -v '_test\.cpp$$' | \
	  xargs -P $(JOBS) -n 4 clang-tidy-14 -p build/separate --quiet --extra-arg=-Wno-unknown-warning-option \
	  --extra-arg=-Wno-ignored-attributes --extra-arg=-Wno-bitwise-instead-of-logical

reproduce: PROGRAMS += fairway_reproduce
reproduce: build
	build/release/bin/fairway-reproduce demo out/reproduce

install: PROGRAMS += fairway_python fairway_help_pages
install: build
	cmake --install build/release --prefix $(or $(PREFIX),/usr/local)

package: setup
	@tools/setup.sh tools/packages-package.apt
	cmake --preset package
	cmake --build --preset package --parallel $(JOBS) --target package

try-package: package
	$(if $(filter-out 0,$(shell id -u)),sudo) tools/try_package.sh build/package/packages

site: PROGRAMS = fairway_python
site: build
	@tools/setup.sh tools/packages-site.apt
	tools/site.sh build/release/python/fairway

clean:
	rm -rf build out
