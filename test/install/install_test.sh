#!/usr/bin/env bash
# Installs a build into a folder of its own, builds the example of docs/ against that, and runs it.
# Usage: install_test.sh BUILD
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

cmake --install "$1" --prefix "$folder/installed" >"$folder/install.log"
cmake -S "$root/docs/example" -B "$folder/build" -DCMAKE_BUILD_TYPE=Release \
  -Dplm_vins_DIR="$folder/installed/share/plm_vins/cmake"
cmake --build "$folder/build"
"$folder/build/example" "$folder/installed/share/plm_vins/config/euroc.yaml" | tee "$folder/poses"
if ! grep -q '^1\.9.* m$' "$folder/poses"; then
  echo "install_test.sh: the example has no pose after 1.9 s" >&2
  exit 1
fi
