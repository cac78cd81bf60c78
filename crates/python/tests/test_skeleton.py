"""Axes of stems as arrays, graphs and files."""

import pickle
import sys
from pathlib import Path

import numpy as np
import pleach
import pytest


def test_a_skeleton_is_a_graph_of_nodes() -> None:
    tree = pleach.species("acer").grow(2)
    skeleton = tree.skeleton()
    parents, positions = skeleton.parents, skeleton.positions
    assert positions.shape == (len(skeleton), 3)
    assert len(parents) == len(skeleton.radii) == len(skeleton.stems) == len(skeleton.levels) == len(skeleton)
    inner = np.flatnonzero(parents >= 0)
    assert (parents[inner] < inner).all()
    lengths = np.linalg.norm(positions[inner] - positions[parents[inner]], axis=1)
    assert lengths.sum() == pytest.approx(skeleton.length)
    starts = inner[skeleton.stems[inner] != skeleton.stems[parents[inner]]]
    assert len(starts) == (tree.parents >= 0).sum()
    assert (positions[starts] == positions[parents[starts]]).all()
    assert skeleton.volume > 0
    assert "nodes" in repr(skeleton)
    with pytest.raises(ValueError):
        positions[0, 0] = 1.0


def test_networkx_has_the_same_graph() -> None:
    networkx = pytest.importorskip("networkx")
    skeleton = pleach.species("acer").grow(2).skeleton()
    graph = skeleton.to_networkx()
    assert networkx.is_arborescence(graph)
    assert graph.number_of_nodes() == len(skeleton)
    assert graph.size(weight="length") == pytest.approx(skeleton.length)
    last = len(skeleton) - 1
    facts = graph.nodes[last]
    assert facts["position"] == tuple(skeleton.positions[last])
    assert (facts["radius"], facts["stem"], facts["level"]) == (
        skeleton.radii[last],
        skeleton.stems[last],
        skeleton.levels[last],
    )
    assert list(graph.predecessors(last)) == [skeleton.parents[last]]


def test_without_networkx_the_error_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "networkx", None)
    with pytest.raises(ImportError, match="pip install networkx"):
        pleach.species("acer").grow().skeleton().to_networkx()


@pytest.mark.parametrize("suffix", ["swc", "csv"])
def test_a_skeleton_that_was_written_is_a_species(tmp_path: Path, suffix: str) -> None:
    tree = pleach.species("acer").grow(2)
    path = tmp_path / f"scan.{suffix}"
    tree.export(path)
    read = pleach.species(path).grow()
    assert (read.parents == tree.parents).all() and read.kinds == tree.kinds
    assert read.skeleton().length == pytest.approx(tree.skeleton().length)
    assert read.silhouette(64).any()
    assert read.to_glb()[:4] == b"glTF"
    path.write_text("radius,length\n1,2\n" if suffix == "csv" else "1 1 0 0 0 1 -1\n2 1 0 0 1 1 9\n")
    with pytest.raises(pleach.PleachError, match=f"scan.{suffix}:"):
        pleach.species(path)


def test_a_tree_graph_is_written(tmp_path: Path) -> None:
    tree = pleach.species("acer").grow(2)
    [path] = tree.export(tmp_path / "tree.mtg")
    lines = Path(path).read_text().split("\nMTG:\n")[1].splitlines()
    assert len(lines) == 1 + len(tree.skeleton())


def test_a_measured_tree_cannot_be_pickled_and_says_so(tmp_path: Path) -> None:
    file = tmp_path / "tree.swc"
    file.write_text("1 5 0 0 0 0.1 -1\n2 5 0 0 1 0.1 1\n")
    species = pleach.species(file)
    for thing in (species, species.grow(1)):
        with pytest.raises(pleach.PleachError, match="read its file again"):
            pickle.dumps(thing)
