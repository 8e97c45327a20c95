#!/usr/bin/env bash
# Builds the release preset with its benchmarks, runs all of them and writes the tables of share/doc/performance.md.
#
#   share/bench.sh [--repetitions N]   all benchmarks, N times each (default 5); DSC_DATA adds the thesis' clouds
#   share/bench.sh --quick             everything once and small, to standard output: shows that it works, measures nothing
#
# Run it on a machine that does nothing else; it takes some twenty minutes after the build.
# Other programs run beside dsc where they are installed; Debian 12 calls them libcgal-dev and libpcl-dev.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
case "${1:-}" in
    -h | --help) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" && exit 0 ;;
esac
cmake -S "$root" --preset release -DDSC_BUILD_BENCHMARKS=ON --log-level=WARNING >&2
cmake --build "$root/build/release" -j "${DSC_JOBS:-$(nproc)}" >&2
exec env PYTHONDONTWRITEBYTECODE=1 python3 "$root/tests/bench/report.py" --build "$root/build/release" \
    --page "$root/share/doc/performance.md" "$@"
