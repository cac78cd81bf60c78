"""Times derivation against another program: `python3 experiments/lsystem-time/compare.py`.

Each program runs as a whole process on one thread and prints the string; what it takes after no step is
taken off, so that starting it does not count, and writing the string does. Processor time, the least of
RUNS tries, alternately. Both strings have to be the same. Writes `foreign.csv` beside this file and
prints the README's table. The npm package is installed into a temporary folder; without node and npm there
is nothing to compare with, and the script says so.
"""

import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = "lindenmayer@1.5.4"
RUNS = 3
# Name, kind, steps.
GRAMMARS = [
    ("koch", "D0L", 5), ("koch", "D0L", 6), ("plant", "D0L", 8), ("plant", "D0L", 9),
    ("dragon", "D0L", 16), ("dragon", "D0L", 18), ("tree", "parametric", 12), ("tree", "parametric", 15),
    ("row", "parametric", 7), ("row", "parametric", 8),
]
COLUMNS = ["grammar", "kind", "steps", "symbols", "wall_pleach_ms", "wall_lindenmayer_ms", "wall_ratio"]


def once(command, folder):
    """Processor milliseconds of one run, and what it printed."""
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(command, cwd=folder, stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            sys.exit(f"{command} failed")
        out.seek(0)
        text = out.read().decode()
    return 1e3 * (usage.ru_utime + usage.ru_stime), text


def parts(text):
    """The symbols, and the numbers rounded as far as programs agree on them."""
    numbers = [float(f"{float(n):.9g}") for n in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", text)]
    symbols = re.sub(r"\([^)]*\)", "", text).strip()
    return symbols.replace("Fl", "L").replace("Fr", "R").replace(" ", ""), numbers


def main():
    if not (shutil.which("node") and shutil.which("npm")):
        print("skipped: node and npm are not installed, so there is nothing to compare with")
        return
    pleach = Path(os.environ.get("CARGO_TARGET_DIR", HERE.parent.parent / "target")) / "release" / "pleach"
    if not pleach.exists():
        sys.exit("build the program first: cargo build --release")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["npm", "install", "--silent", PACKAGE], cwd=folder, check=True)
        for name, kind, steps in GRAMMARS:
            ours = lambda n: [str(pleach), "--threads", "1", "grammar", str(HERE / f"grammars/{name}.lsys"),
                              "--derive", str(n)]
            theirs = lambda n: ["node", str(HERE / "lindenmayer.mjs"), name, str(n)]
            least = {}
            for _ in range(RUNS):
                for program, command in (("ours", ours), ("theirs", theirs)):
                    for n in (0, steps):
                        ms, text = once(command(n), folder)
                        least[program, n] = (min(ms, least.get((program, n), (ms, text))[0]), text)
            one, other = (parts(least[program, steps][1]) for program in ("ours", "theirs"))
            if one != other:
                sys.exit(f"{name} after {steps} steps: the strings differ")
            spent = [max(least[p, steps][0] - least[p, 0][0], 0.1) for p in ("ours", "theirs")]
            rows.append([name, kind, steps, len(one[0]), *(f"{ms:.1f}" for ms in spent),
                         f"{spent[1] / spent[0]:.1f}"])
    with open(HERE / "foreign.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    print("| grammar | kind | steps | symbols | pleach, ms | lindenmayer, ms | ratio |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: |")
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")


if __name__ == "__main__":
    main()
