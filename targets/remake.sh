#!/usr/bin/env bash
# Grows the fifteen own goals again: species file with its seed, and the silhouette of that tree.
# Run from the root of the repository.
set -eu
cargo build --quiet --release
pleach() { target/release/pleach "$@"; }
for species in quaking_aspen weeping_willow bamboo palm lombardy_poplar small_pine acer silver_birch \
    douglas_fir apple black_tupelo black_oak european_larch hill_cherry balsam_fir; do
    pleach species "$species" --seed 1 >"targets/$species.toml"
    pleach silhouette "targets/$species.toml" --size 256 --out "targets/$species.png"
done
