#!/bin/bash -eu
# Builds the fuzz targets as OSS-Fuzz wants them: $OUT/TARGET, its corpus and
# dictionary beside it, and the libraries that its machines do not have.
#
# Outside of OSS-Fuzz, for a look at it:
#   SRC=$PWD/.. WORK=/tmp/work OUT=/tmp/out CXX=clang++ SANITIZER=address \
#     CXXFLAGS=-fsanitize=address,fuzzer-no-link \
#     LIB_FUZZING_ENGINE=-fsanitize=fuzzer fuzz/oss-fuzz/build.sh [TARGET...]
cd "$(dirname "$(readlink -f "$0")")"
[ -f CMakeLists.txt ] || cd "$SRC/halfspace" 2>/dev/null || cd ../..

# oneTBB comes as a shared library made with libstdc++, so all is.
flags=${CXXFLAGS//-stdlib=libc++/}
cmake -S . -B "$WORK/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_CXX_FLAGS="$flags" \
  -DHALFSPACE_WARNINGS_AS_ERRORS=OFF -DHALFSPACE_BENCH=OFF \
  -DHALFSPACE_FUZZING_ENGINE="$LIB_FUZZING_ENGINE" \
  -DCMAKE_BUILD_WITH_INSTALL_RPATH=ON "-DCMAKE_INSTALL_RPATH=\$ORIGIN/lib"

targets=("$@")
if [ ${#targets[@]} = 0 ]; then
  for source in fuzz/fuzz_*.cpp; do
    targets+=("$(basename "$source" .cpp)")
  done
fi
cmake --build "$WORK/build" --target "${targets[@]}"

mkdir -p "$OUT/lib"
for target in "${targets[@]}"; do
  name=${target#fuzz_}
  cp "$WORK/build/fuzz/$target" "$OUT/"
  (cd "fuzz/corpus/$name" && python3 -m zipfile -c \
    "$OUT/${target}_seed_corpus.zip" ./*)
  if [ -f "fuzz/dictionaries/$name.dict" ]; then
    cp "fuzz/dictionaries/$name.dict" "$OUT/$target.dict"
  fi
  ldd "$WORK/build/fuzz/$target" | sed -n 's/.* => \(\/[^ ]*\) .*/\1/p' |
    grep -E 'lib(tbb|gmp|png|z|stdc\+\+|gcc_s)' | xargs -r cp -t "$OUT/lib"
done
