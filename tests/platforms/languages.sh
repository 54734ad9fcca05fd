#!/usr/bin/env bash
# Checks the sources by compilers and languages without building them: languages.sh ROOT CC CXX
#   Every file of src as C++17, C++20 and C++23, with every extension replaced by its plain alternative once.
#   The public headers and the kernels as MSVC would take them: clang in MSVC mode, with its own headers and the few
#   stand-ins of msvc_headers. The other sources need MSVC's C++ library, which is not to be had here, so they are not
#   checked in that mode.
# Prints `languages: N passed, N failed`.
set -u
root=$1 cc=$2 cxx=$3
passed=0 failed=0
try() { # label, command...
  local label=$1 said
  shift
  if said=$("$@" 2>&1); then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf 'error: %s\n%s\n' "$label" "$(printf '%s\n' "$said" | head -20)"
  fi
}
generated=$(ls -d "$root"/build/*/generated 2>/dev/null | head -1)
[ -n "$generated" ] || { printf 'error: configure a build first\n'; exit 1; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
warnings=(-Wall -Wextra -Wpedantic -Werror)
own=(-fsyntax-only -DHF_BUILDING -I "$root/include" -I "$root/src" -I "$generated" -isystem /usr/include/eigen3)
for room in "$root"/src/*/; do
  [ "$(basename "$room")" = gltf ] && continue # a library of its own, with headers that are not everywhere
  all="$folder/$(basename "$room").txt"
  ls "$room"*.cpp | grep -vE '_(avx2|avx512|neon)\.cpp$' >"$all"
  while read -r file; do
    name=${file#"$root"/}
    try "$name as C++17, plain" "$cxx" -std=c++17 -DHF_PLAIN_COMPILER "${warnings[@]}" "${own[@]}" "$file"
    [ "${HF_FULL_TESTS:-0}" = 1 ] || continue
    try "$name as C++20" "$cxx" -std=c++20 "${warnings[@]}" "${own[@]}" "$file"
    try "$name as C++23" "$cxx" -std=c++2b "${warnings[@]}" "${own[@]}" "$file"
  done <"$all"
  # one file of each room in the later languages, where the long form takes them all
  file=$(head -1 "$all")
  for language in c++20 c++2b; do
    try "${file#"$root"/} as $language" "$cxx" -std=$language "${warnings[@]}" "${own[@]}" "$file"
  done
done
msvc=(--target=x86_64-pc-windows-msvc -fsyntax-only -ffreestanding -I "$root/include" "${warnings[@]}" -Wconversion -Wshadow)
for header in "$root"/include/hf/*.h; do
  name=$(basename "$header")
  printf '#include "hf/%s"\nint main(void) { return 0; }\n' "$name" >"$folder/alone.c"
  cp "$folder/alone.c" "$folder/alone.cpp"
  try "$name as C99 in MSVC mode" "$cc" "${msvc[@]}" -std=c99 "$folder/alone.c"
  # the C++ compiler finds stdint.h of clang, since there is none of MSVC
  try "$name as C++17 in MSVC mode" "$cxx" "${msvc[@]}" -std=c++17 "$folder/alone.cpp"
done
kernels=(--target=x86_64-pc-windows-msvc -fsyntax-only -ffreestanding -std=c++17 -DHF_BUILDING
  -isystem "$root/tests/platforms/msvc_headers" -I "$root/include" -I "$root/src" "${warnings[@]}")
for name in factor/kernels_plain factor/kernels field/directions; do
  try "$name.cpp in MSVC mode" "$cxx" "${kernels[@]}" "$root/src/$name.cpp"
  try "$name.cpp in MSVC mode, plain" "$cxx" "${kernels[@]}" -DHF_PLAIN_COMPILER "$root/src/$name.cpp"
done
for name in factor/kernels_avx2 deform/blend_avx2 deform/dense_avx2 deform/normals_avx2 deform/rotation_avx2; do
  try "$name.cpp in MSVC mode" "$cxx" "${kernels[@]}" -mavx2 -mfma "$root/src/$name.cpp"
done
for name in factor/kernels_avx512 deform/blend_avx512 deform/rotation_avx512; do
  try "$name.cpp in MSVC mode" "$cxx" "${kernels[@]}" -mavx512f -mavx512vl -mavx512dq -mfma "$root/src/$name.cpp"
done
for name in factor/kernels_neon deform/blend_neon deform/normals_neon; do
  try "$name.cpp in MSVC mode for ARM" "$cxx" "${kernels[@]/x86_64/aarch64}" "$root/src/$name.cpp"
done
printf 'languages: %s passed, %s failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
