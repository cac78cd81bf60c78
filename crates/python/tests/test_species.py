"""Species as mappings."""

from __future__ import annotations

import collections.abc
import pickle
import pathlib

from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
import pytest

import pleach


def test_all_species_grow_by_name() -> None:
    names = pleach.species()
    assert len(names) >= 20
    assert {pleach.species(name).generator for name in names} == set(pleach.generators())


def test_a_species_is_a_mapping() -> None:
    acer = pleach.species("acer")
    assert isinstance(acer, collections.abc.Mapping)
    assert dict(acer) == dict(acer.items()) == dict(zip(acer.keys(), acer.values()))
    assert list(acer) == acer.keys() and len(acer) == len(acer.keys())
    assert "ratio" in acer and "rotio" not in acer and 3 not in acer  # type: ignore[comparison-overlap]
    assert acer.get("rotio") is None and acer.get("rotio", 7) == 7
    assert isinstance(acer["ratio"], float) and isinstance(acer["levels"], int) and isinstance(acer["shape"], str)
    assert isinstance(acer["length"], tuple) and len(acer["length"]) == 4
    with pytest.raises(KeyError):
        acer["rotio"]


def test_a_changed_copy_says_what_is_wrong() -> None:
    acer = pleach.species("acer")
    changed = acer.replace({"length[1]": 0.25, "shape": "conical"}, g_scale=np.float64(9))
    assert (changed["length"][1], changed["shape"], changed["g_scale"]) == (0.25, "conical", 9.0)
    assert acer["shape"] == "tapered_cylindrical"
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"rotio": 1}, "did you mean `ratio`"),
        ({"ratio": "wide"}, "expected a number"),
        ({"ratio": -1}, "`ratio`"),
        ({"ratio": float("nan")}, "`ratio`"),
        ({"length": 1}, "4 numbers, not one value"),
        ({"length": (1, 2)}, "4 numbers, not 2"),
        ({"shape": "cube"}, "expected"),
    ]
    for changes, message in wrong:
        with pytest.raises(pleach.SpeciesError, match=message):
            acer.replace(changes)
    with pytest.raises(pleach.SpeciesError):
        acer.with_numbers(acer.numbers[:-1].copy())
    assert acer.with_numbers(acer.numbers) == acer
    assert len(acer.slots) == len(acer.numbers)


def test_files_go_there_and_back(tmp_path: pathlib.Path) -> None:
    acer = pleach.species("acer").named("mine", tree_seed=12)
    file = tmp_path / "mine.toml"
    file.write_text(acer.to_toml())
    again = pleach.species(file)
    assert again == acer and hash(again) == hash(acer) and (again.name, again.tree_seed) == ("mine", 12)
    assert pickle.loads(pickle.dumps(acer)) == acer
    assert acer != pleach.species("acer") and acer != object()
    file.write_text('generator = "weber-penn"\nratio = "thick"\n')
    with pytest.raises(pleach.SpeciesError, match="(?s)line 2|:2:"):
        pleach.species(file)
    with pytest.raises(pleach.SpeciesError, match="did you mean|no species"):
        pleach.species("acre")
    with pytest.raises(pleach.PleachError):
        acer.named("a/b")


def test_species_of_other_programs_are_files_too(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "small.py"
    file.write_text("params = {'g_scale': 6, 'levels': 2, 'bevel_res': [10, 10, 10, 10]}")
    small = pleach.species(file)
    assert small.name == "small" and small["g_scale"] == 6 and len(small.grow().parents) > 10
    file.write_text("import os\n")
    with pytest.raises(pleach.SpeciesError, match="small.py:1:1: `import`"):
        pleach.species(file)


def test_what_is_declared_is_told() -> None:
    about = pleach.species("acer").declared("length")
    assert [slot["slot"] for slot in about["slots"]] == [f"length[{i}]" for i in range(4)]
    assert about["doc"] and about["source"] and about["min"] < about["max"]
    shape = pleach.species("acer").declared("shape")
    assert "conical" in shape["choices"] and shape["first"] == 0
    one = pleach.species("acer").declared("length[1]")
    assert (one["name"], one["values"], one["slots"]) == ("length[1]", 1, about["slots"][1:2])
    assert one["search"] == about["search"][1:2] and one["default"] == about["default"][1:2]
    assert one.keys() == about.keys()
    with pytest.raises(pleach.SpeciesError, match="length"):
        pleach.species("acer").declared("lenght[1]")


def test_seeds_are_whole_numbers() -> None:
    acer = pleach.species("acer")
    for wrong in (-1, 1.5, 2**64, "one", True):
        with pytest.raises(pleach.PleachError, match="a seed is .*, expected a whole number"):
            acer.grow(wrong)  # type: ignore[arg-type]
        with pytest.raises(pleach.PleachError, match="a seed is"):
            acer.named(tree_seed=wrong)  # type: ignore[arg-type]


def test_the_version_is_told() -> None:
    try:
        installed = version("pleach")
    except PackageNotFoundError:
        pytest.skip("pleach is beside its sources and not installed")
    assert pleach.__version__ == installed
