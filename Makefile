# SPDX-License-Identifier: Apache-2.0
# The whole of Talus by make. `make demo` and `make test` do everything on a bare Debian 12.

BUILD ?= build
JOBS ?= $(shell nproc)
# In CI as far as PTX, which takes half as long; gpu-check and kernel-report go on to machine code.
CUDA_ARCHITECTURES ?= $(if $(CI),90-virtual,90)
NVCC := $(or $(shell command -v nvcc 2>/dev/null),$(wildcard /usr/local/cuda/bin/nvcc))
STAGES := talus talus-digitize talus-generate talus-family talus-decompose talus-catalog talus-simulate talus-post

.PHONY: help demo test build install engine test-engines portable hard-cases cuda accuracy study gpu-check gpu-test kernel-report instruction-counts record-instruction-counts peers exact-pairs large-mesh large-cloud fuzz decomposition format check-format clean

help:  ## This list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

demo: install $(BUILD)/CMakeCache.txt  ## From scans to a hopper and a mill; SCANS=folder UNIT=m for your own
	cmake --build $(BUILD) --parallel $(JOBS) --target $(STAGES)
	BUILD=$(BUILD) SCANS="$(SCANS)" UNIT="$(UNIT)" DEMO="$(DEMO)" workflows/demo.sh

test: install build cuda  ## Build everything, run every test; with nvcc also compile the CUDA engine
	ctest --test-dir $(BUILD) --output-on-failure --parallel $(JOBS)

build: install $(BUILD)/CMakeCache.txt  ## Build everything
	cmake --build $(BUILD) --parallel $(JOBS)

install:  ## Install what Talus needs (Debian 12; root or sudo)
	@workflows/install_dependencies.sh

$(BUILD)/CMakeCache.txt:
	cmake -S . -B $(BUILD) -G Ninja -DTALUS_WARNINGS_AS_ERRORS=$(if $(CI),ON,OFF)

engine: install  ## The engine alone: no PCL, CGAL, assimp or VTK
	cmake --preset dem-cpu -DTALUS_WARNINGS_AS_ERRORS=$(if $(CI),ON,OFF)
	cmake --build --preset dem-cpu --parallel $(JOBS)

test-engines: install  ## Engine tests with OpenMP under the address and undefined-behaviour sanitizers
	cmake --preset asan -DTALUS_WARNINGS_AS_ERRORS=$(if $(CI),ON,OFF)
	cmake --build --preset asan --parallel $(JOBS)
	ctest --test-dir build-asan --output-on-failure --parallel $(JOBS) -L 'unit|property|backend'

portable: install  ## The engine for machines of several generations: each loads what it has instructions for (build-dem-portable)
	cmake --preset dem-portable
	cmake --build --preset dem-portable --parallel $(JOBS) --target talus-simulate time_scene
	workflows/portable_check.sh build-dem-portable

HARD_CASES_TABLE := docs/results/hard_cases.md
hard-cases: install $(BUILD)/CMakeCache.txt  ## Every hard case, about an hour; writes docs/results/hard_cases.md
	cmake --build $(BUILD) --parallel $(JOBS) --target hard_cases
	@mkdir -p $(dir $(HARD_CASES_TABLE))
	@{ printf '# Hard cases\n\nWritten by `make hard-cases` on %s, one thread of %s. A case that does not hold is shown as failed; the quick ones are also tests (`ctest -R HardCases`).\n\n' \
	  "$$(date -u +%Y-%m-%d)" "$$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)"; \
	  $(BUILD)/bin/hard_cases; } > $(HARD_CASES_TABLE).next; status=$$?; mv $(HARD_CASES_TABLE).next $(HARD_CASES_TABLE); \
	  cat $(HARD_CASES_TABLE); exit $$status

ifeq ($(NVCC),)
cuda:
	@echo 'cuda: no nvcc here, the CUDA engine is not compiled'
else
cuda: install  ## Compile the CUDA engine and its talus-simulate (where nvcc is)
	PATH="$(dir $(NVCC)):$$PATH" cmake --preset dem-cuda -DCMAKE_CUDA_ARCHITECTURES="$(CUDA_ARCHITECTURES)"
	PATH="$(dir $(NVCC)):$$PATH" cmake --build --preset dem-cuda --parallel $(JOBS) --target talus-simulate
endif

accuracy: install  ## Write docs/accuracy.md: every validation table and bench in both precisions (two hours)
	for preset in dem-cpu dem-cpu-mixed; do \
	  cmake --preset $$preset && cmake --build --preset $$preset --parallel $(JOBS) || exit; done
	workflows/accuracy_report.sh build-dem-cpu build-dem-cpu-mixed

ifeq ($(and $(SCAN),$(UNIT)),)
study:
	@echo 'study: state the scan and its length unit, such as make study SCAN=rock.stl UNIT=mm' >&2; exit 2
else
study: install $(BUILD)/CMakeCache.txt  ## How many parts a rock needs: SCAN=rock.stl UNIT=mm (about three hours); writes study/rock/parts_per_rock.md
	cmake --build $(BUILD) --parallel $(JOBS) --target $(STAGES) talus-bench
	SCAN="$(SCAN)" UNIT="$(UNIT)" BUILD=$(BUILD) workflows/studies/parts_per_rock.sh
endif

ifeq ($(NVCC),)
gpu-check:
	@echo 'gpu-check: needs nvcc (CUDA 12.4 or newer; no GPU) to build the folder' >&2; exit 2
else
gpu-check: install  ## Build build-gpu-check/talus-gpu-check: carried to a GPU machine, its run.sh tests and times there (8 minutes)
	cmake --preset dem-cpu -DTALUS_WARNINGS_AS_ERRORS=$(if $(CI),ON,OFF)
	cmake --build --preset dem-cpu --parallel $(JOBS) --target agreement
	rm -rf build-gpu-check/reference
	build-dem-cpu/bin/agreement --write build-gpu-check/reference
	PATH="$(dir $(NVCC)):$$PATH" cmake --preset dem-cuda-check
	PATH="$(dir $(NVCC)):$$PATH" cmake --build --preset dem-cuda-check --parallel $(JOBS) --target gpu_check_folder
	du -sh build-gpu-check/talus-gpu-check
endif

KERNELS := docs/results/kernels.md
kernel-report:  ## Registers, stack and spills of the CUDA kernels for sm_90, into docs/results/kernels.md; needs nvcc, no GPU
	@[ -n "$(NVCC)" ] || { echo 'kernel-report: needs nvcc' >&2; exit 2; }
	PATH="$(dir $(NVCC)):$$PATH" cmake --preset dem-cuda -B build-kernel-report -DCMAKE_CUDA_ARCHITECTURES=90-real -DCMAKE_CUDA_FLAGS="-Xptxas -v"
	PATH="$(dir $(NVCC)):$$PATH" cmake --build build-kernel-report --parallel $(JOBS) --target clean
	PATH="$(dir $(NVCC)):$$PATH" cmake --build build-kernel-report --parallel $(JOBS) --target dem_engine > build-kernel-report/ptxas.log 2>&1 \
	  || { tail -30 build-kernel-report/ptxas.log; exit 1; }
	@{ printf '# CUDA kernels\n\nWritten by `make kernel-report` with %s for sm_90. Registers a thread; the stack is local memory, in bytes a thread, spills among it.\n\n' \
	  "$$($(NVCC) --version | sed -n 's/.*release \([0-9.]*\),.*/CUDA \1/p')"; \
	  workflows/kernel_report.sh build-kernel-report/ptxas.log; } > $(KERNELS).next && mv $(KERNELS).next $(KERNELS)

gpu-test: install  ## On a GPU machine with the sources: build the CUDA engine with its tests and run them
	cmake --preset dem-cuda -DCMAKE_CUDA_ARCHITECTURES=native
	cmake --build --preset dem-cuda --parallel $(JOBS)
	ctest --test-dir build-dem-cuda --output-on-failure -L 'unit|property|validation|backend'

COUNTS := tests/benchmark/instruction_counts.json
instruction-counts: install $(BUILD)/CMakeCache.txt  ## Instructions of a particle and step by callgrind, S1 and S2, LIGGGHTS beside (about five minutes)
	cmake --build $(BUILD) --parallel $(JOBS) --target instruction_counts
	$(BUILD)/bin/instruction_counts --whole

record-instruction-counts: install $(BUILD)/CMakeCache.txt  ## Renew what the test Benchmark.InstructionCounts compares with
	cmake --build $(BUILD) --parallel $(JOBS) --target instruction_counts
	$(BUILD)/bin/instruction_counts --record $(COUNTS)

peers: install $(BUILD)/CMakeCache.txt  ## Talus beside LIGGGHTS, LAMMPS and YADE where they are installed (about ten minutes)
	cmake --build $(BUILD) --parallel $(JOBS) --target time_scene write_particles
	tests/benchmark/peers/compare.sh $(BUILD)

exact-pairs: $(BUILD)/CMakeCache.txt  ## A million random pairs against exact arithmetic (25 CPU minutes); PAIRS=number
	cmake --build $(BUILD) --parallel $(JOBS) --target dem_exact_test
	TALUS_EXACT_PAIRS=$(or $(PAIRS),1000000) TALUS_EXACT_TABLE=$(BUILD)/exact_pairs.md $(BUILD)/tests/dem_exact_test
	cat $(BUILD)/exact_pairs.md

large-mesh: install $(BUILD)/CMakeCache.txt  ## Memory and time of decomposing 2,000,000 faces (10 CPU seconds); FACES=number
	cmake --build $(BUILD) --parallel $(JOBS) --target test_large_mesh
	TALUS_LARGE_FACES=$(or $(FACES),2000000) $(BUILD)/tests/test_large_mesh

large-cloud: install $(BUILD)/CMakeCache.txt  ## Memory and time of digitising 50,000,000 points (a minute, 0.6 GB of disk); POINTS=number
	cmake --build $(BUILD) --parallel $(JOBS) --target test_large_cloud
	TALUS_LARGE_POINTS=$(or $(POINTS),50000000) $(BUILD)/tests/test_large_cloud

ifeq ($(SCANS),)
decomposition:
	@echo 'decomposition: state where the scans lie, such as make decomposition SCANS=../shared/data/real' >&2; exit 2
else
decomposition: install $(BUILD)/CMakeCache.txt  ## Decomposition of real scans against its goals; SCANS=folder; writes docs/results/decomposition.md
	cmake --build $(BUILD) --parallel $(JOBS) --target talus talus-bench
	$(BUILD)/bin/talus bench decomposition --scans "$(SCANS)" --out docs/results || [ $$? -eq 4 ]
endif

FUZZ_SECONDS ?= 180
# assimp leaks a little where it refuses a file.
fuzz: install  ## Readers of scans under libFuzzer with sanitizers; needs clang++; FUZZ_SECONDS=180
	@command -v clang++ > /dev/null || { echo 'fuzz: needs clang++; install it with apt-get install clang' >&2; exit 2; }
	cmake -S . -B build-fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DTALUS_LIBFUZZER=ON -DBUILD_DEM=OFF
	cmake --build build-fuzz --parallel $(JOBS) --target reader_fuzz write_seeds
	build-fuzz/tests/write_seeds build-fuzz/seeds && mkdir -p build-fuzz/corpus
	ASAN_OPTIONS=detect_leaks=0 build-fuzz/tests/reader_fuzz -max_total_time=$(FUZZ_SECONDS) -rss_limit_mb=3000 \
	  -artifact_prefix=build-fuzz/ -timeout=20 -max_len=20000 \
	  build-fuzz/corpus build-fuzz/seeds

format:  ## Format every source file
	git ls-files '*.cpp' '*.h' | xargs clang-format -i

check-format:  ## Fail if a source file is not formatted
	git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run -Werror

clean:  ## Remove the build folders (not the demo's results)
	rm -rf $(BUILD) build-dem-cpu build-dem-cpu-mixed build-dem-tbb build-dem-portable build-dem-cuda build-gpu-check build-kernel-report build-asan
