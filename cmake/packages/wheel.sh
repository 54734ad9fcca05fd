#!/usr/bin/env bash
# Python wheels, one for each platform: manylinux2014 (glibc 2.17) and Windows. The code is the same in all.
. "$(dirname "$0")/common.sh"
python="$hf_root/bindings/python"

wheel_tag() {
  case "$1" in
    linux-x64) printf manylinux_2_17_x86_64.manylinux2014_x86_64 ;;
    linux-arm64) printf manylinux_2_17_aarch64.manylinux2014_aarch64 ;;
    windows-x64) printf win_amd64 ;;
  esac
}

wheel_make() {
  local platform folder
  for platform in $(hf_platforms); do
    folder=$(mktemp -d) || exit 1
    mkdir -p "$folder/hf" "$folder/hf_fields-$hf_version.dist-info/sboms"
    cp "$python"/hf/*.py "$python/hf/py.typed" "$folder/hf/"
    cp "$(hf_library "$platform")" "$folder/hf/$(hf_library_name "$platform")"
    hf_licences "$folder/hf_fields-$hf_version.dist-info/licenses" "$platform"
    hf_bom "$folder/hf_fields-$hf_version.dist-info/sboms/bom.cdx.json" "$platform" "$folder"
    hf_pack wheel "$1" "$folder" "$python/pyproject.toml" "$python/README.md" "$(wheel_tag "$platform")" >/dev/null || exit 1
    rm -rf "$folder"
  done
}

wheel_try() {
  local out=$1 scratch=$2 platform said tools filled found=()
  tools=$(hf_python_tools) || exit $?
  filled=$(hf_filled) || exit 1
  for platform in $(hf_platforms); do
    local wheel
    wheel=$(ls "$out"/*"$(wheel_tag "$platform")".whl) || hf_fail "no wheel for $platform"
    # pip takes it for that platform, and for no other
    mkdir -p "$scratch/$platform"
    hf_quiet "$tools/bin/pip" download -q --no-deps --no-index --find-links "$out" --only-binary :all: --dest "$scratch/$platform" \
      --python-version 3.8 --platform "$(wheel_tag "$platform" | sed 's/.*\.//')" "hf-fields==$hf_version"
    cmp -s "$wheel" "$scratch/$platform/$(basename "$wheel")" || hf_fail "pip takes another wheel for $platform"
    (mkdir "$scratch/$platform/inside" && cd "$scratch/$platform/inside" && python3 -m zipfile -e "$wheel" .) || exit 1
    hf_same_library "$platform" "$scratch/$platform/inside/hf/$(hf_library_name "$platform")"
    case "$platform" in linux-*)
      said=$("$tools/bin/auditwheel" show "$wheel" 2>&1) || { printf '%s\n' "$said" >&2; hf_fail "auditwheel show $wheel"; }
      said=$(printf '%s' "$said" | tr '\n' ' ' | grep -oE 'consistent with the following platform tag: *"[^"]*"|following platform tag: *"[^"]*"' | grep -o '"[^"]*"' | head -1)
      case "$said" in '"manylinux_2_17_'* | '"manylinux_2_5_'* | '"manylinux_2_12_'*) ;; *) hf_fail "auditwheel says $said of $wheel" ;; esac
      found+=("auditwheel says $said")
      ;;
    esac
  done
  # an empty environment: numpy and the wheel, nothing else
  hf_quiet python3 -m venv "$scratch/venv"
  hf_quiet "$scratch/venv/bin/pip" install -q --no-index --find-links "$out" --find-links "$hf_work/wheels" --disable-pip-version-check hf-fields
  [ "$("${hf_clean_env[@]}" "$scratch/venv/bin/python" -c 'import hf; print(hf.__file__)')" = "$(ls "$scratch"/venv/lib/python3*/site-packages/hf/__init__.py)" ] ||
    hf_fail "another hf is imported"
  (cd "$scratch" && "${hf_clean_env[@]}" "$scratch/venv/bin/python" "$hf_tests/golden.py" "$filled" "$hf_golden/bad_input.json") >"$scratch/golden.log" 2>&1 || {
    tail -20 "$scratch/golden.log" >&2
    hf_fail "golden scenes of the wheel"
  }
  hf_quiet env -u PYTHONPATH "$scratch/venv/bin/pip" check --disable-pip-version-check
  hf_ran "pip into an empty environment of Python $("$scratch/venv/bin/python" -c 'import sys; print("%d.%d" % sys.version_info[:2])'): golden scenes and bad calls; pip picks each by platform; $(printf '%s; ' "${found[@]}")Windows and arm64 by their library alone"
}

case "$1" in
  make) wheel_make "$2" ;;
  try) wheel_try "$2" "$3" ;;
esac
