#!/bin/sh
# Compares the pictures of two builds of manyview, byte by byte: all views of programs and of traces, by each strategy.
# Usage: same.sh OTHER_BIN BIN OUT PROGRAM|TRACE…; a trace ends with .trace. Frames of a program: FRAMES (default 1..4); of a trace: TRACE_FRAMES (40..42).
# Status 1 if a picture differs, or only one build makes it.
set -eu
other=$1 bin=$2 out=$3
shift 3
rm -rf "$out"
mkdir -p "$out"

# take BIN FOLDER STRATEGY LAYOUT FRAMES COMMAND…
take() {
	build=$1 folder=$2 strategy=$3 layout=$4 frames=$5
	shift 5
	mkdir -p "$folder"
	env -u DISPLAY "$build/manyview" capture --views 5 --strategy "$strategy" --atlas "$layout" --what atlas --frames "$frames" --timeout 300 \
		--out "$folder/%d.png" -- "$@" >"$folder.log" 2>&1 || echo "$folder: status $?" >>"$out/failed.txt"
}

pictures=0 differ=0
for program in "$@"; do
	name=$(printf '%s' "$program" | tr -c 'A-Za-z0-9.-' '_')
	case $program in
	*.trace) frames=${TRACE_FRAMES:-40..42} command="glretrace $program" ;;
	*) frames=${FRAMES:-1..4} command=$program ;;
	esac
	for way in replay:side-by-side replay:layers instanced:layers geometry:layers depth-image:side-by-side occlusion:side-by-side hybrid:side-by-side; do
		strategy=${way%:*} layout=${way#*:}
		# Unquoted: a program may have arguments.
		take "$other" "$out/$name/$strategy-$layout/other" "$strategy" "$layout" "$frames" $command
		take "$bin" "$out/$name/$strategy-$layout/this" "$strategy" "$layout" "$frames" $command
		for picture in "$out/$name/$strategy-$layout/other"/*.png "$out/$name/$strategy-$layout/this"/*.png; do
			[ -e "$picture" ] || continue
			file=${picture##*/}
			case $picture in */this/*) [ ! -e "$out/$name/$strategy-$layout/other/$file" ] || continue ;; esac
			pictures=$((pictures + 1))
			cmp -s "$out/$name/$strategy-$layout/other/$file" "$out/$name/$strategy-$layout/this/$file" || {
				differ=$((differ + 1))
				echo "differs: $out/$name/$strategy-$layout/*/$file"
			}
		done
	done
	echo "$program: $pictures pictures so far, $differ differ" >&2
done
[ ! -e "$out/failed.txt" ] || sort "$out/failed.txt"
echo "$pictures pictures, $differ differ"
[ "$differ" -eq 0 ] && [ "$pictures" -gt 0 ]
