"""Every example in a docstring and in the README runs and prints what it says."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import pytest

import courant_stability

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL
README = Path(__file__).parent.parent / "README.md"
MODULES = [name for _, name, _ in pkgutil.iter_modules(courant_stability.__path__, "courant_stability.")]


@pytest.mark.parametrize("name", ["courant_stability", *(n for n in MODULES if not n.endswith("_native"))])
def test_docstrings(name):
    if name.endswith(".dask"):
        pytest.importorskip("dask.array")
    assert doctest.testmod(importlib.import_module(name), optionflags=FLAGS).failed == 0


def test_readme():
    if README.exists():
        assert doctest.testfile(str(README), module_relative=False, optionflags=FLAGS).failed == 0


def test_everything_public_is_described():
    for name in courant_stability.__all__:
        assert getattr(courant_stability, name).__doc__, name
