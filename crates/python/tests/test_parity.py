"""A fit says the same here, by the program and in the page: the cases of ``tests/data/parity.json``."""

from __future__ import annotations

import json
import pathlib
from typing import Any

import pytest

import pleach

ROOT = pathlib.Path(__file__).parents[3]
KNOWN = json.loads((ROOT / "tests" / "data" / "parity.json").read_text(encoding="utf-8"))
CASES = KNOWN["cases"]


def without_times(report: dict[str, Any]) -> dict[str, Any]:
    """A copy without what depends on the clock."""
    report = json.loads(json.dumps(report))
    for key in KNOWN["times"]:
        *place, last = key.split(".")
        inner: Any = report
        for step in place:
            inner = inner[step]
        if inner is not None:
            del inner[last]
    return report


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_python_reports_what_the_program_does(case: dict[str, Any]) -> None:
    found = without_times(pleach.fit(ROOT / case["goal"], **case["keywords"]).report)
    expected = case["report"]
    assert sorted(found) == sorted(expected)
    for key, value in expected.items():
        # Numbers as well: both are the shortest texts that read back as the same bits.
        assert found[key] == value, key
