"""Fills an archive with pyribs: different trees that are all like one goal, over two traits.

The traits are how wide the crown is and how dense, of the tree seen from the side, which the goal does not show.
Only trees that are like the goal get in. Leaves a heat map with thumbnails in archive.png.

    pip install "ribs[visualize]" matplotlib
    python with_ribs.py [GOAL]
"""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt
from ribs.archives import GridArchive
from ribs.emitters import EvolutionStrategyEmitter, IsoLineEmitter
from ribs.schedulers import Scheduler

import pleach

SIZE = 96
#: Width over height, and the share of its box that is ink.
WIDTHS, INKS = (0.3, 1.3), (0.05, 0.4)
#: Least likeness to the goal.
LIKE = 0.7


def traits(problem: pleach.Problem, values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Width over height, and the share of its box that is ink, of each tree seen from the side."""

    def of(numbers: npt.NDArray[np.float64]) -> tuple[float, float]:
        ink = problem.species(numbers).grow().silhouette(SIZE, view=90)
        columns, rows = np.flatnonzero(ink.any(axis=0)), np.flatnonzero(ink.any(axis=1))
        width, height = np.ptp(columns) + 1, np.ptp(rows) + 1
        return float(width / height), float(ink.sum() / (width * height))

    # Threads help: growing lets go of Python's lock.
    with ThreadPoolExecutor() as pool:
        return np.array(list(pool.map(of, values))).reshape(-1, 2)


def main(rounds: int = 1500, picture: str = "archive.png") -> Any:
    goal = sys.argv[1] if len(sys.argv) > 1 else pleach.species("acer").grow(5).silhouette(SIZE)
    problem = pleach.Problem(goal, "acer", size=SIZE, objective="likeness")
    free = problem.lower < problem.upper
    low, span = problem.lower[free], (problem.upper - problem.lower)[free]
    first = np.clip((problem.start[free] - low) / span, 0, 1)
    archive = GridArchive(
        solution_dim=len(first),
        dims=[60, 60],
        ranges=[WIDTHS, INKS],
        # Above it a cell takes what is better than what it has, as without.
        threshold_min=LIKE,
        learning_rate=1.0,
        seed=1,
    )
    bounds = np.tile([0.0, 1.0], (len(first), 1))
    emitters = [
        IsoLineEmitter(archive, x0=first, iso_sigma=0.03, line_sigma=0.2, bounds=bounds, batch_size=24, seed=2),
        # Without bounds, within which it would draw again and again: `whole` takes the nearest that is allowed.
        EvolutionStrategyEmitter(archive, x0=first, sigma0=0.02, batch_size=12, seed=3),
    ]
    scheduler = Scheduler(archive, emitters)

    def whole(units: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        rows = np.tile(problem.start, (len(units), 1))
        rows[:, free] = low + span * np.clip(units, 0, 1)
        return rows

    for _ in range(rounds):
        rows = whole(scheduler.ask())
        costs = problem.evaluate(rows)
        grown = np.isfinite(costs)
        measures = np.zeros((len(rows), 2))
        measures[grown] = traits(problem, rows[grown])
        scheduler.tell(np.where(grown, 1.0 - costs, 0.0), measures)
    stats = archive.stats
    print(f"{stats.num_elites} different trees, the best {stats.obj_max:.3f}, the mean {stats.obj_mean:.3f} (1 is the goal)")
    show(problem, archive, whole, picture)
    return archive


def show(problem: pleach.Problem, archive: Any, whole: Any, picture: str) -> None:
    """A heat map of the archive, with the silhouettes of a few of its trees."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from ribs.visualize import grid_archive_heatmap

    figure, axes = plt.subplots(figsize=(11, 8))
    grid_archive_heatmap(archive, ax=axes)
    axes.set(xlabel="width over height, from the side", ylabel="share of its box that is ink, from the side")
    elites = archive.data(["solution", "measures", "objective"], return_type="dict")
    order = np.argsort(-elites["objective"])
    shown: list[npt.NDArray[np.float64]] = []
    for number in order:
        place = elites["measures"][number]
        apart = all(abs(place[0] - other[0]) > 0.12 or abs(place[1] - other[1]) > 0.05 for other in shown)
        if not apart or len(shown) == 40:
            continue
        shown.append(place)
        ink = problem.species(whole(elites["solution"][number][None])[0]).grow().silhouette(SIZE, view=90)
        rgba = np.zeros((*ink.shape, 4))
        rgba[ink] = (0, 0, 0, 0.85)
        axes.imshow(
            rgba,
            extent=(place[0] - 0.05, place[0] + 0.05, place[1] - 0.022, place[1] + 0.022),
            aspect="auto",
            zorder=3,
        )
    axes.set(xlim=WIDTHS, ylim=INKS)
    figure.savefig(picture, dpi=110, bbox_inches="tight")
    plt.close(figure)


if __name__ == "__main__":
    main()
