# Every target makes its own virtual environment when it is missing or out of date.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
REPORT := reproduction

.DEFAULT_GOAL := help
.PHONY: help setup reproduce verify test bench check wheel lab format screenshots clean

help: ## Say what the targets do
	@sed -n 's/^\([a-z]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 20

setup: $(VENV)/installed ## Make the virtual environment

$(VENV)/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[test,app]'
	@touch $@

reproduce: $(VENV)/installed ## Regenerate the figures and tables on bundled data
	$(BIN)/workbench reproduce --profile quick --out $(REPORT)

verify: reproduce ## Check the report as a whole
	$(BIN)/python -m tests.check_report $(REPORT)

test: $(VENV)/installed ## Run all tests
	$(BIN)/python -m pytest --numprocesses 2 --dist loadfile --no-loadscope-reorder

bench: $(VENV)/installed ## Measure the hot paths beside their baselines
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable '.[bench]'
	$(BIN)/python -m tests.benchmarks

check: $(VENV)/installed ## Check style, types, imports and notebooks
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python tests/check_notebooks.py notebooks

wheel: ## Build the wheel and use it in a clean environment
	tests/packaging/check_wheel.sh $(PYTHON)

format: $(VENV)/installed ## Format the code
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

lab: $(VENV)/installed ## Open the notebooks in JupyterLab
	$(BIN)/workbench lab

screenshots: $(VENV)/installed ## Make the pictures of the README again
	$(BIN)/python -m tests.browser.make_screenshots docs/images
	$(BIN)/workbench reproduce --out $(REPORT)
	$(BIN)/python -m tests.notebooks.screenshot_report $(REPORT) docs/images/report.png 1280 1400

clean: ## Remove everything that was made
	rm -rf $(VENV) $(REPORT) dist build
