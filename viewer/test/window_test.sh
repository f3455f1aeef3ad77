#!/usr/bin/env bash
# The window as its users have it, without a screen: events are played, and
# what it dumps is what `halfspace render` makes of the same state.
. "$(dirname "$0")/../../tools/test/expect.sh"
export SDL_VIDEODRIVER=dummy SDL_RENDER_DRIVER=software

"$make_model" pinwheel pinwheel.off >/dev/null 2>&1 ||
  box 0 0 0 3 1 1 >pinwheel.off
box 0 0 0 2 2 2 >box.off
box 1 1 1 3 3 3 >other.off

# played N ARGUMENT...: plays what stands on standard input; N pictures come of
# it, and each is that of its view.
played() {
  local count=$1 i
  shift
  cat >events
  rm -f out-*
  timeout 60 "$program" view "$@" --play events --dump out-%d.png \
    >stdout 2>stderr </dev/null ||
    wrong "'view $*': $(head -c 300 stderr) ($(tr '\n' ';' <events))"
  [ "$(find . -name 'out-*.png' | wc -l)" = "$count" ] ||
    wrong "'view $*': not $count pictures"
  for ((i = 0; i < count; ++i)); do
    "$program" render "out-$i.view" -o again.png -q ||
      wrong "out-$i.view is not rendered"
    same "out-$i.png" again.png
  done
}

# The first picture is that of render's own usual view.
echo dump | played 1 box.off --size 300x200 --background 255,255,255
"$program" render box.off --size 300x200 -o usual.png -q
same out-0.png usual.png
echo dump | played 1 box.off --size 301x203 --view front --shade gouraud \
  --background 10,20,30 --color 200,100,50 --light 1,2,3 --fov 50
"$program" render box.off --size 301x203 --view front --shade gouraud -q \
  --background 10,20,30 --color 200,100,50 --light 1,2,3 --fov 50 -o usual.png
same out-0.png usual.png

printf 'key E\ndump\n' | played 1 box.off --size 301x203 --view front \
  --background 10,20,30 --ambient 0.5
"$program" render box.off --size 301x203 --view front -q --lines features \
  --line-color 235,238,242 --background 10,20,30 --ambient 0.5 -o usual.png
same out-0.png usual.png

# What lets light through is blended; sections of it have no caps.
echo dump | played 1 box.off --size 301x203 --alpha 90
cmp -s out-0.png usual.png && wrong "--alpha changes nothing"
played 2 box.off --size 200x150 --alpha 120 <<'END'
key V
dump
key .
dump
END

# Every way to move the camera makes another picture.
played 11 pinwheel.off --size 320x240 <<'END'
dump
drag left 100 100 180 120
dump
drag right 100 100 100 140
dump
drag middle 100 100 130 140
dump
drag left 100 100 130 140 ctrl
dump
move 30 200
wheel 2
dump
key 7
dump
key 5
dump
key 9
dump
key Shift+Left
dump
size 900 500
dump
END
for ((i = 1; i < 11; ++i)); do
  cmp -s "out-$i.png" "out-$((i - 1)).png" && wrong "move $i moves nothing"
done

# Two fingers zoom to where they are, and pan; over the panel they do nothing.
played 5 pinwheel.off --size 320x240 <<'END'
dump
pinch 0.1 100 100
dump
press left
release left
pinch 0 100 100
pinch 0 130 90
dump
press left
release left
pinch 0.3 500 100
dump
pinch 0 100 100
pinch 0 70 110
pinch -0.1 100 100
dump
END
cmp -s out-0.png out-1.png && wrong 'two fingers do not zoom'
cmp -s out-1.png out-2.png && wrong 'two fingers do not pan'
same out-2.png out-3.png
python3 -c 'import json
def camera(n):
    return json.load(open(f"out-{n}.view"))["camera"]
def size(c):
    return sum((a - b) ** 2 for a, b in zip(c["eye"], c["target"])) ** 0.5
# Nearer by e^-0.4, then across, then as far again.
assert abs(size(camera(1)) / size(camera(0)) - 0.67032) < 1e-3
assert abs(size(camera(2)) / size(camera(1)) - 1) < 1e-9
assert abs(size(camera(4)) / size(camera(0)) - 1) < 1e-3' ||
  wrong 'two fingers zoom by another factor'

# Two files, a boolean by the panel's state, hiding, undoing.
played 4 box.off other.off --size 200x150 <<'END'
dump
key Right
dump
key Right
dump
key A
dump
END
same out-0.png out-3.png
cmp -s out-1.png out-2.png && wrong 'both files look the same'

# Looks: lines, marks of back sides, colours of parts and faces, and by Alt a
# file that is moved, which is taken back as one.
played 9 box.off other.off --size 200x150 --back-color 255,0,0 <<'END'
key E
dump
key W
dump
key C
dump
key C
dump
key Shift+K
dump
drag left 100 75 130 60 alt
dump
key Ctrl+Z
dump
key Shift+7
dump
key L
dump
END
for ((i = 1; i < 9; ++i)); do
  cmp -s "out-$i.png" "out-$((i - 1)).png" && [ $i != 1 ] && [ $i != 4 ] &&
    wrong "look $i changes nothing"
done
same out-4.png out-6.png
# From inside, the marks are seen.
echo dump | played 1 box.off --size 99x70 --eye 1,1,1 --target 2,1.5,1.2
cp out-0.png plain.png
echo dump | played 1 box.off --size 99x70 --eye 1,1,1 --target 2,1.5,1.2 \
  --back-color 255,0,0
cmp -s out-0.png plain.png && wrong '--back-color marks nothing'

# The film of a turn is that of render.
played 1 box.off --size 99x70 --view front <<'END'
key E
key Ctrl+T
wait
key Return
wait
dump
END
"$program" render out-0.view --turntable 36 --frames 0:36 -o film-%d.png -q ||
  wrong 'the view makes no film'
for k in 0 1 17 35; do same "box-$(printf %03d $k).png" "film-$k.png"; done
same box-000.png out-0.png
cmp -s box-000.png box-001.png && wrong 'the film does not turn'

# What was typed for one question is not undone in the next, whose name is
# shorter: the letters to be undone are not there.
played 1 box.off --size 200x150 <<'END'
wait
key Ctrl+E
key Ctrl+Y
key Backspace
key Return
key Ctrl+Z
key Ctrl+S
key Ctrl+Z
key Escape
dump
END

# A section is one more clip plane, which other keys move; numbers colour.
played 4 box.off --size 200x150 <<'END'
dump
key V
dump
key .
dump
key V
dump
END
same out-0.png out-3.png
cmp -s out-0.png out-1.png && wrong 'the section cuts nothing'
cmp -s out-1.png out-2.png && wrong 'the section does not move'
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n' >heat.ply
printf 'property float y\nproperty float z\nproperty float heat\n' >>heat.ply
printf 'element face 1\nproperty list uchar int vertex_indices\n' >>heat.ply
printf 'end_header\n0 0 0 1\n4 0 0 2\n0 0 3 9\n3 0 1 2\n' >>heat.ply
echo dump | played 1 heat.ply --size 300x200 --view front
cp out-0.png plain.png
echo dump | played 1 heat.ply --size 300x200 --view front --scalar heat \
  --map turbo --legend
cmp -s out-0.png plain.png && wrong 'numbers colour nothing'
expect 2 "no property 'cold'" render heat.ply --scalar cold -o none.png

# Dropped files: one that is bad leaves what was there.
echo nonsense >bad.off
played 3 box.off --size 200x150 <<'END'
dump
drop bad.off
dump
key Escape
drop other.off
dump
END
same out-0.png out-1.png

# A view brings everything back.
cp out-2.view kept.view
cp out-2.png kept.png
echo dump | played 1 kept.view
same out-0.png kept.png

# Without files there is a window, too; the window itself can be taken.
printf 'wait\nshot window.png\nkey H\nshot help.png\nquit\n' | played 0
for file in window help; do
  [ -s $file.png ] || wrong "no $file.png"
done
cmp -s window.png help.png && wrong 'the help is not shown'

# What is wrong is one line.
expect 2 'line 2' view box.off --play <(printf 'wait\njump\n')
expect 2 'no.events' view box.off --play no.events
echo '{}' >empty.view
expect 2 'view.parts' view empty.view --play /dev/null
expect 2 'view.parts' render empty.view -o none.png
SDL_VIDEODRIVER=none expect 2 'no display' view box.off
unset SDL_VIDEODRIVER DISPLAY WAYLAND_DISPLAY
export XDG_RUNTIME_DIR=$PWD  # else libwayland says that it is not there
expect 2 'no display: neither X11' view box.off
finish
