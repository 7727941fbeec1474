#!/usr/bin/env bash
# Builds this checkout in Release into build/. Usage: build.sh [-DOPTION=VALUE ...]
# BUILD names another folder. TARGETS (names separated by spaces) restricts the build to these.
# JOBS limits the parallel compilers; by default one per core, at most one per 1.5 GB of free memory.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck source=scripts/usage.sh
source "$root/scripts/usage.sh"

if [[ -z "${ROS_PACKAGE_PATH:-}" && -f /opt/ros/noetic/setup.bash ]]; then
  set +u  # ROS's script reads unset variables
  # shellcheck disable=SC1091
  source /opt/ros/noetic/setup.bash --  # otherwise it reads our options
  set -u
fi

cores="$(nproc)"
by_memory="$(awk '/MemAvailable/ {print int($2 / 1572864) + 1}' /proc/meminfo)"
jobs="${JOBS:-$((cores < by_memory ? cores : by_memory))}"

# With ccache, what another checkout has compiled is reused.
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER="${CMAKE_CXX_COMPILER_LAUNCHER-ccache}"
  export CCACHE_BASEDIR="${CCACHE_BASEDIR-$root}" CCACHE_NOHASHDIR=1
  export CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS-pch_defines,time_macros}"
fi

build="${BUILD:-$root/build}"
cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "$@"
read -ra targets <<<"${TARGETS:-all}"
cmake --build "$build" -j "$jobs" --target "${targets[@]}"
