#!/bin/sh
# What the panel's own window and the on-screen display cost: median frame times of `teapot` in 8 views, over those without, in turns.
# panel-cost.sh BIN DEMOS [ROUNDS]
set -eu
bin=$1 demos=$2 rounds=${3:-5}
folder=$(mktemp -d)
# The server of one test at a time, by the number that it chooses itself.
server=
trap 'kill $server 2>/dev/null; rm -rf "$folder"' EXIT

# screen WIDTHxHEIGHT
screen() {
    [ -z "$server" ] || kill "$server"
    mkfifo "$folder/number"
    Xvfb -displayfd 3 -screen 0 "${1}x24" 3>"$folder/number" >/dev/null 2>&1 &
    server=$!
    DISPLAY=:$(cat "$folder/number")
    export DISPLAY
    rm "$folder/number"
}

# once FILE SIZE OPTIONS...: one run, its median is appended to the file
once() {
    file=$1 size=$2
    shift 2
    MALLOC_TRIM_THRESHOLD_=134217728 MALLOC_MMAP_THRESHOLD_=33554432 "$bin/manyview" run "$@" --display huebner8 --auto-depth=0 \
        --strategy replay --report "$folder/report.json" -- "$demos/teapot" --frames 40 --size "$size" >/dev/null 2>&1
    sed -n 's/.*"median": \([0-9.]*\),*/\1/p' "$folder/report.json" | head -n 1 >>"$folder/$file"
}

# ratio NAME: the middle of the rounds' ratios, the lowest and the highest
ratio() {
    paste "$folder/with" "$folder/without" | awk '{ print $1 / $2 }' | sort -n |
        awk -v name="$1" '{ all[NR] = $1 } END { printf "%s  %.2f  (%.2f to %.2f)\n", name, all[int((NR + 1) / 2)], all[1], all[NR] }'
    rm "$folder/with" "$folder/without"
}

screen 1920x1080
for _ in $(seq "$rounds"); do
    once without 1920x1080 --osd off
    once with 1920x1080 --osd off --panel auto
done
ratio "the panel's window, 1080p, over the same picture in the program's own"
for _ in $(seq "$rounds"); do
    once without 1920x1080 --osd off
    once with 1920x1080 --osd fps,crosshair
done
ratio "on-screen display, 1080p"
screen 3840x2160
for _ in $(seq "$rounds"); do
    once without 3840x2160 --osd off
    once with 1280x720 --osd off --panel auto
done
ratio "a 4K panel from a window of 720p, over a window of 4K"
