#!/bin/sh
# Succeeds where the library for 32-bit programs can be built: there are Rust's target, and a C compiler with libraries of 32 bits.
#
# usage: has-32.sh TARGET
rustup target list --installed 2>/dev/null | grep -qx "$1" || exit 1
printf 'int main(void) { return 0; }' | gcc -m32 -x c - -o /dev/null 2>/dev/null
