"""Measures what the simulation needs, and one worker beside two.

    python3 measure.py PLEACH FOLDER [fits] [costs] [pair] [--goals N] [--pair N]

PLEACH is the program, FOLDER is for goals and run folders. Writes beside this file durations.csv (fits: all
goals, two at a time), measured.csv (costs: what a task costs beside its fit, what a fit writes) and workers.csv
(pair: some goals on one worker and on two). Needs HyperQueue (`pip install hyperqueue`) and strace.
"""

import argparse
import csv
import os
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
# Trees of several kinds, so that fits take several times. All are small: what is measured is not the fits.
SPECIES = ["acer", "palm", "small_pine", "lombardy_poplar"]
FIT = ["--size", "48", "--from", "palm", "--evaluations", "12", "--individual", "off"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("pleach", type=os.path.abspath)
    parser.add_argument("folder", type=os.path.abspath)
    parser.add_argument("what", nargs="*", default=["fits", "costs", "pair"])
    parser.add_argument("--goals", type=int, default=500)
    parser.add_argument("--pair", type=int, default=40)
    return parser.parse_args()


def quiet(*args):
    subprocess.run(args, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def make_goals(pleach, count):
    os.makedirs("goals")
    with open("goals.csv", "w") as goals:
        goals.write("file\n")
        for i in range(count):
            name = f"goals/{i + 1}.png"
            species, seed = SPECIES[i % len(SPECIES)], str(i // len(SPECIES) + 1)
            quiet(pleach, "silhouette", species, "--seed", seed, "--size", "48", "-o", name)
            goals.write(name + "\n")


def first(count):
    """A list of the first goals."""
    with open("goals.csv") as goals, open(f"first-{count}.csv", "w") as out:
        out.writelines(next(goals) for _ in range(count + 1))
    return f"first-{count}.csv"


class Cluster:
    """A server and workers of one core each."""

    def __init__(self, workers):
        self.folder = os.path.abspath(f"cluster-{workers}-{time.monotonic_ns()}")
        self.processes = []
        self.start("server", "server")
        for number in range(workers):
            self.start("worker", f"worker-{number}")

    def own(self, name):
        return os.path.join(self.folder, name)

    def start(self, what, name):
        os.makedirs(self.own(name))
        folders = [self.own("server")] + ([self.own(name)] if what == "worker" else [])
        script = str(ROOT / "tests/cluster/hq.py")
        process = subprocess.Popen([sys.executable, script, what, *folders], stdout=subprocess.DEVNULL)
        self.processes.append(process)
        while not os.path.exists(os.path.join(self.own(name), "ready")):
            time.sleep(0.02)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()

    def fit(self, pleach, goals, out):
        """Seconds of all goals of a list, a task each."""
        script = str(ROOT / "docs/cluster/submit_hq.py")
        begun = time.monotonic()
        quiet(sys.executable, script, goals, out, "--server", self.own("server"), "--pleach", pleach, "--", *FIT)
        return time.monotonic() - begun

    def run_nothing(self, count):
        """Seconds of so many tasks that do nothing, by the clock and of the server's processor."""
        from hyperqueue import Client, Job

        job = Job(max_fails=None)
        for _ in range(count):
            job.program(["/bin/true"], stdout=None, stderr=None)
        client = Client(self.own("server"))
        begun, server = time.monotonic(), self.server_seconds()
        client.wait_for_jobs([client.submit(job)])
        return time.monotonic() - begun, self.server_seconds() - server

    def server_seconds(self):
        """Processor time of the server, which is one process and does one thing at a time."""
        with open(f"/proc/{self.processes[0].pid}/stat") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def timed(pleach):
    """A program that does as pleach and notes how long it took, by the clock and of a processor."""
    path = os.path.abspath("timed-pleach")
    with open(path, "w") as script:
        script.write(
            "#!/bin/bash\n"
            "TIMEFORMAT='%R %U %S'\n"
            f'{{ time "{pleach}" "$@" 2>&3; }} 3>&2 2>> "{os.path.abspath("durations.txt")}"\n'
        )
    os.chmod(path, 0o755)
    return path


def write_durations():
    with open("durations.txt") as lines:
        rows = [tuple(map(float, line.split())) for line in lines]
    print(f"{len(rows)} fits ended", flush=True)
    with open(HERE / "durations.csv", "w") as out:
        out.write("wall_s,cpu_s\n")
        out.writelines(f"{wall:.3f},{user + system:.3f}\n" for wall, user, system in rows)


def traced(pleach, goal, more):
    """What a fit asks of the disk that holds its folder: files opened to be written, renamed, removed, made
    durable; folders made; bytes written."""
    calls = "openat,rename,renameat,renameat2,unlink,unlinkat,mkdir,fsync,fdatasync,write,ftruncate"
    log = os.path.abspath("strace.txt")
    args = [pleach, "fit", goal, "--out", "traced", "--overwrite", "--threads", "1", "--quiet", *more]
    quiet("strace", "-f", "-y", "-e", f"trace={calls}", "-o", log, *args)
    operations, data = 0, 0
    with open(log, errors="replace") as lines:
        for line in lines:
            if "traced" not in line or "resumed>" in line:
                continue
            call = line.split("(")[0].split()[-1]
            if call == "write":
                data += int(line.rsplit("=", 1)[1].split()[0]) if "= " in line else 0
            elif call != "openat" or "O_CREAT" in line or "O_WRONLY" in line or "O_RDWR" in line:
                operations += 1
    return operations, data


def measure_pair(pleach, count):
    """The same goals on one worker and on two, alternately."""
    pair = first(count)
    rows = []
    for workers in [1, 2] * 2:
        before = foreign_seconds()
        with Cluster(workers) as cluster:
            out = f"pair-{time.monotonic_ns()}"
            seconds = cluster.fit(pleach, pair, out)
        others = foreign_seconds() - before
        rows.append({"workers": workers, "goals": count, "wall_s": f"{seconds:.2f}", "others_s": f"{others:.2f}"})
        print(rows[-1], flush=True)
    write("workers.csv", rows)


def foreign_seconds():
    """Processor time that the whole machine has used, without this process and what it has ended."""
    with open("/proc/stat") as stat:
        user, nice, system = map(int, stat.readline().split()[1:4])
    own = os.times()
    return (user + nice + system) / os.sysconf("SC_CLK_TCK") - sum(own[:4])


def measure_fits(pleach):
    if os.path.exists("durations.txt"):
        os.remove("durations.txt")
    shutil.rmtree("runs", ignore_errors=True)
    try:
        with Cluster(2) as cluster:
            cluster.fit(timed(pleach), "goals.csv", "runs")
    finally:
        # Also of a measurement that was stopped.
        write_durations()


def processor_seconds(*args):
    begun = os.times()
    quiet(*args)
    ended = os.times()
    return ended.children_user + ended.children_system - begun.children_user - begun.children_system


def measure_costs(pleach, goals):
    with Cluster(1) as cluster:
        tasks = 500
        wall, server = (seconds / tasks for seconds in cluster.run_nothing(tasks))
    # A task of a finished shard: a process that reads the list and finds nothing to do.
    batch = ["--list", "goals.csv", "--out", "runs", "--resume", "--shard", f"1/{goals}"]
    start = statistics.median(processor_seconds(pleach, "fit", *batch, "--threads", "1", *FIT) for _ in range(20))
    # What --from auto costs a process: all species are grown before the first goal.
    auto = ["--size", "48", "--evaluations", "1", "--individual", "off", "--threads", "1", "--overwrite"]
    guess = [
        processor_seconds(pleach, "fit", "goals/1.png", "--out", "guessed", *auto, "--from", start_from)
        for start_from in ["auto", "palm"]
    ]
    rows = [
        ("start_s", f"{start:.4f}"),
        ("worker_s", f"{wall:.4f}"),
        ("dispatch_s", f"{server:.5f}"),
        ("first_guess_s", f"{guess[0] - guess[1]:.1f}"),
        # The default of --checkpoint-every.
        ("checkpoint_s", 1),
    ]
    for name, options in [("", FIT), ("minute_", ["--timeout", "1m"])]:
        operations, data = traced(pleach, "goals/1.png", options)
        files = list(Path("traced").iterdir())
        rows.append((f"{name}disk_operations", operations))
        rows.append((f"{name}bytes_written", data))
        rows.append((f"{name}files", len(files)))
        rows.append((f"{name}bytes", sum(file.stat().st_size for file in files)))
        shutil.rmtree("traced")
    write("measured.csv", [{"what": what, "value": value} for what, value in rows])


def write(name, rows):
    with open(HERE / name, "w", newline="") as out:
        table = csv.DictWriter(out, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def main():
    args = arguments()
    os.makedirs(args.folder, exist_ok=True)
    os.chdir(args.folder)
    if not os.path.exists("goals.csv"):
        make_goals(args.pleach, args.goals)
    if "fits" in args.what:
        measure_fits(args.pleach)
    if "costs" in args.what:
        measure_costs(args.pleach, args.goals)
    if "pair" in args.what:
        measure_pair(args.pleach, args.pair)


if __name__ == "__main__":
    main()
