#!/bin/sh
# Runs tests with a library that a sanitizer watches: sanitize.sh address|thread FOLDER TEST... What it finds is in FOLDER/report.*
set -eu
kind=$1
folder=$2
shift 2
target=$(rustc -vV | sed -n 's/^host: //p')

fail() {
	echo "$1, then make sanitize again" >&2
	exit 1
}

rustc +nightly --version >/dev/null 2>&1 || fail "Rust's nightly toolchain is missing: run rustup toolchain install nightly --profile minimal"
# What programs leak is their own affair. Libraries that are opened with bindings of their own (RTLD_DEEPBIND) cannot be watched.
options="log_path=$folder/report:exitcode=66:handle_segv=0"
case $kind in
	address)
		name=libasan.so
		variable=ASAN_OPTIONS
		options=$options:detect_leaks=0
		standard=
		start=
		# What is watched needs more stack.
		skipped="bound_to_its_own_libraries --skip a_small_stack"
		;;
	thread)
		name=libtsan.so
		variable=TSAN_OPTIONS
		# The driver and the program are not watched: how they keep their threads apart is not seen.
		options=$options:ignore_noninstrumented_modules=1:report_thread_leaks=0:report_signal_unsafe=0
		# Locks and counts of Rust's own library have to be seen.
		standard=-Zbuild-std
		test -f "$(rustc +nightly --print sysroot)/lib/rustlib/src/rust/library/Cargo.lock" ||
			fail "The sources of Rust's library are missing: run rustup component add rust-src --toolchain nightly"
		# The runtime of older compilers takes addresses as they are without randomisation.
		start="setarch -R"
		# The runtime puts signals off, also one that the layer has blocked, and takes a thread that is cancelled in a call for its own fault.
		skipped="bound_to_its_own_libraries --skip has_reached_its_limit --skip may_exceed_the_limit --skip is_cancelled_in_a_call"
		;;
	*) fail "$kind is no sanitizer: name address or thread" ;;
esac
runtime=$(gcc -print-file-name=$name)
test -f "$runtime" || fail "$name is missing: install the package of gcc that has it"

mkdir -p "$folder"
rm -f "$folder"/report.*
# The flags are those of the library alone, as there is a --target.
CARGO_TARGET_DIR=$folder/build RUSTFLAGS="-Zsanitizer=$kind -Cforce-frame-pointers=yes" \
	cargo +nightly build --release $standard --target "$target" -p manyview-shim
gcc -shared -fPIC -O1 -w -o "$folder/early.so" tests/support/c/early.c -ldl
# The tests are those that `make test` has built.
failed=0
for test in "$@"; do
	watched=$options
	# Mesa 22.3 reads the vertices that a list continues beyond their end, and memory that it has never written, also without the layer. So
	# random calls run without a watch on memcpy, and memory is not filled.
	test "$kind$test" != addressrandom || watched=$options:replace_intrin=0:max_malloc_fill_size=0
	MANYVIEW_TESTS_LIBRARY=$folder/build/$target/release/libmanyview.so MANYVIEW_TESTS_RUNTIME=$runtime:$folder/early.so \
		$start env "$variable=$watched" cargo test --release --workspace --exclude manyview-viewer --features manyview-shim/fake-driver --no-fail-fast --test all -- \
		"$test::" --skip full_ --skip $skipped || failed=1
done
for report in "$folder"/report.*; do
	test -f "$report" || continue
	echo "$report:" >&2
	grep -m 3 -E '^(SUMMARY|WARNING|==.*ERROR)' "$report" >&2 || head -n 3 "$report" >&2
	failed=1
done
exit $failed
