#!/bin/sh
# The pictures of docs/gallery.md: one scene in each layout, the views of eyes before a panel, and a panel before and after calibration with
# the photos that tests/calibrate/gallery.rs takes. gallery.sh BIN DEMO FOLDER PHOTOS
set -eu
bin=$1 demo=$2 folder=$3 photos=$4
scene="--frame 40 --eye-spacing 0.3 --focal-depth 8"
mkdir -p "$folder"

# shot NAME SIZE OPTIONS...
shot() {
    name=$1 size=$2
    shift 2
    # The scene's options are words.
    # shellcheck disable=SC2086
    env -u DISPLAY "$bin/manyview" capture $scene "$@" --out "$folder/$name.png" -- "$demo" --size "$size" >/dev/null
}

shot quilt 168x126 --views 8 --output quilt
shot sbs 252x189 --views 2 --output sbs
shot half-sbs 252x189 --views 2 --output half-sbs
shot tb 252x189 --views 2 --output tb
shot rgbd 252x189 --output rgbd
shot rows 252x189 --output rows
shot columns 252x189 --output columns
shot checker 252x189 --output checker
for glasses in red-cyan green-magenta amber-blue; do
    for mixture in "" -half -grey; do
        shot "anaglyph-$glasses$mixture" 252x189 --output "anaglyph:$glasses$mixture"
    done
done
shot panel 504x378 --display slanted8
shot blend 504x378 --display slanted8 --filter blend
shot gaussian 504x378 --display slanted8 --filter gaussian
for filter in panel blend gaussian; do
    "$bin/manyview" simulate --display slanted8 --eye 0,0,600 --strip 5 --width 300 \
        --in "$folder/$filter.png" --out "$folder/$filter-strip.png"
done
# The assumed description of a panel, and the one measured from photos; eyes look through the true sheet.
"$bin/manyview" calibrate fit --display "$photos/described.toml" --size 960x540 --out "$photos/measured.toml" \
    --picture "$folder/fit.png" "$photos/front.jpg" "$photos/side.jpg"
for panel in described measured; do
    shot $panel 960x540 --display "$photos/$panel.toml"
    "$bin/manyview" simulate --display "$photos/true.toml" --eye 0,0,600 --strip 3 --width 240 --cone 30 \
        --in "$folder/$panel.png" --out "$folder/$panel-strip.png"
done
# Crops that are small enough for a page; the other pictures are as the commands wrote them.
for strip in panel-strip blend-strip gaussian-strip; do
    pngtopnm "$folder/$strip.png" | pnmscale 0.4 | pnmtopng -compression 9 >"$folder/$strip.tmp"
    mv "$folder/$strip.tmp" "$folder/$strip.png"
done
for picture in described-strip measured-strip fit; do
    pngtopnm "$folder/$picture.png" | pnmscale 0.25 | pnmtopng -compression 9 >"$folder/$picture.tmp"
    mv "$folder/$picture.tmp" "$folder/$picture.png"
done
pngtopnm "$photos/wall-strip.png" | pnmscale 0.5 | pnmtopng -compression 9 >"$folder/wall-strip.png"
rm -f "$folder/blend.png" "$folder/gaussian.png" "$folder/described.png" "$folder/measured.png"
