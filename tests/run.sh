#!/usr/bin/env bash
# Runs all tests on every installed software Vulkan driver.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup.sh
. tests/format/tools.sh

usage() {
  cat <<'END'
Usage: ./tests/run.sh [--no-install] [--long] [--help] [CTEST OPTION...]

Installs missing packages (Debian 12, Ubuntu 24.04 or newer; uses sudo if not root), builds, and runs
  all tests on lavapipe but those with the label long,
  tests with the label subgroups on lavapipe with a subgroup size of 16,
  tests with the label threads on lavapipe with one thread per core,
  tests with the label hostile-driver on lavapipe (they use what the specification leaves to drivers),
  tests with the labels gpu, drivers and subgroups on SwiftShader, which has a subgroup size of 4;
    if it is not installed, those with the label subgroups on lavapipe with that size.
Tests of a program share a few processes. With CTEST OPTIONs each runs in its own, so that -R selects by name.

  --no-install   build and run without installing packages
  --long         also run tests with the label gpu-assisted (the validation layer checks each access to a buffer)
                 and those with the label long on lavapipe: long simulations, the viewer on every scene, and several minutes
                 of fuzzing, which requires clang
  CTEST OPTION   options for ctest

Examples:
  ./tests/run.sh --no-install -R graph
  ./tests/run.sh --long
END
}

install=yes
long=no
none=error  # a run without tests is an error, unless the caller selects tests
shards=yes  # tests of a program share processes, unless the caller selects tests: see SHARDS in tests/CMakeLists.txt
while [ $# -gt 0 ]; do
  case $1 in
    --no-install) install=no ;;
    --long) long=yes ;;
    -h | --help) usage; exit ;;
    *) none=ignore shards=no; break ;;
  esac
  shift
done

# first_file PATH...: prints the first existing file.
first_file() {
  local path
  for path in "$@"; do
    if [ -f "$path" ]; then
      printf '%s\n' "$path"
      return
    fi
  done
}

log=$(mktemp)
trap 'rm -f "$log"' EXIT
failed=0
results=()

# run_tests NAME DRIVER NO_TESTS CTEST_OPTION...
run_tests() {
  local name=$1 driver=$2 no_tests=$3 begin=$SECONDS
  shift 3
  phase "Testing on $name"
  # Older loaders read only VK_ICD_FILENAMES.
  VK_DRIVER_FILES=$driver VK_ICD_FILENAMES=$driver \
    ctest --test-dir build/release --output-on-failure --no-tests="$no_tests" --parallel "$(nproc)" "$@" 2>&1 | tee "$log" || failed=1
  results+=("$name, $((SECONDS - begin)) s: $(grep -m1 -E 'tests passed|No tests were found' "$log" || echo 'no test ran')")
}

[ $install = no ] || install_packages build run test 'test?'
build_release ON all

lavapipe=$(first_file /usr/share/vulkan/icd.d/lvp_icd."$(uname -m)".json /usr/share/vulkan/icd.d/lvp_icd.json)
swiftshader=$(first_file /usr/lib/chromium/vk_swiftshader_icd.json)
[ -n "$lavapipe" ] || fail "/usr/share/vulkan/icd.d: lvp_icd.*.json of lavapipe was not found"

if [ $shards = yes ]; then
  round=(-C shards) prefix='' skipped='long|threads|hostile-driver|gpu-assisted|single-.*'
else
  round=() prefix='(single-)?' skipped='long|threads|hostile-driver|gpu-assisted'
fi

# LP_NUM_THREADS=0: lavapipe works in the thread of the test, which for dispatches this small takes a third of the time. Workgroups run
# concurrently in the tests with the label threads and on SwiftShader; without SwiftShader in those with subgroups of 16.
export LP_NUM_THREADS=0
run_tests "lavapipe" "$lavapipe" error "${round[@]}" -LE "^($skipped)$" "$@"
# The rounds on subgroups are without validation, which takes half of the time: calls are those of the round on lavapipe.
if [ -z "$swiftshader" ]; then
  RILL_TEST_VALIDATION=off LP_NATIVE_VECTOR_WIDTH=128 run_tests "lavapipe with subgroups of 4" "$lavapipe" $none "${round[@]}" -L "^${prefix}subgroups$" "$@"
  unset LP_NUM_THREADS
fi
RILL_TEST_VALIDATION=off LP_NATIVE_VECTOR_WIDTH=512 run_tests "lavapipe with subgroups of 16" "$lavapipe" $none "${round[@]}" -L "^${prefix}subgroups$" "$@"
run_tests "hostile drivers" "$lavapipe" $none -L '^hostile-driver$' "$@"
unset LP_NUM_THREADS
LP_NATIVE_VECTOR_WIDTH=512 run_tests "lavapipe with subgroups of 16 and threads" "$lavapipe" $none -L '^threads$' "$@"
export LP_NUM_THREADS=0
if [ -n "$swiftshader" ]; then
  # Programs, and the tests of gpu and of the contract, have validation by themselves. Every way to gather neighbors: on lavapipe, and where lanes matter.
  RILL_TEST_VALIDATION=off RILL_TEST_GATHERS=first run_tests "SwiftShader" "$swiftshader" $none "${round[@]}" -L "^(${prefix}gpu|drivers)$" "$@"
  RILL_TEST_VALIDATION=off run_tests "SwiftShader, subgroups of 4" "$swiftshader" $none "${round[@]}" -L "^${prefix}subgroups$" "$@"
else
  results+=("SwiftShader: skipped, not installed (package chromium-common)")
fi
for tool in clang-format clang-tidy; do
  [ -n "$(clang_tool $tool)" ] || results+=("$tool: version $clang_version is not installed, so its test was skipped")
done
[ $long = no ] || run_tests "lavapipe with gpu-assisted validation" "$lavapipe" $none -L '^gpu-assisted$' "$@"
[ $long = no ] || run_tests "lavapipe, long tests" "$lavapipe" $none "${round[@]}" -L '^long$' "$@"

phase "Results"
printf '%s\n' "${results[@]}"
exit $failed
