#!/usr/bin/env bash
# hf-VERSION.crate: the crate as cargo packages it, tried in a project of its own, without a network, on the library of the
# archive for Linux.
. "$(dirname "$0")/common.sh"
command -v cargo >/dev/null || hf_skip "no cargo here (Rust 1.70 or newer)"
export CARGO_NET_OFFLINE=true

case "$1" in
  make)
    folder=$(mktemp -d) || exit 1
    cp -r "$hf_root/bindings/rust" "$folder/hf"
    # the golden scenes are the project's, not the crate's; without git the crate does not name a commit
    sed -i '/^\[\[test\]\]/,/^path/d' "$folder/hf/Cargo.toml"
    (cd "$folder/hf" && CARGO_TARGET_DIR="$folder/target" HF_LIBRARY_DIR="$hf_work/linux-x64/tree/lib" hf_quiet cargo package --no-verify --allow-dirty --quiet) || exit 1
    cp "$folder/target/package/hf-$hf_version.crate" "$2/" || exit 1
    rm -rf "$folder"
    ;;
  try)
    scratch=$3
    filled=$(hf_filled) || exit 1
    tar xzf "$2/hf-$hf_version.crate" -C "$scratch"
    mkdir -p "$scratch/app/src"
    cp -r "$hf_golden" "$scratch/golden"  # where the scenes look for meshes
    printf '[package]\nname = "app"\nversion = "0.0.0"\nedition = "2021"\n[dependencies]\nhf = { path = "../hf-%s" }\n[[test]]\nname = "golden"\npath = "%s/golden.rs"\n' \
      "$hf_version" "$hf_tests" >"$scratch/app/Cargo.toml"
    printf 'fn main() { println!("{:?}", hf::Surface::new(&[0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0][..], &[0u32, 1, 2][..], &Default::default()).is_ok()); }\n' >"$scratch/app/src/main.rs"
    export HF_LIBRARY_DIR="$hf_work/linux-x64/tree/lib" HF_SCENES="$filled" CARGO_TARGET_DIR="$scratch/target"
    export LD_LIBRARY_PATH="$HF_LIBRARY_DIR" CARGO_BUILD_JOBS=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
    said=$(cd "$scratch/app" && cargo test --quiet --test golden 2>&1) || {
      printf '%s\n' "$said" | tail -20 >&2
      hf_fail "golden scenes of the crate"
    }
    hf_ran "cargo test in a project of its own, offline: golden scenes and bad calls"
    ;;
esac
