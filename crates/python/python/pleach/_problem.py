"""A goal as a function of numbers, for other people's optimisers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union, cast

import numpy as np
import numpy.typing as npt

from . import _native
from ._blend import Kind, one_species
from ._goal import Goal, given


@dataclass(frozen=True)
class Scores:
    """How well some individuals match the goal; float64 of shape (n,) each."""

    cost: npt.NDArray[np.float64]
    """The cost, to be minimised: 0 is a perfect match, infinity a tree that does not grow."""
    iou: npt.NDArray[np.float64]
    """Intersection over union, 0 to 1."""
    accuracy: npt.NDArray[np.float64]
    """The share of equal pixels."""
    likeness: npt.NDArray[np.float64]
    """How much they look like trees of one kind, 0 to 1; NaN where the objective does not look at it."""


def _again(kind: type[Problem], goal: Any, species: _native.Species, options: tuple[Any, ...]) -> Problem:
    """A problem from its pickle."""
    problem = kind.__new__(kind)
    problem._begin(goal, species, options)
    return problem


def _seeds(seeds: npt.ArrayLike, count: int) -> list[Any]:
    """A seed for each of ``count`` rows; the native part says what is wrong with one."""
    given = np.asarray(seeds)
    if given.ndim == 0:
        return [given.item()] * count
    if given.ndim != 1:
        raise _native.FitError(f"seeds are of shape {given.shape}, expected one seed, or shape ({count},)")
    # Of whole numbers above 2**63 and others numpy makes floats.
    is_listed = isinstance(seeds, (list, tuple))
    return list(cast("list[Any]", seeds if is_listed else given.tolist()))


class Problem:
    """The free numbers of a species, and what each choice of them is worth for a goal.

    ``goal`` is what ``pleach.fit`` takes, ``species`` where the numbers come from: what is not free stays as it is.
    ``free`` and ``fix`` are patterns as of ``pleach fit``: a parameter, one number such as ``length[1]``, a group, or
    ``level:1``. ``wide`` searches all that is declared instead of what is plausible. With ``match_height`` every tree
    is resized to the height of the goal before it is compared, as searches of pleach do.

    ``frame`` is where the tree stands, where that is known: metres per pixel, the column of the trunk's foot and the
    row of the ground in pixels of the picture. Otherwise it is read off the picture to a pixel or two.

    >>> import numpy as np, pleach
    >>> goal = pleach.species("acer").grow(3).silhouette(64)
    >>> problem = pleach.Problem(goal, "acer", size=64)
    >>> cost = problem.evaluate(problem.start[None, :])
    >>> cost.shape, 0 < cost[0] < 1
    ((1,), np.True_)
    """

    def __init__(
        self,
        goal: Goal,
        species: Kind,
        *,
        height: float = 10.0,
        size: int = 256,
        frame: Optional[tuple[float, float, float]] = None,
        view: Union[float, tuple[float, float], None] = None,
        leaves: bool = True,
        objective: str = "balance",
        free: Sequence[str] = (),
        fix: Sequence[str] = (),
        seed: int = 1,
        match_height: bool = True,
        wide: bool = False,
    ) -> None:
        options = (height, size, view, frame, leaves, objective, list(free), list(fix), seed, match_height, wide)
        self._begin(given(goal), one_species(species), options)

    def _begin(self, goal: Any, species: _native.Species, options: tuple[Any, ...]) -> None:
        self._begun = (species, options)
        self._native = _native.NativeProblem(goal, species, *options)
        self.names: list[str] = self._native.names
        """The free numbers, such as ``length[1]``."""
        self.kinds: list[str] = self._native.kinds
        """What each is: real, integer, choice, flagged (its sign is a switch) or flagged integer."""
        self.is_integer: npt.NDArray[np.bool_] = np.array([kind != "real" and kind != "flagged" for kind in self.kinds])
        """Which are whole, choices among them."""
        self.is_choice: npt.NDArray[np.bool_] = np.array([kind == "choice" for kind in self.kinds])
        """Which are numbers of names, so that neighbours are no more alike than others."""
        self.is_log: npt.NDArray[np.bool_] = np.array(self._native.is_log)
        """Which are compared by ratio: search their logarithms."""
        self.lower: npt.NDArray[np.float64] = self._native.lower
        """The smallest value of each, float64 of shape (numbers,)."""
        self.upper: npt.NDArray[np.float64] = self._native.upper
        """The largest."""
        self.start: npt.NDArray[np.float64] = self._native.start
        """Those of the species."""
        self.goal: npt.NDArray[np.bool_] = self._native.goal
        """The goal as it is compared with, bool of shape (height, width)."""

    def __reduce__(self) -> tuple[Any, ...]:
        # With the picture itself: a file may not be there where this is read.
        return _again, (type(self), self._native.source, *self._begun)

    def __len__(self) -> int:
        return len(self.names)

    def scores(
        self,
        values: npt.ArrayLike,
        seeds: Optional[npt.ArrayLike] = None,
        *,
        threads: Optional[int] = None,
    ) -> Scores:
        """Grows and compares a tree for each row of ``values``, shape (n, numbers), on all threads.

        Values beyond the bounds count as the nearest within, whole numbers are rounded. ``seeds``, shape (n,), are
        those of the trees, or one for all of them; ``seed`` by default. The result does not depend on the number of threads. Raises
        ``FitError`` for a wrong shape, and for NaN and infinity by name and row.
        """
        rows = np.asarray(values)
        if rows.dtype == object or rows.ndim != 2:
            raise _native.FitError(
                f"values are {rows.dtype} of shape {rows.shape}, expected float64 of shape (n, {len(self)})"
            )
        chosen = None if seeds is None else _seeds(seeds, len(rows))
        return Scores(**self._native.scores(np.asarray(rows, dtype=np.float64), chosen, threads))

    def evaluate(
        self,
        values: npt.ArrayLike,
        seeds: Optional[npt.ArrayLike] = None,
        *,
        threads: Optional[int] = None,
    ) -> npt.NDArray[np.float64]:
        """The costs alone, float64 of shape (n,): what an optimiser makes small. See ``scores``."""
        return self.scores(values, seeds, threads=threads).cost

    def species(self, values: npt.ArrayLike, seed: int = 1) -> _native.Species:
        """The species with these numbers, shape (numbers,), of the size that it was compared at."""
        return self._native.species(np.asarray(values, dtype=np.float64), seed)
