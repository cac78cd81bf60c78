"""Times exports and previews as whole processes: `python3 experiments/export/measure.py`.

Runs the release program on each of the fifteen species, writes `results.csv` (every leaf and twig) and
`usual.csv` (the file without options) beside this file, and prints the README's table. Columns that begin
with `wall_` or `peak_` depend on the machine; the others must come out the same everywhere. With `--usual`
it counts the files without options alone, and times nothing.
"""

import csv
import json
import os
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SPECIES = [
    "quaking_aspen", "weeping_willow", "bamboo", "palm", "lombardy_poplar", "small_pine", "acer",
    "silver_birch", "douglas_fir", "apple", "black_tupelo", "black_oak", "european_larch",
    "hill_cherry", "balsam_fir",
]
SEED = "1"
RUNS = 7
COLUMNS = [
    "species", "seed", "corners", "triangles", "glb_bytes", "wall_glb_s", "wall_glb_cpu_s",
    "peak_glb_bytes", "wall_obj_s", "wall_preview_s", "peak_preview_bytes",
]


def program():
    """The release program of this checkout, built if need be."""
    subprocess.run(["cargo", "build", "--release", "--quiet", "--package", "pleach-cli"], check=True)
    target = Path(os.environ.get("CARGO_TARGET_DIR", HERE.parent.parent / "target"))
    return str(target / "release" / "pleach")


def once(command):
    """Wall seconds, processor seconds and peak bytes of one run."""
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.perf_counter() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(command)} ended with {child.returncode}")
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def several(command):
    """The least times and the largest memory of several runs, after one that is not counted."""
    once(command)
    wall, cpu, peak = zip(*(once(command) for _ in range(RUNS)))
    return min(wall), min(cpu), max(peak)


def counts(path):
    """Corners and triangles of a GLB file."""
    with open(path, "rb") as file:
        (length,) = struct.unpack("<I", file.read(20)[12:16])
        content = json.loads(file.read(length))
    corners = triangles = 0
    for mesh in content["meshes"]:
        for primitive in mesh["primitives"]:
            corners += content["accessors"][primitive["attributes"]["POSITION"]]["count"]
            triangles += content["accessors"][primitive["indices"]]["count"] // 3
    return corners, triangles


def usual(pleach, folder):
    """Writes what a file without options has."""
    rows = []
    for species in SPECIES:
        glb = folder / "tree.glb"
        once([pleach, "grow", species, "--seed", SEED, "-o", str(glb)])
        rows.append([species, SEED, *counts(glb), glb.stat().st_size])
    write("usual.csv", COLUMNS[:5], rows)


def write(name, columns, rows):
    with open(HERE / name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def measure(pleach, species, folder):
    grow = [pleach, "grow", species, "--seed", SEED, "-o"]
    glb = folder / "tree.glb"
    wall, cpu, peak = several([*grow, str(glb), "--finest"])
    obj, _, _ = several([*grow, str(folder / "tree.obj")])
    render = [pleach, "render", species, "--seed", SEED, "--size", "512", "-o", str(folder / "tree.png")]
    preview, _, preview_peak = several(render)
    corners, triangles = counts(glb)
    row = [species, SEED, corners, triangles, glb.stat().st_size, f"{wall:.4f}", f"{cpu:.4f}", peak]
    return [*row, f"{obj:.4f}", f"{preview:.4f}", preview_peak]


def main():
    pleach = program()
    rows = []
    with tempfile.TemporaryDirectory(prefix="pleach-export-") as folder:
        usual(pleach, Path(folder))
        if "--usual" in sys.argv:
            return
        for species in SPECIES:
            rows.append(measure(pleach, species, Path(folder)))
            one = dict(zip(COLUMNS, rows[-1]))
            size, peak = one["glb_bytes"], one["peak_glb_bytes"]
            print(
                f"| {species.replace('_', ' ')} | {one['triangles']} | {size / 1e6:.1f} "
                f"| {1e3 * float(one['wall_glb_s']):.0f} | {1e3 * float(one['wall_glb_cpu_s']):.0f} "
                f"| {peak / 1e6:.0f} | {peak / size:.2f} | {1e3 * float(one['wall_obj_s']):.0f} "
                f"| {1e3 * float(one['wall_preview_s']):.0f} |",
                flush=True,
            )
    write("results.csv", COLUMNS, rows)


if __name__ == "__main__":
    main()
