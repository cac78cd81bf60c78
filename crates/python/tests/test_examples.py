"""The examples run, and find something."""

from __future__ import annotations

import importlib.util
import pathlib
import sys
from types import ModuleType

import pytest

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"


def example(name: str, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.setattr(sys, "argv", [name])
    specification = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert specification is not None and specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_optuna(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("optuna")
    assert example("with_optuna", monkeypatch).main(trials=24) < 0.6


def test_cmaes(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("cmaes")
    assert example("with_cmaes", monkeypatch).main(generations=3) < 0.6


def test_ribs(monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path) -> None:
    pytest.importorskip("ribs")
    pytest.importorskip("matplotlib")
    archive = example("with_ribs", monkeypatch).main(rounds=8, picture=str(tmp_path / "archive.png"))
    assert archive.stats.num_elites > 5 and (tmp_path / "archive.png").stat().st_size > 10_000
