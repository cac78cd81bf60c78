"""Fits a picture with Optuna: two dozen numbers of an acer, two hundred trees.

    pip install optuna
    python with_optuna.py [GOAL]
"""

from __future__ import annotations

import sys

import numpy as np
import optuna

import pleach


def main(trials: int = 200) -> float:
    goal = sys.argv[1] if len(sys.argv) > 1 else pleach.species("acer").grow(5).silhouette(128)
    problem = pleach.Problem(goal, "acer", size=128, free=["length", "down_angle", "branches", "curve", "shape"])

    def suggest(trial: optuna.Trial) -> list[float]:
        values: list[float] = []
        for i, name in enumerate(problem.names):
            low, high = float(problem.lower[i]), float(problem.upper[i])
            if problem.is_choice[i]:
                values.append(trial.suggest_categorical(name, list(range(int(low), int(high) + 1))))
            elif problem.is_integer[i]:
                values.append(trial.suggest_int(name, int(low), int(high)))
            elif low < high:
                values.append(trial.suggest_float(name, low, high, log=bool(problem.is_log[i])))
            else:
                values.append(low)
        return values

    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1, multivariate=True))
    study.enqueue_trial(dict(zip(problem.names, (float(value) for value in problem.start))))
    # Eight trees at a time: Optuna asks one by one, pleach grows them on all threads.
    for _ in range(trials // 8):
        asked = [study.ask() for _ in range(8)]
        costs = problem.evaluate(np.array([suggest(trial) for trial in asked]))
        for trial, cost in zip(asked, costs):
            study.tell(trial, float(cost) if np.isfinite(cost) else 1.0)
    best = problem.species([study.best_params.get(name, low) for name, low in zip(problem.names, problem.lower)])
    print(f"cost {study.best_value:.3f}, the species itself {problem.evaluate(problem.start[None])[0]:.3f}")
    print(best.named("by_optuna").to_toml().splitlines()[1])
    return float(study.best_value)


if __name__ == "__main__":
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    main()
