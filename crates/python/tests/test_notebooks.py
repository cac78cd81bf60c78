"""The notebooks run, with less of everything."""

from __future__ import annotations

import pathlib

import pytest

NOTEBOOKS = pathlib.Path(__file__).parents[3] / "docs" / "notebooks"


@pytest.mark.parametrize("name", ["first-fit", "figures", "archive"])
def test_a_notebook(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    if name == "archive":
        pytest.importorskip("ribs")
    monkeypatch.setenv("PLEACH_QUICK", "1")
    book = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
    nbclient.NotebookClient(book, timeout=240, resources={"metadata": {"path": str(NOTEBOOKS)}}).execute()
