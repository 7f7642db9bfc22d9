# Everything a newcomer needs: `make demo` to see it work, `make test` to see it tested. `make` alone lists all targets.
#
# Set-ups are recorded by stamp files in the virtual environment and redone only when a lock or pyproject.toml changes.
# uv installs: the one on the PATH, or one that pip puts into the environment first where it asks the usual index, for
# uv knows no other of pip's. Where there is none, or it fails, pip does. All check the hashes in the locks. Byte-code of
# what the command needs is written then, on all cores, of what compiles (packages hold files for other versions of
# Python, too): it starts fast even where Python may not write it later.

SHELL := /bin/bash
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

VENV := .venv
BIN := $(VENV)/bin
PY := $(BIN)/python

# The first interpreter that runs and is new enough; override with `make setup PYTHON=...`. Looked up only where needed.
PYTHON ?= $(shell for p in python3.11 python3.12 python3.13 python3; do \
	"$$p" -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1 && { echo "$$p"; break; }; done)
UV := $(shell uv --version >/dev/null 2>&1 && echo uv)
# In one process for each core; `make test PYTEST_ARGS=-x` and the like take other arguments instead.
PYTEST_ARGS ?= -n auto --dist worksteal
LOCK_ARGS ?=

PIP_INSTALL := $(PY) -m pip install -qq --no-input --disable-pip-version-check --no-compile

# $(call install,LOCK): what the lock names, then this project itself, editable and without looking anywhere else.
define install
	@echo "setting up from $(1)"
	@set -e; uv="$(UV)"; \
	has_pip() { $(PY) -m pip --version >/dev/null 2>&1 || $(PY) -m ensurepip >/dev/null 2>&1; }; \
	own_uv() { \
		has_pip && ! $(PY) -m pip config list 2>/dev/null | grep -q '[.]index-url=' && \
		sed -n '/^uv==/,/[^\\]$$/p' $(1) >$(VENV)/uv.lock && $(PIP_INSTALL) --require-hashes -r $(VENV)/uv.lock && \
		uv=$(BIN)/uv && export UV_CACHE_DIR=$(VENV)/uv.cache UV_SYSTEM_CERTS=1; }; \
	by_uv() { \
		"$$uv" pip install --quiet --python $(PY) --require-hashes -r $(1) && \
		"$$uv" pip install --quiet --python $(PY) --no-deps --no-build-isolation -e . ; }; \
	by_pip() { \
		has_pip || { \
			echo "pip is missing from $(VENV) and cannot be added: install the venv package of your Python" >&2; exit 1; }; \
		$(PIP_INSTALL) --require-hashes -r $(1) && $(PIP_INSTALL) --no-deps --no-build-isolation -e . ; }; \
	[ -n "$$uv" ] || own_uv || true; \
	if [ -n "$$uv" ]; then by_uv || { echo "uv could not install; trying pip" >&2; by_pip; }; else by_pip; fi; \
	rm -rf $(VENV)/uv.cache $(VENV)/uv.lock
endef

.PHONY: help
help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-8s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

.PHONY: setup
setup: $(VENV)/core.stamp ## Make .venv with what the command needs

.PHONY: dev
dev: $(VENV)/dev.stamp ## Make .venv with what tests, checks and documentation need too

.PHONY: demo
demo: $(VENV)/core.stamp ## Run the example scenario; the page to open is runs/demo/index.html
	$(BIN)/scenewright run examples/demo.txt --out runs/demo
	@echo "To see it, open runs/demo/index.html in a browser, or type: $(BIN)/scenewright view runs/demo"

.PHONY: test
test: $(VENV)/dev.stamp browser ## Run all tests
	$(BIN)/pytest $(PYTEST_ARGS)

.PHONY: check
check: $(VENV)/dev.stamp docs ## Types, style, import contract, documentation
	$(BIN)/mypy --strict src
	$(BIN)/ruff check --no-cache  # where an import comes from changes without its file
	$(BIN)/ruff format --check
	$(BIN)/lint-imports

.PHONY: docs
docs: $(VENV)/dev.stamp ## Build the documentation, warnings as errors
	$(BIN)/sphinx-build --quiet --builder html --nitpicky --fail-on-warning --keep-going docs docs/_build/html

.PHONY: forms
forms: $(VENV)/dev.stamp ## Ask anew what each stage does with every form of constraint (docs/forms.md, minutes)
	$(PY) tools/forms_table.py

.PHONY: lock
lock: $(VENV)/core.stamp ## Resolve both locks again (LOCK_ARGS=--upgrade moves to newer versions)
	$(lock_command) --all-extras --group dev -o requirements-dev.lock
	$(lock_command) --group build --constraint requirements-dev.lock -o requirements.lock
	@! grep -n '://' requirements.lock requirements-dev.lock

# Locks hold names, versions and hashes, but no address: each machine keeps its own package index.
lock_command = $(or $(UV),$(BIN)/uv) pip compile pyproject.toml --quiet --universal --python-version 3.11 --generate-hashes --no-header \
	--no-annotate --no-strip-extras --no-emit-index-url --no-emit-find-links $(LOCK_ARGS)

.PHONY: clean
clean: ## Remove the environment, caches and everything built
	rm -rf $(VENV) build dist docs/_build .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +

# The page's tests drive the system's Chromium; without it they skip, or fail where SCENEWRIGHT_REQUIRE_BROWSER=1.
.PHONY: browser
browser:
	@if command -v chromium chromium-browser google-chrome >/dev/null; then :; \
	elif ! command -v apt-get >/dev/null; then \
		echo "no Chromium here and no apt-get to install it: tests of the page will be skipped"; \
	elif [ "$$(id -u)" != 0 ]; then \
		echo "no Chromium here and only root may install it (apt-get install chromium): tests of the page will be skipped"; \
	else \
		echo "installing Chromium for the tests of the page"; \
		export DEBIAN_FRONTEND=noninteractive; \
		{ apt-get update -qq && apt-get install -y -qq --no-install-recommends chromium fonts-dejavu-core; } \
			</dev/null >/dev/null || echo "apt-get could not install Chromium: tests of the page will be skipped"; \
	fi

$(PY):
	@[ -n "$(PYTHON)" ] || { echo "Python 3.11 or newer is needed; none found on the PATH (or name one: make PYTHON=...)" >&2; exit 1; }
	@if [ -n "$(UV)" ]; then uv venv --quiet --allow-existing --no-python-downloads --python "$$(command -v $(PYTHON))" $(VENV) \
		|| $(PYTHON) -m venv $(VENV); else $(PYTHON) -m venv $(VENV); fi

$(VENV)/core.stamp: requirements.lock pyproject.toml | $(PY)
	$(call install,requirements.lock)
	@$(PY) -m compileall -q -j 0 $(VENV)/lib src >/dev/null || true
	@touch $@

$(VENV)/dev.stamp: requirements-dev.lock $(VENV)/core.stamp
	$(call install,requirements-dev.lock)
	@touch $@
