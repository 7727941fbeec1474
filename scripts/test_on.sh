#!/usr/bin/env bash
# Builds and tests the last commit on another release of Debian, with nothing but what setup.sh
# installs there. As root on Debian or Ubuntu. Ends with a table of versions and results.
# Usage: test_on.sh [--systems DIR] [--mirror URL] SUITE [ARCH [ctest option ...]]
#   SUITE          bullseye, bookworm, trixie (Debian 11, 12, 13)
#   ARCH           amd64 (default); or arm64: the build without ROS, cross-compiled, run by qemu
#   --systems DIR  where systems are kept for the next run (default: /var/tmp/plm_systems)
#   --mirror URL   of Debian packages (default: that of this machine)
# JOBS is the number of parallel compilers and tests. CCACHE_DIR, if set, is used by the compilers.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck source=scripts/usage.sh
source "$root/scripts/usage.sh"

fail() {
  echo "test_on.sh: $*" >&2
  exit 1
}

mirror_of_this_machine() {
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(ORIGIN) $(SITE)' 'Created-By: Packages' 2>/dev/null |
    awk '$1 == "Debian" && !/security/ {print $2; exit}'
}

systems=/var/tmp/plm_systems mirror=''
while [[ "${1:-}" == --* ]]; do
  (($# > 1)) || fail "$1 needs a value"
  case "$1" in
    --systems) systems="$(realpath -m "$2")" ;;
    --mirror) mirror="$2" ;;
    *) fail "unknown option $1; test_on.sh --help lists them" ;;
  esac
  shift 2
done
(($#)) || fail "no SUITE is given, for instance bullseye"
suite="$1" arch="${2:-amd64}"
[[ "$arch" == amd64 || "$arch" == arm64 ]] || fail "$arch: not amd64 or arm64"
((EUID == 0)) || fail "needs root, for chroot and mount"
system="$systems/${suite}_$arch"

# A complete system has its final name. Both architectures begin as amd64: arm64 is added to it.
make_system() {
  [[ ! -d "$system" ]] || return 0
  command -v debootstrap >/dev/null || apt-get install -qq -y debootstrap
  mirror="${mirror:-$(mirror_of_this_machine)}"
  rm -rf "$system.part"
  mkdir -p "$systems"
  debootstrap --variant=minbase --arch=amd64 "$suite" "$system.part" \
    "${mirror:-http://deb.debian.org/debian}"
  echo force-unsafe-io >"$system.part/etc/dpkg/dpkg.cfg.d/test_on"  # halves the time to install
  mkdir "$system.part/ccache"
  mv "$system.part" "$system"
}

# The clone keeps its build folder from run to run.
update_clone() {
  [[ -d "$system/plm_vins" ]] || git clone --quiet --no-checkout "$root" "$system/plm_vins"
  git -C "$system/plm_vins" fetch --quiet "$root" HEAD
  git -C "$system/plm_vins" reset --quiet --hard FETCH_HEAD
}

# Runs a command in the system, with nothing of this machine's environment. Its mounts and processes
# end with it.
in_system() {
  local environment=(HOME=/root LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin JOBS="${JOBS:-}")
  if [[ -n "${CCACHE_DIR:-}" ]]; then
    environment+=(CCACHE_DIR=/ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
      "CCACHE_SLOPPINESS=pch_defines,time_macros")
  fi
  cp /etc/resolv.conf /etc/hosts "$system/etc/"
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child bash -c '
    system="$1" ccache="$2"
    shift 2
    mount -t proc proc "$system/proc"
    mount --rbind /dev "$system/dev"
    [[ -z "$ccache" ]] || mount --bind "$ccache" "$system/ccache"
    exec chroot "$system" env -i "$@"' \
    bash "$system" "${CCACHE_DIR:-}" "${environment[@]}" "$@"
}

make_system
update_clone
in_system /plm_vins/test/tools/test_system.sh "$arch" "${@:3}"
