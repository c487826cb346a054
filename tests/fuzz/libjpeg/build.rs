//! Compiles the few lines of C that libjpeg's way of reporting errors needs.

fn main() {
    println!("cargo::rerun-if-changed=src/decode.c");
    cc::Build::new().file("src/decode.c").compile("fovqa_fuzz_libjpeg");
    println!("cargo::rustc-link-lib=jpeg");
}
