#!/usr/bin/env bash
# The window on a display of its own (Xvfb), moved by a hand that xdotool is:
# drags, the wheel, another size, keys, and that it sleeps when nothing happens.
. "$(dirname "$0")/../../tools/test/expect.sh"
unset SDL_VIDEODRIVER SDL_RENDER_DRIVER WAYLAND_DISPLAY
export XDG_STATE_HOME=$PWD/state
# D-Bus, which SDL asks on a real display, keeps memory to the end; leaks of our
# own are looked for by the tests without one.
export ASAN_OPTIONS=detect_leaks=0:${ASAN_OPTIONS:-}

for needed in Xvfb xdotool; do
  command -v $needed >/dev/null || {
    echo "WRONG: this test takes $needed (test.sh installs it)"
    exit 1
  }
done
exec 3<>display
# Without -noreset the display begins anew when a search that found nothing is
# its last client to go, and whoever comes at that moment loses his window.
Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp -noreset 2>xvfb.log &
screen=$!
viewer=
trap 'kill $viewer $screen 2>/dev/null' EXIT
for ((i = 0; i < 300 && $(wc -c <display) == 0; ++i)); do sleep 0.1; done
DISPLAY=:$(cat display)
export DISPLAY

box 0 0 0 2 2 2 >box.off
"$program" view box.off --size 600x400 --record recorded 2>stderr &
viewer=$!
window=
for ((i = 0; i < 300; ++i)); do
  window=$(xdotool search --name 'box.off - Halfspace' 2>/dev/null | tail -1)
  [ -n "$window" ] && break
  sleep 0.1
done
if [ -z "$window" ]; then
  wrong 'no window with the name of the file'
  finish
fi
hand() {
  xdotool "$@" || wrong "xdotool $*"
  sleep 0.5
}
hand mousemove --window "$window" 200 200
hand mousedown 1
hand mousemove --window "$window" 260 220
hand mousemove --window "$window" 300 230
hand mouseup 1
hand click 4
hand windowsize "$window" 1000 600
hand key 7
# A click whose press and release come at once is one, also in the panel: on
# `Front`, in the middle of the first button of the view.
hand mousemove --window "$window" 740 184
hand click 1
sleep 1
hand key ctrl+shift+s
hand key Return

# Ticks of the processor, of all threads.
ticks() { awk '{ print $14 + $15 }' /proc/$viewer/stat; }
# What was asked for is done at some time, on a busy machine late: when nothing
# was done for two seconds, for one may have gone to others.
before=
quiet=0
for ((i = 0; i < 20 && quiet < 2; ++i)); do
  now=$(ticks)
  if [ "$now" = "$before" ]; then quiet=$((quiet + 1)); else quiet=0; fi
  before=$now
  sleep 1
done
sleep 3
[ $(($(ticks) - before)) -le 1 ] || wrong 'an idle window works'

hand key ctrl+q
for ((i = 0; i < 100; ++i)); do
  kill -0 $viewer 2>/dev/null || break
  sleep 0.1
done
if kill -0 $viewer 2>/dev/null; then
  wrong 'Ctrl+Q does not end the window'
  kill -9 $viewer
fi
wait $viewer || wrong "it ended with $?"
python3 -c 'import json
camera = json.load(open("box.view"))["camera"]
(ex, ey, _), (tx, ty, _) = camera["eye"], camera["target"]
assert abs(ex - tx) < 1e-9 and ey < ty - 1' ||
  wrong 'the view that was saved is not from the front'
[ -s stderr ] && grep -v XDG_RUNTIME_DIR stderr | grep -q . &&
  wrong "it complained: $(cat stderr)"
grep -qx "$PWD/box.off" state/halfspace/recent ||
  wrong 'the file is not among the recent ones'
for line in 'press left' 'release left' 'wheel 1' 'size 1000 600' 'key 7' \
  'key Ctrl+Q'; do
  grep -qx "$line" recorded || wrong "nothing was recorded of '$line'"
done

# What a hand has done is played again.
(cat recorded && echo dump) | sed '/Ctrl+Q/d' >events
SDL_VIDEODRIVER=dummy "$program" view box.off --size 600x400 --play events \
  --dump played-%d.png >/dev/null || wrong 'the recorded events are not played'
"$program" render played-0.view -o again.png -q
same played-0.png again.png
finish
