#!/bin/sh
# Builds the command, the library, the probe and the viewer so that they need no newer C library than GLIBC: release.sh GLIBC FOLDER. zig has the symbols of each
# version of the C library; with those of this machine alone, older systems could not load what it builds.
set -eu
glibc=$1
folder=$2
target=$(rustc -vV | sed -n 's/^host: //p')

command -v cargo-zigbuild >/dev/null && { command -v zig || python3 -c 'import ziglang'; } >/dev/null 2>&1 ||
	{ echo "cargo-zigbuild or zig is missing: run cargo install cargo-zigbuild and pip install ziglang, then make release again" >&2; exit 1; }

# Three calls, as in `make build`.
export CARGO_TARGET_DIR="$folder/build"
cargo zigbuild --release --target "$target.$glibc" -p manyview
cargo zigbuild --release --target "$target.$glibc" -p manyview-shim
cargo zigbuild --release --target "$target.$glibc" -p manyview-viewer
for name in manyview libmanyview.so manyview-probe manyview-points; do
	cp "$CARGO_TARGET_DIR/$target/release/$name" "$folder/$name"
done
