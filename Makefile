# For developers; to use mahovik, `pip install ".[report]"` is enough. Everything lives in .venv: `make demo` and
# `make test` need nothing but Python >= 3.11, gcc and make.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
TEST_READY := $(VENV)/.ready-test
BENCH := .venv-bench

# Python keeps the modules that it has compiled, in the tests' folder where it shall leave none beside the sources.
ifneq ($(PYTHONDONTWRITEBYTECODE),)
unexport PYTHONDONTWRITEBYTECODE
export PYTHONPYCACHEPREFIX := $(CURDIR)/.pytest_cache/bytecode
endif

.PHONY: help setup setup-test demo test lint docs generated net targets fuzz proofs faults bench nightly clean

help:
	@echo "make demo        set up, generate bench8, verify it, print the table"
	@echo "make test        the same, then the tests"
	@echo "make setup       virtual environment in .venv with mahovik and its pictures (run .venv/bin/mahovik)"
	@echo "make setup-test  the same environment with judges, test tools and the site's builder added"
	@echo "make lint        format, lint, types, imports, and the size of the house"
	@echo "make docs        the pages of docs/ as a site: build/docs/index.html; any warning is an error"
	@echo "make generated   derive the formulas again with SymPy, write generated/bench8 again"
	@echo "make net         the C of 67 stands, answers of every study, transcripts: as accepted in tests/net?"
	@echo "make targets     compilers and emulators (Debian), then the same bits and no rise of cost on every processor"
	@echo "make fuzz        ten million executions of the C on arbitrary arguments, every reader on arbitrary files"
	@echo "make proofs      Frama-C Eva on the C of the example stands, and the static checks with MISRA C:2012"
	@echo "make faults      plants faults in the package: does a test notice each?"
	@echo "make bench       times beside the peers, in .venv-bench, ten minutes at first: docs/results"
	@echo "make nightly     all of these and what is too long for every change; PARTS=\"slow faults\" runs some"
	@echo "make clean       remove what the other targets made"

# Python keeps what it has compiled, even where the environment forbids it: tests start thousands of processes.
test: export PYTHONDONTWRITEBYTECODE :=

demo: setup
	$(BIN)/mahovik generate generator/mahovik/stands/bench8.toml -o build/demo/bench8
	$(BIN)/mahovik verify generator/mahovik/stands/bench8.toml

test: demo setup-test
	$(BIN)/python -m pytest -q -n 2 --dist worksteal

# Not compiled at once: less disk and time, and most modules are never imported. Those that commands import are compiled by
# running some, where the environment lets Python keep none: as pip does there, and every start takes half the time.
KEEPING := env -u PYTHONDONTWRITEBYTECODE -u PYTHONPYCACHEPREFIX
INSTALL := $(BIN)/python -m pip install --no-compile --disable-pip-version-check -c constraints.txt

setup: $(READY)

$(READY): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
	  || { echo "mahovik needs Python 3.11 or newer: try make PYTHON=python3.12"; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null \
	  || { echo "this Python has no venv: on Debian, apt-get install python3-venv"; exit 1; }
	@echo "setup: mahovik and what it needs, into $(VENV)"
	@$(PYTHON) -m venv $(VENV)
	@$(INSTALL) -e '.[report]'
	@$(KEEPING) $(BIN)/python tools/compile_modules.py
	@touch $(READY)

# in the same environment: judges, test tools, the site's builder
setup-test: $(TEST_READY)

$(TEST_READY): $(READY)
	@echo "setup: judges, test tools and the site's builder, into $(VENV)"
	@$(INSTALL) -e '.[test]'
	@touch $(TEST_READY)

lint: setup-test
	$(BIN)/ruff check generator tests tools bench
	$(BIN)/ruff format --check generator tests tools bench
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache
	$(BIN)/python tools/size.py

docs: setup-test
	$(BIN)/python -m sphinx -W --keep-going -n -q -b html docs build/docs
	@echo "build/docs/index.html"

generated: setup
	$(BIN)/python tools/formulas.py
	$(BIN)/mahovik generate generator/mahovik/stands/bench8.toml -o generated/bench8

net: setup-test
	$(BIN)/python tests/net/net.py

targets: setup-test
	tools/targets-packages.sh
	$(BIN)/python tests/net/processors.py --all

fuzz: setup-test
	tools/fuzz-packages.sh
	$(BIN)/python tools/campaign.py fuzz
	MAHOVIK_FUZZ_TIMES=20 $(BIN)/python -m pytest -q -n 2 --dist worksteal -m fuzz tests/fuzz

proofs: setup-test
	tools/proofs-packages.sh
	$(BIN)/python tools/campaign.py proofs

faults: setup-test
	$(BIN)/python tools/faults.py

bench: setup-test
	@[ -e $(BENCH)/.ready ] || { $(PYTHON) -m venv $(BENCH) && $(BENCH)/bin/python -m pip install --quiet \
	  --disable-pip-version-check -c bench/constraints.txt -r bench/requirements.txt && touch $(BENCH)/.ready; }
	PYTHONPATH=generator $(BENCH)/bin/python tools/campaign.py benchmarks --write

nightly: setup-test
	$(BIN)/python tools/nightly.py $(PARTS)

clean:
	rm -rf $(VENV) $(BENCH) build dist .pytest_cache .hypothesis .mypy_cache .ruff_cache
