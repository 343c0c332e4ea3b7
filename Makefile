# Two commands do everything: `make reports` and `make test`. All set up `.venv` themselves.
VENV := .venv
PYTHON ?= python3
READY := $(VENV)/.ready

.PHONY: reports advice test quick lint bench install clean

reports: $(READY)
	$(VENV)/bin/textmech run --causes
	$(VENV)/bin/textmech page

# Which settings every case needs: minutes of search, which `reports` does not take.
advice: $(READY)
	$(VENV)/bin/textmech advise --all

test: $(READY)
	$(VENV)/bin/pytest -n auto --dist worksteal

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
