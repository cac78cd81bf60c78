"""HyperQueue's server, or one of its workers, as a process of its own.

    python3 hq.py server DIR
    python3 hq.py worker DIR OWN

The package from PyPI starts workers only inside of the process of the server, where they cannot be
killed. A worker finds its server by the link `hq-current` in the server's folder, so a worker here starts a
server of its own in OWN, lets the link there point to DIR's, and then adds itself.
"""

import os
import sys
import time

from hyperqueue.ffi.cluster import Cluster


def main():
    what, folder = sys.argv[1:3]
    if what == "server":
        cluster = Cluster(folder)
    else:
        own = sys.argv[3]
        cluster = Cluster(own)
        link = os.path.join(own, "hq-current")
        os.remove(link)
        os.symlink(os.path.realpath(os.path.join(folder, "hq-current")), link)
        cluster.add_worker(1)
    open(os.path.join(sys.argv[-1], "ready"), "w").close()
    # Until it is killed, or nobody is left who would.
    parent = os.getppid()
    while os.getppid() == parent:
        time.sleep(0.2)
    # The threads of a server or a worker would keep the process.
    os._exit(0)


main()
