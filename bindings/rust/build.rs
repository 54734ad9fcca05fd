//! Finds the hf library: the folder HF_LIBRARY_DIR, or pkg-config, or the linker's own path.
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=HF_LIBRARY_DIR");
    let kind = if cfg!(feature = "static") { "static" } else { "dylib" };
    let folder = std::env::var("HF_LIBRARY_DIR").unwrap_or_else(|_| {
        let found = Command::new("pkg-config").args(["--variable=libdir", "hf"]).output();
        found.map_or(String::new(), |found| String::from_utf8_lossy(&found.stdout).trim().to_string())
    });
    if folder.is_empty() {
        println!("cargo:warning=hf: set HF_LIBRARY_DIR to the folder of libhf, or install hf for pkg-config");
    } else {
        println!("cargo:rustc-link-search=native={folder}");
    }
    println!("cargo:rustc-link-lib={kind}=hf");
    if kind == "static" {
        let apple = std::env::var("CARGO_CFG_TARGET_VENDOR").is_ok_and(|v| v == "apple");
        println!("cargo:rustc-link-lib=dylib={}", if apple { "c++" } else { "stdc++" });
    }
}
