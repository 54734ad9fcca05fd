#!/usr/bin/env bash
# Reads the #include "..." lines of src/, samples/ and include/ and fails on a wrong arrow:
#   base <- {mesh, factor} <- engine <- field <- {deform, detail, remesh} <- transfer <- capi; mesh and factor do not see each other;
#   samples see only include/hf and each other; public headers see each other and the C standard library.
# usage: check_rooms.sh SOURCE_DIR
set -u
root=$1
declare -A sees=(
  [base]="base"
  [mesh]="base mesh"
  [factor]="base factor"
  [engine]="base mesh factor engine"
  [field]="base mesh factor engine field"
  [deform]="base mesh factor engine field deform"
  [detail]="base mesh factor engine field detail"
  [remesh]="base mesh factor engine field remesh"
  [transfer]="base mesh factor engine field deform transfer"
  [capi]="base mesh factor engine field deform detail remesh transfer capi"
)
wrong=0
arrows=0
complain() {
  printf 'wrong arrow: %s\n' "$*"
  wrong=$((wrong + 1))
}

for folder in "$root"/src/*/; do
  room=$(basename "$folder")
  [ -n "${sees[$room]:-}" ] || { complain "src/$room is not a room of the house"; continue; }
  while IFS=: read -r file line text; do
    target=$(sed -E 's/.*"([^"]+)".*/\1/' <<<"$text")
    other=${target%%/*}
    arrows=$((arrows + 1))
    case "$target" in
      hf/*) continue ;;   # the public surface, result codes and descs
      */*) ;;
      *) complain "$file:$line includes \"$target\" without its room"; continue ;;
    esac
    case " ${sees[$room]} " in
      *" $other "*) ;;
      *) complain "$file:$line: $room must not see $other (\"$target\")" ;;
    esac
  done < <(grep -rnE '^ *# *include *"' "$folder" --include='*.h' --include='*.cpp' --include='*.inl' | sed "s|^$root/||")
done

while IFS=: read -r file line text; do
  arrows=$((arrows + 1))
  target=$(sed -E 's/.*"([^"]+)".*/\1/' <<<"$text")
  other=${target%%/*}
  case "$target" in hf/*) continue ;; esac
  [ -n "${sees[$other]:-}" ] && [ ! -e "$root/samples/$target" ] && complain "$file:$line: samples see only include/hf (\"$target\")"
done < <(grep -rnE '^ *# *include *"' "$root/samples" --include='*.h' --include='*.cpp' --include='*.c' | sed "s|^$root/||")

while IFS=: read -r file line text; do
  arrows=$((arrows + 1))
  case "$text" in
    *\"hf/*) ;;
    *"<std"* | *"<cstd"*) ;;
    *) case "$file" in *.hpp) ;; *) complain "$file:$line: public headers include only hf/ and the C standard library ($text)" ;; esac ;;
  esac
done < <(grep -rnE '^ *# *include' "$root/include/hf" | sed "s|^$root/||")

[ "$arrows" -gt 100 ] || { echo "only $arrows include lines found; is $root the project?"; exit 1; }
echo "$arrows arrows, $wrong wrong"
[ "$wrong" -eq 0 ]
