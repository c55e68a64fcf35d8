PYTHON ?= python3
BIN := .venv/bin
EXTRAS := rerun,tune,parquet,plot
.PHONY: run install test check dist clean

run: .venv/installed
	$(BIN)/lineseg $(ARGS)

# More of the extras: make install EXTRAS=cluster
install: .venv/installed
	$(BIN)/pip install --quiet -c constraints.txt -e '.[$(EXTRAS)]'

test: .venv/installed-dev
	$(BIN)/pytest

check: .venv/installed-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/pyright

.venv/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet -c constraints.txt -e '.[$(EXTRAS)]'
	touch $@

.venv/installed-dev: .venv/installed
	$(BIN)/pip install --quiet -c constraints.txt -e '.[dev]'
	touch $@

dist: .venv/installed-dev
	rm -rf dist
	$(BIN)/python -m build --no-isolation
	$(BIN)/twine check --strict dist/*

clean:
	rm -rf .venv build dist *.egg-info
