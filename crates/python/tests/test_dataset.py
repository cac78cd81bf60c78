"""Training data: read back by NumPy, and the same bytes as the program's."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
from typing import Any

import numpy as np
import pytest

import pleach


def files(folder: pathlib.Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_numpy_reads_what_was_drawn(tmp_path: pathlib.Path) -> None:
    written = pleach.dataset(
        ["palm", pleach.species("acer")], tmp_path / "set", count=3, size=40, layers=["wood", "depth", "skeleton"]
    )
    assert (written.trees, written.failures, written.shards, written.kept) == (6, 0, 1, 0)
    shard = np.load(tmp_path / "set" / "shard-00000.npz")
    manifest = json.loads((tmp_path / "set" / "manifest.json").read_text())
    assert set(shard) == {array["name"] for array in manifest["arrays"]}
    for array in manifest["arrays"]:
        found = shard[array["name"]]
        assert found.dtype == array["dtype"], array
        sides = [{"trees": 6, "trees + 1": 7, "knots": len(shard["skeletons"])}.get(side, side) for side in array["shape"]]
        assert list(found.shape) == sides, array
    for tree in range(6):
        kind = manifest["species"][shard["species"][tree]]
        columns = [manifest["numbers"].index(name) for name in kind["numbers"]]
        species = pleach.Species.from_toml(kind["toml"]).with_numbers(shard["numbers"][tree][columns].copy())
        grown = species.grow(int(shard["tree_seed"][tree]))
        for view, azimuth in enumerate([0, 90]):
            assert np.array_equal(grown.silhouette(40, view=azimuth), shard["silhouettes"][tree, view] == 1)
        start, end = shard["skeleton_offsets"][tree : tree + 2].astype(int)
        skeleton = shard["skeletons"][start:end]
        assert np.array_equal(skeleton[:, :3], grown.knots.astype(np.float32))
        assert np.array_equal(skeleton[:, 3], grown.radii.astype(np.float32))
        assert np.array_equal(skeleton[:, 4].astype(int), np.repeat(np.arange(len(grown.levels)), grown.knot_counts))
    assert np.array_equal(np.isfinite(shard["depth"]), shard["silhouettes"] == 1)
    assert np.all(shard["wood"] <= shard["silhouettes"])


PROGRAM = pathlib.Path(os.environ.get("PLEACH", pathlib.Path(__file__).parents[3] / "target" / "debug" / "pleach"))


@pytest.mark.skipif(not PROGRAM.exists(), reason="the program is not built")
@pytest.mark.parametrize("format", ["npz", "webdataset"])
def test_the_program_writes_the_same_bytes(tmp_path: pathlib.Path, format: str) -> None:
    ask = "dataset palm acer -n 5 --size 24 --view 30,200 --shard 4 --with wood,depth,skeleton --free ratio --seed 7"
    subprocess.run([PROGRAM, *ask.split(), "--format", format, "-o", "program"], cwd=tmp_path, check=True)
    pleach.dataset(
        ["palm", "acer"],
        tmp_path / "python",
        count=5,
        size=24,
        view=[30, 200],
        shard=4,
        layers=["skeleton", "depth", "wood"],
        free=["ratio"],
        seed=7,
        format=format,
        threads=1,
    )
    assert files(tmp_path / "program") == files(tmp_path / "python")


def test_a_run_is_followed_and_stopped_and_goes_on(tmp_path: pathlib.Path) -> None:
    class Enough(Exception):
        pass

    def stop(done: int, all: int) -> None:
        assert 0 < done <= all == 300
        if done > 40:
            raise Enough

    ask: dict[str, Any] = {"count": 300, "size": 32, "shard": 20}
    with pytest.raises(Enough):
        pleach.dataset("quaking_aspen", tmp_path / "parts", progress=stop, threads=1, **ask)
    assert json.loads((tmp_path / "parts" / "manifest.json").read_text())["complete"] is False
    with pytest.raises(pleach.PleachError, match="size was 32, now 16"):
        pleach.dataset("quaking_aspen", tmp_path / "parts", resume=True, **{**ask, "size": 16})
    again = pleach.dataset("quaking_aspen", tmp_path / "parts", resume=True, **ask)
    assert (again.shards, again.kept > 0) == (15, True)
    pleach.dataset("quaking_aspen", tmp_path / "whole", **ask)
    assert files(tmp_path / "parts") == files(tmp_path / "whole")


def test_what_cannot_be_is_refused(tmp_path: pathlib.Path) -> None:
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"count": 0}, "`count` is 0; expected 1"),
        ({"size": 0}, "`size` is 0; expected 8"),
        ({"view": []}, "`view` has 0 azimuths"),
        ({"layers": ["leaves"]}, "`layers`: `leaves` is not one of wood, depth, skeleton"),
        ({"format": "hdf5"}, "`format`: `hdf5` is not one of npz, webdataset"),
        ({"spread": -1.0}, "`spread` is -1"),
        ({"free": ["ratoi"]}, "ratio"),
        ({"resume": True, "overwrite": True}, "exclude each other"),
        ({"threads": 0}, "threads"),
    ]
    for options, message in wrong:
        with pytest.raises(pleach.PleachError, match=message):
            pleach.dataset("palm", tmp_path / "set", **options)
    with pytest.raises(pleach.PleachError, match="no species"):
        pleach.dataset([], tmp_path / "set")
    with pytest.raises(pleach.SpeciesError, match="palm"):
        pleach.dataset("plam", tmp_path / "set")
    assert not (tmp_path / "set").exists()
    (tmp_path / "thesis.tex").write_text("precious")
    with pytest.raises(pleach.PleachError, match="is not empty; `resume`"):
        pleach.dataset("palm", tmp_path)
