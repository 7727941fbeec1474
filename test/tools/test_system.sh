#!/usr/bin/env bash
# Builds the package on a fresh Debian, flies, runs the tests and prints a table of versions and
# results. Run by scripts/test_on.sh, as root in the system's own file tree.
# Usage: test_system.sh ARCH [ctest option ...]
#   ARCH  amd64: everything; arm64: the build without ROS, cross-compiled, and its unit tests
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
arch="$1" runner=()
shift

build() {
  "$root/scripts/setup.sh" git locales ${CCACHE_DIR:+ccache}
  TARGETS="all tests" "$root/scripts/build.sh" -DBUILD_TESTING=ON
}

# Programs and unit tests, with the libraries of the other architecture.
cross_build() {
  runner=(qemu-aarch64-static)
  dpkg --add-architecture arm64
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends cmake \
    crossbuild-essential-arm64 libboost-program-options-dev:arm64 libceres-dev:arm64 \
    libgmock-dev:arm64 libgtest-dev:arm64 libopencv-contrib-dev:arm64 libopencv-dev:arm64 \
    libyaml-cpp-dev:arm64 git locales nlohmann-json3-dev python3-matplotlib python3-numpy \
    qemu-user-static ${CCACHE_DIR:+ccache}
  TARGETS="all tests" "$root/scripts/build.sh" -DBUILD_ROS=OFF -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
    -DCMAKE_CROSSCOMPILING_EMULATOR=/usr/bin/qemu-aarch64-static
}

# fly FOLDER COMMAND...: simulates, estimates and evaluates a flight by copies of the programs in
# FOLDER; COMMAND runs them.
fly() {
  local folder="$1"
  shift
  rm -rf "$folder"
  install -d -o nobody "$folder"
  cp -r "$root/build/devel/lib/plm_vins"/{simulate,run_offline} "$root/scripts" \
    "$root/config/euroc.yaml" "$folder/"
  "$@" "${runner[@]}" "$folder/simulate" --config "$folder/euroc.yaml" --duration 8 \
    --asl "$folder/flight"
  "$@" "${runner[@]}" "$folder/run_offline" --config "$folder/euroc.yaml" \
    --asl "$folder/flight" --output "$folder/results"
  "$@" "$folder/scripts/evaluate.py" "$folder/results/trajectory.tum" \
    "$folder/flight/groundtruth.tum" >"$folder/evaluation.txt"
}

# The second flight must give the same bytes. Its user writes decimal commas, has a home that is
# not writable, another time zone, and names with umlauts and spaces.
compare_flights() {
  local plain=/flights/plain other='/flights/Flüge über Köln' file
  localedef -i de_DE -f UTF-8 de_DE.UTF-8
  fly "$plain" env
  fly "$other" setpriv --reuid=65534 --regid=65534 --clear-groups \
    env HOME=/ LC_ALL=de_DE.UTF-8 TZ=NPT-5:45
  for file in results/trajectory.tum evaluation.txt; do
    cmp "$plain/$file" "$other/$file"
  done
}

# versions PACKAGE...: prints the versions of the sources of installed packages.
versions() {
  dpkg-query -W -f='${Package} ${source:Upstream-Version}\n' "$@" 2>/dev/null |
    sed -E 's/^lib|-dev//g; s/\+dfsg[^ ]*//' | sort -u | paste -sd, | sed 's/,/, /g'
}

row() { echo "| $1 | $2 |"; }

print_table() {
  # shellcheck disable=SC1091
  row system "$(source /etc/os-release && echo "$PRETTY_NAME"), $arch"
  row tools "g++ $(g++ -dumpfullversion), $(versions cmake python3 qemu-user-static)"
  row libraries "$(versions libboost-dev libceres-dev libeigen3-dev libopencv-dev libroscpp-dev \
    libyaml-cpp-dev nlohmann-json3-dev)"
  row "flight of 8 s" "$(awk '/^APE \[m\]/ {print $3 " m rms"}' "$1")"
  row tests "$(grep 'tests passed' "$2")"
}

if [[ "$arch" == amd64 ]]; then
  build
else
  cross_build
  set -- -L unit --timeout 7200 "$@"
fi
tests=/flights/ctest.txt status=0
compare_flights
cd "$root/build"
ctest --output-on-failure -j "${JOBS:-2}" "$@" | tee "$tests" || status=$?
print_table /flights/plain/evaluation.txt "$tests"
exit "$status"
