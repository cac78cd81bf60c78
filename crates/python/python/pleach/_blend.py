"""Species between species."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Optional, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._species import species as _species

Kind = Union[str, _native.Species]
Shares = Union[Mapping[str, float], Mapping[_native.Species, float], Mapping[Kind, float]]


def one_species(kind: Kind) -> _native.Species:
    return kind if isinstance(kind, _native.Species) else _species(kind)


def blend(shares: Shares, *, name: str = "blend") -> _native.Species:
    """The blend of species, by name or as objects, of one generator; with their shares.

    Raises ``SpeciesError`` for shares that are negative or all 0, and for species of several generators.

    >>> import pleach
    >>> pleach.blend({"quaking_aspen": 0.7, "silver_birch": 0.3}, name="between").name
    'between'
    """
    return _native.mix([one_species(kind) for kind in shares], [float(share) for share in shares.values()], name)


@dataclass(frozen=True)
class Place:
    """A point of a map."""

    species: _native.Species
    """The tree there."""
    shares: dict[str, float]
    """How much of which species it is made of; those of none left out."""
    outside: float
    """How far outside the hull of the species the point is; 0 inside."""


class Map:
    """Species laid out on a plane by the principal components of their parameters, and a tree for every point.

    By default the fifteen species of Hewitt's dissertation; others by name or as species, at least two of one
    generator.

    >>> import pleach
    >>> plane = pleach.Map()
    >>> x, y = plane.points[plane.names.index("palm")]
    >>> plane.at(x, y).shares
    {'palm': 1.0}
    """

    def __init__(self, kinds: Optional[Sequence[Kind]] = None) -> None:
        chosen = _native.map_species() if kinds is None else [one_species(kind) for kind in kinds]
        self._map = _native.NativeMap(chosen)
        self.species = chosen
        self.names = [one.name for one in chosen]
        self.points: npt.NDArray[np.float64] = self._map.points()
        """Where they stand, float64 of shape (species, 2)."""
        self.explained: list[float] = self._map.explained()
        """The share of the variance that each component has."""

    def __reduce__(self) -> tuple[type[Map], tuple[list[_native.Species]]]:
        return Map, (self.species,)

    def at(self, x: float, y: float, *, name: str = "blend") -> Place:
        """The tree at a point. Raises ``SpeciesError`` for coordinates that are not finite."""
        species, shares, outside = self._map.at(x, y, name)
        return Place(species, {name: share for name, share in zip(self.names, shares) if share > 0}, outside)

    def locate(self, kind: Kind) -> tuple[float, float]:
        """Where a species belongs."""
        return self._map.locate(one_species(kind))

    def picture(self, seed: int = 1) -> bytes:
        """The map as the bytes of a PNG file: species by name with silhouettes of the trees of ``seed``, coloured by the nearest
        one, and a dashed line around the points that are between species."""
        return self._map.picture(seed)

    @property
    def extent(self) -> npt.NDArray[np.float64]:
        """Smallest and largest x, y that the picture shows, float64 of shape (2, 2)."""
        return self._map.extent()

    def pixel_at(self, x: float, y: float) -> tuple[float, float]:
        """Where the picture shows a point: column and row from its upper left corner, in pixels."""
        return self._map.pixel_at(x, y)

    def point_at(self, column: float, row: float) -> tuple[float, float]:
        """The point that the picture shows at a pixel: the way back from ``pixel_at``."""
        return self._map.point_at(column, row)
