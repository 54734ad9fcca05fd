# Sourced by the gates of exported symbols. It needs $nm, and complain() to count what is wrong.
# check_exported LIBRARY HEADER_FOLDER MACRO PREFIX [LEFT_OUT]: the exported symbols are exactly the functions that the headers
# declare with MACRO, without the header LEFT_OUT. Leaves the symbols in $exported.
check_exported() {
  local library=$1 headers=$2 macro=$3 prefix=$4 left_out=${5-} declared changes
  exported=$("$nm" -D --defined-only "$library" | awk '{print $NF}' | sed 's/@.*//' | sort -u)
  [ -n "$exported" ] || complain "nm lists no exported symbol of $library"
  declared=$(find "$headers" -maxdepth 1 -name '*.h' ! -name "$left_out" -exec cat {} + | grep -E "^$macro " | grep -oE "${prefix}[a-z0-9_]+\(" | tr -d '(' | sort -u)
  changes=$(diff <(printf '%s\n' "$declared") <(printf '%s\n' "$exported")) || {
    complain "the exported symbols are not those the headers declare (< declared, > exported):"
    printf '%s\n' "$changes"
  }
}
