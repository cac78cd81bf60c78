"""What is known of a tree before its picture is seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Optional

from . import _native
from ._blend import Kind, one_species


class Prior:
    """Trees around a species, as nature would vary them.

    Each free number is normal around that of the species, with a standard deviation of ``spread`` of its plausible range,
    and cut off at the ends of that range. Features that the species does not have stay absent, and a tree whose form is
    far from that of the species is drawn again: it has a quarter to four times as many stems on each level and as much
    area of leaves for its height, half to twice the width, and at most 60,000 stems and 500,000 leaves. ``free`` and ``fix`` are patterns as of ``pleach fit``. They
    are the trees of ``pleach sample``.

    >>> import pleach
    >>> aspens = pleach.Prior("quaking_aspen").sample(3, seed=7)
    >>> [len(aspen.grow().levels) > 100 for aspen in aspens]
    [True, True, True]

    Raises ``FitError`` for a pattern that the species does not know.
    """

    def __init__(
        self, species: Kind, *, spread: float = 0.15, free: Sequence[str] = (), fix: Sequence[str] = ()
    ) -> None:
        self.species: _native.Species = one_species(species)
        """The species that the trees are around."""
        self.spread: float = spread
        """The standard deviation of each number, as a part of its plausible range, 0 to 10."""
        self.free: list[str] = list(free)
        self.fix: list[str] = list(fix)
        self.slots: list[str] = _native.prior_slots(self.species, spread, self.free, self.fix)
        """The numbers that vary, such as ``length[1]``."""

    def sample(self, count: int, *, seed: int = 1, threads: Optional[int] = None) -> list[_native.Species]:
        """``count`` species, each with the seed of its tree; the same for the same ``seed``, on any number of threads.

        Raises ``PleachError`` where sixteen draws for one of them give no tree, with the reason of the last.
        """
        return _native.prior_sample(
            self.species, self.spread, self.free, self.fix, count, seed, threads
        )

    def __repr__(self) -> str:
        return f"Prior({self.species.name!r}, spread={self.spread}, {len(self.slots)} numbers)"
