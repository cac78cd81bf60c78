"""Fits the goals of a list on a HyperQueue cluster, a task for each goal, and waits until all are done.

    python3 submit_hq.py LIST OUT [--server DIR] [--tasks N] [--pleach PROGRAM] -- OPTIONS

OPTIONS are those of `pleach fit`. A HyperQueue server and its workers must be running; DIR is the
server's folder, if it is not HyperQueue's own. With fewer tasks than goals a task is a shard of
several goals. Submitting again skips what is finished.
"""

import argparse
import csv
import os
import shutil
import sys

from hyperqueue import Client, Job


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("list")
    parser.add_argument("out")
    parser.add_argument("--server")
    parser.add_argument("--tasks", type=int)
    parser.add_argument("--pleach", default="pleach")
    at = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    args = parser.parse_args(sys.argv[1:at])
    args.options = sys.argv[at + 1 :]
    return args


def main():
    args = arguments()
    # Workers may have another search path.
    pleach = shutil.which(args.pleach)
    if pleach is None:
        sys.exit(f"{args.pleach} is not a program: name it with --pleach")
    with open(args.list, newline="") as file:
        goals = sum(1 for _ in csv.DictReader(file))
    tasks = args.tasks or goals
    job = Job(default_workdir=os.getcwd(), max_fails=None, name="pleach")
    for number in range(1, tasks + 1):
        batch = ["--list", args.list, "--out", args.out, "--resume", "--shard", f"{number}/{tasks}"]
        # Two files of output for each task would be too many for shared file systems, and a failed
        # goal is in its shard's table.
        job.program(
            [pleach, "fit", *batch, "--threads", "1", "--quiet", *args.options],
            stdout=None,
            stderr=None,
        )
    client = Client(args.server)
    submitted = client.submit(job)
    if not client.wait_for_jobs([submitted], raise_on_error=False):
        failed = client.get_failed_tasks(submitted)
        sys.exit(f"{len(failed)} of {tasks} tasks failed; `pleach collect` names the goals")


main()
