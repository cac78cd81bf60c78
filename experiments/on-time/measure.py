"""How long fits take that were given a time: from the return key to the prompt.

    python3 experiments/on-time/measure.py target/release/pleach experiments/on-time/results.csv

The default for all twenty species, and options for a light and a heavy one.
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time

SECONDS = 15
SPECIES = (
    "acer apple balsam_fir bamboo black_oak black_tupelo cambridge_oak douglas_fir european_larch fan_palm "
    "hill_cherry lombardy_poplar palm quaking_aspen sassafras silver_birch small_pine sphere_tree weeping_willow "
    "weeping_willow_o"
).split()
OPTIONS = {
    "individual off": ["--individual", "off"],
    "four individuals": ["--individuals", "4"],
    "400 trees of its own": ["--individual", "400trees"],
    "random lists": ["--from", "random"],
    "two views": ["--view", "90=side.png"],
    "all families": ["--generator", "auto"],
    "four seeds": ["--robust", "4"],
    "512 pixels": ["--size", "512"],
    "rules": ["--evolve-rules"],
}
LIGHT_AND_HEAVY = ["palm", "weeping_willow"]
COLUMNS = ["species", "options", "wall_s", "wall_late_s", "wall_search_s", "wall_judging_s", "wall_individual_s", "fresh_seeds", "wall_95_s"]


def main() -> None:
    pleach, results = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    rows = []
    with tempfile.TemporaryDirectory() as folder:

        def run(*arguments: str) -> None:
            subprocess.run([pleach, *arguments], cwd=folder, check=True, capture_output=True)

        def fit(species: str, name: str, options: list[str]) -> None:
            run("silhouette", species, "--seed", "11", "--size", "256", "-o", "goal.png")
            run("silhouette", species, "--seed", "11", "--size", "256", "--view", "90,0", "-o", "side.png")
            started = time.monotonic()
            run("fit", "goal.png", "--timeout", f"{SECONDS}s", "--out", "run", "--overwrite", *options)
            wall = time.monotonic() - started
            summary = json.loads(pathlib.Path(folder, "run", "summary.json").read_text())
            parts = [summary["seconds"], summary["judging_seconds"], (summary["individual"] or {}).get("seconds", 0)]
            seeds = (summary["fresh_seeds"] or {}).get("count", 0)
            with pathlib.Path(folder, "run", "history.csv").open(newline="") as file:
                history = [(float(row["elapsed_s"]), float(row["likeness"])) for row in csv.DictReader(file)]
            # When the search had 95 % of the likeness that it ended with.
            near = min((t for t, likeness in history if likeness >= 0.95 * history[-1][1]), default=SECONDS)
            rows.append([species, name, *(f"{s:.2f}" for s in [wall, wall - SECONDS, *parts]), seeds, f"{near:.2f}"])
            print(*rows[-1], flush=True)

        for species in SPECIES:
            fit(species, "", [])
        for name, options in OPTIONS.items():
            for species in LIGHT_AND_HEAVY:
                fit(species, name, options)
    with results.open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    soon = [float(row[-1]) for row in rows if not row[1]]
    print(f"95 % of the likeness within 3 s: {sum(s <= 3 for s in soon)} of {len(soon)}")
    late = sorted(float(row[3]) for row in rows)
    print(f"{len(rows)} fits of {SECONDS} s: {late[0]:+.2f} to {late[-1]:+.2f} s")


main()
