#!/bin/sh
# The cost of the layer where it does nothing: frame times with it switched off (MANYVIEW_DISABLE=1) and with one view, over those of
# the bare program. `make overhead` calls it.
#
#   scripts/overhead.sh BIN WORK DEMOS
#
# BIN has the command and the library, WORK is a folder for its files, DEMOS has the demo programs. Variables: ROUNDS (5) is how
# often each program is run, in turns; KIB (100, some 280 frames) is the part of OpenArena's recording that is
# played. Without the game only the others are measured.
set -eu

bin=$1
work=$2
demos=$3
rounds=${ROUNDS:-5} kib=${KIB:-100}
pak=/usr/share/games/openarena/baseoa/pak6-patch088.pk3

say() { echo "overhead: $*" >&2; }

mkdir -p "$work/home/.openarena/baseoa/demos"
. "$(dirname "$0")/screen.sh"
HOME=$work/home
export DISPLAY HOME SDL_AUDIODRIVER=dummy LIBGL_ALWAYS_SOFTWARE=1 vblank_mode=0

# frame PROGRAM COMMAND...: milliseconds per frame of PROGRAM, which COMMAND starts.
frame() {
    program=$1
    shift
    case $program in
    glxgears)
        # glxgears prints its rate every 5 seconds, and flushes it only to a terminal or from a full buffer.
        timeout 6 "$@" stdbuf -oL glxgears 2>/dev/null | awk '/frames in/ { print 1000 * $4 / $1; exit }'
        ;;
    draws-3000)
        "$@" "$demos/arrays" --many 3000 --frames 150 --time 2>&1 | awk '/ms_per_frame/ { print $3 }'
        ;;
    openarena)
        "$@" /usr/games/openarena +set r_fullscreen 0 +set r_mode 3 +set s_initsound 0 +set com_hunkmegs 256 \
            +set cl_renderer opengl1 +set r_swapInterval 0 +set timedemo 1 +set nextdemo quit +demo played 2>&1 |
            awk '/frames .* seconds .* fps/ { print 1000 * $3 / $1 }'
        ;;
    esac
}

programs="glxgears draws-3000"
if [ -f "$pak" ]; then
    unzip -p "$pak" demos/demo088-test1.dm_71 | head -c "$kib"k >"$work/home/.openarena/baseoa/demos/played.dm_71"
    programs="$programs openarena"
else
    say "OpenArena is not installed (make openarena installs it)"
fi
: >"$work/figures"
round=1
while [ "$round" -le "$rounds" ]; do
    for program in $programs; do
        say "round $round of $rounds, $program"
        bare=$(frame "$program" env)
        off=$(frame "$program" env MANYVIEW_DISABLE=1 LD_PRELOAD="$bin/libmanyview.so")
        one=$(frame "$program" "$bin/manyview" run --views 1 --)
        [ -n "$bare" ] && [ -n "$off" ] && [ -n "$one" ] || { say "$program told no time"; exit 1; }
        echo "$program $bare $off $one" >>"$work/figures"
    done
    round=$((round + 1))
done

echo "| program | bare, ms | switched off, over bare | one view, over bare |"
echo "|---|---|---|---|"
for program in $programs; do
    grep "^$program " "$work/figures" | awk -v name="$program" '
        function middle(values, n,    i, j, t) {
            for (i = 2; i <= n; i++)
                for (j = i; j > 1 && values[j] < values[j - 1]; j--) { t = values[j]; values[j] = values[j - 1]; values[j - 1] = t }
            return n % 2 ? values[(n + 1) / 2] : (values[n / 2] + values[n / 2 + 1]) / 2
        }
        { bare[NR] = $2; off[NR] = $3 / $2; one[NR] = $4 / $2 }
        END {
            ms = middle(bare, NR); o = middle(off, NR); v = middle(one, NR)
            printf "| %s | %.2f | %.3f (%.3f to %.3f) | %.3f (%.3f to %.3f) |\n", name, ms, o, off[1], off[NR], v, one[1], one[NR]
        }'
done
