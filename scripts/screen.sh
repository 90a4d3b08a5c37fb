# An X server of one's own until the script ends; sets DISPLAY. To be sourced, with the folder `work` and the function `say`.

# That of another run would be read before this one is written.
rm -f "$work/display"
Xvfb -displayfd 1 -screen 0 1024x768x24 -nolisten tcp -noreset >"$work/display" 2>/dev/null &
server=$!
trap 'kill $server 2>/dev/null || true' EXIT
trap 'exit 1' HUP INT TERM
tries=0
until [ -s "$work/display" ]; do
    tries=$((tries + 1))
    [ $tries -lt 100 ] || { say "Xvfb does not start"; exit 1; }
    sleep 0.1
done
DISPLAY=:$(cat "$work/display")
