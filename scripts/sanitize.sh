#!/bin/sh
# Runs tests with a library that the sanitizer of addresses watches: sanitize.sh FOLDER TEST... What it finds is in FOLDER/report.*
set -eu
folder=$1
shift
target=$(rustc -vV | sed -n 's/^host: //p')

rustc +nightly --version >/dev/null 2>&1 ||
	{ echo "Rust's nightly toolchain is missing: run rustup toolchain install nightly --profile minimal, then make sanitize again" >&2; exit 1; }
runtime=$(gcc -print-file-name=libasan.so)
test -f "$runtime" || { echo "libasan.so is missing: install the package of gcc that has it, then run make sanitize again" >&2; exit 1; }

mkdir -p "$folder"
rm -f "$folder"/report.*
# The flags are those of the library alone, as there is a --target.
CARGO_TARGET_DIR=$folder/build RUSTFLAGS="-Zsanitizer=address -Cforce-frame-pointers=yes" \
	cargo +nightly build --release --target "$target" -p manyview-shim
gcc -shared -fPIC -O1 -w -o "$folder/early.so" tests/support/c/early.c -ldl
# What programs leak is their own affair. Libraries that are opened with bindings of their own (RTLD_DEEPBIND) cannot be watched. The tests are
# those that `make test` has built.
options="log_path=$folder/report:exitcode=66:detect_leaks=0:handle_segv=0"
failed=0
for test in "$@"; do
	watched=$options
	# Mesa 22.3 reads the vertices that a list continues beyond their end, and memory that it has never written, also without the layer. So
	# random calls run without a watch on memcpy, and memory is not filled.
	test "$test" != random || watched=$options:replace_intrin=0:max_malloc_fill_size=0
	MANYVIEW_TESTS_LIBRARY=$folder/build/$target/release/libmanyview.so MANYVIEW_TESTS_RUNTIME=$runtime:$folder/early.so ASAN_OPTIONS=$watched \
		cargo test --release --workspace --features manyview-shim/fake-driver --no-fail-fast --test "$test" -- \
		--skip full_ --skip bound_to_its_own_libraries || failed=1
done
for report in "$folder"/report.*; do
	test -f "$report" || continue
	echo "$report:" >&2
	grep -m 3 -E '^(SUMMARY|==.*ERROR)' "$report" >&2 || head -n 3 "$report" >&2
	failed=1
done
exit $failed
