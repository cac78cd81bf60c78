"""From the recorded durations of fits to whole clusters: efficiency, lost nodes, shared disks.

    python3 simulate.py

Reads durations.csv and measured.csv, which measure.py has written; writes simulated.csv and bill.csv. Only
the standard library is used, and the same seed gives the same tables.
"""

import csv
import heapq
import itertools
import random
from collections import deque
from pathlib import Path

HERE = Path(__file__).parent
SEED = 1
GOALS = 10_000
CORES = [1, 2, 8, 32, 64, 128, 256, 512, 1000]
CORES_OF_A_NODE = 8
# What a fit takes by default. Recorded fits are shorter, and are stretched to it on the mean.
MINUTE_S = 60.0
# An assumption and no measurement: what a core costs differs tenfold from place to place.
EUROS_PER_CORE_HOUR = 0.05
# A node that is lost comes back, or another takes its place.
REPLACED_AFTER_S = 300.0
# How long a scheduler needs to see that a node is lost and to start its tasks elsewhere.
SEEN_AFTER_S = 20.0


def read(name):
    with open(HERE / name, newline="") as file:
        return list(csv.DictReader(file))


class Server:
    """One thing at a time, in the order of asking: a scheduler's server, or a disk's."""

    def __init__(self, seconds_each):
        self.seconds_each = seconds_each
        self.free_at = 0.0

    def serve(self, at, count=1):
        """When `count` requests are done that are made at `at`."""
        self.free_at = max(self.free_at, at) + count * self.seconds_each
        return self.free_at


class Node:
    """When a node is lost: drawn once, whatever runs on it."""

    def __init__(self, seed, mean_s):
        self.random = random.Random(seed)
        self.mean_s = mean_s
        self.losses = []

    def next_loss(self, after):
        """The first loss after a time; a node is there again `REPLACED_AFTER_S` after each."""
        if self.mean_s is None:
            return float("inf")
        while not self.losses or self.losses[-1] <= after:
            back = self.losses[-1] + REPLACED_AFTER_S if self.losses else 0.0
            self.losses.append(back + self.random.expovariate(1.0 / self.mean_s))
        return next(loss for loss in self.losses if loss > after)

    def is_there_at(self, time):
        """The time itself, or when the node is back if it is not there."""
        _ = self.next_loss(time)
        for loss in self.losses:
            if loss <= time < loss + REPLACED_AFTER_S:
                return loss + REPLACED_AFTER_S
        return time


def makespan(tasks, cores, measured, *, loss_mean_h=None, disk_operations_per_s=None, operations=0):
    """Seconds until the last task is done, and how often a task was started again.

    Events in the order of time: a core is free, a search has ended, a node was lost, a task comes back.
    """
    mean_s = loss_mean_h * 3600.0 if loss_mean_h else None
    nodes = [Node(SEED + number, mean_s) for number in range(-(-cores // CORES_OF_A_NODE))]
    dispatcher = Server(measured["dispatch_s"])
    disk = Server(1.0 / disk_operations_per_s) if disk_operations_per_s else None
    waiting = deque(tasks)
    idle = deque()
    # The order of equal times is that of the counter.
    count = itertools.count()
    events = [(0.0, next(count), "free", core, 0.0) for core in range(cores)]
    heapq.heapify(events)
    end, restarts = 0.0, 0

    def at(time, what, core, seconds=0.0):
        heapq.heappush(events, (time, next(count), what, core, seconds))

    while events:
        now, _, what, core, seconds = heapq.heappop(events)
        if what == "back":
            waiting.append(seconds)
            if not idle:
                continue
            core = idle.popleft()
        elif what == "computed":
            if disk:
                at(disk.serve(now, operations), "done", core)
                continue
            what = "done"
        if what == "done":
            end = max(end, now)
        there = nodes[core // CORES_OF_A_NODE].is_there_at(now)
        if there > now:
            at(there, "free", core)
            continue
        if not waiting:
            idle.append(core)
            continue
        seconds = waiting.popleft()
        started = dispatcher.serve(now) + measured["worker_s"] + measured["start_s"]
        loss = nodes[core // CORES_OF_A_NODE].next_loss(now)
        if started + seconds <= loss:
            at(started + seconds, "computed", core)
        else:
            # What was searched since the last checkpoint is lost, the rest goes on elsewhere.
            kept = max(0.0, loss - started - measured["checkpoint_s"])
            restarts += 1
            at(loss + SEEN_AFTER_S, "back", core, seconds - kept)
            at(loss + REPLACED_AFTER_S, "free", core)
    return end, restarts


def shards(durations, size):
    """Tasks of `size` goals each, as `--shard` deals them."""
    count = -(-len(durations) // size)
    return [sum(durations[i::count]) for i in range(count)]


def main():
    # Processor time of one thread: what a fit takes on a core of its own.
    recorded = [float(row["cpu_s"]) for row in read("durations.csv")]
    measured = {row["what"]: float(row["value"]) for row in read("measured.csv")}
    # Durations hold the start of a process, which is a cost of a task and not of a fit.
    recorded = [seconds - measured["start_s"] for seconds in recorded]
    goals = random.Random(SEED).choices(recorded, k=GOALS)
    mean = sum(goals) / len(goals)
    minute = [MINUTE_S * seconds / mean for seconds in goals]
    short = {"operations": measured["disk_operations"]}
    long = {"operations": measured["minute_disk_operations"]}
    cases = [
        ("as recorded", goals, 1, {}),
        ("as recorded, ten goals per task", goals, 10, {}),
        ("as recorded, a disk of 10000 operations per s", goals, 1, short | {"disk_operations_per_s": 1e4}),
        ("as recorded, a disk of 1000 operations per s", goals, 1, short | {"disk_operations_per_s": 1e3}),
        ("a minute each", minute, 1, {}),
        ("a minute each, ten goals per task", minute, 10, {}),
        ("a minute each, a disk of 10000 operations per s", minute, 1, long | {"disk_operations_per_s": 1e4}),
        ("a minute each, a disk of 1000 operations per s", minute, 1, long | {"disk_operations_per_s": 1e3}),
        ("a minute each, every node lost once in 24 h", minute, 1, {"loss_mean_h": 24.0}),
        ("a minute each, every node lost once in an hour", minute, 1, {"loss_mean_h": 1.0}),
    ]
    rows = []
    for name, durations, size, case in cases:
        work = sum(durations)
        for cores in CORES:
            seconds, restarts = makespan(shards(durations, size), cores, measured, **case)
            row = {"case": name, "cores": cores, "hours": f"{seconds / 3600:.3f}"}
            rows.append(row | {"efficiency": f"{work / (cores * seconds):.3f}", "restarts": restarts})
    write("simulated.csv", rows)
    write("bill.csv", [bill(rows, measured, cores) for cores in [1, 64, 256, 1000]])


def bill(rows, measured, cores):
    """What 10,000 photographs cost, a minute of one core each."""
    hours = next(float(row["hours"]) for row in rows if (row["case"], row["cores"]) == ("a minute each", cores))
    return {
        "photographs": GOALS,
        "cores": cores,
        "hours": f"{hours:.2f}",
        "core_hours": f"{hours * cores:.0f}",
        "euros": f"{hours * cores * EUROS_PER_CORE_HOUR:.2f}",
        "files": f"{GOALS * measured['minute_files']:.0f}",
        "gigabytes_kept": f"{GOALS * measured['minute_bytes'] / 1e9:.1f}",
        "gigabytes_written": f"{GOALS * measured['minute_bytes_written'] / 1e9:.1f}",
    }


def write(name, rows):
    with open(HERE / name, "w", newline="") as out:
        table = csv.DictWriter(out, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    main()
