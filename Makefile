# What a person or a CI machine runs. `make help` lists it.

PYTHON ?= python3
ARGS ?=
UPGRADE ?=

VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet install
COMPILE := $(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes \
	--no-emit-index-url --no-header
WEB_SOURCES := $(shell find web -type f -not -path '*/node_modules/*' -not -path '*/dist/*' 2>/dev/null)

# The tools of the environment come first, among them the stand-ins of .ci/ensure-node.
export PATH := $(CURDIR)/$(BIN):$(PATH)
MAKEFLAGS += --no-print-directory

.DEFAULT_GOAL := help
.PHONY: help setup run test lint format audit sbom bench bench-vision shots campaign calibrations \
	fuzz fuzz-api fuzz-guided hostile kill rig board lock clean \
	setup-dev system-packages \
	check-style check-types check-web test-together test-alone test-web

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-12s %s\n", $$1, $$2}' Makefile

setup: $(VENV)/.project ## install PlugPilot and build its pages, once

run: setup ## start PlugPilot; options of `plugpilot serve` go into ARGS="..."
	@exec $(BIN)/plugpilot serve $(ARGS)

test: setup-dev system-packages ## run every check and every test, as CI does
	@$(MAKE) --keep-going check-style check-types check-web test-together test-alone test-web

lint: setup-dev ## check style and types only
	@$(MAKE) --keep-going check-style check-types check-web

format: setup-dev ## lay the Python sources out and mend what can be mended
	@$(BIN)/ruff check --fix --quiet .
	@$(BIN)/ruff format --quiet .

audit: $(VENV)/.audit web/node_modules/.package-lock.json ## look for known weaknesses in what is used (asks the registries)
	@$(BIN)/pip-audit --progress-spinner off --strict --require-hashes --disable-pip --requirement requirements.lock
	@cd web && npm audit --audit-level=low

sbom: $(VENV)/.audit web/node_modules/.package-lock.json ## list all parts with licences and hashes, CycloneDX, into build/
	@mkdir -p build
	@$(BIN)/cyclonedx-py requirements --output-reproducible --output-file build/sbom-python.json \
		requirements.lock
	@cd web && npm sbom --package-lock-only --sbom-format cyclonedx >../build/sbom-web.json
	@echo "build/sbom-python.json build/sbom-web.json"

bench: setup-dev ## run the benchmarks
	@for file in tests/bench/[a-z]*.py; do \
		name=$$(basename $$file .py); echo "-- $$name"; \
		$(BIN)/python -m tests.bench.$$name || exit 1; \
	done

bench-vision: setup-dev ## compare ways of locating the label; --quick, --frames N in ARGS
	@$(BIN)/python -m tests.bench.vision --out build $(ARGS)

rig: setup-dev system-packages ## test the real firmware at length: fault by fault, step by step
	@$(BIN)/pytest --no-header tests/rig tests/rig/campaign $(ARGS)

board: setup system-packages ## a simulated board with the real firmware, for serve --driver arduino
	@exec $(BIN)/python -m tests.rig $(ARGS)

shots: setup-dev system-packages ## take a picture of every page and state into build/shots; STATE... in ARGS
	@mkdir -p build/shots
	@$(BIN)/python -m tests.browser.shots build/shots $(ARGS)

campaign: setup ## plug in 100 simulated cars; options of `plugpilot simulate campaign` in ARGS
	@$(BIN)/plugpilot simulate campaign $(ARGS)

calibrations: setup ## calibrate 10 badly built robots, passing over those done; --seeds 0-199 in ARGS
	@mkdir -p build
	@$(BIN)/plugpilot simulate calibration --seeds 0-9 --keep build/calibrations.jsonl $(ARGS)

fuzz-guided: setup-dev $(VENV)/.guided ## the same for what reads foreign bytes, led by coverage; x86-64 only; --minutes N in ARGS
	@$(BIN)/python -m tests.campaign.fuzz.guided $(ARGS)

hostile: setup-dev ## 1000 times a hostile energy manager at a random moment; --timings N in ARGS
	@$(BIN)/python -m tests.campaign.hostile $(ARGS)

fuzz: setup-dev ## send everything that comes from outside something strange; FUZZ_MINUTES=60
	@$(BIN)/python -m tests.campaign.fuzz --minutes $${FUZZ_MINUTES:-60} $(ARGS)

fuzz-api: setup-dev ## send the API thousands of requests, good and bad; FUZZ_EXAMPLES=N for each
	@FUZZ_EXAMPLES=$${FUZZ_EXAMPLES:-300} $(BIN)/pytest --no-header tests/server/api/fuzz $(ARGS)

kill: setup-dev ## kill the server 200 times in the middle of jobs; --kills, --seed, --speed in ARGS
	@$(BIN)/python -m tests.campaign.kill.entries
	@$(BIN)/python -m tests.campaign.kill $(ARGS)

lock: $(BIN)/python ## write the lock files; UPGRADE=--upgrade takes the newest allowed versions
	@$(PIP) "uv>=0.8,<1"
	@$(COMPILE) $(UPGRADE) pyproject.toml --group build --output-file requirements.lock
	@$(COMPILE) $(UPGRADE) pyproject.toml --group build --group dev \
		--constraints requirements.lock --output-file requirements-dev.lock
	@$(COMPILE) $(UPGRADE) --group node --output-file requirements-node.lock
	@$(COMPILE) $(UPGRADE) --group audit --output-file requirements-audit.lock
	@$(COMPILE) $(UPGRADE) --group guided --output-file requirements-guided.lock

clean: ## remove everything that was installed or built, but no data
	@rm -rf $(VENV) server/static web/node_modules dist build \
		.mypy_cache .pytest_cache .ruff_cache .hypothesis

# --- parts of the checks ------------------------------------------------------------------------

check-style:
	@echo "-- style"
	@$(BIN)/ruff check --quiet .
	@$(BIN)/ruff format --quiet --check --diff .

check-types:
	@echo "-- types"
	@$(BIN)/mypy --no-error-summary

check-web: web/node_modules/.package-lock.json
	@echo "-- types of the web pages"
	@cd web && npm run --silent check

# Promises in seconds of the wall clock, hands on real buttons and a board in real time: they get
# the machine to themselves. All others live in virtual time, or have patience.
ALONE = tests/browser/test_technician.py tests/drivers/camera tests/rig/device \
	tests/server/test_connections.py tests/server/test_serving.py tests/server/test_timing.py

test-together:
	@echo "-- tests, two at a time"
	@$(BIN)/pytest --no-header --numprocesses 2 --dist loadfile $(ALONE:%=--ignore=%)

test-alone:
	@echo "-- tests that need the machine to themselves"
	@$(BIN)/pytest --no-header $(ALONE)

test-web: web/node_modules/.package-lock.json
	@echo "-- tests of the web pages"
	@cd web && npm test --silent

# --- what is installed, each with a stamp -------------------------------------------------------

setup-dev: setup $(VENV)/.development

system-packages:
	@.ci/install-system-packages .ci/system-packages.txt

$(BIN)/python:
	@$(PYTHON) .ci/check_python.py
	@$(PYTHON) -m venv $(VENV)

$(VENV)/.requirements: requirements.lock | $(BIN)/python
	@echo "Installing the requirements (once, about a minute) ..."
	@$(PIP) --no-compile --require-hashes --requirement requirements.lock
	@touch $@

# Byte code of the requirements is made by all processors, while the pages are being built.
$(VENV)/.project: $(VENV)/.requirements pyproject.toml $(WEB_SOURCES)
	@.ci/ensure-node $(BIN)
	@echo "Building the web pages and installing PlugPilot ..."
	@$(BIN)/python -m compileall -qq -j 0 $(VENV)/lib server twin drivers & \
		$(PIP) --no-deps --no-build-isolation --editable .; built=$$?; wait; exit $$built
	@touch $@

$(VENV)/.development: $(VENV)/.requirements requirements-dev.lock
	@echo "Installing the tools for the checks ..."
	@$(PIP) --require-hashes --requirement requirements-dev.lock
	@touch $@

$(VENV)/.guided: requirements-guided.lock | $(VENV)/.requirements
	@echo "Installing the fuzzer that is led by coverage ..."
	@$(PIP) --require-hashes --requirement requirements-guided.lock
	@touch $@

$(VENV)/.audit: requirements-audit.lock | $(VENV)/.requirements
	@echo "Installing the tools for the audit ..."
	@$(PIP) --require-hashes --requirement requirements-audit.lock
	@touch $@

web/node_modules/.package-lock.json: web/package-lock.json | $(VENV)/.project
	@cd web && npm ci --silent
	@touch $@
