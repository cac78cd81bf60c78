"""Priors: the trees of ``pleach sample``."""

from __future__ import annotations

import os
import pathlib
import subprocess

import numpy as np
import pytest

import pleach


def test_trees_vary_around_the_species_where_they_may() -> None:
    prior = pleach.Prior("palm", fix=["ratio"])
    assert "ratio" not in prior.slots and "base_size[0]" in prior.slots
    own = pleach.species("palm")
    drawn = prior.sample(40, seed=3)
    assert drawn == prior.sample(40, seed=3, threads=1) and drawn != prior.sample(40, seed=4)
    numbers = np.array([one.numbers for one in drawn])
    column = own.slots.index("ratio")
    assert (numbers[:, column] == own.numbers[column]).all()
    column = own.slots.index("base_size[0]")
    assert numbers[:, column].std() > 0.02
    assert numbers[:, column].min() < own.numbers[column] <= numbers[:, column].max() + 0.1
    assert all(one.tree_seed is not None for one in drawn)
    still = pleach.Prior("palm", spread=0.0).sample(2)
    assert (still[0].numbers == still[1].numbers).all()
    assert repr(prior).startswith("Prior('palm', spread=0.15")


PROGRAM = pathlib.Path(os.environ.get("PLEACH", pathlib.Path(__file__).parents[3] / "target" / "debug" / "pleach"))


@pytest.mark.skipif(not PROGRAM.exists(), reason="the program is not built")
def test_they_are_the_programs(tmp_path: pathlib.Path) -> None:
    command = [str(PROGRAM), "sample", "acer", "--count", "3", "--seed", "5", "-o", str(tmp_path / "s"), "-q"]
    subprocess.run(command, check=True)
    for number, one in enumerate(pleach.Prior("acer").sample(3, seed=5), start=1):
        written = pleach.species(tmp_path / "s" / f"{number}.toml")
        assert (written.numbers == one.numbers).all() and written.tree_seed == one.tree_seed


def test_what_cannot_be_is_said() -> None:
    with pytest.raises(pleach.PleachError, match="spread.*from 0 to 10"):
        pleach.Prior("palm", spread=-1)
    with pytest.raises(pleach.PleachError, match="spread"):
        pleach.Prior("palm", spread=float("nan"))
    with pytest.raises(pleach.FitError, match="no_such"):
        pleach.Prior("palm", free=["no_such"])
    with pytest.raises(pleach.PleachError, match="at most 1000000"):
        pleach.Prior("palm").sample(1_000_001)
    assert pleach.Prior("palm").sample(0) == []
