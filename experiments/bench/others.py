"""Optimisers of other people on the goals of the exam, each with as many trees as the rows of `pleach bench`.

    pip install numpy cma cmaes scipy optuna        and the package `pleach`
    pleach bench --goals goals
    python experiments/bench/others.py goals answers --trees 100 [--rows pycma,cmawm,scipy_de,optuna_tpe]
    pleach bench --check answers/pycma.csv --check answers/cmawm.csv ... -o exam

Each begins where `pleach fit` begins: at the numbers of its first guess, which no tree is counted for. Whole numbers and
choices are searched as the optimiser offers it: in steps by CMAwM, SciPy and Optuna, rounded by pycma. Trees above
50,000 leaves or 10,000 stems count as trees that do not grow. Rows that a run has finished are not made again.
"""

from __future__ import annotations

import argparse
import csv
import pathlib
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

import pleach

Floats = npt.NDArray[np.float64]
SIGMA = 0.03
"""First step of CMA-ES, as a part of each range: that of `near_step` in pleach."""


class Spent(Exception):
    """All trees are used up."""


class Contest:
    """A goal as a function of numbers from 0 to 1, which counts its trees and keeps the best."""

    def __init__(self, problem: pleach.Problem, trees: int) -> None:
        self.problem = problem
        self.free = problem.lower < problem.upper
        self.low = problem.lower[self.free]
        self.span = (problem.upper - problem.lower)[self.free]
        self.is_integer = problem.is_integer[self.free]
        self.start: Floats = np.clip((problem.start[self.free] - self.low) / self.span, 0.0, 1.0)
        self.left = trees
        self.best_cost, self.best = np.inf, problem.start.copy()

    def rows(self, units: Floats) -> Floats:
        rows = np.tile(self.problem.start, (len(units), 1))
        values = self.low + self.span * np.clip(units, 0.0, 1.0)
        rows[:, self.free] = np.where(self.is_integer, np.round(values), values)
        return rows

    def costs(self, units: Floats) -> Floats:
        """The costs of as many rows as there are trees left; 1 for trees that do not grow."""
        if self.left == 0:
            raise Spent
        rows = self.rows(units[: self.left])
        self.left -= len(rows)
        costs = self.problem.evaluate(rows)
        if costs.min() < self.best_cost:
            self.best_cost, self.best = float(costs.min()), rows[costs.argmin()]
        padded = np.ones(len(units))
        padded[: len(costs)] = np.where(np.isfinite(costs), costs, 1.0)
        return padded


def pycma(contest: Contest) -> None:
    import cma

    options = {"bounds": [0.0, 1.0], "seed": 1, "verbose": -9, "maxfevals": contest.left}
    contest.costs(contest.start[None])
    search = cma.CMAEvolutionStrategy(contest.start, SIGMA, options)
    while True:
        asked = search.ask()
        search.tell(asked, list(contest.costs(np.array(asked))))


def cmawm(contest: Contest) -> None:
    from cmaes import CMAwM

    contest.costs(contest.start[None])
    bounds = np.tile([0.0, 1.0], (len(contest.start), 1))
    steps = np.where(contest.is_integer, 1.0 / contest.span, 0.0)
    search = CMAwM(mean=contest.start.copy(), sigma=SIGMA, bounds=bounds, steps=steps, seed=1)
    while True:
        asked = [search.ask() for _ in range(search.population_size)]
        costs = contest.costs(np.array([values for values, _ in asked]))
        search.tell([(told, float(cost)) for (_, told), cost in zip(asked, costs)])


def scipy_de(contest: Contest) -> None:
    from scipy.optimize import differential_evolution

    bounds = [(0.0, 1.0)] * len(contest.start)
    # A population that a small budget can move: one member for every tenth tree, the start among them.
    members = max(5, contest.left // 10)
    first = np.clip(contest.start + SIGMA * np.random.default_rng(1).normal(size=(members, len(bounds))), 0.0, 1.0)
    first[0] = contest.start
    differential_evolution(
        lambda units: contest.costs(np.asarray(units).T),
        bounds, init=first, maxiter=contest.left, polish=False, seed=1, vectorized=True, updating="deferred",
    )


def optuna_tpe(contest: Contest) -> None:
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1, multivariate=True))
    study.enqueue_trial({str(i): float(unit) for i, unit in enumerate(contest.start)})
    while True:
        trial = study.ask()
        units = np.array([trial.suggest_float(str(i), 0.0, 1.0) for i in range(len(contest.start))])
        study.tell(trial, float(contest.costs(units[None])[0]))


ROWS: dict[str, Callable[[Contest], None]] = {
    "pycma": pycma, "cmawm": cmawm, "scipy_de": scipy_de, "optuna_tpe": optuna_tpe,
}


def answer(row: dict[str, str], goals: pathlib.Path, name: str, trees: int) -> tuple[pleach.Species, float]:
    """The species that the optimiser called `name` finds, and its seconds."""
    frame = tuple(float(row[key]) for key in ("meters_per_pixel", "axis_column", "ground_row"))
    goal = goals / row["file"]
    began = time.monotonic()
    guess = pleach.fit(goal, frame=frame, evaluations=1, individual=False).species
    problem = pleach.Problem(goal, guess, frame=frame, max_leaves=50_000, max_stems=10_000)
    contest = Contest(problem, trees)
    try:
        ROWS[name](contest)
    except Spent:
        pass
    return problem.species(contest.best), time.monotonic() - began


def done(table: pathlib.Path) -> list[dict[str, Any]]:
    if not table.exists():
        return []
    with table.open(newline="") as file:
        return list(csv.DictReader(file))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("goals", type=pathlib.Path, help="the folder that `pleach bench --goals` has written")
    parser.add_argument("out", type=pathlib.Path, help="a folder for the answers")
    parser.add_argument("--trees", type=int, default=100)
    parser.add_argument("--rows", default=",".join(ROWS), help="only these: " + ", ".join(ROWS))
    parser.add_argument("--only", default="", help="only goals whose names begin so")
    args = parser.parse_args()
    with (args.goals / "goals.csv").open(newline="") as file:
        goals = [row for row in csv.DictReader(file) if row["goal"].startswith(args.only)]
    for name in args.rows.split(","):
        table = args.out / f"{name}.csv"
        (args.out / name).mkdir(parents=True, exist_ok=True)
        answers, budget = done(table), f"{args.trees} trees"
        for row in goals:
            if any((old["goal"], old["budget"]) == (row["goal"], budget) for old in answers):
                continue
            species, seconds = answer(row, args.goals, name, args.trees)
            path = args.out / name / f"{row['goal']}-{args.trees}.toml"
            path.write_text(species.to_toml())
            answers.append({
                "goal": row["goal"], "species": f"{name}/{path.name}", "seed": 1, "budget": budget,
                "seconds": f"{seconds:.1f}",
            })
            # Complete after every goal, so that a run that is killed loses one.
            with table.open("w", newline="") as file:
                writer = csv.DictWriter(file, list(answers[-1]))
                writer.writeheader()
                writer.writerows(answers)
            print(f"{name} {row['goal']}: {seconds:.1f} s", flush=True)


if __name__ == "__main__":
    main()
