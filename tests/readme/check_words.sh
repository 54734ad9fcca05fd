#!/usr/bin/env bash
# check_words.sh SOURCE_DIR: panels and buttons of Blender's add-on are named as those of the studio.
set -u
addon="$1/bindings/blender/hf_blender" studio="$1/samples/studio/src"
failed=0
titles=$(sed -n "s/.*static title = '\(.*\)';/\1/p" "$studio"/tools/*.js | sort -u)
# the panel of the whole tab is named hf
while IFS= read -r panel; do
  grep -qx "$panel" <<<"$titles" || { echo "panels.py: the studio has no tool \"$panel\", only: $(paste -sd, <<<"$titles")"; failed=1; }
done < <(sed -n 's/.*bl_idname.* = "\([A-Z][a-z]*\)", "HF_PT_.*/\1/p' "$addon/panels.py")
for word in 'Make quads' 'Draw strokes' 'ole of '; do
  for folder in "$addon" "$studio"; do
    grep -rq "$word" "$folder" || { echo "${folder#"$1"/} has no \"$word\""; failed=1; }
  done
done
[ "$(sed -n 's/.*bl_idname.* = "\([A-Z][a-z]*\)", "HF_PT_.*/\1/p' "$addon/panels.py" | wc -l)" -ge 5 ] || { echo "panels.py: fewer than five panels were found"; failed=1; }
exit "$failed"
