# make demo    install, build the FMU, run a scene, write a result, a picture and a table
# make test    install with the test tools, lint, check types, run the tests
# make clean   remove what these made
#
# Needs Python 3.11 or later. A C compiler makes the kernel about fifty times faster; without one it runs interpreted.

PYTHON ?= $(shell for python in python3.13 python3.12 python3.11 python3.14 python3 python; do \
	$$python -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null \
	&& echo $$python && break; done)
SCENE ?= pickup_udds

BIN := .venv/bin
DEMO := build/demo
# What the installed metadata and the compiled kernel are made of; other sources run from where they stand.
INSTALLED_FROM := pyproject.toml setup.py $(wildcard fmu_src/cardan_kernel/*.py fmu_src/cardan_kernel/*.pxd) \
	build_scripts/cardan_build/amalgamate.py build_scripts/cardan_build/extension.py
PIP_INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check

.PHONY: demo test clean
.DELETE_ON_ERROR:

demo: .venv/.installed
	@mkdir -p $(DEMO)
	$(BIN)/cardan build -o $(DEMO)/CardanDriveline.fmu
	$(BIN)/cardan simulate $(SCENE) -o $(DEMO)/$(SCENE).csv --plot $(DEMO)/$(SCENE).png
	@echo "written: $(DEMO)/CardanDriveline.fmu $(DEMO)/$(SCENE).csv $(DEMO)/$(SCENE).png"

test: .venv/.test
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/pytest -n 2

clean:
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis fmu_src/cardan_kernel/_compiled*
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
	rm -rf fmu_src/*.egg-info

.venv/.python:
	@test -n "$(PYTHON)" || { echo "make needs Python 3.11 or later with venv and ensurepip (on Debian: python3-venv);" \
	"name it with: make PYTHON=/path/to/python3 ..." >&2; exit 2; }
	$(PYTHON) -m venv .venv
	@touch $@

.venv/.installed: $(INSTALLED_FROM) | .venv/.python
	$(PIP_INSTALL) -e .
	@touch $@

.venv/.test: $(INSTALLED_FROM) | .venv/.python
	$(PIP_INSTALL) -e '.[test]'
	@touch $@ .venv/.installed
