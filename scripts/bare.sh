#!/usr/bin/env bash
# Tries the packages of out/debian in a bare Debian 12, made in a folder that is
# thrown away: installs all of them by apt; runs the program, the window on a
# display without a screen, and the module for Python; purges them, which must
# leave no file; and has autopkgtest run debian/tests, such as a consumer by
# CMake and by pkg-config. Needs root, and a mirror: this machine's.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

need debootstrap "makes a bare Debian"
need autopkgtest "runs the tests of packages"
install_needed
[ "$(id -u)" = 0 ] || fail "only root can make a bare Debian"
packages=$PWD/out/debian
ls "$packages"/*.deb >/dev/null || fail "first: scripts/debian.sh"

folder=$(mktemp -d)
bare=$folder/bare
inside() {
  chroot "$bare" env LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}
finish() {
  umount "$bare/proc" 2>/dev/null || true
  rm -rf --one-file-system "$folder"
}
trap finish EXIT

mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Codename: bookworm' |
  head -1)
debootstrap --variant=minbase bookworm "$bare" $mirror \
  >"$folder/debootstrap.log" 2>&1 ||
  fail "debootstrap: $(tail -1 "$folder/debootstrap.log")"
cp /etc/resolv.conf "$bare/etc/"
mount -t proc proc "$bare/proc"
mkdir "$bare/packages"
for package in "$packages"/*.deb; do
  case $package in *-dbgsym_*) ;; *) cp "$package" "$bare/packages" ;; esac
done
# A display for the window; what it takes is no part of the comparison.
inside apt-get -q -y install --no-install-recommends xvfb xauth >"$folder/log" ||
  fail "$(tail -3 "$folder/log")"

# files OUT: all files but those of apt itself, of logs and of caches.
files() {
  inside find / -xdev \( -path /proc -o -path /sys -o -path /packages -o \
    -path /tmp -o -path /root -o -path /var/cache -o -path /var/log -o \
    -path /var/lib/apt -o -path '/var/lib/dpkg/*-old' -o -path /run \) -prune \
    -o -print | LC_ALL=C sort >"$1"
}
files "$folder/before"
inside sh -c 'cd /packages &&
  apt-get -q -y install --no-install-recommends ./*.deb' >"$folder/log" 2>&1 ||
  fail "$(tail -3 "$folder/log")"
echo "Installed: $(cd "$bare/packages" && echo *.deb)"
inside sh -euc '
  cd /tmp
  halfspace csg "box(4) - translate(box(2), 1, 1, 3)" -o cup.stl -q
  halfspace info cup.stl --check
  halfspace render cup.stl -o cup.png -q
  printf "wait\ndump\nquit\n" >events
  xvfb-run -a halfspace view cup.stl --size 320x240 --play events \
    --dump shown.png
  SDL_VIDEODRIVER=dummy halfspace view cup.stl --size 320x240 --play events \
    --dump dark.png
  cmp shown.png dark.png
  python3 -c "
import halfspace
part = halfspace.Solid.box((0, 0, 0), (2, 2, 2))
part -= halfspace.Solid.box((1, 1, 1), (3, 3, 3))
assert part.volume() == 7
print(\"halfspace\", halfspace.__version__, \"volume\", part.volume())"
  rm -f cup.stl cup.png events shown.png dark.png' ||
  fail "what was installed does not work"
inside sh -c 'cd /packages && apt-get -q -y purge --autoremove $(
  for package in *.deb; do echo "${package%%_*}"; done)' >"$folder/log" 2>&1 ||
  fail "$(tail -3 "$folder/log")"
files "$folder/after"
diff "$folder/before" "$folder/after" >"$folder/left" ||
  fail "purged, and not as before: $(head -5 "$folder/left")"
echo "Purged: $(wc -l <"$folder/before") files, as before."

umount "$bare/proc"
autopkgtest -B "$bare"/packages/*.deb "$packages"/halfspace_*.dsc \
  -- chroot "$bare" || fail "a test of debian/tests failed"
echo "The packages work in a bare Debian 12."
