#!/bin/bash
# Shards on the cores of one machine, or of several that GNU parallel reaches by ssh:
# `docs/cluster/parallel.sh 8 --timeout 2m` from the folder of goals.csv, for eight shards.
# What follows the number are options of `pleach fit`. PARALLEL holds options of GNU parallel, such as
# `--jobs 4` or `--sshloginfile nodes --workdir .`.
set -euo pipefail
shards=$1
shift
# A shard whose machine is lost is tried again, and goes on where it was.
seq "$shards" | parallel --will-cite --retries 3 --joblog parallel.log \
    "${PLEACH:-pleach}" fit --list goals.csv --out runs --resume --shard "{}/$shards" --threads 1 "$@"
