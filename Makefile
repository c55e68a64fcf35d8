PYTHON ?= python3
BIN := .venv/bin
.PHONY: run test check clean

run: .venv/installed stale-kernels
	$(BIN)/lineseg $(ARGS)

test: .venv/installed-dev stale-kernels
	$(BIN)/pytest

# numba's cache does not see that a kernel of another file has changed.
.PHONY: stale-kernels
stale-kernels:
	@newest=$$(find lineseg -name '*.py' -printf '%T@ %p\n' | sort -rn | head -n 1 | cut -d' ' -f2-); \
	find lineseg -name '*.nb[ic]' ! -newer "$$newest" -delete

check: .venv/installed-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/pyright

.venv/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet -c constraints.txt -e '.[rerun,tune]'
	touch $@

.venv/installed-dev: .venv/installed
	$(BIN)/pip install --quiet -c constraints.txt -e '.[dev]'
	touch $@

clean:
	rm -rf .venv build *.egg-info
