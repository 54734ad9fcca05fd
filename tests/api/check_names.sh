#!/usr/bin/env bash
# The names of the exports: check_names.sh EXPORTS.TXT. Every function but five is hf_NOUN_VERB or hf_NOUN_VERB_WHAT, with a
# noun and a verb of the lists below; every noun and every verb is in use.
set -u
exports=$1
plain='hf_create hf_add_sites hf_remove_sites hf_solve hf_deform' # the five names without a noun
nouns='surface solver pose region detail transfer direction geodesics quads flow weights skeleton retarget progress error result version'
verbs='add apply cancel cast certify clone create deform destroy edit find get measure mirror morph move prepare propose release relink remove
  reset rotate save set solve space trace transfer update'
status=0
complain() { printf 'error: %s\n' "$1"; status=1; }
either() { printf '%s' "$*" | tr -s ' \n' '|'; }

for name in $plain; do grep -qx "$name" "$exports" || complain "$name is not exported"; done
pattern="^($(either $plain)|hf_($(either $nouns))_($(either $verbs))(_[a-z0-9]+)*)$"
if odd=$(grep -vE "$pattern" "$exports"); then complain "not hf_NOUN_VERB: $(printf '%s' "$odd" | tr '\n' ' ')"; fi
for noun in $nouns; do grep -qE "^hf_${noun}_" "$exports" || complain "no function has the noun $noun"; done
for verb in $verbs; do grep -qE "^hf_[a-z]+_${verb}(_|$)" "$exports" || complain "no function has the verb $verb"; done
[ "$status" -eq 0 ] && printf '%s names as agreed\n' "$(wc -l <"$exports")"
exit "$status"
