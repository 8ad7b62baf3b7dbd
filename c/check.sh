#!/usr/bin/env bash
# What has to hold of the C library: needs Rust with clippy and rustfmt, gcc, g++ and, once, to build cbindgen, the network.
# `--write` makes what is generated instead of comparing it.
set -euo pipefail
cd "$(dirname "$0")"
target=${CARGO_TARGET_DIR:-$PWD/target}
export CARGO_TARGET_DIR=$target
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
say() { printf '%s\n' "$*"; }
fail() { say "$*" >&2; exit 1; }

cbindgen=${CBINDGEN:-$target/cbindgen/bin/cbindgen}
[ -x "$cbindgen" ] || cargo install --quiet --locked --root "$target/cbindgen" cbindgen --version 0.29.4

# Single precision is double precision in other words, and the header is made from both.
sed -e 's/f64/f32/g; s/F64/F32/g' \
    -e 's/double precision. `f32.rs` is made from this file by `check.sh`./single precision: made from `f64.rs` by `check.sh`./' \
    src/f64.rs > "$made/f32.rs"
if [ "${1:-}" = --write ]; then
    cp "$made/f32.rs" src/f32.rs
    "$cbindgen" --quiet --config cbindgen.toml --output include/selfosc.h .
fi
cmp "$made/f32.rs" src/f32.rs || fail 'src/f32.rs is not what src/f64.rs makes: run check.sh --write'
"$cbindgen" --quiet --config cbindgen.toml --verify --output include/selfosc.h . ||
    fail 'include/selfosc.h is out of date: run check.sh --write'

cargo fmt --check
cargo clippy --quiet --release -- -D warnings
cargo build --quiet --release
archive=$target/release/libselfosc.a

# No way to a panic is linked; and where one is, this looks at the right thing.
panics() { nm -C "$1" 2>/dev/null | grep -c -e 'core::panicking' -e selfosc_would_panic || true; }
[ "$(panics "$archive")" = 0 ] || fail "$(nm -C "$archive" 2>/dev/null | grep -e panicking -e would_panic)"
cargo build --quiet --release --features panics --target-dir "$target/panics"
[ "$(panics "$target/panics/release/libselfosc.a")" != 0 ] || fail 'a panic is not seen'

strict=(-Wall -Wextra -pedantic -Werror -Iinclude)
checked=(-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all)
for source in examples/experiment.c examples/task.c examples/heater.c tests/contract.c; do
    say "== $source"
    gcc -std=c99 "${strict[@]}" "${checked[@]}" "$source" "$archive" -lm -o "$made/program"
    "$made/program"
done
say '== tests/header.cpp'
g++ -std=c++11 "${strict[@]}" "${checked[@]}" tests/header.cpp "$archive" -o "$made/program"
"$made/program"
say '== tests/extremes.c'
for precision in f64 f32; do
    words=()
    [ "$precision" = f64 ] || words=(-e 's/f64/f32/g' -e 's/double/float/g' -e 's/DBL_/FLT_/g')
    sed -e '' "${words[@]}" tests/extremes.c > "$made/extremes.c"
    gcc -std=c99 "${strict[@]}" "${checked[@]}" -c "$made/extremes.c" -o "$made/extremes.o"
    functions=$(grep -o -e "selfosc_[a-z_]*_$precision(" -e 'selfosc_parameter(' include/selfosc.h | tr -d '(' | sort -u)
    [ "$(wc -l <<< "$functions")" -ge 20 ] || fail "functions of the header: $functions"
    for function in $functions; do
        nm -u "$made/extremes.o" | grep -q " $function\$" || fail "tests/extremes.c does not call $function"
    done
    gcc "${checked[@]}" "$made/extremes.o" "$archive" -lm -o "$made/program"
    "$made/program"
done
# The measurement is built everywhere and run by hand: it takes minutes.
gcc -std=gnu99 "${strict[@]}" -O2 measure/measure.c "$archive" -lm -o "$target/measure"
gcc -std=c99 "${strict[@]}" -O2 -s -Wl,--gc-sections examples/task.c "$archive" -lm -o "$made/program"
say "examples/task.c, f32: $(size "$made/program" | awk 'NR == 2 { print $1 " bytes of code, " $2 + $3 " of data" }')"
