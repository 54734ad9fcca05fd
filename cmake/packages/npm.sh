#!/usr/bin/env bash
# The npm packages: hf-fields with the WebAssembly inside, one with the native library for each platform, which npm
# picks by system and processor (optionalDependencies), and hf-studio. HF_WASM_DIR: a folder that holds hf.mjs, hf.wasm and
# those of the small build already. HF_STUDIO_DIR: a folder that samples/studio/run --build wrote already.
. "$(dirname "$0")/common.sh"
js="$hf_root/bindings/js"

npm_platform() { # what npm calls it: system, processor
  case "$1" in
    linux-x64) printf 'linux x64' ;;
    linux-arm64) printf 'linux arm64' ;;
    windows-x64) printf 'win32 x64' ;;
  esac
}

npm_wasm() {
  local folder=${HF_WASM_DIR:-$hf_work/wasm}
  if [ -z "${HF_WASM_DIR:-}" ]; then
    command -v emcmake >/dev/null || hf_skip "no emscripten here (Debian: emscripten)"
    HF_JOBS=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)} "$js/wasm/build.sh" "$folder" >"$hf_work/wasm.log" 2>&1 || { tail -5 "$hf_work/wasm.log" >&2; hf_fail "WebAssembly"; }
  fi
  [ -s "$folder/hf.wasm" ] && [ -s "$folder/hf_slim.wasm" ] || hf_fail "no hf.wasm and hf_slim.wasm in $folder"
  printf '%s' "$folder"
}

npm_studio() { # the page, of the WebAssembly in a folder
  if [ -n "${HF_STUDIO_DIR:-}" ]; then
    printf '%s' "$HF_STUDIO_DIR"
    return
  fi
  HF_WASM=$1 "$hf_root/samples/studio/run" --yes --build "$hf_work/studio" >"$hf_work/studio.log" 2>&1 || { tail -5 "$hf_work/studio.log" >&2; hf_fail "the studio"; }
  printf '%s' "$hf_work/studio"
}

npm_make() {
  local out=$1 folder wasm studio package platform system processor optional=()
  command -v npm >/dev/null || hf_skip "no npm here"
  wasm=$(npm_wasm) || exit $?
  studio=$(npm_studio "$wasm") || exit $?
  folder=$(mktemp -d) || exit 1
  for platform in $(hf_platforms); do
    read -r system processor < <(npm_platform "$platform")
    mkdir -p "$folder/$platform"
    cp "$(hf_library "$platform")" "$folder/$platform/$(hf_library_name "$platform")"
    chmod 644 "$folder/$platform"/*hf*
    hf_licences "$folder/$platform/licences" "$platform"
    hf_bom "$folder/$platform/bom.cdx.json" "$platform" "$folder/$platform"
    python3 - "$js/package.json" "$folder/$platform" "$system" "$processor" <<'PY'
import json, sys
project = json.load(open(sys.argv[1]))
system, processor = sys.argv[3:]
package = {"name": f"hf-fields-{system}-{processor}", "version": project["version"], **{key: project[key] for key in ("license", "keywords", "homepage", "repository")},
           "description": f"The native library of hf-fields for {system} on {processor}.", "os": [system], "cpu": [processor],
           **({"libc": ["glibc"]} if system == "linux" else {}), "files": ["*"], "preferUnplugged": True}
json.dump(package, open(sys.argv[2] + "/package.json", "w"), indent=2)
open(sys.argv[2] + "/README.md", "w").write(f"# {package['name']}\n\n{package['description']} npm installs it with hf-fields.\n")
PY
    hf_pack tar "$out/hf-fields-$system-$processor-$hf_version.tgz" "$folder/$platform" package
    optional+=("hf-fields-$system-$processor")
  done
  mkdir -p "$folder/main/dist" "$folder/studio"
  cp -r "$js/src" "$js/README.md" "$folder/main/"
  cp "$wasm"/hf{,_slim}.{mjs,wasm} "$folder/main/dist/"
  cp -r "$js/studio/bin" "$js/studio/README.md" "$folder/studio/"
  cp -r "$studio" "$folder/studio/page"
  chmod 755 "$folder"/studio/bin/*
  for package in main studio; do
    hf_licences "$folder/$package/licences" wasm
    hf_bom "$folder/$package/bom.cdx.json" wasm "$folder/$package"
  done
  python3 - "$js" "$folder" "${optional[@]}" <<'PY'
import json, sys
js, out, *optional = sys.argv[1:]
for manifest, folder, libraries in (("package.json", "main", optional), ("studio/package.json", "studio", [])):
    project = json.load(open(f"{js}/{manifest}"))
    if libraries:
        project["optionalDependencies"] |= {name: project["version"] for name in libraries}
    project["files"] += ["licences", "bom.cdx.json"]
    json.dump(project, open(f"{out}/{folder}/package.json", "w"), indent=2)
PY
  hf_pack tar "$out/hf-fields-$hf_version.tgz" "$folder/main" package
  hf_pack tar "$out/hf-studio-$hf_version.tgz" "$folder/studio" package
  rm -rf "$folder"
}

npm_try() {
  local out=$1 scratch=$2 filled said=() specifier installed platform served link file
  for platform in $(hf_platforms); do
    mkdir -p "$scratch/$platform"
    tar xzf "$out/hf-fields-$(npm_platform "$platform" | tr ' ' -)-$hf_version.tgz" -C "$scratch/$platform"
    hf_same_library "$platform" "$scratch/$platform/package/$(hf_library_name "$platform")"
  done
  filled=$(hf_filled) || exit 1
  # koffi as the tests' lock file installs it, our packages from their files: nothing is downloaded
  hf_install_node_modules || hf_skip "npm could not install koffi"
  python3 - "$out" "$scratch/package.json" "$hf_root/build/npm/node_modules/koffi" <<'PY'
import glob, json, os, re, sys
files = {re.match(r"(.*)-\d+\.\d+\.\d+\.tgz", os.path.basename(f)).group(1): "file:" + f for f in glob.glob(sys.argv[1] + "/*.tgz")}
koffi = "file:" + os.path.realpath(sys.argv[3])
ours = {name: files.pop(name) for name in ("hf-fields", "hf-studio")}
json.dump({"private": True, "dependencies": {**ours, "koffi": koffi}, "overrides": files}, open(sys.argv[2], "w"))
PY
  (cd "$scratch" && npm install --offline --ignore-scripts --no-audit --no-fund --cache "$hf_work/npm_cache") >"$scratch/npm.log" 2>&1 || {
    tail -5 "$scratch/npm.log" >&2
    hf_skip "npm could not install them with koffi"
  }
  installed=$(cd "$scratch/node_modules" && ls -d hf-fields-* | paste -sd' ')
  [ "$installed" = hf-fields-linux-x64 ] || hf_fail "npm installed the libraries of: $installed"
  # the page as npx hf-studio serves it
  (cd "$scratch" && exec "${hf_clean_env[@]}" "$(command -v node)" node_modules/.bin/hf-studio) >"$scratch/studio.log" 2>&1 &
  served=$!
  for _ in $(seq 50); do
    grep -q http "$scratch/studio.log" && break
    sleep 0.1
  done
  link=$(grep -o 'http[^ ]*' "$scratch/studio.log")
  for file in '' hf.wasm rest.wasm samples/horse.glb; do
    [ "$("${hf_clean_env[@]}" "$(command -v node)" -e 'fetch(process.argv[1]).then((answer) => console.log(answer.status))' "$link$file")" = 200 ] || said+=("$file")
  done
  kill "$served"
  [ "${#said[@]}" = 0 ] || hf_fail "hf-studio does not serve: ${said[*]}"
  cp "$hf_tests/golden_package.mjs" "$hf_tests/golden.mjs" "$scratch/"
  for specifier in hf-fields hf-fields/wasm; do
    said+=("$(cd "$scratch" && "${hf_clean_env[@]}" "$(command -v node)" --expose-gc golden_package.mjs "$specifier" "$hf_golden/meshes" "$filled" "$hf_golden/bad_input.json" 2>"$scratch/error.log" | tail -1)")
    [ "${PIPESTATUS[0]}" = 0 ] && [ ! -s "$scratch/error.log" ] || { head -10 "$scratch/error.log" >&2; hf_fail "golden scenes of $specifier: ${said[*]}"; }
    case "${said[-1]}" in *scenes*calls) ;; *) hf_fail "golden scenes of $specifier" ;; esac
  done
  hf_ran "npm into an empty folder picks $installed of $(ls "$out"/hf-fields-*-*-*.tgz | wc -l); node: ${said[0]}; ${said[1]}; hf-studio serves the page"
}

case "$1" in
  make) npm_make "$2" ;;
  try) npm_try "$2" "$3" ;;
esac
