"""Fits goals.csv in the working directory on two workers of HyperQueue and kills one in the middle.

    python3 kill_a_worker.py ROOT PLEACH OUT OPTIONS

ROOT is the repository's. A new worker takes the place of the one that was killed.
"""

import glob
import os
import subprocess
import sys
import tempfile
import time

root, pleach, out, *options = sys.argv[1:]
PATIENCE_S = 600


def start(*args):
    script = os.path.join(root, "tests/cluster/hq.py")
    process = subprocess.Popen([sys.executable, script, *args], stdout=subprocess.DEVNULL)
    wait_until(lambda: os.path.exists(os.path.join(args[-1], "ready")))
    return process


def wait_until(is_true):
    end = time.monotonic() + PATIENCE_S
    while not is_true():
        if time.monotonic() > end:
            sys.exit("waited in vain")
        time.sleep(0.02)


def finished():
    return len(glob.glob(os.path.join(out, "*/summary.json")))


def main():
    with tempfile.TemporaryDirectory() as folder:

        def own(name):
            path = os.path.join(folder, name)
            os.mkdir(path)
            return path

        server = own("server")
        processes = [start("server", server)]
        try:
            first = start("worker", server, own("first"))
            processes += [first, start("worker", server, own("second"))]
            submit = os.path.join(root, "docs/cluster/submit_hq.py")
            args = ["goals.csv", out, "--server", server, "--pleach", pleach, "--", *options]
            # Its bar of progress is of no use here.
            job = subprocess.Popen([sys.executable, submit, *args], stderr=subprocess.DEVNULL)
            processes.append(job)
            wait_until(lambda: finished() >= 10 or job.poll() is not None)
            # In the middle of a fit.
            wait_until(lambda: glob.glob(os.path.join(out, "*/lock")) or job.poll() is not None)
            first.kill()
            first.wait()
            print(f"one worker killed when {finished()} goals were finished")
            processes.append(start("worker", server, own("third")))
            code = job.wait(PATIENCE_S)
        finally:
            for process in processes:
                process.kill()
                process.wait()
        sys.exit(code)


main()
