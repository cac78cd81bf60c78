"""Fits a picture with cmaes: CMA-ES with margin, which knows whole numbers, on all numbers of an acer.

    pip install cmaes
    python with_cmaes.py [GOAL]
"""

from __future__ import annotations

import sys

import numpy as np
from cmaes import CMAwM

import pleach


def main(generations: int = 40) -> float:
    goal = sys.argv[1] if len(sys.argv) > 1 else pleach.species("acer").grow(5).silhouette(128)
    problem = pleach.Problem(goal, "acer", size=128)
    free = problem.lower < problem.upper
    low, span = problem.lower[free], (problem.upper - problem.lower)[free]
    # Every number from 0 to 1; whole numbers in steps of their own.
    steps = np.where(problem.is_integer[free], 1.0 / span, 0.0)
    optimizer = CMAwM(
        mean=np.clip((problem.start[free] - low) / span, 0, 1),
        sigma=0.03,
        bounds=np.tile([0.0, 1.0], (int(free.sum()), 1)),
        steps=steps,
        seed=1,
    )
    best_cost, best = np.inf, problem.start.copy()
    for _ in range(generations):
        asked = [optimizer.ask() for _ in range(optimizer.population_size)]
        rows = np.tile(problem.start, (len(asked), 1))
        rows[:, free] = low + span * np.array([values for values, _ in asked])
        costs = np.where(np.isfinite(costs := problem.evaluate(rows)), costs, 1.0)
        optimizer.tell([(asked_for, float(cost)) for (_, asked_for), cost in zip(asked, costs)])
        if costs.min() < best_cost:
            best_cost, best = float(costs.min()), rows[costs.argmin()]
    print(f"cost {best_cost:.3f}, the species itself {problem.evaluate(problem.start[None])[0]:.3f}")
    print(problem.species(best).named("by_cmaes").to_toml().splitlines()[1])
    return best_cost


if __name__ == "__main__":
    main()
