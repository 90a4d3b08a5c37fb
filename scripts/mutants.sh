#!/bin/sh
# Mutation testing of the path of a draw: draws COUNT mutants by SEED, and runs the unit tests against each. Results are in OUT.
# Usage: mutants.sh SEED COUNT OUT
set -eu
seed=$1 count=$2 out=$3
command -v cargo-mutants >/dev/null 2>&1 ||
	{ echo "cargo-mutants is missing: run cargo install cargo-mutants --locked, then try again" >&2; exit 1; }
files="-f src/plan/**/*.rs -f src/layer/draw/**/*.rs -f src/draw/**/*.rs -e **/tests/** -e **/tests.rs"
mkdir -p "$out"
set -f
cargo mutants --list -p manyview $files >"$out/all.txt"
# In the order of a hash of seed and name: the same draw on every machine.
while IFS= read -r name; do
	printf '%s %s\n' "$(printf '%s %s' "$seed" "$name" | sha256sum | cut -d' ' -f1)" "$name"
done <"$out/all.txt" | sort | head -n "$count" | cut -d' ' -f2- >"$out/drawn.txt"
{
	echo 'examine_re = ['
	sed -e 's/[][\.*^$+?(){}|&~#-]/\\&/g' -e "s/.*/  '''^&\$''',/" "$out/drawn.txt"
	echo ']'
} >"$out/mutants.toml"
echo "$(wc -l <"$out/drawn.txt") of $(wc -l <"$out/all.txt") mutants"
# Tests of parts that no mutant is in, and that take long, are left out.
skipped="--skip state::neutral --skip rewrite:: --skip interleave:: --skip synthesis:: --skip display:: --skip metric:: --skip config:: --skip fixed:: --skip control::"
PROPTEST_CASES=${PROPTEST_CASES:-32} cargo mutants -p manyview $files --config "$out/mutants.toml" --no-default-features --profile mutants \
	--cargo-arg=--lib --baseline=skip --timeout 150 --shuffle -o "$out" -- -- $skipped
