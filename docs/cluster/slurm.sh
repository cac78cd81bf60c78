#!/bin/bash
# An array of shards for Slurm: `sbatch docs/cluster/slurm.sh --timeout 2m` from the folder of goals.csv.
# What follows the script's name are options of `pleach fit`.
#SBATCH --job-name=pleach
#SBATCH --array=1-8
#SBATCH --cpus-per-task=1
# Lost or preempted shards start again, and go on where they were.
#SBATCH --requeue
#SBATCH --output=slurm-%A_%a.out
#SBATCH --open-mode=append

# All shards, also where --array asks for a few of them again.
SHARDS=${SHARDS:-8}

# The program takes the place of the shell, so that it is told to stop: it then leaves a checkpoint.
exec "${PLEACH:-pleach}" fit --list goals.csv --out runs --resume \
    --shard "$SLURM_ARRAY_TASK_ID/$SHARDS" --threads "$SLURM_CPUS_PER_TASK" "$@"
