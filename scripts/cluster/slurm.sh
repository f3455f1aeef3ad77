#!/usr/bin/env bash
# Submits a plan's jobs to Slurm, as an array for each phase:
#
#   scripts/cluster/slurm.sh DIR [OPTIONS of sbatch, such as --partition=night]
#
# A phase waits for that before it; the last job writes the manifest. Prints the
# numbers of the arrays. A job whose node fails is run again by Slurm; after
# anything else, submit again: what is done is not run again. An array has at
# most as many tasks as the cluster allows, which then run several jobs each.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 1 ] || {
  echo "slurm.sh: takes a plan's folder, and options of sbatch" >&2
  exit 2
}
folder=$(cd "$1" && pwd)
shift
most=$(scontrol show config | sed -n 's/^MaxArraySize *= *//p')
mkdir -p "$folder/log"
before=()
# submit NAME WORDS...: a job after those before, in the folder's logs.
submit() {
  local name=$1
  shift
  sbatch --parsable --requeue --kill-on-invalid-dep=yes --job-name="$name" \
    --open-mode=append "${before[@]}" "$@" | cut -d';' -f1
}
phases=$("$here/farm.py" phases "$folder")
while read -r phase count; do
  tasks=$((count < most ? count : most))
  number=$(submit "$phase" --array="0-$((tasks - 1))" \
    --output="$folder/log/$phase-%a.log" "$@" \
    "$here/slurm.sbatch" "$here/farm.py" run "$folder" "$phase" \
    --stride "$tasks")
  echo "$phase: array $number of $tasks tasks, $count jobs"
  before=(--dependency="afterok:$number")
done <<<"$phases"
number=$(submit manifest --output="$folder/log/manifest.log" "$@" \
  "$here/slurm.sbatch" "$here/farm.py" manifest "$folder")
echo "manifest: job $number"
