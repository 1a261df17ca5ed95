# make book | pdf | quick | test | mutants | lab | notebooks | students | solutions | bench | requirements | clean
# Needs Python 3.11, 3.12, 3.13 or 3.14 and nothing else.

# Looked for when it is first needed, and once.
PYTHON ?= $(eval PYTHON := $(firstword $(foreach name,python3 python3.14 python3.13 python3.12 python3.11,$(shell \
    $(name) -c "import sys; (3, 11) <= sys.version_info < (3, 15) and print('$(name)')" 2>/dev/null))))$(PYTHON)
BIN := .venv/bin
VENV := .venv/.installed
PEERS := .venv/bench/.installed
# Fixed seeds and dates, or two builds would differ.
BUILD := PYTHONHASHSEED=0 SOURCE_DATE_EPOCH=1795478400 \
    $(BIN)/jupyter-book build . --all -W -n --keep-going

PYTEST := $(BIN)/python -m pytest --numprocesses auto --maxprocesses 4
BY_FILE := --dist loadfile --no-loadscope-reorder
# Its import takes every process a second, and only notebooks need it.
WITHOUT_NBVAL := -p no:nbval --override-ini addopts="--doctest-modules --import-mode=importlib -q"
# Notebooks and tests run side by side: threads for small matrices would only stand in their way.
export OPENBLAS_NUM_THREADS := 1

.PHONY: book pdf printer readings lint quick test mutants lab notebooks students solutions bench twice requirements clean

book: $(VENV) readings
	@echo "Building the book (two minutes) ..."
	@$(BUILD)

# What the book is about to be made from; an unusable file ends it here.
readings: $(VENV)
	@echo "Reading the spring data ..."
	@$(BIN)/python -m suspension.springs

lint: $(VENV)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

# After every change: under a minute, and no book is needed. Tests marked slow wait for `make test`.
quick: lint
	$(PYTEST) --dist worksteal -m "not slow" $(WITHOUT_NBVAL) tests/unit suspension

# Before a change is handed in: everything. The book takes what nbval has executed a moment before, and
# is built beside the tests that need none, by one process. What it says stands below what they say.
test: readings lint
	$(PYTEST) $(BY_FILE) notebooks
	@echo "Building the book, beside the tests that need none ..."
	@mkdir -p _build; trap 'kill $$book' INT TERM; $(BUILD) >_build/build.log 2>&1 & book=$$!; \
	    $(PYTEST) $(BY_FILE) -m "not built" tests suspension; failed=$$?; \
	    wait $$book || failed=$$?; cat _build/build.log; exit $$failed
	$(PYTEST) $(BY_FILE) -m built $(WITHOUT_NBVAL) tests/book tests/browser tests/unit/test_explorer_page.py

# Do the tests notice? Changes the core, one operator or number at a time, and runs its unit tests.
# MODULES="robot critical" picks some, SAMPLE=40 takes so many of each.
mutants: $(VENV)
	$(BIN)/python tests/mutants.py $(if $(SAMPLE),--sample $(SAMPLE)) $(MODULES)

# The root is this folder, so that links between notebooks and pages work. JupyterLab shows the stored
# figures, which are SVG, in notebooks that it trusts.
lab: $(VENV)
	@$(BIN)/jupyter trust notebooks/*.ipynb >/dev/null
	$(BIN)/jupyter lab --config=book/_lab/jupyter_server_config.py --KernelManager.transport_encryption=auto $(if $(filter 0,$(shell id -u)),--allow-root)

# The answer sheet and the whole book, as _build/pdf/*.pdf; needs Chromium.
pdf: printer book
	@echo "Printing the book (a minute) ..."
	@$(BIN)/python book/paper.py

# Before the book is built: what will print it?
printer: $(VENV)
	@$(BIN)/python book/paper.py --check

# Executes every notebook and stores what the tests compare, nothing else.
notebooks: $(VENV)
	@echo "Executing the notebooks (a minute) ..."
	@$(BIN)/python notebooks/normalise.py notebooks/*.ipynb notebooks/workbook/*.ipynb

# The notebooks to hand out: without solutions and answers, and the lecturer's copy, its blanks filled.
students solutions: $(VENV)
	@echo "Packing the notebooks (a moment) ..."
	@$(BIN)/python book/_ext/students.py $@

# Speed, beside what one would otherwise use; BENCH=--book times the book and its tests as well.
bench: $(PEERS)
	.venv/bench/bin/python benchmarks/run.py $(BENCH)

# Are two builds from clean copies the same, byte for byte?
twice: $(VENV)
	$(BIN)/python tests/twice.py

# Pins what pyproject.toml allows, with hashes; what is pinned stays, unless UPGRADE=--upgrade.
requirements: $(VENV)
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --all-extras --generate-hashes \
	    --no-annotate --custom-compile-command "make requirements" $(UPGRADE) \
	    --output-file requirements.txt pyproject.toml

clean:
	rm -rf .venv _build book/npm/node_modules

# uv installs in seconds what takes pip a minute; where only pip finds packages, pip does it.
$(VENV): requirements.txt pyproject.toml
	$(if $(PYTHON),,$(error No Python 3.11, 3.12, 3.13 or 3.14 found; name one: make PYTHON=/path/to/python3))
	@$(PYTHON) -c "import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 15))" || \
	    { echo "$(PYTHON) is not Python 3.11, 3.12, 3.13 or 3.14"; exit 1; }
	@$(PYTHON) -c "import venv, ensurepip" 2>/dev/null || \
	    { echo "$(PYTHON) cannot make environments; on Debian: apt install python3-venv"; exit 1; }
	@echo "Setting up the environment in .venv (a minute) ..."
	@$(PYTHON) -m venv .venv
	@sed -n '/^uv==/,/[^\\]$$/p' requirements.txt >.venv/uv.txt
	@$(BIN)/python -m pip install --quiet --require-hashes --requirement .venv/uv.txt && \
	    $(BIN)/uv pip install --quiet --compile-bytecode --python $(BIN)/python --require-hashes --requirement requirements.txt || \
	    $(BIN)/python -m pip install --quiet --require-hashes --requirement requirements.txt || \
	    { echo "pip could not install requirements.txt; is there a network?"; exit 1; }
	@$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@

$(PEERS): requirements-bench.txt | $(VENV)
	@echo "Setting up the environment of the benchmark in .venv/bench (a minute) ..."
	@$(BIN)/python -m venv .venv/bench
	@$(BIN)/uv pip install --quiet --python .venv/bench/bin/python --require-hashes -r requirements.txt
	@$(BIN)/uv pip install --quiet --python .venv/bench/bin/python -r requirements-bench.txt
	@.venv/bench/bin/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@
