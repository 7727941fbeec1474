# shellcheck shell=bash
# Sourced by scripts whose first comment describes their usage: prints it on --help.
if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then
  sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"
  exit
fi
