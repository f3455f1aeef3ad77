#!/usr/bin/env bash
# Help, the manual and the completion, all made from the options.
. "$(dirname "$0")/expect.sh"

expect 0 'halfspace csg' help
expect 0 '\-\-merge' help csg
expect 0 'halfspace build.*\-\-threads' help --threads
expect 0 'halfspace render .*--near' help near
expect 0 'halfspace csg' help rotate
expect 0 'halfspace csg .*--format' help 3mf
expect 0 '  box.*sphere(R' help Sphere
expect 2 'no command or option called teapot' help teapot
expect 2 'no command called teapot' help --man teapot
for command in '' info render draw build csg compare join pick scene view \
  help; do
  # shellcheck disable=SC2086
  "$program" help --man $command >page.1 || wrong "help --man $command"
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS; do
    grep -q "^.SH $section" page.1 || wrong "$command: no section $section"
  done
  grep -q '^\.B .*help' page.1 || wrong "$command: no option --help"
  if command -v groff >/dev/null; then
    [ -z "$(groff -man -Tascii -ww -z page.1 2>&1)" ] ||
      wrong "$command: $(groff -man -Tascii -ww -z page.1 2>&1 | head -2)"
  fi
done

"$program" help --completion >halfspace.bash || wrong 'help --completion'
# offered WORDS...: what bash offers for the last of them.
offered() {
  bash -c '. ./halfspace.bash
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    _halfspace
    echo "${COMPREPLY[*]}"' bash "$@"
}
[ "$(offered halfspace in)" = info ] || wrong "in: $(offered halfspace in)"
[ "$(offered halfspace csg --mer)" = --merge ] || wrong 'csg --mer'
[ "$(offered halfspace csg --merge co)" = color ] || wrong 'csg --merge co'
[ -z "$(offered halfspace info par)" ] || wrong 'info par'
finish
