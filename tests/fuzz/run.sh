#!/usr/bin/env bash
# Fuzzes what reads files: scenes with overrides, PLY, checkpoints. Needs clang with libFuzzer; ends with 77 where there is none.
# An input that crashes a target is left in build/fuzz/findings; run the target on it alone to see it again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

case ${1:-} in
  -h | --help) echo "Usage: tests/fuzz/run.sh [SECONDS]   (of each target; default: 60)"; exit ;;
esac
seconds=${1:-60}

clang=$(command -v clang++ || true)
if [ -z "$clang" ] || ! echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' |
  "$clang" -x c++ -fsanitize=fuzzer,address - -o /dev/null 2>/dev/null; then
  echo "There is no clang++ with libFuzzer here (Debian: clang, libclang-rt-dev), so nothing was fuzzed"
  exit 77
fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_scene fuzz_ply fuzz_checkpoint fuzz_seeds
mkdir -p build/fuzz/findings
build/fuzz/tests/fuzz_seeds build/fuzz/corpus
failed=0
for target in scene ply checkpoint; do
  echo "Fuzzing $target for $seconds s"
  "build/fuzz/tests/fuzz_$target" -max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="build/fuzz/findings/$target-" "build/fuzz/corpus/$target" || failed=1
done
exit $failed
