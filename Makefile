# `make demo` and `make test` set up all they need: a virtual environment in .venv, and nqc where it is missing.

PYTHON ?= python3
VENV ?= .venv
BIN = $(VENV)/bin

.PHONY: demo test coverage thorough fuzz bench docs nqc clean

demo: $(VENV)/ready nqc
	$(BIN)/golc check examples/delivery/delivery.gl
	$(BIN)/golc gen-nqc examples/delivery/delivery.gl --compile
	$(BIN)/golc run examples/delivery/delivery.gl --world examples/delivery/delivery.toml \
		--events examples/delivery/requests.events --speed 20 --stop-when-idle 30 --picture examples/delivery/build/delivery.svg

test: $(VENV)/ready nqc
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy golc tests
	rm -rf build && $(BIN)/pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir build/wheel .
	tests/packaging/try-wheel $(PYTHON) build/wheel/*.whl
	$(MAKE) --no-print-directory docs
	$(BIN)/pytest -n auto -q

# Which lines and branches of golc the tests go through.
coverage: $(VENV)/ready nqc
	$(BIN)/pytest -n auto --cov --cov-report=term:skip-covered -q

# Property tests on 5,000 new examples each.
thorough: $(VENV)/ready nqc
	GOLC_EXAMPLES=5000 $(BIN)/pytest -q --timeout=3600 tests/syntax/test_round_trip.py tests/syntax/test_round_trip_through_python.py tests/syntax/test_format.py tests/situation tests/program/test_definitions.py

# The manual as a site: build/docs/index.html
docs: $(VENV)/ready
	$(BIN)/sphinx-build -W --keep-going -q -b html docs build/docs

bench: $(VENV)/ready
	$(BIN)/python tests/bench

# Mutants of every domain go through every command; what golc fails on is kept in build/fuzz.
fuzz: $(VENV)/ready
	$(BIN)/python tests/fuzz --minutes 10 --seed $$(date +%s)

$(VENV)/ready: pyproject.toml
	@echo "setting up $(VENV); this takes a minute"
	@$(PYTHON) -m venv $(VENV) || (tests/packaging/install python3-venv && $(PYTHON) -m venv $(VENV))
	@$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[dev]'
	@touch $@

nqc:
	@command -v nqc > /dev/null || tests/packaging/install nqc

clean:
	rm -rf $(VENV) build
