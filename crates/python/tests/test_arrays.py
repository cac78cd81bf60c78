"""What of a tree other programs need: shapes of leaves and blossoms, foliage, attach points, meshes."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import pleach

FLOAT = npt.NDArray[np.float64]


def at(tree: pleach.Tree, stem: int, place: float) -> FLOAT:
    """The point of a stem's spline at a piece and the part of it that lies below."""
    piece = min(int(place), int(tree.knot_counts[stem]) - 2)
    knot, t = int(tree.first_knots[stem]) + piece, place - piece
    ends = tree.knots[knot], tree.handles_out[knot], tree.handles_in[knot + 1], tree.knots[knot + 1]
    weights = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3
    return np.asarray(sum(weight * end for weight, end in zip(weights, ends)))


@pytest.mark.parametrize("name", ["quaking_aspen", "acer", "coffey_pine", "field_maple", "stylised_oak", "leafy_oak"])
def test_a_foot_is_on_its_parent(name: str) -> None:
    """No other place of the parent is nearer to the stem's first knot, and it is not far."""
    tree = pleach.species(name).grow(1, leaves=False)
    places, parents = tree.places, tree.parents
    assert np.isnan(places[parents < 0]).all() and len(places) == len(parents)
    children = np.flatnonzero(parents >= 0)
    assert len(children) and (places[children] >= 0).all()
    assert (places[children] <= tree.knot_counts[parents[children]] - 1).all()
    for child in children[:: max(1, len(children) // 50)]:
        parent = int(parents[child])
        foot = tree.knots[tree.first_knots[child]]
        found = np.linalg.norm(foot - at(tree, parent, float(places[child])))
        others = np.linspace(0, tree.knot_counts[parent] - 1, 40 * int(tree.knot_counts[parent]))
        assert found <= min(np.linalg.norm(foot - at(tree, parent, float(other))) for other in others) + 1e-9
        assert found <= 0.02 * tree.stats["height_m"], (child, found)


def test_leaves_name_their_outlines() -> None:
    tree = pleach.species("acer").grow(1)
    (name, corners), *_ = tree.leaf_outlines
    assert isinstance(name, str) and corners.dtype == np.float32 and corners.shape[1] == 2 and len(corners) >= 3
    assert tree.leaf_shapes.dtype == np.uint16 and len(tree.leaf_shapes) == len(tree.leaf_positions)
    assert tree.leaf_shapes.max() < len(tree.leaf_outlines)
    # Outlines in their places are the leaves of the mesh.
    mesh = tree.mesh(leaves="outline").levels[0]["leaves"]
    first = tree.leaf_positions[0] + corners[:, :1] * tree.leaf_across[0] + corners[:, 1:] * tree.leaf_along[0]
    assert np.allclose(mesh.positions[: len(corners)], first, atol=1e-5)


def test_blossoms_are_there() -> None:
    tree = pleach.species("hill_cherry").grow(1)
    count = len(tree.blossom_positions)
    assert count == tree.stats["blossoms"] > 0
    assert len(tree.blossom_along) == len(tree.blossom_across) == len(tree.blossom_shapes) == count
    assert (tree.blossom_stems < len(tree.levels)).all() and tree.blossom_shapes.max() < len(tree.blossom_faces)
    name, corners, faces = tree.blossom_faces[0]
    assert name == "cherry" and corners.shape[1] == 3 and len(faces) == 10
    assert all(0 <= corner < len(corners) for face in faces for corner in face)
    # A corner in its place is one of the mesh.
    along, across = tree.blossom_along[0], tree.blossom_across[0]
    normal = np.cross(across, along)
    normal *= np.linalg.norm(along) / np.linalg.norm(normal)
    placed = tree.blossom_positions[0] + corners[:, :1] * across + corners[:, 1:2] * along + corners[:, 2:] * normal
    assert np.allclose(tree.mesh().levels[0]["blossom"].positions[: len(corners)], placed, atol=1e-5)


def test_foliage_of_stylised_trees_is_closed() -> None:
    tree = pleach.species("stylised_oak").grow(1)
    triangles, first = tree.blob_triangles, tree.blob_first_vertices
    assert len(tree.blob_stems) == len(first) > 1 and triangles.max() == len(tree.blob_vertices) - 1
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    there, back = ({tuple(edge) for edge in some} for some in (edges, edges[:, ::-1]))
    assert there == back
    # The triangles of a surface name no vertex of another one.
    which = np.searchsorted(first, triangles, side="right")
    assert (which == which[:, :1]).all()
    assert pleach.species("acer").grow(1).blob_vertices.shape == (0, 3)


def test_meshes_as_arrays() -> None:
    tree = pleach.species("acer").grow(1)
    mesh = tree.mesh(triangles=[8000, 2000], textures=512, billboard=2)
    assert [sum(len(part.triangles) for part in level.values()) for level in mesh.levels][2] == 4
    for level, budget in zip(mesh.levels, (8000, 2000)):
        assert 0.85 * budget <= sum(len(part.triangles) for part in level.values()) <= budget
    assert sorted(mesh.pictures) == ["bark", "card", "twigs"]
    assert all(png.startswith(b"\x89PNG") for files in mesh.pictures.values() for png in files.values())
    bark = mesh.levels[0]["bark"]
    corners = len(bark.positions)
    assert bark.normals.shape == (corners, 3) and bark.uvs.shape == (corners, 2) and bark.tangents.shape == (corners, 4)
    assert bark.triangles.dtype == np.uint32 and bark.triangles.max() < corners
    assert np.allclose(np.linalg.norm(bark.normals, axis=1), 1, atol=1e-4)
    assert np.allclose(np.linalg.norm(bark.tangents[:, :3], axis=1), 1, atol=1e-4)
    # At right angles to the normals; bark is not mirrored.
    assert np.abs((bark.tangents[:, :3] * bark.normals).sum(axis=1)).max() < 1e-4
    assert (bark.tangents[:, 3] == 1).mean() > 0.99
    low, high = tree.bounds
    assert (bark.positions >= low - 0.01).all() and (bark.positions <= high + 0.01).all(), "z is up"
    for options, words in (({"sway": True}, "`sway` is for files"), ({"leaves": "instances"}, "`leaves` is for files"), ({"lodd": 1}, "unknown")):
        with pytest.raises(pleach.PleachError, match=words):
            tree.mesh(**options)


def test_seasons_and_roots() -> None:
    tree = pleach.species("acer").grow(1)
    assert "leaves" not in tree.mesh(season="winter").levels[0]
    rooted = pleach.species("shallow_root_oak").grow(1, leaves=False)
    assert "root" in rooted.kinds
    below = [rooted.mesh(roots=roots).levels[0]["bark"].positions[:, 2].min() for roots in (False, True)]
    assert below[1] < below[0] - 0.1


def test_palettes() -> None:
    birch = pleach.species("silver_birch")
    summer, autumn = birch.palette("summer"), birch.palette("autumn")
    assert summer["pattern"] == "banded" and summer["leaf"] != autumn["leaf"] and summer["bark"] == (0xD9, 0xD6, 0xCC)
    assert not birch.palette("winter")["leaves"] and pleach.species("small_pine").palette("winter")["leaves"]
    with pytest.raises(pleach.PleachError, match="spring, summer, autumn, winter"):
        birch.palette("fall")  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["acer", "stylised_oak", "abop_plant_a"])
def test_everything_is_declared(name: str) -> None:
    species = pleach.species(name)
    declared = species.declared()
    assert list(declared) == species.keys()
    assert declared == {key: species.declared(key) for key in species}
    slots = [slot for about in declared.values() for slot in about["slots"]]
    assert [slot["slot"] for slot in slots] == species.slots
    # The few that are shown first, in order; the numbers of a grammar are its own.
    handles = sorted((slot["handle"] for slot in slots if slot["handle"]), key=lambda handle: handle["order"])
    assert [handle["name"] for handle in handles][:1] == ([] if name == "abop_plant_a" else ["height"])


def test_wind_of_stems_is_that_of_their_bark() -> None:
    tree = pleach.species("acer").grow(1)
    bark = tree.mesh(wind=True).levels[0]["bark"]
    assert bark.wind is not None and len(bark.wind) == len(bark.positions)
    assert tree.mesh().levels[0]["bark"].wind is None
    growing = tree.mesh(growth=True).levels[0]["leaves"]
    assert growing.growth is not None and growing.growth.shape == (len(growing.positions), 4)
    assert (growing.growth[:, 0] >= 0).all() and (growing.growth[:, 0] <= 0.9).all()
    assert growing.wind is None and tree.mesh().levels[0]["leaves"].growth is None
    stems = tree.wind()
    assert len(stems) == len(tree.levels) and set(np.unique(stems.levels)) == {0, 1, 2}

    def bodies(wind: pleach.Wind) -> set[tuple[float, ...]]:
        phases = np.column_stack([wind.phases, wind.parent_phases, wind.levels])
        rows = np.hstack([wind.pivots, wind.bends, wind.parent_pivots, wind.parent_bends, phases])
        return {tuple(row) for row in rows.tolist()}

    assert bodies(stems) == bodies(bark.wind)
    # A limb turns about its first knot, and the trunk only leans.
    limb = int(np.flatnonzero(stems.levels == 1)[0])
    assert np.allclose(stems.pivots[limb], tree.knots[tree.first_knots[limb]], atol=1e-5)
    assert not stems.bends[stems.levels == 0].any() and (np.linalg.norm(stems.bends[stems.levels > 0], axis=1) > 0).all()
    assert ((stems.phases >= 0) & (stems.phases < 1)).all() and not stems.flutters.any()


def test_wind_of_what_stems_carry() -> None:
    tree = pleach.species("hill_cherry").grow(1)
    stems = tree.wind("stems")
    for parts, carriers in (("leaves", tree.leaf_stems), ("blossoms", tree.blossom_stems)):
        wind = tree.wind(parts)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
        assert np.array_equal(wind.pivots, stems.pivots[carriers]) and np.array_equal(wind.bends, stems.bends[carriers])
        assert ((wind.flutters > 0) & (wind.flutters <= 0.03)).all()
        assert np.array_equal(stems.take(carriers.astype(np.int64)).phases, wind.phases)
        assert np.array_equal(stems.take(carriers.astype(np.uint32)).phases, wind.phases)
    for wrong in (-1, len(stems)):
        with pytest.raises(IndexError, match="expected from 0 to"):
            stems.take(np.array([0, wrong]))
    oak = pleach.species("stylised_oak").grow(1)
    assert np.array_equal(oak.wind("blobs").phases, oak.wind().phases[oak.blob_stems])
    with pytest.raises(pleach.PleachError, match="no `twigs`, expected one of stems, leaves, blossoms, blobs"):
        oak.wind("twigs")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


def test_places_in_wind() -> None:
    tree = pleach.species("acer").grow(1)
    wind, height = tree.wind("leaves"), float(tree.bounds[1, 2])
    still = wind.moved(tree.leaf_positions, wind=(0, 0, 0), time=3.0, height=height)
    assert np.allclose(still, tree.leaf_positions, atol=1e-6)
    moved = wind.moved(tree.leaf_positions, wind=(1, 0, 0), time=3.0, height=height)
    doubles = tree.leaf_positions.astype(np.float64)
    assert np.array_equal(wind.moved(doubles, wind=(1, 0, 0), time=3.0, height=height), moved)
    assert 0.01 < np.linalg.norm(moved - still, axis=1).mean() < 1.0 and (moved - still)[:, 0].mean() > 0.01
    upwards = np.tile(np.array([0, 0, 1], np.float32), (len(still), 1))
    fluttered = wind.moved(tree.leaf_positions, wind=(1, 0, 0), time=3.0, height=height, normals=upwards)
    assert 0.001 < np.abs(fluttered - moved).max() < 0.05
    # The base of a limb stays where the trunk takes it.
    stems = tree.wind()
    first = tree.knots[tree.first_knots].astype(np.float32)
    bases = stems.moved(first, wind=(0, 2, 0), time=1.0, height=height)
    bark = tree.mesh(wind=True).levels[0]["bark"]
    assert bark.wind is not None
    assert bark.wind.moved(bark.positions, wind=(1, 0, 0), time=1.0, height=height).shape == bark.positions.shape
    limbs = (stems.levels == 1) & np.isclose(stems.pivots, first, atol=1e-5).all(axis=1)
    assert limbs.any()
    lean = bases[limbs] - first[limbs]
    assert np.abs(lean[:, 0]).max() < 1e-5 and (lean[:, 1] >= 0).all()
    with pytest.raises(pleach.PleachError, match="one row for each"):
        wind.moved(still[:5], wind=(1, 0, 0), time=0.0, height=height)
