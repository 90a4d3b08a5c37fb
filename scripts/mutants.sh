#!/bin/sh
# Mutation testing of the path of a draw by the unit tests. Usage: mutants.sh PART/PARTS OUT, such as 6/10: every tenth mutant, from number 6 on.
# Results are in OUT/mutants.out.
set -eu
command -v cargo-mutants >/dev/null 2>&1 ||
	{ echo "cargo-mutants is missing: run cargo install cargo-mutants --locked, then try again" >&2; exit 1; }
mkdir -p "$2"
# Tests of parts that no mutant is in, and that take long, are left out.
skipped="--skip state::neutral --skip rewrite:: --skip interleave:: --skip synthesis:: --skip display:: --skip metric:: --skip config:: --skip fixed:: --skip control::"
PROPTEST_CASES=${PROPTEST_CASES:-24} cargo mutants -p manyview \
	-f 'src/plan/decide/*.rs' -f src/plan/class.rs -f src/plan/parallax.rs -f 'src/layer/draw/*.rs' -f 'src/draw/*.rs' -e '**/tests.rs' \
	--shard "$1" --sharding round-robin --shuffle --no-default-features --profile mutants --cargo-arg=--lib --baseline=skip --timeout 150 \
	-o "$2" -- -- $skipped
