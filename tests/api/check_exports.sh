#!/usr/bin/env bash
# The binary gate: check_exports.sh LIBHF.SO HEADER_FOLDER ON|OFF (HF_WITH_PEERS) ON|OFF (HF_WITH_GPL) NM READELF
#   the exported symbols are exactly the HF_API functions of the headers;
#   without HF_WITH_PEERS they are those of the headers but hf/peers.h, and no symbol of the room peers is inside;
#   what is called in other libraries is in the golden list tests/api/called.txt, each with its reason;
#   nothing that ends, prints, draws random numbers or touches signals is called, whatever the list says;
#   without HF_WITH_GPL nothing of CHOLMOD or METIS is called or linked.
set -u
library=$1 headers=$2 with_peers=$3 with_gpl=$4 nm=$5 readelf=$6
here=$(cd "$(dirname "$0")" && pwd)
export LC_ALL=C
status=0
complain() { printf 'error: %s\n' "$1"; status=1; }

. "$here/../support/exports.sh"
left_out=
[ "$with_peers" = ON ] || left_out=peers.h
check_exported "$library" "$headers" HF_API hf_ "$left_out"
if [ "$with_peers" = OFF ] && found=$("$nm" -C "$library" 2>/dev/null | grep -E 'hf_peer_|RefactorSolver|UpdownSolver|Paper'); then
  complain "HF_WITH_PEERS is OFF, but the library names a baseline:"
  printf '%s\n' "$found"
fi

# snprintf and vsnprintf write into our own message buffer and are allowed
called=$("$nm" -D --undefined-only "$library" | awk '{print $NF}' | sed 's/@.*//' | sort -u)
forbidden='^(abort|_?_?exit|_Exit|quick_exit|atexit|__assert_fail|__chk_fail'
forbidden+='|(__)?(f|d|v|vf|vd|w|fw|vw|vfw|as|vas)?printf(_chk)?|f?puts|f?putc|putchar|f?putws|fwrite|write|perror|psignal|syslog'
forbidden+='|s?rand(_r)?|s?random(_r)?|[dlem]rand48|signal|sigaction|sigprocmask|raise|kill|_?_?(sig)?(set|long)jmp(_chk)?|setlocale|fork|exec[lv]p?e?|system|popen|fopen|open|_ZSt4c(out|err|log)'
# a container copied without its memory would take the process's default one, past the host's allocator and limit
forbidden+='|_ZNSt3pmr20get_default_resourceEv|_ZNSt3pmr20set_default_resourceEPNS_15memory_resourceE)$'
if found=$(printf '%s\n' "$called" | grep -E "$forbidden"); then
  complain "the library calls what may take its host down, print, or touch its state:"
  printf '%s\n' "$found"
fi

# an entry is an expression of a whole name; those marked GPL hold for a build with HF_WITH_GPL only
allowed=$(awk -v gpl="$with_gpl" '!/^#/ && NF && (gpl == "ON" || $2 != "GPL") { print $1 }' "$here/called.txt" | paste -sd'|')
if found=$(printf '%s\n' "$called" | grep -vE "^($allowed)$"); then
  complain "the library calls what tests/api/called.txt has no reason for:"
  printf '%s\n' "$found"
fi

if [ "$with_gpl" = OFF ]; then
  found=$({ "$nm" "$library" 2>/dev/null; "$nm" -D "$library"; } | awk '{print $NF}' | grep -E '^(cholmod|METIS|libmetis|SuiteSparse_metis|SuiteSparse_METIS)_' | sort -u)
  if [ -n "$found" ]; then
    complain "HF_WITH_GPL is OFF, but the library names CHOLMOD or METIS:"
    printf '%s\n' "$found"
  fi
  if found=$("$readelf" -d "$library" | grep NEEDED | grep -iE 'cholmod|metis|blas|lapack|gomp'); then
    complain "HF_WITH_GPL is OFF, but the library links:"
    printf '%s\n' "$found"
  fi
fi
"$readelf" -d "$library" | grep -qE 'SONAME.*libhf\.so\.[0-9]+\]' || complain "the library has no soname libhf.so.MAJOR"
if "$readelf" -d "$library" | grep -qE 'RPATH|TEXTREL'; then complain "the library has text relocations or an rpath"; fi
[ "$status" -eq 0 ] && printf '%s exported symbols, %s called ones: as expected\n' "$(printf '%s\n' "$exported" | wc -l)" "$(printf '%s\n' "$called" | wc -l)"
exit "$status"
