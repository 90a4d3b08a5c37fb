# Starts an X server that ends with the script, and sets DISPLAY. To be sourced; needs the folder `work` and the function `say`.

# The number of an earlier run would be read before the new one is written.
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
