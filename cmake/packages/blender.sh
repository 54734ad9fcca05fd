#!/usr/bin/env bash
# hf_blender-VERSION.zip: an extension for Blender 4.2 and later and an add-on for 3.x, with the libraries for the systems
# Blender has. Tried in the Blender of this machine (HF_BLENDER), and in Blender as a Python module where HF_BPY names a
# Python that has it.
. "$(dirname "$0")/common.sh"

blender_make() {
  local out=$1 platform libraries=() platforms=() extra
  extra=$(mktemp -d) || exit 1
  for platform in $(hf_platforms); do
    case "$platform" in linux-x64 | windows-x64) libraries+=("$(hf_library "$platform")") platforms+=("$platform") ;; esac
  done
  hf_licences "$extra/licences" "${platforms[*]}"
  for platform in "${platforms[@]}"; do cp "$(hf_library "$platform")" "$extra/" || exit 1; done
  hf_bom "$extra/bom.cdx.json" "$(printf '%s\n' "${platforms[@]}" | paste -sd,)" "$extra"
  rm -f "$extra"/*.so.* "$extra"/*.dll
  EXTRA="$extra" python3 "$hf_root/bindings/blender/make_zip.py" "${libraries[@]}" "$out/hf_blender-$hf_version.zip" || exit 1
  rm -rf "$extra"
}

blender_try() {
  local out=$1 scratch=$2 blender=${HF_BLENDER:-blender} filled said=() platform
  filled=$(hf_filled) || exit 1
  export HF_ADDON_ZIP="$out/hf_blender-$hf_version.zip" HF_TESTS="$hf_tests" HF_SCENES="$filled"
  command -v "$blender" >/dev/null || hf_skip "no Blender here (Debian: blender)"
  mkdir -p "$scratch/scripts" "$scratch/config" "$scratch/inside"
  (cd "$scratch/inside" && python3 -m zipfile -e "$HF_ADDON_ZIP" .) || exit 1
  for platform in $(hf_platforms); do
    case "$platform" in linux-x64 | windows-x64) hf_same_library "$platform" "$scratch/inside/hf_blender/vendor/hf/$(hf_library_name "$platform")" ;; esac
  done
  BLENDER_USER_SCRIPTS="$scratch/scripts" BLENDER_USER_CONFIG="$scratch/config" PATH=/usr/bin:$PATH env -u PYTHONPATH -u PYTHONHOME -u HF_LIBRARY \
    "$blender" -b --factory-startup --python-exit-code 3 --python "$hf_tests/blender_test.py" -- "$scratch/picture.png" >"$scratch/blender.log" 2>&1 || {
    tail -20 "$scratch/blender.log" >&2
    hf_fail "the add-on in $("$blender" --version | head -1)"
  }
  said+=("$("$blender" --version | head -1): as add-on, golden scenes and all operators")
  if [ -n "${HF_BPY:-}" ]; then
    mkdir -p "$scratch/module"
    (cd "$scratch/module" && BLENDER_USER_RESOURCES="$scratch/module" env -u PYTHONPATH -u HF_LIBRARY \
      "$HF_BPY" "$hf_tests/blender_test.py" -- "$scratch/module.png") >"$scratch/module.log" 2>&1 || {
      tail -20 "$scratch/module.log" >&2
      hf_fail "the extension in Blender as a module"
    }
    said+=("$(sed -n 's/^extension: //p' "$scratch/module.log" | tail -1)")
  fi
  hf_ran "$(printf '%s; ' "${said[@]}" | sed 's/; $//')"
}

case "$1" in
  make) blender_make "$2" ;;
  try) blender_try "$2" "$3" ;;
esac
