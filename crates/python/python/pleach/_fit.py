"""Fits: from a picture to a species."""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._goal import Goal, given
from ._reading import Reading, corrections
from ._score import Card, Point, card_of, hints


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
class Interval:
    """Ends between which nine in ten lie, and the middle."""

    low: float
    median: float
    high: float


@dataclass(frozen=True)
class PosteriorNumber:
    """What is known of one number of the goal's tree."""

    prior: Interval
    """Before the picture was seen."""
    posterior: Interval
    """Since."""
    shrunk: float
    """By how much the variance is smaller since, in 0..=1."""


@dataclass(frozen=True)
class Posterior:
    """What a picture says about the numbers of its tree, learnt from trees around a species."""

    species: str
    """The species that the trees are around."""
    trees: int
    """How many of them grew."""
    familiarity: float
    """The share of those trees whose pictures are at least as strange as the goal is, in 0..=1."""
    is_familiar: bool
    """Whether the goal is like a picture of such a tree; where it is not, intervals cannot be trusted."""
    numbers: dict[str, PosteriorNumber] = field(repr=False)
    """Every number that varies, by its slot, such as ``length[1]``."""
    samples: list[_native.Species] = field(repr=False)
    """Trees that the goal may be of, each with its own seed."""


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
    history: dict[str, npt.NDArray[np.float64]] = field(repr=False)
    """A row for each generation: ``evaluations``, ``best_cost``, ``iou``, ``likeness`` ..."""
    warnings: list[str]
    """What about the goal is not as a fit expects."""
    report: dict[str, Any] = field(repr=False)
    """Everything that is known of the fit, as the program writes it to ``summary.json``: the options included."""
    goal: npt.NDArray[np.bool_] = field(repr=False)
    """The goal, bool of shape (height, width)."""
    silhouette: npt.NDArray[np.bool_] = field(repr=False)
    """The kind's own tree over it."""
    posterior: Optional[Posterior] = field(repr=False)
    """What the goal says about the numbers of its tree, where it was asked for."""

    @property
    def fresh_likeness(self) -> Optional[tuple[float, float]]:
        """Likeness of other seeds to the goal, mean and standard deviation: what the parameters are worth."""
        fresh = self.report["fresh_seeds"]
        return (fresh["likeness"]["mean"], fresh["likeness"]["sd"]) if fresh else None

    @property
    def looks_like(self) -> list[tuple[str, float]]:
        """The species that the goal looks like, with confidence, the likeliest first."""
        return [(one["species"], one["confidence"]) for one in self.report["looks_like"]]

    @property
    def identifiability(self) -> dict[str, tuple[float, str]]:
        """For each free number its value and whether the goal determines it: ``determined``, ``loosely``, ``not-seen`` or
        ``not-tried`` (for want of time)."""
        return {one["slot"]: (one["value"], one["seen"]) for one in self.report["parameters"]}

    @property
    def intervals(self) -> dict[str, PosteriorNumber]:
        """For each number that a picture of such a tree tells of, or leaves open, its interval before the picture was seen
        and since: of the posterior where one was asked for, and else by what is built in. Empty where the goal is not like
        a picture of a tree around the species ``report["intervals"]["species"]``, or nothing is known of such trees."""
        return {
            one["slot"]: PosteriorNumber(Interval(**one["before"]), Interval(**one["interval"]), one["shrunk"])
            for one in self.report["parameters"]
            if one["interval"] is not None
        }

    @property
    def cost(self) -> float:
        """What the search minimised, of the kind."""
        return float(self.report["cost"])

    @property
    def evaluations(self) -> int:
        """Trees grown by the search."""
        return int(self.report["evaluations"])

    @property
    def generations(self) -> int:
        """Generations of the search."""
        return int(self.report["generations"])

    @property
    def seconds(self) -> float:
        """What the first guess and the search took."""
        return float(self.report["seconds"])

    @property
    def leaves(self) -> bool:
        """Whether trees have leaves: asked for, or seen in the goal."""
        return bool(self.report["leaves"])

    @property
    def interrupted(self) -> bool:
        """Whether ctrl-C ended it before its budget did."""
        return not self.report["finished"]

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

    def __call__(self, event: dict[str, Any]) -> None:
        if event["stage"] != self._stage:
            self._stage = event["stage"]
            self._bar.reset()
        words = {"guess": "first guess", "begun": "search", "search": "search", "judging": "judging", "individual": "this very tree",
                 "posterior": "how sure it is"}
        said = words[self._stage]
        if event.get("likeness") is not None:
            said += f", likeness {event['likeness']:.3f}"
        self._bar.set_description_str(said)
        self._bar.n = min(100, round(100 * (event.get("used") or 0)))
        self._bar.refresh()

    def close(self) -> None:
        self._bar.close()


#: Azimuth in degrees, or azimuth and elevation.
Direction = Union[float, tuple[float, float]]


def _direction(given: Union[str, Direction]) -> str:
    """A direction as text."""
    if isinstance(given, str):
        return given
    azimuth, elevation = given if isinstance(given, tuple) else (given, 0.0)
    return f"{azimuth},{elevation}"


def _effort(given: Union[bool, float, str]) -> str:
    """How long a tree is searched, as text."""
    if isinstance(given, bool):
        return "share" if given else "off"
    return given if isinstance(given, str) else f"{given}s"


def _as_json(options: dict[str, Any]) -> str:
    """The options as JSON, which has no infinite numbers."""
    for name, value in options.items():
        if isinstance(value, float) and not math.isfinite(value):
            raise _native.FitError(f"`{name}` is {value}, expected a number")
    return json.dumps(options, default=_number)


def _number(value: Any) -> Any:
    """A number of numpy's as one of Python's."""
    if isinstance(value, np.generic):
        return value.item()  # pyright: ignore[reportUnknownVariableType]
    raise _native.FitError(f"{value!r} is not a number, a text or a list")


def fit(
    goal: Goal,
    *,
    start: Union[str, _native.Species] = "auto",
    generator: Optional[str] = None,
    height: float = 10.0,
    size: int = 256,
    mask: Optional[str] = None,
    box: Optional[tuple[int, int, int, int]] = None,
    include: Sequence[Point] = (),
    exclude: Sequence[Point] = (),
    strokes: Optional[str] = None,
    wood: Optional[str] = None,
    reading: Union[Reading, Mapping[str, Any], None] = None,
    tree: str = "auto",
    ground_row: Optional[float] = None,
    axis_column: Optional[float] = None,
    frame: Optional[tuple[float, float, float]] = None,
    view: Optional[Direction] = None,
    views: Sequence[tuple[Goal, Union[str, Direction]]] = (),
    free_frame: bool = False,
    holdout_views: Sequence[tuple[Goal, Direction]] = (),
    leaves: Optional[bool] = None,
    appearance: str = "picture",
    volume_from: Optional[str] = None,
    optimizer: Union[str, dict[str, dict[str, Any]]] = "evolution",
    evolve_rules: bool = False,
    objective: Optional[str] = None,
    free: Sequence[str] = (),
    fix: Sequence[str] = (),
    seed: int = 1,
    tree_seed: Optional[int] = 1,
    robust: int = 1,
    timeout: Optional[float] = None,
    evaluations: Optional[int] = None,
    generations: Optional[int] = None,
    target_iou: Optional[float] = None,
    individual: Union[bool, float, str] = True,
    individuals: int = 1,
    posterior: Union[bool, int] = False,
    name: Optional[str] = None,
    threads: Optional[int] = None,
    progress: Union[bool, Progress] = False,
) -> Fit:
    """Finds the parameters of the tree in a picture; as ``pleach fit``, whose results it gives bit for bit.

    The picture is a path, an array (bool of shape (height, width), True where the tree is; or uint8), a PIL image or
    an open file. ``height`` is the tree's, in metres; ``size`` the longer side that the search compares at, in
    pixels. ``mask`` is ``"auto"`` for a photograph, or a file that says what is tree; ``box``, ``include``, ``exclude``
    and ``strokes`` show the tree in a photograph, as in ``pleach.mask``; ``wood`` is a file that says what of the tree
    is wood. ``reading`` is a ``pleach.Reading``, or a dict with some of its measures, of what is otherwise in the picture
    than it is read, such as ``{"trunks": 1, "lean_deg": -8}``: see ``pleach.read``. ``tree`` is the tone that is the tree: ``"auto"``, ``"dark"`` or ``"light"``. ``ground_row`` and ``axis_column`` are where the tree stands, in pixels
    of the picture; ``frame``, where it is known, is metres per pixel, the column of the trunk's foot and the row of the
    ground: it is taken as exact, and the height follows from it. ``view`` is the azimuth, or azimuth and elevation, in
    degrees. ``views`` are further pictures of the same tree, each with where it was taken from:
    ``[("side.png", 90)]``; ``"~90"`` is about there, ``"auto"`` anywhere. ``free_frame`` searches their scale and place.
    ``holdout_views`` are scored and not fitted.

    The fit begins at ``start``: ``"auto"``, the species that the goal looks like; ``"random"``; or a species.
    ``generator`` is the family that the species is of: its name, ``"auto"`` for all, ``"trees"`` for ``weber-penn`` and
    ``space-colonization``; by default that of ``start``, or ``"trees"`` for a photograph, ``"stylised"`` for a drawing in
    flat colours, and ``"weber-penn"`` for a silhouette.
    ``volume_from`` starts from a tree of paths in the outline of the ``"goal"`` or of a file. ``leaves`` says whether the
    tree has some; None looks for them. ``appearance`` says where the colours of the result come from: the ``"picture"``
    where it has some, or the ``"species"``. ``optimizer`` is a name, or a name and settings such as
    ``{"cma": {"population": 20}}``; ``evolve_rules`` searches the rules of a grammar too. ``tree_seed`` None searches the
    seed too; ``robust`` is the number of seeds that parameters are scored by.

    It ends after ``timeout`` seconds, ``evaluations`` or ``generations``, or once ``target_iou`` is reached; after a
    minute if nothing is said. ``individual`` is how long the goal's own tree is searched: True, a share of the budget;
    seconds; a number of trees such as ``"400trees"``; or False, which ``"off"`` is too. ``posterior`` is the number of trees,
    100 to 20,000, from which the fit learns in the end how surely the goal determines each number; True is 2000. It is not
    part of ``timeout``.

    ``progress`` is True, for a bar (with tqdm), or a function of a dict: ``stage`` and what it says of it. Fits
    bounded by evaluations are the same bits on any number of ``threads``. Ctrl-C ends the fit with what it has:
    ``interrupted`` is then true; before it has anything, ``KeyboardInterrupt`` is raised.

    Raises ``GoalError`` for a picture that is not a goal and ``FitError`` for options that cannot be.

    >>> import pleach
    >>> goal = pleach.species("acer").grow(5).silhouette(48)
    >>> found = pleach.fit(goal, start="acer", evaluations=30, size=48, individual="16trees")
    >>> found.species.name, found.card.likeness > 0.5
    ('goal', True)
    """
    pictures: dict[str, Any] = {}

    def named(kind: str, given_views: Sequence[tuple[Goal, Union[str, Direction]]]) -> list[str]:
        """Views as texts that name their pictures: files by their paths."""
        texts: list[str] = []
        for number, (picture, direction) in enumerate(given_views):
            picture = given(picture)
            label = picture if isinstance(picture, str) else f"{kind}-{number + 1}"
            pictures[label] = picture
            texts.append(f"{_direction(direction)}={label}")
        return texts

    options = {
        "height": height,
        "size": size,
        "mask": mask,
        "hints": hints(box, include, exclude, strokes),
        "wood": wood,
        "reading": corrections(reading),
        "tree": tree,
        "ground_row": ground_row,
        "axis_column": axis_column,
        "frame": None if frame is None else list(frame),
        "view": None if view is None else _direction(view),
        "views": named("view", views),
        "free_frame": free_frame,
        "holdout_views": named("holdout", holdout_views),
        "appearance": appearance,
        "leaves": {None: "auto", True: "on", False: "off"}[leaves],
        # A species may have any name.
        "from": start if isinstance(start, str) else f"species {start.name}",
        "generator": generator,
        "volume_from": volume_from,
        "free": list(free),
        "fix": list(fix),
        "optimizer": optimizer,
        "evolve_rules": evolve_rules,
        "objective": objective,
        "seed": seed,
        "tree_seed": "any" if tree_seed is None else tree_seed,
        "robust": robust,
        "individual": _effort(individual),
        "individuals": individuals,
        "posterior": (2000 if posterior is True else posterior) or None,
        "timeout": timeout,
        "evaluations": evaluations,
        "generations": generations,
        "target_iou": target_iou,
        "name": name,
    }
    species = None if isinstance(start, str) else start
    text = _as_json(options)
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
        found = _native.fit(given(goal), text, pictures, species, threads, tell)
    finally:
        if bar is not None:
            bar.close()
    kind, card, silhouette, cards = found.pop("kind")
    found.update(species=kind, card=card_of(card), silhouette=silhouette, view_cards=[card_of(one) for one in cards])
    found["individuals"] = [
        Individual(species, card_of(card), silhouette, [card_of(one) for one in cards])
        for species, card, silhouette, cards in found["individuals"]
    ]
    found["posterior"] = _posterior(found["report"]["posterior"], found.pop("samples"))
    return Fit(**found)


def _posterior(report: Optional[dict[str, Any]], samples: list[_native.Species]) -> Optional[Posterior]:
    if report is None:
        return None
    numbers = {
        one["slot"]: PosteriorNumber(Interval(**one["prior"]), Interval(**one["posterior"]), one["shrunk"])
        for one in report["numbers"]
    }
    return Posterior(
        report["species"], report["trees"], report["familiarity"], report["is_familiar"], numbers, samples
    )
