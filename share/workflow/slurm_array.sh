#!/usr/bin/env bash
# The points of a sweep as a Slurm array, a task each:  slurm_array.sh DIR [options of sbatch]
#
# Submits the points that are not done, so that the same line goes on after any failure. Two minutes before its time is
# up a task gets the signal TERM, at which dsc finishes the step and saves what it has (exit 75).
set -euo pipefail

# Within the array: the arguments are those that the call below gave.
if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
    folder=$(awk -F '\t' -v task="$SLURM_ARRAY_TASK_ID" '$1 == task { print $2 }' "$2/jobs.tsv")
    exec "$1/run_point.sh" "$2/$folder" --threads "${SLURM_CPUS_PER_TASK:-1}" --progress never
fi

if [ $# -lt 1 ] || [ ! -f "$1/jobs.tsv" ]; then
    echo "slurm_array: expected a folder that dsc sweep expand wrote, got '${1:-}'" >&2
    exit 2
fi
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
sweep=$(cd -- "$1" && pwd)
shift
tasks=''
while IFS=$'\t' read -r index folder _; do
    [ "$index" != index ] || continue
    grep -q '"state": "done"' "$sweep/$folder/run/status.json" 2>/dev/null || tasks="$tasks,$index"
done <"$sweep/jobs.tsv"
if [ -z "$tasks" ]; then
    echo "slurm_array: all points of $sweep are done" >&2
    exit 0
fi
exec sbatch --job-name=dsc-sweep --array="${tasks#,}" --output="$sweep/slurm-%A_%a.log" --signal=B:TERM@120 "$@" \
    "$here/slurm_array.sh" "$here" "$sweep"
