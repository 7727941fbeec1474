#!/usr/bin/env bash
# Runs clang-tidy on the given sources; with --all on all of them, which takes hours; by default on
# the most recently changed ones: those of the branch since it left main, or of the last 20 commits,
# at most 20 of them. Usage: check_tidy.sh [--all | SOURCE ...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/tidy
limit=20

# Newest first; a header stands for the source of the same name.
changed_sources() {
  local range=(-n 20) base
  base="$(git merge-base origin/main HEAD 2>/dev/null || true)"
  if [[ -n "$base" && "$base" != "$(git rev-parse HEAD)" ]]; then
    range=("$base..HEAD")
  fi
  git log "${range[@]}" --name-only --format= -- '*.cpp' '*.h' ':!test/benchmark' ':!docs' |
    sed 's/\.h$/.cpp/' | awk '!seen[$0]++' | while read -r source; do
      if [[ -f "$source" ]]; then
        echo "$source"
      fi
    done
}

if [[ "${1:-}" == --all ]]; then
  mapfile -t sources < <(git ls-files '*.cpp' ':!test/benchmark' ':!docs')
elif (($#)); then
  sources=("$@")
else
  mapfile -t sources < <(changed_sources)
  echo "clang-tidy: ${#sources[@]} changed sources, at most $limit checked"
  sources=("${sources[@]:0:limit}")
fi
((${#sources[@]})) || exit 0

# Uses the compile commands of a full build; clang cannot read the precompiled headers of GCC.
cmake -S . -B "$build" -DPLM_PRECOMPILED_HEADERS=OFF -DPLM_GROUP_SOURCES=OFF -DBUILD_FUZZ=ON >/dev/null
printf '%s\n' "${sources[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy-14 -p "$build" --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option
