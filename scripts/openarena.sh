#!/bin/sh
# OpenArena's timedemo without the layer and under it, beside the figures of Luo et al. for Quake III. `make openarena` calls it.
#
#   scripts/openarena.sh BIN WORK            the table, on stdout and in WORK/openarena.txt
#   scripts/openarena.sh BIN WORK pictures   those of the documents, in WORK
#   scripts/openarena.sh BIN WORK walk       its first frames as a trace, held at FPS (7) by `hybrid`, and all strategies side by side
#
# BIN has the command and the library, WORK is a folder for its files. Variables: ROUNDS (2) is how often each row is played,
# in turns; KIB (140, some 400 frames) is the part of the recording that is played, 0 for all of it (3388 frames); MODE (3, 640x480) is the
# engine's number for the size of the window. The home folder of the engine is in WORK; the user's own is not touched.
set -eu

bin=$(cd "$1" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
what=${3:-table}
rounds=${ROUNDS:-2} kib=${KIB:-140} mode=${MODE:-3}
pak=/usr/share/games/openarena/baseoa/pak6-patch088.pk3
demo=demo088-test1

say() { echo "openarena: $*" >&2; }

mkdir -p "$work/home/.openarena/baseoa/demos"
played=$work/home/.openarena/baseoa/demos/played.dm_71
unzip -p "$pak" "demos/$demo.dm_71" >"$work/whole.dm_71"

# The engine ends the demo at the end of the file.
cut_to() {
    if [ "$1" -eq 0 ]; then cp "$work/whole.dm_71" "$played"; else head -c "$1"k "$work/whole.dm_71" >"$played"; fi
}

. "$(dirname "$0")/screen.sh"
HOME=$work/home
export DISPLAY HOME SDL_AUDIODRIVER=dummy LIBGL_ALWAYS_SOFTWARE=1

# play COMMAND...: the program, behind a command that starts it.
play() {
    "$@" /usr/games/openarena +set r_fullscreen 0 +set r_mode "$mode" +set s_initsound 0 +set com_hunkmegs 256 \
        +set cl_renderer opengl1 +set r_swapInterval 0 +set timedemo 1 +set nextdemo quit +demo played
}

# Sets `spent` to the seconds of processor time of all runs so far; `times` counts only children of its own shell.
clock() {
    times >"$work/times"
    spent=$(awk 'NR == 2 { split($1, u, "[ms]"); split($2, s, "[ms]"); print 60 * (u[1] + s[1]) + u[2] + s[2] }' "$work/times")
}

if [ "$what" = pictures ]; then
    cut_to 0
    for output in quilt panel; do
        mode=$([ $output = quilt ] && echo 0 || echo 3)
        # capture keeps a name that has columns and rows already.
        large=$work/$output-large$([ $output = quilt ] && echo _qs2x2 || true).png
        say "$output"
        play "$bin/manyview" capture --frame 241 --timeout 900 --output $output --out "$large" --views 4 \
            --display lenticular-4 -- >"$work/$output.log" 2>&1 || { say "no picture, see $work/$output.log"; exit 1; }
        pngtopnm "$large" | pamdepth 63 | pnmtopng -compression 9 >"$work/$output.png"
    done
    exit 0
fi

# sheet OUT OPTIONS...: the eight views of frame 100 of the trace, small, side by side.
sheet() {
    out=$1
    shift
    say "$out"
    "$bin/manyview" capture --frame 100 --timeout 900 --what atlas --out "$work/large.png" --views 8 --display slanted8 "$@" -- \
        glretrace -b "$work/walk.trace" >"$work/$out.log" 2>&1 || { say "no picture, see $work/$out.log"; exit 1; }
    pngtopnm "$work/large.png" | pamscale -xsize 1600 >"$work/$out.ppm"
}

if [ "$what" = walk ]; then
    cut_to 96
    say "recording"
    play apitrace trace -a gl -o "$work/walk.trace" >"$work/recording.log" 2>&1 || { say "it failed, see $work/recording.log"; exit 1; }
    # The chart prints the command, which should not have the path of WORK.
    (cd "$work" && "$bin/manyview" bench --fps "${FPS:-7}" --frames 60..240 --views 8 --display slanted8 --csv walk.csv --json walk.json \
        --chart walk.png -- glretrace -b walk.trace >walk.txt) || { say "no walk"; exit 1; }
    cat "$work/walk.txt"
    rows=
    for strategy in replay instanced geometry depth-image occlusion hybrid; do
        true_views=$([ $strategy = hybrid ] && echo "--true-views 3" || true)
        # shellcheck disable=SC2086 # two words
        sheet $strategy --strategy $strategy $true_views
        rows="$rows $work/$strategy.ppm"
        case $strategy in depth-image | occlusion | hybrid)
            # shellcheck disable=SC2086 # two words
            sheet $strategy-holes --strategy $strategy $true_views --holes mark
            rows="$rows $work/$strategy-holes.ppm"
            ;;
        esac
    done
    # shellcheck disable=SC2086 # several files
    pnmcat -tb $rows | pamdepth 63 | pnmtopng -compression 9 >"$work/strategies.png"
    exit 0
fi

# Views and strategy of each row; the first is the program by itself.
rows="0,bare 2,auto 2,geometry 4,auto 4,replay 4,instanced 4,geometry"
count=$(echo "$rows" | wc -w)
: >"$work/figures"
say "loading"
cut_to 4
clock
before=$spent
play env >"$work/loading.log" 2>&1 || { say "it failed, see $work/loading.log"; exit 1; }
clock
loading=$(echo "$spent $before" | awk '{ print $1 - $2 }')
cut_to "$kib"
round=1
while [ "$round" -le "$rounds" ]; do
    at=1
    for row in $rows; do
        views=${row%,*} strategy=${row#*,}
        say "round $round of $rounds, $at of $count: $views views, $strategy"
        log=$work/$views-$strategy.log
        if [ "$views" -eq 0 ]; then
            set -- env
        else
            set -- "$bin/manyview" run --views "$views" --display "lenticular-$views" --strategy "$strategy" \
                --report "$work/$views-$strategy.json" --
        fi
        clock
        before=$spent
        play "$@" >"$log" 2>&1 || { say "it failed, see $log"; exit 1; }
        clock
        cpu=$(echo "$spent $before $loading" | awk '{ print $1 - $2 - $3 }')
        # 401 frames 35.8 seconds 11.2 fps …
        line=$(grep -a 'frames .* seconds .* fps' "$log") || { say "no frame rate in $log"; exit 1; }
        say "$line"
        echo "$round $views $strategy $cpu $line" >>"$work/figures"
        at=$((at + 1))
    done
    round=$((round + 1))
done

awk '
    {
        round = $1; name = $2 " " $3; fps = $5 / ($7 + 0); cpu = $4 / $5
        if (!(name in rate)) order[++rows] = name
        rate[name] += fps; time[name] += cpu
        if ($2 == 0) { bare = fps; alone = cpu; next }
        ratio = fps / bare
        slower[name] += ratio; longer[name] += cpu / alone
        if (!(name in least) || ratio < least[name]) least[name] = ratio
        if (ratio > most[name]) most[name] = ratio
        frames = $5
    }
    END {
        print "OpenArena 0.8.8, OpenGL 1 renderer, timedemo: " frames " frames, mean of " round " rounds in turns, drawn by the processor (llvmpipe)"
        print ""
        print "| views | strategy | frames a second | against one view | least to most | processor time a frame | against one view |"
        print "|---|---|---|---|---|---|---|"
        for (i = 1; i <= rows; i++) {
            name = order[i]
            split(name, part, " ")
            if (part[1] == 0)
                printf "| 1 | without the layer | %.1f | | | %.0f ms | |\n", rate[name] / round, 1000 * time[name] / round
            else
                printf "| %d | %s | %.1f | %.2f | %.2f to %.2f | %.0f ms | %.1f |\n", part[1], part[2], rate[name] / round,
                    slower[name] / round, least[name], most[name], 1000 * time[name] / round, longer[name] / round
        }
        print ""
        print "Luo et al., Table II: Quake III on 7 PCs with GeForce 9600 GT; neither one view nor the size of the picture is told"
        print ""
        print "| views | GBMVR, frames a second | Annen et al. |"
        print "|---|---|---|"
        print "| 2 | 15.2 | 5.2 |"
        print "| 4 | 12.6 | 3.4 |"
        print ""
        printf "From 2 views to 4 the rate falls to %.2f (auto) and %.2f (geometry) of itself; GBMVR %.2f, Annen et al. %.2f.\n",
            rate["4 auto"] / rate["2 auto"], rate["4 geometry"] / rate["2 geometry"], 12.6 / 15.2, 3.4 / 5.2
    }
' "$work/figures" | tee "$work/openarena.txt"
