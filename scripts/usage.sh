# shellcheck shell=bash
# Sourced by scripts whose first comment says how to use them: prints it where help is asked for.
if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"
  exit
fi
