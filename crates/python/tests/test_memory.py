"""Memory comes back."""

from __future__ import annotations

import sys

import pytest

import pleach


@pytest.mark.skipif(sys.platform != "linux", reason="ru_maxrss is in kilobytes on Linux")
def test_ten_thousand_trees_take_no_more_than_one_at_a_time() -> None:
    import resource

    palm = pleach.species("palm").replace({"levels": 1})
    total = 0

    def grow(seeds: range) -> int:
        grown = 0
        for seed in seeds:
            tree = palm.grow(seed, leaves=False)
            grown += len(tree.knots) + tree.silhouette(32).shape[0]
            grown += len(tree.mesh(tolerance=50.0).levels[0]["bark"].triangles) + len(tree.places)
        return grown

    total += grow(range(500))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    total += grow(range(500, 10_000))
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert total > 10_000 and after - before < 20_000, f"{after - before} KB more"
