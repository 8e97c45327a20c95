#!/usr/bin/env bash
# Sets dsc up and runs it: installs what Debian 12 lacks, builds, then reconstructs a surface or runs the tests.
#
#   share/setup.sh run                    build, reconstruct the built-in teapot scan, say where the results are
#   share/setup.sh run CLOUD [options]    the same with your own point cloud; options are those of `dsc reconstruct`
#   share/setup.sh test [--full]          build with warnings as errors and run the test suite;
#                                         --full builds each source alone, also installs the tools that only a few tests need,
#                                         and runs these tests, the gate on instruction counts, the benchmarks and the
#                                         comparison with the release build
#   share/setup.sh package                build a Debian package of dsc; install it with apt-get install ./FILE
#
# Works from any folder, never changes to another one: relative paths mean what they mean to the caller.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
os_release=${DSC_OS_RELEASE:-/etc/os-release}  # replaced by the script's own test

build_packages=(
    cmake ninja-build g++ doctest-dev
    libboost-dev libcli11-dev libeigen3-dev libembree-dev libfmt-dev libjs-three libnanoflann-dev libopenmesh-dev libpcl-dev libpng-dev librandom123-dev
    libspdlog-dev libssl-dev libvtk9-dev libyaml-cpp-dev nlohmann-json3-dev pybind11-dev python3-dev python3-numpy
)
test_packages=(clang-format-14 libcgal-dev libgmp-dev libmpfr-dev python3 python3-jsonschema python3-yaml)
package_packages=(dpkg-dev file)
full_packages=(dpkg-dev file valgrind chromium chromium-driver libbenchmark-dev munge parallel python3-meshio python3-scipy slurm-wlm snakemake)

say() { printf '%s\n' "$*" >&2; }

fail() {  # fail EXIT_CODE MESSAGE
    printf 'setup: %s\n' "$2" >&2
    exit "$1"
}

usage() { sed -n '3,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

# A path as the caller would type it: relative below the current folder, absolute elsewhere.
shown() { printf '%s' "${1#"$PWD"/}"; }

# The same as apt-get wants it: a name without a slash would be that of a package in the archive.
relative() {
    case "$1" in
        "$PWD"/*) printf './%s' "${1#"$PWD"/}" ;;
        *) printf '%s' "$1" ;;
    esac
}

is_debian_12() (
    ID='' VERSION_ID=''
    # shellcheck source=/dev/null
    [ -r "$os_release" ] && . "$os_release"
    [ "$ID" = debian ] && [ "$VERSION_ID" = 12 ]
)

missing_packages() {
    local package
    for package in "$@"; do
        [ "$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | head -n 1)" = installed ] || echo "$package"
    done
}

apt() {
    local prefix=()
    [ "$(id -u)" = 0 ] || prefix=(sudo)
    "${prefix[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "$@"
}

# Installs those of the named packages that are missing; the package lists are fetched only where they are absent or stale.
# What apt-get says goes to a log, its end to the terminal where it failed.
install_missing() {
    local missing install log="$root/build/packages.log"
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} -gt 0 ] || return 0
    if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
        fail 1 "installing needs root and there is no sudo; as root: apt-get install --no-install-recommends ${missing[*]}"
    fi
    say "setup: installing ${missing[*]}; this takes a minute or two"
    install=(install -y -q --no-install-recommends "${missing[@]}")
    mkdir -p "$root/build"
    if apt-cache show "${missing[@]}" >/dev/null 2>&1 && apt "${install[@]}" >"$log" 2>&1; then
        return 0
    fi
    if apt update -q >"$log" 2>&1 && apt "${install[@]}" >>"$log" 2>&1; then
        return 0
    fi
    tail -n 20 "$log" >&2
    return 1
}

# provide PACKAGES...: on Debian 12 installs them, elsewhere names them and leaves the verdict to the build.
provide() {
    if is_debian_12; then
        install_missing "$@" || fail 1 "the packages could not be installed; the end of apt-get's log is above"
    else
        say "setup: not Debian 12, nothing is installed; needed are, by their Debian 12 names: $*"
        local tool
        for tool in cmake ninja c++; do
            command -v "$tool" >/dev/null || fail 1 "$tool is not here; install it and the packages above"
        done
    fi
}

# One compiler a core, but never more than the memory carries: the heaviest files take 2 GB each.
compile_jobs() {
    local cores memory
    cores=$(nproc 2>/dev/null || echo 1)
    memory=$(awk '/^MemAvailable:/ {print int($2 / 2000000)}' /proc/meminfo 2>/dev/null || true)
    if [ -n "$memory" ] && [ "$memory" -lt "$cores" ]; then cores=$((memory > 0 ? memory : 1)); fi
    echo "$cores"
}

# What the release build costs in the compiler, in minutes of one core.
release_minutes=7

# Said before anything else, where nothing is built yet.
announce() {
    local jobs
    jobs=$(compile_jobs)
    [ -x "$dsc" ] || say "setup: the first run compiles dsc, which usually takes $(((release_minutes + jobs - 1) / jobs)) min with" \
        "$jobs at a time, after a minute or two for packages that are missing; later runs start at once"
}

build() {  # build PRESET
    say "setup: building $(shown "$root/build/$1"); the counter shows the finished steps, all steps and the time"
    cmake -S "$root" --preset "$1" --log-level=WARNING >&2 ||
        fail 1 "CMake could not configure the build; its message above names what it did not find"
    NINJA_STATUS='[%f/%t, %e s] ' cmake --build "$root/build/$1" -j "$(compile_jobs)" >&2 || fail 1 "the build failed; the compiler's message is above"
}

# The closing lines of `run`, for eyes and for scripts.
report() {  # report KIND PATH
    [ -s "$2" ] || fail 1 "the job ended without $2"
    printf '%s %s\n' "$1" "$(shown "$2")"
}

say_next() { printf 'next: %s reconstruct YOUR_CLOUD -o surface.obj -o volume.vtu\n' "$(shown "$dsc")"; }

run_default() {
    local out="$root/runs/quickstart"
    "$dsc" run "$root/configs/quickstart.yaml" -o "$out" >&2
    report surface "$out/result/surface.obj"
    report volume "$out/result/volume.vtu"
    report picture "$out/preview.png"
    report report "$out/report.html"
    say_next
}

run_cloud() {  # run_cloud CLOUD [options of dsc reconstruct]
    local written path surface='' volume='' picture
    written=$("$dsc" reconstruct "$@")
    while IFS= read -r path; do
        case "${path,,}" in
            *.obj | *.ply | *.off | *.stl) surface=${surface:-$path} ;;
            *.vtu | *.dsc | *.msh | *.mesh) volume=${volume:-$path} ;;
        esac
        printf '%s\n' "$path"
    done <<<"$written"
    if [ -n "$surface" ]; then
        picture=${surface%.*}
        picture=${picture%_surface}_picture.png
        "$dsc" render "$surface" -o "$picture" >&2
        report surface "$surface"
    fi
    [ -z "$volume" ] || report volume "$volume"
    [ -z "$surface" ] || report picture "$picture"
    say_next
}

package() {
    local folder="$root/build/release" file
    rm -f "$folder"/*.deb
    (cd "$folder" && cpack -G DEB >&2) || fail 1 "CPack could not write the package; its message is above"
    for file in "$folder"/*.deb; do
        report package "$file"
        printf 'next: sudo apt-get install %s\n' "$(relative "$file")"
    done
}

command=${1:-}
[ $# -eq 0 ] || shift
case "$command" in
    run)
        dsc="$root/build/release/bin/dsc"
        if [ $# -gt 0 ]; then
            case "$1" in -*) fail 2 "expected a point cloud after run, got the option $1; see share/setup.sh --help" ;; esac
            if [ ! -f "$1" ] || [ ! -r "$1" ]; then fail 6 "$1: no such readable file; give the path of a point cloud"; fi
        fi
        announce
        provide "${build_packages[@]}"
        build release
        if [ $# -gt 0 ]; then run_cloud "$@"; else run_default; fi
        ;;
    test)
        full=no
        case "$*" in
            '') ;;
            --full) full=yes ;;
            *) fail 2 "unknown argument of test: $*; accepted is --full" ;;
        esac
        provide "${build_packages[@]}" "${test_packages[@]}"
        if [ "$full" = yes ] && is_debian_12; then
            (install_missing "${full_packages[@]}") ||
                say "setup: not all of ${full_packages[*]} could be installed; the tests that need them will be skipped"
        fi
        # valgrind makes the gate on instructions slow, and the comparison of the jumbo sources with single ones compiles both.
        # A browser, Slurm, GNU parallel and Snakemake are what --full installs.
        preset=test left_out=(-LE '^(gate|slow|browser|cluster)$')
        if [ "$full" = yes ]; then
            preset=dev left_out=()
        else
            say "setup: without the gate on instruction counts, the benchmarks, the comparison with the release build, and the tests" \
                "in a browser and on job schedulers (ctest labels gate, bench, slow, browser and cluster); test --full runs them all"
        fi
        build "$preset"
        exec ctest --test-dir "$root/build/$preset" --output-on-failure -j2 "${left_out[@]}"
        ;;
    package)
        [ $# -eq 0 ] || fail 2 "package has no arguments, got $*"
        is_debian_12 || fail 1 "a Debian package is built on Debian 12 only; elsewhere use cmake --install build/release"
        dsc="$root/build/release/bin/dsc"
        announce
        provide "${build_packages[@]}" "${package_packages[@]}"
        build release
        package
        ;;
    -h | --help) usage ;;
    '') usage >&2 && exit 2 ;;
    *) fail 2 "unknown command: $command; accepted are run, test and package" ;;
esac
