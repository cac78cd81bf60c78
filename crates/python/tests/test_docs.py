"""The examples in the documentation."""

from __future__ import annotations

import doctest
import importlib
import pathlib
import pkgutil

import pytest

import pleach
from pleach import _native

MODULES = ["pleach"] + [f"pleach.{one.name}" for one in pkgutil.iter_modules(pleach.__path__) if one.name != "_native"]


@pytest.mark.parametrize("name", MODULES)
def test_modules(name: str) -> None:
    failed, _ = doctest.testmod(importlib.import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_native_classes() -> None:
    """Those of compiled classes are not found by doctest itself."""
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner()
    tried = 0
    for one in (_native.Species, _native.Tree, _native.generators):
        for name, what in [("", one)] + [(name, getattr(one, name)) for name in dir(one) if not name.startswith("_")]:
            text = getattr(what, "__doc__", None) or ""
            examples = parser.get_doctest(text, {}, f"{one.__name__}.{name}", None, None)
            tried += len(examples.examples)
            runner.run(examples)
    assert runner.summarize().failed == 0 and tried >= 10


def test_everything_is_documented() -> None:
    for one in (_native.Species, _native.Tree, _native.Skeleton, _native.Mesh, _native.MeshPart):
        for name in dir(one):
            if not name.startswith("_"):
                assert (getattr(one, name).__doc__ or "").strip(), f"{one.__name__}.{name}"
    for name in pleach.__all__:
        assert (getattr(pleach, name).__doc__ or "").strip(), name


def test_the_readme() -> None:
    text = (pathlib.Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
    examples = doctest.DocTestParser().get_doctest(text, {}, "README.md", None, None)
    assert examples.examples
    assert doctest.DocTestRunner().run(examples).failed == 0
