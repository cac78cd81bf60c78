"""Goals as functions of numbers."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pleach


@pytest.fixture(scope="module")
def problem() -> pleach.Problem:
    return pleach.Problem(pleach.species("acer").grow(3).silhouette(64), "acer", size=64)


def rows(problem: pleach.Problem, count: int) -> npt.NDArray[np.float64]:
    """Trees like those of the species: anywhere within the bounds some are huge."""
    steps = np.random.default_rng(7).uniform(-0.05, 0.05, (count, len(problem)))
    return np.clip(problem.start + steps * (problem.upper - problem.lower), problem.lower, problem.upper)


def test_slots_are_described(problem: pleach.Problem) -> None:
    assert len(problem.names) == len(problem) == len(problem.kinds) == len(problem.is_log)
    assert (problem.lower <= problem.start).all() and (problem.start <= problem.upper).all()
    assert problem.is_integer[problem.names.index("levels")] and problem.is_choice[problem.names.index("shape")]
    assert problem.goal.shape == (64, 64)


def test_threads_change_nothing_and_rows_keep_their_order(problem: pleach.Problem) -> None:
    values = rows(problem, 24)
    one = problem.scores(values, threads=1)
    for threads in (2, 5):
        other = problem.scores(values, threads=threads)
        assert np.array_equal(one.cost, other.cost) and np.array_equal(one.iou, other.iou)
    alone = np.concatenate([problem.evaluate(row[None]) for row in values])
    assert np.array_equal(alone, one.cost)
    assert problem.evaluate(values[:0]).shape == (0,)


def test_seeds_are_the_trees(problem: pleach.Problem) -> None:
    values = np.repeat(problem.start[None], 3, axis=0)
    cost = problem.evaluate(values, seeds=[1, 2, 3])
    assert len(set(cost)) == 3 and cost[2] < cost[0], "the goal is tree 3"
    # One seed is that of all.
    assert np.array_equal(problem.evaluate(values, seeds=2), np.repeat(cost[1], 3))
    assert np.array_equal(problem.evaluate(values, seeds=np.array([1, 2, 3], dtype=np.int32)), cost)
    assert np.isfinite(problem.evaluate(values[:2], seeds=[1, 2**64 - 1])).all()
    # That tree's picture is the goal.
    grown = problem.species(problem.start, seed=3).grow()
    assert pleach.score(grown.silhouette(64), problem.goal).iou > 0.95


def test_values_beyond_the_bounds_count_as_the_nearest(problem: pleach.Problem) -> None:
    values = rows(problem, 2)
    beyond = values.copy()
    beyond[0, 0], values[0, 0] = problem.upper[0] + 5, problem.upper[0]
    assert np.array_equal(problem.evaluate(values), problem.evaluate(beyond))


def test_what_is_wrong_is_told(problem: pleach.Problem) -> None:
    values = rows(problem, 3)
    hole = values.copy()
    hole[2, 1] = np.nan
    with pytest.raises(pleach.FitError, match=f"`{problem.names[1].split('[')[0]}.*row 2 is NaN"):
        problem.evaluate(hole)
    for wrong in (values[0], values[:, :-1], values[None], values.astype(object)):
        with pytest.raises(pleach.FitError):
            problem.evaluate(wrong)
    with pytest.raises(pleach.FitError, match="2 seeds for 3 rows"):
        problem.evaluate(values, seeds=[1, 2])
    with pytest.raises(pleach.PleachError, match="threads"):
        problem.evaluate(values, threads=0)
    wrong_seeds: list[tuple[Any, str]] = [
        ([1, -1, 2], "-1"),
        ([1, 2.5, 3], "2.5"),
        (["a", "b", "c"], "'a'"),
        (2**64, "18446744073709551616"),
    ]
    for seeds, shown in wrong_seeds:
        with pytest.raises(pleach.PleachError, match=f"a seed is {shown}, expected a whole number from 0 to"):
            problem.evaluate(values, seeds=seeds)
    with pytest.raises(pleach.FitError, match="expected one seed"):
        problem.evaluate(values, seeds=[[1, 2, 3]])
    for wrong_seed in (lambda: problem.species(values[0], seed=-1), lambda: pleach.Problem(problem.goal, "acer", seed=-1)):
        with pytest.raises(pleach.PleachError, match="a seed is -1"):
            wrong_seed()
    goal = problem.goal
    wrong_options: list[dict[str, Any]] = [{"objective": "beauty"}, {"free": ["lenght"]}]
    for options in wrong_options:
        with pytest.raises(pleach.FitError):
            pleach.Problem(goal, "acer", **options)


def test_some_numbers_alone() -> None:
    goal = pleach.species("acer").grow(3).silhouette(48)
    some = pleach.Problem(goal, "acer", size=48, free=["length", "down_angle"], fix=["length[0]"])
    assert "length[1]" in some.names and "length[0]" not in some.names and "ratio" not in some.names


def test_numbers_need_no_goal(problem: pleach.Problem) -> None:
    alone = pleach.Numbers("acer")
    assert isinstance(problem, pleach.Numbers)
    for own, of_problem in zip(vars(alone).values(), (getattr(problem, name) for name in vars(alone))):
        assert np.array_equal(own, of_problem)
    assert pleach.Numbers("acer", free=["length"], fix=["length[0]"]).names == ["length[1]", "length[2]", "length[3]"]
    wide = pleach.Numbers("acer", wide=True)
    assert (wide.upper >= alone.upper[0]).any() and len(wide) >= len(alone)
    with pytest.raises(pleach.FitError, match="did you mean `length`"):
        pleach.Numbers("acer", free=["lenght"])


def test_further_views_count_as_much_as_the_goal() -> None:
    tree = pleach.species("acer").grow(3)
    front, side = tree.silhouette(64), tree.silhouette(64, view=90)
    other = pleach.species("palm").grow(1).silhouette(64)
    both = pleach.Problem(front, "acer", size=64, seed=3, views=[(side, 90)])
    odd = pleach.Problem(front, "acer", size=64, seed=3, views=[(other, 90)])
    assert [goal.shape for goal in both.goals] == [(64, 64)] * 2 and np.array_equal(both.goals[1], side)
    own = both.start[None]
    assert both.evaluate(own)[0] + 0.15 < odd.evaluate(own)[0]
    again = pickle.loads(pickle.dumps(odd))
    assert np.array_equal(again.evaluate(own), odd.evaluate(own)) and np.array_equal(again.goals[1], other)
    seen = both.silhouettes(own, view=1)[0]
    # Where the tree stands is read off each picture to a pixel.
    assert (seen == side).mean() > max(0.9, (seen == front).mean() + 0.05)
    assert not np.array_equal(seen, both.silhouettes(own)[0])
    for wrong in ([(side, 90, 3)], [(side, "left")], [side]):
        with pytest.raises((TypeError, ValueError)):
            pleach.Problem(front, "acer", views=wrong)  # type: ignore[arg-type]
    with pytest.raises(pleach.PleachError, match="elevation from"):
        pleach.Problem(front, "acer", views=[(side, (0.0, 120.0))])
    with pytest.raises(pleach.FitError, match="no view 2, expected one below 2"):
        both.silhouettes(own, view=2)


def test_pictures_are_those_that_are_compared(problem: pleach.Problem) -> None:
    values = rows(problem, 9)
    pictures = problem.silhouettes(values, threads=1)
    assert pictures.shape == (9, 64, 64) and pictures.dtype == bool
    assert np.array_equal(pictures, problem.silhouettes(values, threads=3))
    shared = (pictures & problem.goal).sum((1, 2)) / (pictures | problem.goal).sum((1, 2))
    assert np.abs(shared - problem.scores(values).iou).max() < 0.06, "searches draw a little coarser"
    assert problem.silhouettes(values[:0]).shape == (0, 64, 64)
    with pytest.raises(pleach.FitError, match=r"600000 pictures of 64 × 64 pixels are too many"):
        problem.silhouettes(np.zeros((600_000, len(problem))))


def test_a_tree_can_be_too_large(problem: pleach.Problem) -> None:
    small = pleach.Problem(problem.goal, "acer", size=64, max_leaves=100)
    values = small.start[None]
    assert np.isinf(small.evaluate(values)[0]) and np.isfinite(problem.evaluate(values)[0])
    assert not small.silhouettes(values).any()
    assert np.isinf(pickle.loads(pickle.dumps(small)).evaluate(values)[0])
    assert np.isinf(pleach.Problem(problem.goal, "acer", size=64, max_stems=3).evaluate(values)[0])
    with pytest.raises(pleach.FitError, match="max_stems is 0"):
        pleach.Problem(problem.goal, "acer", max_stems=0)


def test_problems_can_be_pickled_and_copied(problem: pleach.Problem, tmp_path: Path) -> None:
    values = rows(problem, 4)
    for again in (pickle.loads(pickle.dumps(problem)), copy.copy(problem), copy.deepcopy(problem)):
        assert again.names == problem.names and np.array_equal(again.goal, problem.goal)
        assert np.array_equal(again.upper, problem.upper) and np.array_equal(again.start, problem.start)
        assert np.array_equal(again.evaluate(values), problem.evaluate(values))
    # Of a file the pickle holds the picture, and of options what was said.
    file = tmp_path / "goal.png"
    file.write_bytes(pleach.species("palm").grow(2)._repr_png_())
    some = pleach.Problem(file, "palm", size=48, free=["length"], height=7.5, view=30, objective="iou", seed=4, match_height=False)
    kept = pickle.dumps(some)
    file.unlink()
    again = pickle.loads(kept)
    assert again.names == some.names and np.array_equal(again.goal, some.goal)
    assert np.array_equal(again.evaluate(rows(some, 3)), some.evaluate(rows(some, 3)))
