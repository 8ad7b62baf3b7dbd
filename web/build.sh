#!/usr/bin/env bash
# Builds the module and the page into `dist/`. Needs of Debian `rustc-web`, `rust-web-src`, `lld` and `wasi-libc`, and npm.
set -euo pipefail
cd "$(dirname "$0")"
wasi=/usr/lib/wasm32-wasi
export RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
export CARGO_TARGET_WASM32_WASIP1_LINKER=wasm-ld
export CARGO_TARGET_WASM32_WASIP1_RUSTFLAGS="-C link-self-contained=no -L $wasi -C link-arg=$wasi/crt1-command.o -C link-arg=-lc"
cargo build --quiet --locked -Zbuild-std=std,panic_abort --target wasm32-wasip1 --release
npm ci --silent --no-audit --no-fund
npx tsc
node build.mjs
