# For developers; to use mahovik, `pip install ".[report]"` is enough. Everything lives in .venv: `make demo` and
# `make test` need nothing but Python >= 3.11, gcc and make.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
TEST_READY := $(VENV)/.ready-test
EXAMPLES := $(basename $(notdir $(wildcard generator/mahovik/stands/*.toml)))

# Python keeps the modules that it has compiled, in the tests' folder where it shall leave none beside the sources.
ifneq ($(PYTHONDONTWRITEBYTECODE),)
unexport PYTHONDONTWRITEBYTECODE
export PYTHONPYCACHEPREFIX := $(CURDIR)/.pytest_cache/bytecode
endif

BENCH := .venv-bench
BENCH_READY := $(BENCH)/.ready

.PHONY: $(shell sed -n 's/^\([a-z-]*\):.*/\1/p' Makefile)

help:
	@echo "make demo       set up, generate bench8, verify it, print the table"
	@echo "make test       the same, then the tests"
	@echo "make test-slow  the longest of the tests, of their cases a fifth: minutes"
	@echo "make test-all   every test, of the slow ones every case: an hour"
	@echo "make nightly    every test, target, proof and campaign that judges, in parts that are taken up again; hours"
	@echo "make net        hashes of the C of 67 stands and answers of every study, compared with those kept in tests/net"
	@echo "make setup      virtual environment in .venv with mahovik and its pictures (run .venv/bin/mahovik)"
	@echo "make setup-test the same environment with judges, test tools and the site's builder added"
	@echo "make generated  write generated/ again from the example stands"
	@echo "make targets    install compilers and emulators of the targets (Debian)"
	@echo "make verify-targets  the same bits on every target, of the other stands on some: minutes"
	@echo "make targets-table   the same, written into docs/results/targets.md"
	@echo "make cost       measure the example stands, COST.md in generated/; ACCEPT=--accept accepts what has risen"
	@echo "make cost-check fails where the cost of an example stand has risen"
	@echo "make verify-campaign  fifty random stands, compiled, against both derivations"
	@echo "make rigorous   the true error of the C, by ball arithmetic, into docs/results/rounding.md: minutes"
	@echo "make math-campaign  accuracy of sine, cosine, sqrt, atan2: proofs and samples, into docs/results/arithmetic.md"
	@echo "make fuzz       ten million executions of the C on arbitrary arguments, every file reader on arbitrary files"
	@echo "make fuzz-quick  the same in two minutes"
	@echo "make terms-campaign  one to four wrong terms in a program, and whether judge --explain names them: docs/results/terms.md"
	@echo "make audits     public models of others against the reference: docs/results/audits.md"
	@echo "make explain-campaign  planted faults, and which of them judge --explain names: into docs/results/diagnosis.md; minutes"
	@echo "make flight     a flight on an emulated Cortex-M4, logged, and replayed here bit for bit"
	@echo "make following-campaign  how well bench8 follows with mismatch, without and with trim: docs/results/following.md; minutes"
	@echo "make pil        servos on emulated M7 and M4 in closed loop with a stand, bit for bit: docs/results/servo.md"
	@echo "make control-loop  instructions of a control loop on emulated M7 and M4, into docs/results/control-loop.md"
	@echo "make attitude-loop  attitude loop with its plant on emulated M7 and M4, into docs/results/attitude-loop.md"
	@echo "make held-cost    what forward of held carriers costs beside the free one: docs/results/held.md"
	@echo "make short-steps  what rounding takes from a million short steps in float: docs/results/short-steps.md"
	@echo "make campaign-speed  time of a sample of a campaign beside the batch C alone, into docs/results/campaign-speed.md"
	@echo "make tables-speed  nanoseconds a stand of tables that differ, beside the batch C, into docs/results/tables.md"
	@echo "make campaign-scale  speed, memory and load of campaigns, a million samples: docs/results/campaigns.md; minutes"
	@echo "make campaign-faults  a campaign whose processes are killed at random: docs/results/campaign-faults.md; minutes"
	@echo "make api-speed  nanoseconds a state of Python's forward beside the batch C, into docs/results/python.md"
	@echo "make verify-time  how long the comparison of three takes, stand by stand"
	@echo "make generation-time  generation cold and warm, start of commands, gcc: docs/results/generation.md"
	@echo "make install-size  time and disk of an install in a fresh clone: docs/results/install.md, README.md; minutes"
	@echo "make faults     plants faults in the C and in the derivation, each caught: docs/results/planted-faults.md; minutes"
	@echo "make traceability  mutants of every function, and the tests that notice them: docs/results/traceability.md; a quarter hour"
	@echo "make traceability-page  the same page with the lines of generated/ as they are now"
	@echo "make programme-picture  plans bench8's motion and draws it: docs/programme.svg"
	@echo "make design-campaign  how often few flywheels are found for simple motions: docs/results/design.md; a quarter of an hour"
	@echo "make excite-campaign  how much better excite determines free numbers: docs/results/excite.md; ten minutes"
	@echo "make plan-campaign  how often and how fast programmes are found: docs/results/planning.md, run-ups too; hours"
	@echo "make ocp-campaign  (13) by IPOPT on bench8 and random stands: docs/results/optimal-control.md; minutes"
	@echo "make jitter-campaign  jitter against the C, time of a sweep: docs/results/jitter.md, docs/results/jitter-sweep.md"
	@echo "make identify-campaign  unbalances of eight flywheels from data of the reference: docs/results/identification.md; half an hour"
	@echo "make linear-campaign  linear models against CasADi, steady states against the C: docs/results/linear.md, docs/results/response.md"
	@echo "make jitter-picture  the sweep that the README shows: docs/jitter.svg"
	@echo "make satellite-picture  the jitter of the satellite's tutorial: docs/satellite-jitter.svg"
	@echo "make held-pictures  runs the pages on held carriers, and keeps what they draw: docs/held-*.svg, docs/swing-up.svg"
	@echo "make response-picture  a sweep of bench8's speed: docs/response.svg"
	@echo "make quiet-campaign  how much quieter quiet makes sat4 and random satellites: docs/results/quiet.md; minutes"
	@echo "make balance-campaign  published cases of balancing, and times with measured data: docs/results/balancing.md"
	@echo "make bench      beside the peers, N = 2, 6, 8, 12: docs/results/benchmarks.md; .venv-bench, about ten minutes at first"
	@echo "make bench-full the same with N = 32, 64, of CasADi torque alone there (--patient: all, an hour)"
	@echo "make bench-quick  our own C and the reference alone, in half a minute, to the terminal"
	@echo "make bench-gate fails where instructions, stack or code have risen; ACCEPT=--accept accepts that"
	@echo "make proofs     Frama-C Eva on the C of the example stands, into docs/results/proofs.md, and the static checks"
	@echo "make proofs-quick  Frama-C Eva on demo3, some minutes"
	@echo "make static-checks  compilers, analyser, cppcheck with MISRA C:2012: fails at a new deviation"
	@echo "make static-checks-quick  the same for one of the example stands, as CI runs it"
	@echo "make commands-page  the --help of every command, into docs/commands.md"
	@echo "make lint       format, lint, types, and who imports whom"
	@echo "make docs       the pages of docs/ as a site: build/docs/index.html; any warning is an error"
	@echo "make clean      remove what the other targets made"

demo: setup
	$(BIN)/mahovik generate generator/mahovik/stands/bench8.toml -o build/demo/bench8
	$(BIN)/mahovik verify generator/mahovik/stands/bench8.toml

# Python keeps what it has compiled, even where the environment forbids it: tests start thousands of processes.
test test-slow test-all: export PYTHONDONTWRITEBYTECODE :=

test: demo setup-test
	$(BIN)/python -m pytest -q -n 2 --dist worksteal

# One case in five of each slow test, always the same ones (tests/toolchain/sampled.py).
test-slow: setup-test
	$(BIN)/python -m pytest -q -n 2 --dist worksteal -m slow

test-all: setup-test
	$(BIN)/python -m pytest -q -n 2 --dist worksteal -m 'not fuzz'

# A part that has passed is not run again: `rm -r build/nightly` begins again, `make PART` runs one.
NIGHTLY := test-all verify-targets cost-check bench-gate fuzz static-checks proofs faults traceability audits

nightly: setup-test
	@mkdir -p build/nightly
	@for part in $(NIGHTLY); do \
	  [ -e build/nightly/$$part.passed ] || { $(MAKE) $$part > build/nightly/$$part.log 2>&1 && touch build/nightly/$$part.passed; }; \
	  [ -e build/nightly/$$part.passed ] && echo "passed  $$part" || echo "FAILED  $$part: build/nightly/$$part.log"; \
	done; [ $$(ls build/nightly/*.passed | wc -l) -eq $(words $(NIGHTLY)) ]

net: setup-test
	$(BIN)/python tests/net/net.py

# Not compiled at once: less disk and time, and most modules are never imported. Those that commands import are compiled by
# running some, where the environment lets Python keep none: as pip does there, and every start takes half the time.
KEEPING := env -u PYTHONDONTWRITEBYTECODE -u PYTHONPYCACHEPREFIX MAHOVIK_CACHE=
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

generated: setup
	@for stand in $(EXAMPLES); do \
	  $(BIN)/mahovik generate generator/mahovik/stands/$$stand.toml -o generated/$$stand || exit 1; done

targets:
	tools/targets-packages.sh

verify-targets: setup-test
	$(BIN)/mahovik verify generator/mahovik/stands/bench8.toml --targets all
	@for stand in $(filter-out bench8,$(EXAMPLES)); do \
	  $(BIN)/mahovik verify generator/mahovik/stands/$$stand.toml --targets quick || exit 1; done

targets-table: setup-test
	$(BIN)/python tools/targets_table.py

cost: setup-test
	@for stand in $(EXAMPLES); do \
	  $(BIN)/mahovik cost generator/mahovik/stands/$$stand.toml -o generated/$$stand $(ACCEPT) || exit 1; done

cost-check: setup-test
	@for stand in $(EXAMPLES); do \
	  $(BIN)/mahovik cost generator/mahovik/stands/$$stand.toml -o generated/$$stand --check || exit 1; done

verify-campaign: setup-test
	$(BIN)/python tools/verify_campaign.py --stands 50 --write

rigorous: setup-test
	$(BIN)/python tools/rounding_campaign.py

math-campaign: setup-test
	$(BIN)/python tools/math_campaign.py

FUZZ_READERS := $(BIN)/python -m pytest -q -n 2 --dist worksteal -m fuzz tests/fuzz

fuzz: setup-test
	tools/fuzz-packages.sh
	$(BIN)/python tools/fuzz_campaign.py
	MAHOVIK_FUZZ_TIMES=20 $(FUZZ_READERS)

fuzz-quick: setup-test
	tools/fuzz-packages.sh
	$(BIN)/python tools/fuzz_campaign.py --quick
	$(FUZZ_READERS)

explain-campaign: setup-test
	$(BIN)/python tools/explain_campaign.py --write

terms-campaign: setup-test
	$(BIN)/python tools/terms_campaign.py --write

audits: setup-test
	$(BIN)/python tools/audits_campaign.py --write

flight: setup-test
	$(BIN)/python tools/flight.py

following-campaign: setup-test
	$(BIN)/python tools/following_campaign.py --write

pil: setup-test
	mkdir -p build/demo
	$(BIN)/mahovik plan generator/mahovik/stands/bench8.toml \
	  --motion generator/mahovik/stands/bench8.motion.json -o build/demo/programme.json
	$(BIN)/python tools/pil.py --programme build/demo/programme.json --write

control-loop: setup-test
	$(BIN)/python tools/control_loop.py

attitude-loop: setup-test
	$(BIN)/python tools/attitude_loop.py

held-cost: setup-test
	$(BIN)/python tools/held_cost.py

short-steps: setup-test
	$(BIN)/python tools/short_steps.py

api-speed: setup-test
	$(BIN)/python tools/api_speed.py

campaign-speed: setup-test
	$(BIN)/python tools/campaign_speed.py

tables-speed: setup-test
	$(BIN)/python tools/tables_speed.py

campaign-scale: setup-test
	$(BIN)/python tools/campaign_scale.py
	$(BIN)/python tools/campaign_scale.py --million

campaign-faults: setup-test
	$(BIN)/python tools/campaign_faults.py

verify-time: setup-test
	$(BIN)/python tools/verify_time.py

generation-time: setup-test
	$(BIN)/python tools/generation_time.py

install-size: setup-test
	$(BIN)/python tools/install_size.py

faults: setup-test
	$(BIN)/python tools/planted_faults.py

traceability: setup-test
	$(BIN)/python tools/traceability_campaign.py

traceability-page: setup-test
	$(BIN)/python tools/traceability_campaign.py --page

commands-page: setup-test
	$(BIN)/python tools/commands_page.py

identify-campaign: setup-test
	OPENBLAS_NUM_THREADS=1 $(BIN)/python tools/identify_campaign.py --write

jitter-campaign: setup-test
	$(BIN)/python tools/jitter_campaign.py --write

linear-campaign: setup-test
	$(BIN)/python tools/linear_campaign.py --write

held-pictures: setup-test
	$(BIN)/python tools/held_pictures.py

response-picture: setup-test
	$(BIN)/mahovik response generator/mahovik/stands/bench8.toml --at carrier \
	  --speed w1=0..600rpm --speed w2=-0.5*w1 --steps 61 -o docs/response.svg

jitter-picture: setup-test
	mkdir -p build/demo
	sed -n '/^```toml telescope.toml/,/^```$$/{/^```/!p}' README.md > build/demo/telescope.toml
	$(BIN)/mahovik response build/demo/telescope.toml --at carrier --speed wheel=0..4000rpm --steps 81 -o docs/jitter.svg

satellite-picture: setup-test
	mkdir -p build/demo
	for file in wheel bearing camera mask; do \
	  sed -n "/^\`\`\`csv $$file.csv/,/^\`\`\`$$/{/^\`\`\`/!p}" docs/tutorial-satellite.md > build/demo/$$file.csv; done
	cd build/demo && $(CURDIR)/$(BIN)/mahovik jitter $(CURDIR)/generator/mahovik/stands/eye4.toml \
	  --speed rw1=0..6000rpm --speed rw2=-rw1 --speed rw3=0.97*rw1 --speed rw4=-0.97*rw1 --steps 600 \
	  --sight camera.csv --harmonics all=wheel.csv --inner-modes all=bearing.csv -o $(CURDIR)/docs/satellite-jitter.svg

programme-picture: setup-test
	mkdir -p build/demo
	$(BIN)/mahovik plan generator/mahovik/stands/bench8.toml \
	  --motion generator/mahovik/stands/bench8.motion.json -o build/demo/programme.json
	$(BIN)/mahovik plot generator/mahovik/stands/bench8.toml --programme build/demo/programme.json \
	  --motion generator/mahovik/stands/bench8.motion.json -o docs/programme.svg

design-campaign: setup-test
	$(BIN)/python tools/design_campaign.py --write
balance-campaign: setup-test
	$(BIN)/python tools/balance_campaign.py
	$(BIN)/python tools/measured_speed.py

excite-campaign: setup-test
	$(BIN)/python tools/excite_campaign.py --write

quiet-campaign: setup-test
	$(BIN)/python tools/quiet_campaign.py --write

plan-campaign: setup-test
	$(BIN)/python tools/plan_campaign.py --stands 50 --first 50000 --jobs 2 --write
	$(BIN)/python tools/refusal_campaign.py --stands 50 --first 60000 --jobs 2 --write
	$(BIN)/python tools/runup_campaign.py --stands 10 --first 70000 --write

ocp-campaign: setup-test
	$(BIN)/python tools/ocp_campaign.py --write

bench: $(BENCH_READY)
	PYTHONPATH=bench:generator $(BENCH)/bin/python -m mahovik_bench bench

bench-full: $(BENCH_READY)
	PYTHONPATH=bench:generator $(BENCH)/bin/python -m mahovik_bench full

bench-quick: setup-test
	PYTHONPATH=bench:generator $(BIN)/python -m mahovik_bench quick

bench-gate: setup-test
	PYTHONPATH=bench:generator $(BIN)/python -m mahovik_bench gate $(ACCEPT)

$(BENCH_READY): bench/requirements.txt bench/constraints.txt
	$(PYTHON) -m venv $(BENCH)
	$(BENCH)/bin/python -m pip install --quiet --disable-pip-version-check -c bench/constraints.txt -r bench/requirements.txt
	@touch $(BENCH_READY)

proofs: setup-test static-checks
	$(BIN)/python tools/proofs.py --page

proofs-quick: setup-test
	tools/proofs-packages.sh
	$(BIN)/python tools/proofs.py --quick

static-checks: setup-test
	tools/proofs-packages.sh
	$(BIN)/python tools/static_checks.py --page

static-checks-quick: setup-test
	tools/proofs-packages.sh
	$(BIN)/python tools/static_checks.py --stands sat4

lint: setup-test
	$(BIN)/ruff check generator tests tools bench
	$(BIN)/ruff format --check generator tests tools bench
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache

docs: setup-test
	$(BIN)/python -m sphinx -W --keep-going -n -q -b html docs build/docs
	@echo "build/docs/index.html"

clean:
	rm -rf $(VENV) $(BENCH) build dist .pytest_cache .hypothesis .mypy_cache .ruff_cache
