"""Trees as arrays, pictures and meshes."""

from __future__ import annotations

import gc
import pickle
import struct
from pathlib import Path

import numpy as np
import pytest

import pleach


def test_arrays_show_the_tree() -> None:
    tree = pleach.species("acer").grow(3)
    knots, counts = tree.knots, tree.knot_counts
    stems = len(tree.parents)
    assert knots.dtype == np.float64 and knots.shape == tree.handles_in.shape == tree.handles_out.shape == (counts.sum(), 3)
    assert tree.radii.shape == (len(knots),) and (tree.radii >= 0).all()
    assert (tree.first_knots[1:] == np.cumsum(counts)[:-1]).all()
    assert tree.levels.shape == tree.offsets.shape == (stems,) and len(tree.kinds) == stems
    assert (tree.parents < np.arange(stems)).all() and tree.parents[0] == -1
    # A stem's parent is of the level before, or forks on its own.
    levels, child = tree.levels.astype(int), tree.parents >= 0
    step = levels[child] - levels[tree.parents[child]]
    assert set(np.unique(step)) <= {0, 1}
    leaves = tree.stats["leaves"]
    assert tree.leaf_positions.shape == tree.leaf_along.shape == tree.leaf_across.shape == (leaves, 3)
    assert tree.leaf_positions.dtype == np.float32 and (tree.leaf_stems < stems).all()
    low, high = tree.bounds
    assert (knots >= low - 1e-9).all() and (knots <= high + 1e-9).all() and high[2] == pytest.approx(tree.stats["height_m"])


def test_arrays_are_views_that_keep_the_tree() -> None:
    tree = pleach.species("silver_birch").grow(1)
    knots = tree.knots
    base: object = knots.base
    assert base is tree and np.shares_memory(knots, tree.knots)
    for array in (knots, tree.radii, tree.levels, tree.leaf_positions):
        with pytest.raises(ValueError):
            array[0] = 1
    before = knots.copy()
    del tree
    gc.collect()
    assert (knots == before).all()


def test_trees_without_parts_have_empty_arrays() -> None:
    bare = pleach.species("acer").grow(1, leaves=False)
    assert bare.leaf_positions.shape == (0, 3) and bare.leaf_stems.shape == (0,)


def test_the_same_seed_is_the_same_tree() -> None:
    acer = pleach.species("acer")
    one, other = acer.grow(5), acer.grow(5)
    assert (one.knots == other.knots).all() and not np.array_equal(one.knots, acer.grow(6).knots)
    again = pickle.loads(pickle.dumps(one))
    assert (again.knots == one.knots).all() and again.seed == 5 and again.species == acer


def test_pictures() -> None:
    tree = pleach.species("palm").grow()
    ink = tree.silhouette(96)
    assert ink.dtype == np.bool_ and ink.shape == (96, 96) and 0.02 < ink.mean() < 0.8
    assert ink[-1].any(), "it stands on the bottom edge"
    assert not np.array_equal(ink, tree.silhouette(96, view=90)) and tree.silhouette(96, view=(0, 80)).any()
    picture = tree.render(64, threads=1)
    assert picture.shape == (64, 64, 4) and picture.dtype == np.uint8 and picture.std() > 5
    assert np.array_equal(picture, tree.render(64, threads=3))
    acer = pleach.species("acer").grow()
    summer, winter = (acer.render(64, season=season, background="transparent") for season in ("summer", "winter"))
    assert summer[..., 3].sum() > winter[..., 3].sum() and summer[0, 0, 3] == 0
    assert tuple(acer.render(64, background="#102030", ground="none")[0, 0]) == (16, 32, 48, 255)
    assert not np.array_equal(acer.render(64, ground="grass"), acer.render(64))
    with pytest.raises(pleach.PleachError, match="autumn"):
        acer.render(64, season="fall")  # type: ignore[arg-type]
    with pytest.raises(pleach.PleachError, match="grass"):
        acer.render(64, ground="sea")  # type: ignore[arg-type]
    with pytest.raises(pleach.PleachError, match="dde6ee"):
        acer.render(64, background="sky")
    wood, depth, ink = acer.wood(96, view=40), acer.depth(96, view=40), acer.silhouette(96, view=40)
    assert 0 < wood.sum() < ink.sum() and not (wood & ~ink).any() and wood.dtype == np.bool_
    assert depth.dtype == np.float32 and (np.isfinite(depth) == ink).all() and np.nanmin(depth) < 0 < np.nanmax(depth)
    assert tree._repr_png_().startswith(b"\x89PNG") and pleach.species("palm")._repr_png_().startswith(b"\x89PNG")
    for wrong in (0, 100_000):
        with pytest.raises(pleach.PleachError):
            tree.silhouette(wrong)
    with pytest.raises(pleach.PleachError, match="-90 to 90"):
        tree.silhouette(64, view=(0, 120))
    with pytest.raises(pleach.PleachError, match="threads"):
        tree.render(64, threads=0)


def test_meshes() -> None:
    glb = pleach.species("acer").grow(1, leaves=False).to_glb()
    magic, version, length = struct.unpack("<4sII", glb[:12])
    assert (magic, version, length) == (b"glTF", 2, len(glb))


def test_bark_has_pictures(tmp_path: Path) -> None:
    tree = pleach.species("palm").grow(1, leaves=False)
    files = [file.name for file in tree.export(tmp_path / "palm.obj", textures=512)]
    pictures = ["palm-bark.png", "palm-bark-normal.png", "palm-bark-roughness.png"]
    assert files == ["palm.obj", *pictures, "palm.mtl"]
    glb = tree.to_glb(textures=512)
    assert all((tmp_path / name).read_bytes() in glb for name in pictures)
    with pytest.raises(pleach.PleachError, match="textures.*512, 1024, 2048"):
        tree.to_glb(textures=1000)


def test_pivots_for_unreal_stand_beside_the_file(tmp_path: Path) -> None:
    tree = pleach.species("acer").grow(1)
    files = [file.name for file in tree.export(tmp_path / "acer.glb", pivot_painter=True)]
    assert files == ["acer.glb", "acer-pivots.exr", "acer-axes.png"]
    with pytest.raises(pleach.PleachError, match="pivot_painter.*wind"):
        tree.export(tmp_path / "acer.glb", pivot_painter=True, wind=True)
    with pytest.raises(pleach.PleachError, match="pivot_painter.*export"):
        tree.to_glb(pivot_painter=True)  # type: ignore[call-arg]  # pyright: ignore[reportCallIssue]


def test_levels_keep_to_budgets(tmp_path: Path) -> None:
    """A budget for each level; one level alone; a budget that cannot be."""
    tree = pleach.species("acer").grow(1)
    both = tree.to_glb(triangles=[8000, 2000])
    assert b'"acer_LOD0"' in both and b'"acer_LOD1"' in both and b'"twigs"' in both
    one = tree.to_glb(triangles=[8000, 2000], level=1)
    assert b'"acer_LOD1"' in one and b'"acer_LOD0"' not in one
    files = tree.export(tmp_path / "acer.obj", triangles=[2000])
    assert "acer-twigs.png" in [file.name for file in files]
    for wrong in ([10], [2000, 8000], [2000] * 2):
        with pytest.raises(pleach.PleachError, match="triangles"):
            tree.to_glb(triangles=wrong)


def test_skeletons_are_files_of_nodes_and_of_cylinders(tmp_path: Path) -> None:
    tree = pleach.species("acer").grow(1)
    assert tree.export(tmp_path / "acer.swc") == [tmp_path / "acer.swc"]
    nodes = np.loadtxt(tmp_path / "acer.swc")
    parents = nodes[:, 6].astype(int)
    assert (parents < nodes[:, 0]).all() and (nodes[parents < 0][:, 4] == 0).all()
    tree.export(tmp_path / "acer.csv")
    cylinders = np.genfromtxt(tmp_path / "acer.csv", delimiter=",", names=True, deletechars="")
    assert cylinders["length"].sum() == pytest.approx(sum(tree.stats["length_total_m"]), rel=0.01)
    assert {"radius", "parent", "extension", "BranchOrder"} <= set(cylinders.dtype.names or ())
    with pytest.raises(pleach.PleachError, match="takes no options"):
        tree.export(tmp_path / "acer.swc", season="winter")


def test_a_glb_is_for_engines_unless_it_is_to_be_the_finest() -> None:
    """A budget by default; every leaf if asked for; a tree that does not fit is whole, with a warning."""
    tree = pleach.species("quaking_aspen").grow(1)
    usual, finest = tree.to_glb(), tree.to_glb(finest=True)
    assert b'"bark normal"' in usual and b'"twigs"' in usual and len(usual) < 5e6
    assert b'"bark normal"' not in finest and len(finest) > 15e6
    assert len(tree.to_glb(textures=0)) < len(usual)
    dragon = (Path(__file__).parents[3] / "species/lsystem/abop_dragon.toml").read_text()
    long = pleach.Species.from_toml(dragon.replace("steps: 10", "steps: 15"))
    with pytest.warns(UserWarning, match="does not fit into a level of 50000 triangles"):
        assert len(long.grow(1).to_glb()) > 30e6


def test_too_large_a_tree_is_an_error() -> None:
    huge = pleach.species("quaking_aspen").replace({"branches": (1, 500, 500, 500), "levels": 4})
    with pytest.raises(pleach.GrowError):
        huge.grow()
