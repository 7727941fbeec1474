#!/usr/bin/env bash
# Runs a command in the environment of the built package.
set -e
# shellcheck disable=SC1091
source /plm_vins/build/devel/setup.bash --  # otherwise it reads the command's options
exec "$@"
