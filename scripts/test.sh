#!/usr/bin/env bash
# Installs missing packages, builds in Release and runs all tests.
# Usage: test.sh [ctest option ...], for instance: test.sh -R preintegration
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck source=scripts/usage.sh
source "$root/scripts/usage.sh"

"$root/scripts/setup.sh"
TARGETS="all tests" "$root/scripts/build.sh" -DBUILD_TESTING=ON
cd "$root/build"
ctest --output-on-failure -j2 "$@"
