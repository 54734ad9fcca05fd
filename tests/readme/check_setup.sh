#!/usr/bin/env bash
# check_setup.sh SOURCE_DIR SCRATCH: what samples/run and tests/run do before and while they build (cmake/setup.sh). Packages are
# installed after a question, and without one for root and with --yes; a bar moves on a terminal; samples/run ends with ten
# lines of relative paths. apt-get, sudo and id are stand-ins. Skipped (77) without `script`.
set -u
source=$1 scratch=$2
command -v script >/dev/null || { echo "skipped: no program script here"; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch/bin"
failed=0
expect() { # SENTENCE CONDITION...
  local sentence=$1
  shift
  "$@" || { printf 'not so: %s\n' "$sentence"; failed=1; }
}
has() { grep -q -- "$1" "$2"; }
hasnot() { ! grep -q -- "$1" "$2"; }

printf 'hf-no-such-package command:hf_no_such_program\n' >"$scratch/list.txt"
# the stand-ins are not this machine's: the user is number $HF_TEST_ID
printf '#!/bin/sh\necho "${HF_TEST_ID:-1000}"\n' >"$scratch/bin/id"
printf '#!/bin/sh\nexec "$@"\n' >"$scratch/bin/sudo"
printf '#!/bin/sh\necho "apt-get $*" >>"%s/apt.log"\n' "$scratch" >"$scratch/bin/apt-get"
chmod 755 "$scratch"/bin/*
install=(env PATH="$scratch/bin:$PATH" bash -c ". '$source/cmake/setup.sh'; hf_yes=\${HF_TEST_YES:-0}; hf_install_packages '$scratch/list.txt'")
try() { # NAME COMMAND...: its output is in NAME.log, the calls of apt-get in apt.log
  local name=$1
  shift
  : >"$scratch/apt.log"
  "$@" >"$scratch/$name.log" 2>&1
}

try alone setsid "${install[@]}" </dev/null
expect "without a terminal, nothing is installed" [ ! -s "$scratch/apt.log" ]
expect "the sentence names the package and --yes" has 'Run again with --yes, or do: sudo apt-get install hf-no-such-package' "$scratch/alone.log"
try yes env HF_TEST_YES=1 setsid "${install[@]}" </dev/null
expect "--yes installs without a question" has 'install .*hf-no-such-package' "$scratch/apt.log"
try root env HF_TEST_ID=0 setsid "${install[@]}" </dev/null
expect "root is not asked" has 'install .*hf-no-such-package' "$scratch/apt.log"
for answer in y n; do
  try "asked_$answer" script -qec "$(printf '%q ' "${install[@]}")" /dev/null < <(sleep 1; printf '%s\n' "$answer"; sleep 1)
  expect "on a terminal it asks" has 'Install them with sudo apt-get? \[y/N\]' "$scratch/asked_$answer.log"
  case "$answer" in
    y) expect "and installs after a yes" has 'install .*hf-no-such-package' "$scratch/apt.log" ;;
    n) expect "and installs nothing after a no" [ ! -s "$scratch/apt.log" ] ;;
  esac
done

# the bar: eight steps of what ninja prints
printf 'for i in 1 2 3 4 5 6 7 8; do echo "[$i/8] step"; sleep 0.3; done\n' >"$scratch/steps.sh"
bar=". '$source/cmake/setup.sh'; bash '$scratch/steps.sh' | hf_progress '$scratch/steps.log'"
try bar script -qec "bash -c $(printf '%q' "$bar")" /dev/null
expect "the bar moves in one line" [ "$(tr '\r' '\n' <"$scratch/bar.log" | grep -cE '^ +\[#* *\] [1-8] of 8')" -eq 8 ]
expect "it says what is left" has '] 6 of 8, about [0-9]* s left' "$scratch/bar.log"
try lines bash -c "$bar"
expect "without a terminal it is a line a tenth" [ "$(grep -cE '^ +[1-8] of 8' "$scratch/lines.log")" -eq 8 ]

# the end of samples/run: ten lines after "done in", of paths that are relative
sed -n '/^hf_say "done in/,/^TEXT$/p' "$source/samples/run" >"$scratch/end.sh"
(cd "$source" && bash -c ". cmake/setup.sh; begin=0 here= at_out=out; . '$scratch/end.sh'") >"$scratch/end.log" 2>&1
expect "samples/run ends with ten lines" [ "$(wc -l <"$scratch/end.log")" -eq 10 ]
expect "with what to look at and what to do next" has 'and do next' "$scratch/end.log"
expect "with relative paths" hasnot ' /' "$scratch/end.log"
exit "$failed"
