#!/usr/bin/env bash
# Runs the tests of the public ABI under valgrind: valgrind.sh BIN_FOLDER [NAME...]
#   Runs every api_*_test there, or those named. Leaks and reads of uninitialised memory are errors. valgrind's processor
#   has AVX2 and no AVX-512, so the AVX2 kernels run. Prints VALGRIND_ERRORS; a failed test counts as one. Exits with 77
#   (skipped) without valgrind.
set -u
bin=$1
shift
command -v valgrind >/dev/null || {
  echo "skipped: no valgrind here"
  exit 77
}
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT
# CHOLMOD keeps its OpenMP threads (docs/promises.md), which valgrind reports as a leak
export OMP_THREAD_LIMIT=1
programs=("$@")
[ ${#programs[@]} -gt 0 ] || programs=("$bin"/api_*_test)
errors=0
for program in "${programs[@]}"; do
  [ -x "$program" ] || program=$bin/$program
  if ! valgrind -q --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite,indirect,possible \
    "$program" >"$log" 2>&1; then
    found=$(grep -cE '^==[0-9]+== [A-Z]' "$log")
    errors=$((errors + (found > 0 ? found : 1)))
    printf '%s:\n' "$(basename "$program")"
    grep -E '^==|FAILED|Error' "$log" | head -40
  fi
done
printf 'VALGRIND_PROGRAMS %s >=1\nVALGRIND_ERRORS %s <=0\n' "${#programs[@]}" "$errors"
[ "$errors" -eq 0 ]
