#!/usr/bin/env bash
# Builds the fuzz targets under AddressSanitizer and UndefinedBehaviorSanitizer and runs each of
# them.
# Usage: fuzz.sh [SECONDS [TARGET [FIRST [COUNT]]]]; by default ten minutes each. A finding names
# the target and the index of the input; pass the index as FIRST to run it again. SANITIZE=OFF is
# ten times as fast: for a million faults run SANITIZE=OFF fuzz.sh inf divergence 0 1300, or parts
# of it in parallel.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
# shellcheck source=scripts/usage.sh
source "$root/scripts/usage.sh"
seconds="${1:-600}"

cmake -S "$root" -B "$root/build/fuzz" -DCMAKE_BUILD_TYPE=Release -DSANITIZE="${SANITIZE:-ON}" \
  -DBUILD_TESTING=OFF -DBUILD_FUZZ=ON
cmake --build "$root/build/fuzz" -j "${JOBS:-$(nproc)}" --target plm_fuzz plm_fuzz_input plm_fuzz_ros \
  plm_soak
export ASAN_OPTIONS=abort_on_error=1:handle_segv=0:allocator_may_return_null=0:detect_leaks=0
export UBSAN_OPTIONS=abort_on_error=1:print_stacktrace=1
target="${2:-all}"
case "$target" in
  all) programs=(plm_fuzz plm_fuzz_input plm_fuzz_ros) ;;
  messages) programs=(plm_fuzz_ros) ;;
  config | asl | points | lines) programs=(plm_fuzz_input) ;;
  *) programs=(plm_fuzz) ;;
esac
for program in "${programs[@]}"; do
  "$root/build/fuzz/tests/$program" "$target" "$seconds" "${@:3}"
done
