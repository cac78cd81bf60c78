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
