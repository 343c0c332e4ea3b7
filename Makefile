# Two commands do everything: `make reports` and `make test`. All set up `.venv` themselves.
VENV := .venv
PYTHON ?= python3
READY := $(VENV)/.ready

.PHONY: reports advice test processors quick lint mutants bench install clean

reports: $(READY)
	$(VENV)/bin/textmech run --causes
	$(VENV)/bin/textmech page

# Which settings every case needs: minutes of search, which `reports` does not take.
advice: $(READY)
	$(VENV)/bin/textmech advise --all

test: $(READY)
	$(VENV)/bin/pytest -n auto --dist worksteal

# Whether the tests hang on rounding: all of them as other processors would run them, hours of work;
# fewer by WHAT, as `make processors WHAT=tests/reference`.
processors: $(READY)
	$(VENV)/bin/python tests/processors.py -n auto --dist worksteal $(WHAT)

# What a change of one file needs: its style and types, and the tests of its room but for those
# marked `whole`, which solve or run all shipped cases or take long.
quick: $(READY)
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	mkdir -p $(VENV)/typing && ln -sfn ../.. $(VENV)/typing/textmech
	$(VENV)/bin/pyright $$($(VENV)/bin/python tests/touched.py --files)
	$(VENV)/bin/pytest -q -n auto -m "not whole" $$($(VENV)/bin/python tests/touched.py)

lint: $(READY)
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	mkdir -p $(VENV)/typing && ln -sfn ../.. $(VENV)/typing/textmech
	$(VENV)/bin/pyright

# How many of COUNT mistakes, drawn by chance and planted in a copy, the tests see at the first try.
COUNT ?= 150
SEED ?= 1
mutants: $(READY)
	$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check \
		--constraint reports/environment.txt --editable '.[mutants]'
	$(VENV)/bin/python tests/mutants.py --count $(COUNT) --seed $(SEED)

bench: $(READY)
	$(VENV)/bin/textmech bench

install: $(READY)

clean:
	rm -rf $(VENV)

$(READY): pyproject.toml reports/environment.txt
	$(PYTHON) -m venv --clear $(VENV)
	$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check \
		--constraint reports/environment.txt --editable '.[test]'
	touch $@
