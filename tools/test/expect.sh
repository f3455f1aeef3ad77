# Sourced by the tests of the program, which are called with the program, the
# maker of models and an empty folder to work in.
set -uo pipefail
program=$1
make_model=$2
rm -rf "$3"
mkdir -p "$3"
cd "$3" || exit 1

failures=0

# Says what is wrong; the test goes on, and fails at its end.
wrong() {
  echo "WRONG: $*"
  failures=$((failures + 1))
}

# expect STATUS PATTERN ARGUMENT...: the program ends with this status; what it
# prints on standard error is nothing where the status is not 2, and else one
# line that begins with its name and holds the pattern.
expect() {
  local status=$1 pattern=$2
  shift 2
  "$program" "$@" >stdout 2>stderr </dev/null
  local got=$?
  [ $got = "$status" ] ||
    wrong "'$*' ended with $got, not $status: $(head -c 300 stderr)"
  if [ "$status" = 2 ]; then
    [ "$(wc -l <stderr)" = 1 ] || wrong "'$*': not one line: $(cat stderr)"
    grep -q '^halfspace: ' stderr || wrong "'$*': no name: $(cat stderr)"
    grep -qe "$pattern" stderr ||
      wrong "'$*': no '$pattern' in: $(cat stderr)"
  else
    [ -s stderr ] && wrong "'$*' complained: $(cat stderr)"
    grep -qe "$pattern" stdout ||
      wrong "'$*': no '$pattern' in: $(cat stdout)"
  fi
}

# The number that a JSON file holds under a name.
number() {
  sed -n "s/^ *\"$2\": \(-\{0,1\}[0-9.e+-]*\),\{0,1\}$/\1/p" "$1"
}

# same A B: the two files hold the same bytes.
same() {
  cmp "$1" "$2" || wrong "$1 and $2 differ"
}

# A box as OFF, its corners (x0, y0, z0) and (x1, y1, z1).
box() {
  printf 'OFF\n8 6 0\n'
  local x y z
  for z in "$3" "$6"; do
    for y in "$2" "$5"; do
      for x in "$1" "$4"; do echo "$x $y $z"; done
    done
  done
  printf '4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n'
}

finish() {
  [ $failures = 0 ] || {
    echo "$failures wrong"
    exit 1
  }
}
