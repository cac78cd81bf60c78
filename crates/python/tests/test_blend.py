"""Species between species."""

from __future__ import annotations

import copy
import math
import pickle

import pytest

import pleach


def test_a_blend_is_between() -> None:
    both = pleach.blend({"quaking_aspen": 1, "silver_birch": 1})
    heights = [pleach.species(name)["g_scale"] for name in ("quaking_aspen", "silver_birch")]
    assert min(heights) <= both["g_scale"] <= max(heights)
    mixed: dict[str | pleach.Species, float] = {"acer": 1, pleach.species("palm"): 0}
    assert pleach.blend(mixed)["ratio"] == pleach.species("acer")["ratio"]
    wrong: list[dict[str, float]] = [{}, {"acer": -1, "palm": 2}, {"acer": 0, "palm": 0}, {"acer": 1, "grammar_acer": 1}]
    for shares in wrong:
        with pytest.raises(pleach.SpeciesError):
            pleach.blend(shares)


def test_a_map_has_a_tree_everywhere() -> None:
    plane = pleach.Map()
    assert plane.points.shape == (15, 2) and len(plane.explained) >= 2 and 0 < plane.explained[0] < 1
    for (x, y), one in zip(plane.points, plane.species):
        assert plane.at(x, y).shares == {one.name: 1.0}
        assert plane.locate(one) == pytest.approx((x, y))
    middle = plane.at(*plane.points.mean(axis=0), name="middle")
    assert middle.outside == 0 and len(middle.shares) > 1 and sum(middle.shares.values()) == pytest.approx(1)
    assert middle.species.name == "middle" and middle.species.grow(1, leaves=False).knots.size
    assert plane.at(1e3, 1e3).outside > 0
    with pytest.raises(pleach.SpeciesError):
        plane.at(math.nan, 0)
    with pytest.raises(pleach.SpeciesError):
        pleach.Map(["acer"])


def test_the_picture_of_a_map_shows_where_species_are() -> None:
    plane = pleach.Map()
    png = plane.picture()
    assert png.startswith(b"\x89PNG") and png == pleach.Map().picture(1) != plane.picture(2)
    width, height = (int.from_bytes(png[at : at + 4], "big") for at in (16, 20))
    for x, y in plane.points:
        column, row = plane.pixel_at(x, y)
        assert 0 < column < width and 0 < row < height
        assert plane.point_at(column, row) == pytest.approx((x, y))
    low, high = plane.extent
    assert (low < plane.points.min(axis=0)).all() and (high > plane.points.max(axis=0)).all()
    left, bottom = plane.pixel_at(*low)
    right, top = plane.pixel_at(*high)
    assert 0 < left < right < width and 0 < top < bottom < height
    # x grows to the right, and y upwards.
    assert plane.point_at(500, 400)[0] < plane.point_at(600, 400)[0]
    assert plane.point_at(500, 400)[1] > plane.point_at(500, 500)[1]


def test_maps_can_be_pickled_and_copied() -> None:
    plane = pleach.Map(["acer", "palm", "quaking_aspen"])
    for again in (pickle.loads(pickle.dumps(plane)), copy.copy(plane), copy.deepcopy(plane)):
        assert again.names == plane.names and (again.points == plane.points).all()
        assert again.at(0.1, 0.2).species == plane.at(0.1, 0.2).species
