PYTHON ?= python3
BIN := .venv/bin
EXTRAS := rerun,tune,parquet,plot,dxf,ros2,zenoh
# Tests of one file stay together, since they share a server, and in the order of tests/conftest.py.
PYTEST := $(BIN)/pytest --dist loadfile --no-loadscope-reorder -n
.PHONY: run install quick test check check-page dist clean

run: .venv/installed
	$(BIN)/lineseg $(ARGS)

# More of the extras: make install EXTRAS=cluster
install: .venv/installed
	$(BIN)/pip install --quiet -c constraints.txt -e '.[$(EXTRAS)]'

# Tests start many programs, which begin sooner if Python's compiled modules are kept, whatever the environment says.
quick test: export PYTHONDONTWRITEBYTECODE =

# What needs neither a server nor a browser, with fewer made examples.
quick: .venv/installed-dev
	$(PYTEST) 2 -m "not server" --ignore=tests/browser --hypothesis-profile quick

# Two for each of the two cores, since a browser, its server and its test wait for each other.
test: .venv/installed-dev
	$(PYTEST) 4

check: .venv/installed-dev check-page
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/pyright

ifneq ($(shell command -v npm),)
check-page: node_modules/installed
	npm run --silent check
else
check-page:
	@echo "npm is missing: the page in static/ is not checked."
	@test -z "$$LINESEG_NOTHING_SKIPPED"
endif

.venv/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet -c constraints.txt -e '.[$(EXTRAS)]'
	touch $@

.venv/installed-dev: .venv/installed
	$(BIN)/pip install --quiet -c constraints.txt -e '.[dev]'
	touch $@

node_modules/installed: package.json
	npm install --silent --no-package-lock --no-audit --no-fund
	touch $@

dist: .venv/installed-dev
	rm -rf dist
	$(BIN)/python -m build --no-isolation
	$(BIN)/twine check --strict dist/*

clean:
	rm -rf .venv node_modules build dist *.egg-info
