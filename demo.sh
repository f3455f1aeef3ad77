#!/usr/bin/env bash
# Builds Halfspace and renders a real mesh four ways: by the fast library, its
# tree front to back through the span buffer; and by the exact reference, a tree
# back to front, a z-buffer and ray casting. The four images must be equal,
# pixel for pixel. Pictures go to out/.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/packages.sh
. scripts/meshes.sh

readonly mesh=triceratops.off
readonly view=(--size 640x480 --up 0,1,0 --eye 13,8,16 --target 0,0,0 --fov 32)
readonly program=build/release/tools/halfspace
readonly methods=(span painter zbuffer raycast)

need_build_packages
need python3 "reads the statistics for the table"
install_needed

mkdir -p out
echo "Building (release)."
{
  cmake --preset release -DBUILD_TESTING=OFF &&
    cmake --build --preset release --target halfspace
} >out/build.log 2>&1 || {
  tail -n 30 out/build.log >&2
  fail "the build failed; all of its output is in out/build.log"
}

need_meshes "$mesh"

echo "Rendering $mesh by the fast library, and by the exact reference three ways."
for method in "${methods[@]}"; do
  library=ref
  [ "$method" != span ] || library=fast
  "$program" render "out/models/$mesh" "${view[@]}" --method "$method" \
    --impl "$library" -o "out/$method.png" --ids "out/$method.npy" \
    --stats "out/$method.json" >/dev/null ||
    fail "rendering by $method failed"
done
for method in "${methods[@]:1}"; do
  "$program" compare out/span.npy "out/$method.npy" >"out/$method.txt" || {
    cat "out/$method.txt" >&2
    fail "the images by span and by $method differ"
  }
done

python3 scripts/table.py "$mesh" "${methods[@]}" ||
  fail "the statistics cannot be read"
echo "Pictures: $(printf 'out/%s.png ' "${methods[@]}")"
