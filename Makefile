# Two commands do what most need: `make reports` and `make test`. All set up `.venv` themselves.
VENV := .venv
PYTHON ?= python3
READY := $(VENV)/.ready
LINTING := $(VENV)/.linting
INSTALL := $(VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-compile \
	--constraint reports/environment.txt --editable
# What is compiled is kept: else every worker compiles all modules and all tests anew.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help reports advice test test-slow test-all everywhere processors quick lint mutants models speed bench install clean

# What can be made; `make` alone says it too.
help:
	@awk '/^# /{text = text substr($$0, 2)} \
	/^[a-z-]+:/{if (text) printf "make %-11s%s\n\n", substr($$1, 1, index($$1, ":") - 1), text} \
	!/^#/{text = ""}' Makefile | fold -s -w 100

# Every CSV report anew, with causes, and their page.
reports: $(READY)
	$(VENV)/bin/textmech run --causes --page

# Which settings every case needs: minutes of search, which `reports` does not take.
advice: $(READY)
	$(VENV)/bin/textmech advise --all

# Every engine on every case, and all tests but the slow ones.
test: $(READY)
	$(VENV)/bin/pytest -n auto --dist worksteal -m "not slow"

# The slow ones alone.
test-slow: $(READY)
	$(VENV)/bin/pytest -n auto --dist worksteal -m slow

# Everything.
test-all: test test-slow

# Whether it installs and works without pins: the lowest and the newest versions that pyproject.toml
# allows, on each Python from 3.11 to 3.14 that is here, with all quick tests; fewer by WHAT, as
# `make everywhere WHAT="--python 3.12 tests/cases"` or `WHAT=--smoke`.
everywhere: $(READY)
	$(VENV)/bin/python tests/everywhere.py $(WHAT)

# Whether the tests hang on rounding: all of them as other processors would run them, hours of work;
# fewer by WHAT, as `make processors WHAT=tests/reference`.
processors: $(READY)
	$(VENV)/bin/python tests/processors.py -n auto --dist worksteal $(WHAT)

TUNED := mujoco.tuned pymunk.tuned
# What a change of one file needs: its style and types, the quick tests of its room, and some shipped
# cases that execute it, by their tuned engines.
quick: $(LINTING)
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	mkdir -p $(VENV)/typing && ln -sfn ../.. $(VENV)/typing/textmech
	$(VENV)/bin/pyright $$($(VENV)/bin/python tests/touched.py --files)
	$(VENV)/bin/pytest -q -n auto -m "not slow" $(addprefix --textmech-engine=,$(TUNED)) \
		$$($(VENV)/bin/python tests/touched.py)

# Style and types.
lint: $(LINTING)
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	mkdir -p $(VENV)/typing && ln -sfn ../.. $(VENV)/typing/textmech
	$(VENV)/bin/pyright

COUNT ?= 150
SEED ?= 1
# How many of COUNT mistakes, drawn by chance and planted in a clone, `make quick` sees.
mutants: $(READY)
	$(INSTALL) '.[mutants]'
	$(VENV)/bin/python tests/mutants.py --count $(COUNT) --seed $(SEED)

# How the models that gymnasium and dm-control ship step: minutes of search.
models: $(READY)
	$(VENV)/bin/python tests/public_models.py

# What a person waits for, in a fresh clone of the last commit: half an hour of an idle machine.
speed: $(READY)
	$(VENV)/bin/python tests/speed.py

# What adapters cost over plain loops, and integrators over scipy's: minutes; of less by WHAT, as
# `make bench WHAT="four_bar --engine mujoco"`, and `WHAT=--help` tells the rest.
bench: $(READY)
	PYTHONPATH=tests $(VENV)/bin/python -m bench $(WHAT)

# The package and what its tests need, in `.venv`; every other target does it by itself.
install: $(READY)

# `.venv` is removed.
clean:
	rm -rf $(VENV)

$(READY): pyproject.toml reports/environment.txt
	$(PYTHON) -m venv --clear $(VENV)
	$(INSTALL) '.[test]'
	touch $@

# What only lint needs is a third of all.
$(LINTING): $(READY)
	$(INSTALL) '.[lint]'
	touch $@
