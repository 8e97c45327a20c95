#!/usr/bin/env bash
# One point of a sweep:  run_point.sh FOLDER [options of dsc run]
#
# Every engine may call it as often as it likes: a point whose run is done is left alone, one that somebody else is at is
# not touched (exit 75), any other is carried out. The variable DSC names another dsc than the one on the PATH.
set -euo pipefail

if [ $# -lt 1 ] || [ ! -f "$1/experiment.yaml" ]; then
    echo "run_point: expected a folder of a point, with experiment.yaml in it, got '${1:-}'; see jobs.tsv" >&2
    exit 2
fi
point=$1
shift
dsc=${DSC:-dsc}
if ! command -v "$dsc" >/dev/null; then
    echo "run_point: there is no program '$dsc'; put dsc on the PATH or its path into the variable DSC" >&2
    exit 2
fi

# The lock is held by the process of dsc, which inherits the file, and is gone with it however it ends.
exec 9>"$point/lock"
if ! flock --nonblock 9; then
    echo "run_point: $point is being carried out by another process" >&2
    exit 75
fi
if grep -q '"state": "done"' "$point/run/status.json" 2>/dev/null; then exit 0; fi

resume=()
case "$("$dsc" run --help)" in *--resume*) resume=(--resume) ;; esac
exec "$dsc" run "$point/experiment.yaml" -o "$point/run" "${resume[@]}" "$@"
