#!/usr/bin/env bash
# Counts the instructions of kernels under qemu: instructions.sh KERNEL_WORK PLUGIN EMULATOR...
# Prints for every kernel the instructions of a multiply-add in plain code and in NEON, and the ratio of both. The ratio
# of sweep, path, triangle and blend must not exceed the limit below. Plain code has two lanes and no fused operation.
# With l loads a product the ratio is at least (0.5 + l) / (1 + l): 0.6 where two numbers of a row come with one load of
# two registers, 0.5 only without loads. Rows below that are where plain code does worse. The limit lies just above the
# worst measured ratio: it guards against a regression. The aim is 0.5; of nine rows four reach it.
set -u
program=$1 plugin=$2
shift 2
limit=0.72
"$@" -plugin "$plugin" "$program" >/dev/null 2>&1 || { printf 'skipped: this qemu takes no plug-in\n'; exit 77; }
count() { "${@:3}" -plugin "$plugin" "$program" "$kernel" "$1" "$2" 2>&1 >/dev/null | sed -n 's/^instructions //p'; }
status=0
printf '%-30s %8s %8s %6s\n' kernel plain neon ratio
while read -r kernel products; do
  of=()
  for set in plain neon; do
    few=$(count "$set" 2 "$@") many=$(count "$set" 12 "$@")
    of+=("$(awk -v a="$few" -v b="$many" -v n="$products" 'BEGIN { printf "%.3f", (b - a) / 10 / n }')")
  done
  ratio=$(awk -v a="${of[0]}" -v b="${of[1]}" 'BEGIN { printf "%.3f", b / a }')
  printf '%-30s %8s %8s %6s\n' "$kernel" "${of[@]}" "$ratio"
  case "$kernel" in
    sweep* | path* | triangle* | blend*)
      awk -v r="$ratio" -v l="$limit" 'BEGIN { exit !(r <= l) }' || { printf 'error: %s: more than %s of the plain code\n' "$kernel" "$limit"; status=1; } ;;
  esac
done < <("$@" "$program")
exit "$status"
