#!/usr/bin/env bash
# run_smoke.sh HF_BENCH OUTPUT_FOLDER ON|OFF (HF_WITH_GPL): all commands at a tiny size. Every figure is measured, every
# row is there for both mesh families, the table and one picture per command are written; bad words are refused.
set -u
program=$1 folder=$2 with_gpl=$3
[ -x "$program" ] || { echo "hf_bench is not built: tests/run --full, or cmake --build build/dev --target hf_by_hand"; exit 77; }
status=0
complain() { printf 'error: %s\n' "$1"; status=1; }

rm -rf "$folder"
mkdir -p "$folder"
"$program" all --small --repeat 1 --threads 1 --json "$folder/all.json" --markdown "$folder/all.md" --plot "$folder/plots" \
  >"$folder/all.txt" 2>&1 || { cat "$folder/all.txt"; complain "hf_bench all --small failed"; }

figures="sweep_read channels_3 channels_8 float32 sites_1000 sites_10000 memory load site_error residual edits_error biharmonic_change"
[ "$with_gpl" = ON ] && figures+=" ordering_time ordering_fill ordering_flops numeric first_field sweep_solve table1_torus
  table1_creature table1_single table1_clear_torus table1_clear_creature table1_recompute"
for figure in $figures; do
  grep -q "\"figure\": \"$figure\"" "$folder/all.json" || complain "the figure $figure was not measured"
done
for row in "42K +150/-160" "84K +150/-160" "173K +40/-30" "173K +200/-0" "173K +0/-300" "304K +60/-50" "304K +100/-80" "304K +1/-1"; do
  for family in torus creature; do
    grep -qF "\"name\": \"${row}_$family\"" "$folder/all.json" || complain "table1 has no row ${row}_$family"
  done
done
commands=$("$program" --help | sed -n '/^commands/,/^options/p' | awk '/^  [a-z]/ { print $1 }')
for command in first-field sweep large-sites memory scaling all engines; do
  printf '%s\n' "$commands" | grep -qx "$command" || complain "--help does not name $command"
done
for command in $commands; do
  [ "$command" = all ] || [ "$command" = engines ] || grep -q "</svg>" "$folder/plots/$command.svg" 2>/dev/null || complain "no picture of $command"
done
grep -q "^| figure | mesh | measured | must | aim | reached |" "$folder/all.md" || complain "no table in the Markdown file"
grep -q "nan" "$folder/all.md" && complain "a figure is not a number"

"$program" sweep --small --repeat 1 --threads 1,2 --rows torus --json "$folder/two.json" --plot "$folder/two.svg" >"$folder/two.txt" 2>&1 ||
  complain "hf_bench with two numbers of threads failed"
[ "$(grep -c '"figure": "sweep_read"' "$folder/two.json")" = 2 ] || complain "--threads 1,2 did not measure twice"

printf 'before\n<!-- hf_bench: begin -->\nold\n<!-- hf_bench: end -->\nafter\n' >"$folder/kept.md"
"$program" partial --small --markdown "$folder/kept.md" >/dev/null 2>&1 || complain "--markdown failed"
if ! grep -q "^before" "$folder/kept.md" || ! grep -q "^after" "$folder/kept.md" || grep -q "^old" "$folder/kept.md"; then
  complain "--markdown does not replace what stands between its marks, and nothing else"
fi

refused() {
  if "$program" "$@" >"$folder/refused.txt" 2>&1; then complain "accepted: $*"; fi
  grep -q "^hf_bench: " "$folder/refused.txt" || complain "no message for: $*"
}
refused tabel1
refused table1 --threads 0
refused table1 --threads 1,
refused table1 --repeat
refused all --plot all.svg
refused partial --small --json "$folder/missing/file.json"
exit $status
