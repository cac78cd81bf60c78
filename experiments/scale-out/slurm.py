"""Fits goals on a Slurm of this machine, takes tasks away in the middle, and compares with one process.

    python3 slurm.py PLEACH FOLDER [--goals N] [--evaluations N] [--preempt N]

PLEACH is the program, FOLDER is for goals, run folders and Slurm's own files. Writes slurm.csv beside this file.
Needs Slurm and munge (Debian: slurm-wlm, munge), and root, since Slurm's daemons do.
"""

import argparse
import os
import secrets
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

from measure import FIT, HERE, ROOT, make_goals, quiet, write

SHARDS = 8
PATIENCE_S = 1200


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("pleach", type=os.path.abspath)
    parser.add_argument("folder", type=os.path.abspath)
    parser.add_argument("--goals", type=int, default=40)
    parser.add_argument("--evaluations", type=int, default=600)
    parser.add_argument("--preempt", type=int, default=6)
    return parser.parse_args()


class Slurm:
    """A controller and one node of two cores, as processes of ours."""

    def __init__(self, folder):
        self.folder = folder
        shutil.rmtree(folder, ignore_errors=True)
        for name in ["", "state", "spool"]:
            os.makedirs(folder / name, mode=0o755)
        self.configure()
        self.processes = []
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        # Munge wants folders that nobody else can write to; /tmp is not one.
        self.munge = Path("/run/pleach-munge")
        shutil.rmtree(self.munge, ignore_errors=True)
        self.munge.mkdir(mode=0o755)
        key = self.munge / "key"
        key.write_bytes(secrets.token_bytes(64))
        key.chmod(0o400)
        files = [f"--{name}-file={self.munge / name}" for name in ["key", "log", "pid", "seed"]]
        self.start("munged", "--foreground", "--force", f"--socket={self.munge / 'socket'}", *files)
        wait_until(lambda: (self.munge / "socket").exists())
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        wait_until(lambda: "idle" in asked("sinfo", "--noheader", "--format=%T"))

    def configure(self):
        host = socket.gethostname()
        lines = [
            "ClusterName=pleach",
            f"SlurmctldHost={host}(127.0.0.1)",
            "SlurmUser=root",
            "AuthType=auth/munge",
            # A task that was taken away waits until its credential has expired, by default for two minutes.
            "AuthInfo=socket=/run/pleach-munge/socket,cred_expire=5",
            "CredType=cred/munge",
            "ProctrackType=proctrack/linuxproc",
            "TaskPlugin=task/none",
            "SelectType=select/cons_tres",
            "SelectTypeParameters=CR_Core",
            "SchedulerParameters=batch_sched_delay=1,sched_interval=2",
            "ReturnToService=2",
            f"StateSaveLocation={self.folder / 'state'}",
            f"SlurmdSpoolDir={self.folder / 'spool'}",
            f"SlurmctldPidFile={self.folder / 'slurmctld.pid'}",
            f"SlurmdPidFile={self.folder / 'slurmd.pid'}",
            f"SlurmctldLogFile={self.folder / 'slurmctld.log'}",
            f"SlurmdLogFile={self.folder / 'slurmd.log'}",
            f"NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN",
            f"PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP",
        ]
        (self.folder / "slurm.conf").write_text("\n".join(lines) + "\n")

    def start(self, *args):
        with open(self.folder / f"{args[0]}.out", "w") as out:
            self.processes.append(subprocess.Popen(args, stdout=out, stderr=out))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
            process.wait()


def asked(*args):
    return subprocess.run(args, stdout=subprocess.PIPE, text=True).stdout


def wait_until(is_true):
    end = time.monotonic() + PATIENCE_S
    while not is_true():
        if time.monotonic() > end:
            sys.exit("waited in vain; Slurm's logs say why")
        time.sleep(0.2)


def running(job):
    """The tasks of an array that run now, with the seconds for which they have."""
    rows = asked("squeue", "--noheader", "--states=RUNNING", "--array", f"--jobs={job}", "--format=%K %M")
    tasks = [row.split() for row in rows.splitlines()]
    return [int(task) for task, elapsed in tasks if elapsed != "0:00"]


def finished():
    return len(list(Path("runs").glob("*/summary.json")))


def fit_with_preemption(options, count):
    """Submits the array, takes `count` tasks away, a task at a time, and waits for the end."""
    begun = time.monotonic()
    script = str(ROOT / "docs/cluster/slurm.sh")
    job = asked("sbatch", "--parsable", script, *options).strip()
    taken = []
    while asked("squeue", "--noheader", f"--jobs={job}").strip():
        tasks = running(job)
        done = finished()
        if len(taken) < count and tasks and done > len(taken):
            task = tasks[len(taken) % len(tasks)]
            quiet("scontrol", "requeue", f"{job}_{task}")
            taken.append(task)
            print(f"task {task} taken away when {done} goals were finished", flush=True)
        time.sleep(0.5)
    return taken, time.monotonic() - begun


def results(folder):
    """The files of a fit; of its history all but the last column, which is of the clock."""
    with open(folder / "history.csv") as rows:
        history = [row.rsplit(",", 1)[0] for row in rows]
    return history, [(folder / name).read_bytes() for name in ["best.toml", "best.png", "parameters.csv"]]


def differing(count):
    """Goals whose results are not those of the one process."""
    both = ((results(Path(out, str(goal))) for out in ["runs", "whole"]) for goal in range(1, count + 1))
    return sum(ours != whole for ours, whole in both)


def main():
    args = arguments()
    os.makedirs(args.folder, exist_ok=True)
    os.chdir(args.folder)
    for folder in ["runs", "goals"]:
        shutil.rmtree(folder, ignore_errors=True)
    make_goals(args.pleach, args.goals)
    os.environ["PLEACH"] = args.pleach
    options = [*FIT, "--evaluations", str(args.evaluations)]
    batch = ["fit", "--list", "goals.csv", "--threads", "1", "--overwrite"]
    quiet(args.pleach, *batch, "--out", "whole", *options)
    with Slurm(Path(args.folder, "slurm")):
        taken, seconds = fit_with_preemption(options, args.preempt)
    said = subprocess.run(
        [args.pleach, "collect", "runs", "--list", "goals.csv", "-o", "all.csv"], text=True, stdout=subprocess.PIPE
    )
    print(said.stdout)
    row = {
        "goals": args.goals,
        "shards": SHARDS,
        "taken_away": len(taken),
        "finished": finished(),
        "collect_code": said.returncode,
        "differing_goals": differing(args.goals),
        "wall_s": f"{seconds:.1f}",
    }
    write("slurm.csv", [row])
    print(row)


if __name__ == "__main__":
    main()
