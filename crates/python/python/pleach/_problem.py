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


def _again(
    kind: type[Problem],
    goals: list[Any],
    species: _native.Species,
    options: tuple[Any, ...],
    directions: list[Any],
    limits: tuple[Optional[int], Optional[int]],
) -> Problem:
    """A problem from its pickle."""
    problem = kind.__new__(kind)
    problem._begin(goals[0], species, options, list(zip(goals[1:], directions)), limits)
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


class Numbers:
    """The free numbers of a species, for an optimiser or a sampler that has no goal.

    ``free`` and ``fix`` are patterns as of ``pleach fit``: a parameter, one number such as ``length[1]``, a group, or
    ``level:1``. ``wide`` has the bounds of all that is declared instead of what is plausible.

    >>> import pleach
    >>> crown = pleach.Numbers("acer", free=["crown"])
    >>> len(crown) == len(crown.lower) and bool((crown.lower <= crown.upper).all())
    True
    """

    def __init__(self, species: Kind, *, free: Sequence[str] = (), fix: Sequence[str] = (), wide: bool = False) -> None:
        self._describe(_native.numbers_of(one_species(species), list(free), list(fix), wide))

    def _describe(self, described: dict[str, Any]) -> None:
        self.names: list[str] = described["names"]
        """What they are called, such as ``length[1]``."""
        self.kinds: list[str] = described["kinds"]
        """What each is: real, integer, choice, flagged (its sign is a switch) or flagged integer."""
        self.is_integer: npt.NDArray[np.bool_] = np.array([kind != "real" and kind != "flagged" for kind in self.kinds])
        """Which are whole, choices among them."""
        self.is_choice: npt.NDArray[np.bool_] = np.array([kind == "choice" for kind in self.kinds])
        """Which are numbers of names, so that neighbours are no more alike than others."""
        self.is_log: npt.NDArray[np.bool_] = np.array(described["is_log"])
        """Which are compared by ratio: search their logarithms."""
        self.lower: npt.NDArray[np.float64] = described["lower"]
        """The smallest value of each, float64 of shape (numbers,)."""
        self.upper: npt.NDArray[np.float64] = described["upper"]
        """The largest."""
        self.start: npt.NDArray[np.float64] = described["start"]
        """Those of the species."""

    def __len__(self) -> int:
        return len(self.names)


class Problem(Numbers):
    """The free numbers of a species, and what each choice of them is worth for a goal.

    ``goal`` is what ``pleach.fit`` takes, ``species`` where the numbers come from: what is not free stays as it is.
    ``free`` and ``fix`` are patterns as of ``pleach fit``: a parameter, one number such as ``length[1]``, a group, or
    ``level:1``. ``wide`` searches all that is declared instead of what is plausible. With ``match_height`` every tree
    is resized to the height of the goal before it is compared, as searches of pleach do.

    ``frame`` is where the tree stands, where that is known: metres per pixel, the column of the trunk's foot and the
    row of the ground in pixels of the picture. Otherwise it is read off the picture to a pixel or two.

    ``views`` are further pictures of the same tree, each with its direction: an azimuth in degrees, or azimuth and
    elevation. The cost is then the mean over all pictures.

    A tree with more leaves than ``max_leaves`` or more stems than ``max_stems`` counts as one that does not grow, with
    an infinite cost. Anywhere within the bounds a tree may have millions of leaves and take seconds: with 50,000 and
    10,000 it does not.

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
        views: Sequence[tuple[Goal, Union[float, tuple[float, float]]]] = (),
        max_leaves: Optional[int] = None,
        max_stems: Optional[int] = None,
    ) -> None:
        options = (height, size, view, frame, leaves, objective, list(free), list(fix), seed, match_height, wide)
        further = [(given(picture), direction) for picture, direction in views]
        self._begin(given(goal), one_species(species), options, further, (max_leaves, max_stems))

    def _begin(
        self,
        goal: Any,
        species: _native.Species,
        options: tuple[Any, ...],
        views: list[tuple[Any, Any]],
        limits: tuple[Optional[int], Optional[int]],
    ) -> None:
        self._begun = (species, options, [direction for _, direction in views], limits)
        arguments: tuple[Any, ...] = (*options, views, *limits)
        self._native = _native.NativeProblem(goal, species, *arguments)
        self._describe(self._native.numbers)
        self.goals: list[npt.NDArray[np.bool_]] = self._native.goals
        """The goal and the further views as they are compared with, bool of shape (height, width) each."""
        self.goal: npt.NDArray[np.bool_] = self.goals[0]
        """The first of them."""
    def __reduce__(self) -> tuple[Any, ...]:
        # With the pictures themselves: files may not be there where this is read.
        return _again, (type(self), self._native.sources, *self._begun)

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
        return Scores(**self._native.scores(*self._rows(values, seeds), threads))

    def _rows(
        self, values: npt.ArrayLike, seeds: Optional[npt.ArrayLike]
    ) -> tuple[npt.NDArray[np.float64], Optional[list[Any]]]:
        """Rows of values and a seed for each, as the native part takes them."""
        rows = np.asarray(values)
        if rows.dtype == object or rows.ndim != 2:
            raise _native.FitError(
                f"values are {rows.dtype} of shape {rows.shape}, expected float64 of shape (n, {len(self)})"
            )
        chosen = None if seeds is None else _seeds(seeds, len(rows))
        return np.asarray(rows, dtype=np.float64), chosen

    def silhouettes(
        self,
        values: npt.ArrayLike,
        seeds: Optional[npt.ArrayLike] = None,
        *,
        view: int = 0,
        threads: Optional[int] = None,
    ) -> npt.NDArray[np.bool_]:
        """The picture of the tree of each row of ``values``, as it is compared with the goal: bool of shape (n, height,
        width), empty where no tree grows. ``view`` is the number of the picture, 0 for the goal and from 1 on for
        ``views``. See ``scores`` for the rest.

        >>> import pleach
        >>> goal = pleach.species("acer").grow(3).silhouette(64)
        >>> problem = pleach.Problem(goal, "acer", size=64, seed=3)
        >>> picture = problem.silhouettes(problem.start[None, :])[0]
        >>> picture.shape, bool((picture == problem.goal).mean() > 0.9)
        ((64, 64), True)
        """
        return self._native.silhouettes(*self._rows(values, seeds), view, threads)

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
