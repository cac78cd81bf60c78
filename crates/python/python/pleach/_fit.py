"""Fits: from a picture to a species."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._goal import Goal, given
from ._score import Card, card_of


@dataclass(frozen=True)
class Individual:
    """One tree that lies on the goal."""

    species: _native.Species
    """Its species, with the draws of single stems; ``grow()`` grows it."""
    card: Card
    """How well it matches."""
    silhouette: npt.NDArray[np.bool_] = field(repr=False)
    """Over the goal, bool of its shape."""
    view_cards: list[Card] = field(repr=False)
    """How well it matches each of the further views."""


@dataclass(frozen=True)
class Fit:
    """What a fit has found. It can be pickled."""

    species: _native.Species
    """The kind: parameters whose trees are like the goal."""
    card: Card
    """How well the kind's own tree matches the goal."""
    view_cards: list[Card] = field(repr=False)
    """How well the kind's own tree matches each of the further views."""
    individuals: list[Individual]
    """Trees that lie on the goal, the best first; empty where the generator has none."""
    verdict: Optional[str]
    """Whether the kind is right, in words."""
    fresh_likeness: Optional[tuple[float, float]]
    """Likeness of other seeds to the goal, mean and standard deviation: what the parameters are worth."""
    looks_like: list[tuple[str, float]]
    """The species that the goal looks like, with confidence, the likeliest first."""
    identifiability: dict[str, tuple[float, str]]
    """For each free number its value and whether the goal determines it: ``determined``, ``loosely``, ``not-seen`` or
    ``not-tried`` (for want of time)."""
    history: dict[str, npt.NDArray[np.float64]] = field(repr=False)
    """A row for each generation: ``evaluations``, ``best_cost``, ``iou``, ``likeness`` ..."""
    cost: float
    """What the search made small, of the kind."""
    evaluations: int
    """Trees grown by the search."""
    generations: int
    seconds: float
    """What the first guess and the search took."""
    leaves: bool
    """Whether trees have leaves: asked for, or seen in the goal."""
    warnings: list[str]
    """What about the goal is not as a fit expects."""
    interrupted: bool
    """Whether ctrl-C ended it before its budget did."""
    goal: npt.NDArray[np.bool_] = field(repr=False)
    """The goal, bool of shape (height, width)."""
    silhouette: npt.NDArray[np.bool_] = field(repr=False)
    """The kind's own tree over it."""

    @property
    def individual(self) -> Optional[_native.Species]:
        """The tree that lies best on the goal; None without any."""
        return self.individuals[0].species if self.individuals else None

    @property
    def best(self) -> _native.Species:
        """The tree that lies best on the goal, or else the kind."""
        return self.individual or self.species

    def overlay(self) -> npt.NDArray[np.uint8]:
        """The best tree over the goal, uint8 of shape (height, width, 3): grey where they agree, orange what is
        missing, blue what is too much."""
        ink = self.individuals[0].silhouette if self.individuals else self.silhouette
        picture = np.full((*self.goal.shape, 3), 255, np.uint8)
        picture[ink & self.goal] = (110, 110, 110)
        picture[self.goal & ~ink] = (230, 140, 30)
        picture[ink & ~self.goal] = (70, 120, 220)
        return picture

    def _repr_png_(self) -> bytes:
        return self.best._repr_png_()


Progress = Callable[[dict[str, Any]], object]


class _Bar:
    """Progress as a bar of tqdm."""

    def __init__(self) -> None:
        from tqdm.auto import tqdm

        self._bar = tqdm(total=100, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}")
        self._stage = ""

    def __call__(self, told: dict[str, Any]) -> None:
        if told["stage"] != self._stage:
            self._stage = told["stage"]
            self._bar.reset()
        words = {"guess": "first guess", "begun": "search", "search": "search", "judging": "judging", "individual": "this very tree"}
        said = words[self._stage]
        if told.get("likeness") is not None:
            said += f", likeness {told['likeness']:.3f}"
        self._bar.set_description_str(said)
        self._bar.n = min(100, round(100 * (told.get("used") or 0)))
        self._bar.refresh()

    def close(self) -> None:
        self._bar.close()


def fit(
    goal: Goal,
    *,
    start: Union[str, _native.Species] = "auto",
    generator: Optional[str] = None,
    height: float = 10.0,
    size: int = 256,
    frame: Optional[tuple[float, float, float]] = None,
    view: Union[float, tuple[float, float], None] = None,
    views: Sequence[tuple[Goal, Union[float, tuple[float, float]]]] = (),
    leaves: Optional[bool] = None,
    optimizer: str = "evolution",
    objective: str = "balance",
    free: Sequence[str] = (),
    fix: Sequence[str] = (),
    seed: int = 1,
    tree_seed: Optional[int] = 1,
    timeout: Optional[float] = None,
    evaluations: Optional[int] = None,
    generations: Optional[int] = None,
    individual: Union[bool, float, str] = True,
    individuals: int = 1,
    name: Optional[str] = None,
    threads: Optional[int] = None,
    progress: Union[bool, Progress] = False,
) -> Fit:
    """Finds the parameters of the tree in a picture; as ``pleach fit``, whose results it gives bit for bit.

    The picture is a path, an array (bool of shape (height, width), True where the tree is; or uint8), a PIL image or
    an open file. ``height`` is the tree's, in metres; ``size`` the longer side that the search compares at, in
    pixels; ``frame``, where it is known, metres per pixel, the column of the trunk's foot and the row of the ground in
    pixels of the picture: it is taken as exact, and the height follows from it; ``view`` the azimuth, or azimuth and elevation, in degrees. ``views`` are further pictures of the same tree,
    each with where it was taken from: ``[("side.png", 90)]``.

    The fit begins at ``start``: ``"auto"``, the species that the goal looks like; ``"random"``; or a species. ``leaves``
    says whether the tree has some; None looks for them. It ends after ``timeout`` seconds, or so many ``evaluations`` or
    ``generations``; after a minute if nothing is said. ``individual`` is how long this very tree is searched: True, a
    share of the budget; seconds; a number of trees such as ``"400trees"``; or False, which ``"off"`` is too. ``tree_seed`` None searches the seed
    too.

    ``progress`` is True, for a bar (with tqdm), or a function of a dict: ``stage`` and what it says of it. Fits
    bounded by evaluations are the same bits on any number of ``threads``. Ctrl-C ends the fit with what it has:
    ``interrupted`` is then true; before it has anything, ``KeyboardInterrupt`` is raised.

    Raises ``GoalError`` for a picture that is no goal and ``FitError`` for options that cannot be.

    >>> import pleach
    >>> goal = pleach.species("acer").grow(5).silhouette(48)
    >>> found = pleach.fit(goal, start="acer", evaluations=30, size=48, individual="16trees")
    >>> found.species.name, found.card.likeness > 0.5
    ('goal', True)
    """
    options = {
        "from_": start,
        "generator": generator,
        "height": height,
        "size": size,
        "frame": frame,
        "view": view,
        "views": [(given(picture), direction) for picture, direction in views],
        "leaves": leaves,
        "optimizer": optimizer,
        "objective": objective,
        "free": list(free),
        "fix": list(fix),
        "seed": seed,
        "tree_seed": tree_seed,
        "timeout": timeout,
        "evaluations": evaluations,
        "generations": generations,
        "individual": individual,
        "individuals": individuals,
        "name": name,
        "threads": threads,
    }
    bar: Optional[_Bar] = None
    tell: Optional[Progress] = None
    if progress is True:
        try:
            tell = bar = _Bar()
        except ImportError:
            warnings.warn("progress=True shows a bar with tqdm, which is not installed", stacklevel=2)
    elif progress is not False:
        tell = progress
    try:
        found = _native.fit(given(goal), options, tell)
    finally:
        if bar is not None:
            bar.close()
    species, card, silhouette, cards = found.pop("kind")
    found.update(species=species, card=card_of(card), silhouette=silhouette, view_cards=[card_of(one) for one in cards])
    found["individuals"] = [
        Individual(species, card_of(card), silhouette, [card_of(one) for one in cards])
        for species, card, silhouette, cards in found["individuals"]
    ]
    return Fit(**found)
