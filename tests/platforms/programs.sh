#!/usr/bin/env bash
# The sample programs of another system as a user runs them: programs.sh BIN SAMPLES SCRATCH EMULATOR...
#   hf_field and hf_transfer read and write files whose folders and names hold letters outside ASCII,
#   also in a list whose lines run as processes.
set -u
bin=$1 samples=$2 scratch=$3
shift 3
folder="$scratch/Größe Ä – 形"
rm -rf "$scratch"
mkdir -p "$folder" || exit 1
cd "$folder" || exit 1
must() { "$@" || { printf 'error: %s failed\n' "$*"; exit 1; }; }
there() { [ -s "$1" ] || { printf 'error: %s was not written\n' "$1"; exit 1; }; }
exe() { printf '%s/%s.exe' "$bin" "$1"; }
must "$@" "$(exe hf_make_assets)" . --creature horse --vertices 2000
must "$@" "$(exe hf_make_assets)" . --creature bull --vertices 2000
mv horse.glb 'Pferd – früh.glb' && mv bull.glb 'Stier Ü.glb' || exit 1
printf 'add 5=0.5\nundo\n' >'Änderung.txt'
must "$@" "$(exe hf_field)" 'Pferd – früh.glb' --site 10=0 --site 1200=1 --script 'Änderung.txt' --out 'Feld ß.txt' --glb 'Feld ß.glb' --png 'Feld ß.png'
there 'Feld ß.txt' && there 'Feld ß.glb' && there 'Feld ß.png'
must "$@" "$(exe hf_transfer)" 'Pferd – früh.glb' 'Stier Ü.glb' --pairs "$samples/transfer/pairs/horse_to_bull.json" -o 'Läuft 形.glb'
there 'Läuft 形.glb'
# each line of a list is a process of its own, and one that fails stops no other
printf '"Pferd – früh.glb" "Stier Ü.glb" --pairs "%s" -o "Liste ß.glb"\nfehlt.glb "Stier Ü.glb" -o x.glb\n' \
  "$samples/transfer/pairs/horse_to_bull.json" >'Liste ß.txt'
if said=$("$@" "$(exe hf_transfer)" --batch 'Liste ß.txt' --jobs 2); then printf 'error: a list with a failed line ended well\n'; exit 1; fi
there 'Liste ß.glb'
[ "$(grep -c '"exit":0' <<<"$said") $(grep -c 'fehlt.glb' <<<"$said")" = '1 1' ] || { printf 'error: the list said: %s\n' "$said"; exit 1; }
# a file that is not there is named in the message
if said=$("$@" "$(exe hf_field)" 'fehlt.obj' 2>&1); then printf 'error: a missing file was read\n'; exit 1; fi
case "$said" in *fehlt.obj*) ;; *) printf 'error: the message does not name the file: %s\n' "$said"; exit 1 ;; esac
printf 'hf_field and hf_transfer wrote %s files\n' "$(ls | wc -l)"
