#!/usr/bin/env bash
# Fuzzes the file readers: scenes with overrides, PLY files, meshes, checkpoints. Exits with 77 (skipped) without clang and libFuzzer.
# Crashing inputs are saved in build/fuzz/findings; pass one to its target to reproduce the crash.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

case ${1:-} in
  -h | --help) printf '%s\n' "Usage: tests/fuzz/run.sh [SECONDS]" "" "Fuzzes the readers of scenes, PLY files, meshes and checkpoints, each for SECONDS (default: 60)." \
    "Crashing inputs are saved in build/fuzz/findings. Exit codes: 0 no crash, 1 crash, 77 no clang with libFuzzer."; exit ;;
esac
seconds=${1:-60}

clang=$(command -v clang++ || true)
if [ -z "$clang" ] || ! echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  "$clang" -x c++ -fsanitize=fuzzer,address - -o /dev/null 2>/dev/null; then
  echo "Skipped: clang++ with libFuzzer was not found (Debian: clang, libclang-rt-dev)"
  exit 77
fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_scene fuzz_ply fuzz_mesh fuzz_checkpoint fuzz_seeds
mkdir -p build/fuzz/findings
build/fuzz/tests/fuzz_seeds build/fuzz/corpus
failed=0
for target in scene ply mesh checkpoint; do
  echo "Fuzzing $target for $seconds s"
  "build/fuzz/tests/fuzz_$target" -max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="build/fuzz/findings/$target-" "build/fuzz/corpus/$target" || failed=1
done
exit $failed
