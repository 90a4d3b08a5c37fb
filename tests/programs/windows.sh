#!/bin/sh
# Runs a program of examples/windows under Wine, with a prefix of its own:
#
#   windows.sh CLASS PROGRAM [ARGUMENT...]
set -eu
class=$1 program=$2
shift 2
out=$PWD/target/windows
[ -x "$out/$class/$program.exe" ] || make -C examples/windows OUT="$out" >&2
mkdir -p target/programs/wine
export WINEPREFIX="$PWD/target/programs/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree=;mshtml='
exec wine "$out/$class/$program.exe" "$@"
