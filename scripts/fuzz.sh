#!/bin/sh
# Runs each target of fuzz/ for some seconds: fuzz.sh SECONDS FOLDER. What they find is in FOLDER/TARGET-*; their corpora stay in FOLDER for the next run.
set -eu
seconds=$1
folder=$2

cargo fuzz --version >/dev/null 2>&1 ||
	{ echo "cargo-fuzz is missing: run cargo install cargo-fuzz, then make fuzz again" >&2; exit 1; }
rustc +nightly --version >/dev/null 2>&1 ||
	{ echo "Rust's nightly toolchain is missing: run rustup toolchain install nightly --profile minimal, then make fuzz again" >&2; exit 1; }

failed=
for file in fuzz/targets/*.rs; do
	target=$(basename "$file" .rs)
	seeds=fuzz/seeds/$target
	case $target in
	glsl) seeds=src/rewrite/tests/shaders ;;
	profile) seeds=profiles ;;
	esac
	mkdir -p "$folder/$target"
	echo "$target, $seconds s"
	# No sanitizer of addresses: the code that is tested has no unsafe block. A corpus that is found goes to the first folder.
	cargo +nightly fuzz run -s none "$target" "$folder/$target" "$seeds" -- -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
		-artifact_prefix="$folder/$target-" >"$folder/$target.log" 2>&1 || failed="$failed $target"
	grep -E '^(Done|SUMMARY)' "$folder/$target.log" || tail -n 3 "$folder/$target.log"
done
[ -z "$failed" ] || { echo "failed:$failed; the inputs are in $folder" >&2; exit 1; }
