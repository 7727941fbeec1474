#!/usr/bin/env bash
# Lists the source files that clang-format would change. Exit code 77 (skipped) without clang-format
# 14, since other versions format slightly differently.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

formatter="$(command -v clang-format-14 || command -v clang-format || true)"
if [[ -z "$formatter" ]] || ! "$formatter" --version | grep -q 'version 14\.'; then
  echo "clang-format 14 is not installed: format not checked"
  exit 77
fi
find . -path './build*' -prune -o \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 "$formatter" --dry-run --Werror
