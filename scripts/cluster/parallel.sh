#!/usr/bin/env bash
# Runs a plan's jobs by GNU parallel, here or on other machines that see the
# plan's folder:
#
#   scripts/cluster/parallel.sh DIR [OPTIONS of parallel, such as -j 4 or
#                                 --sshloginfile machines.txt]
#
# A phase begins when that before it is done. Begun again after a failure or an
# interruption, it runs what is not done. Exit status: that of the first phase
# that fails, else of the manifest.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 1 ] || {
  echo "parallel.sh: takes a plan's folder, and options of parallel" >&2
  exit 2
}
folder=$(cd "$1" && pwd)
shift
phases=$("$here/farm.py" phases "$folder")
while read -r phase count; do
  seq 0 $((count - 1)) |
    parallel "$@" --joblog "$folder/$phase.joblog" \
      "$here/farm.py" run "$folder" "$phase" {} || {
    status=$?
    echo "parallel.sh: phase $phase: jobs failed; $folder/$phase.joblog has" \
      "them" >&2
    exit $status
  }
done <<<"$phases"
"$here/farm.py" manifest "$folder"
