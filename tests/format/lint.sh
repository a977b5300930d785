#!/usr/bin/env bash
# clang-tidy on the C++ files that differ from the main branch: those with most changed lines, at most RILL_LINT_MAX (12).
# Where nothing differs, on a few files that never leave the list, so that .clang-tidy is known to work.
#   lint.sh [--all]   --all: on every file, minutes
# The main branch is the commit RILL_LINT_BASE, or else origin/HEAD, origin/main or main.
# Needs clang-tidy 14; ends with 77 where there is none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/format/tools.sh

tidy=$(clang_tool clang-tidy)
[ -n "$tidy" ] || skip "clang-tidy $clang_version is not installed (Debian, Ubuntu: clang-tidy-$clang_version)"

# Hosts are compiled against the installed package, with warnings as errors, by builds of their own.
hosts='^(apps/embed|tests/hosts)/'
few=(engine/graph/hazard.cpp engine/graph/memory_plan.cpp engine/core/words.cpp)

merge_base() {
  local name
  for name in "${RILL_LINT_BASE:-}" origin/HEAD origin/main main; do
    if [ -n "$name" ] && git rev-parse -q --verify "$name^{commit}" >/dev/null 2>&1; then
      git merge-base "$name" HEAD && return
    fi
  done
  return 0
}

files=()
if [ "${1:-}" = --all ]; then
  mapfile -t files < <(tracked '*.cpp' '*.hpp' | grep -vE "$hosts")
elif git rev-parse --git-dir >/dev/null 2>&1; then
  base=$(merge_base)
  if [ -n "$base" ]; then
    mapfile -t files < <(git diff --numstat --no-renames --diff-filter=d "$base" -- '*.cpp' '*.hpp' | sort -k1,1nr | cut -f3 | grep -vE "$hosts")
    echo "${#files[@]} files differ from $(git log -1 --format='%h %s' "$base")"
  fi
fi
if [ ${#files[@]} = 0 ]; then
  echo "No file differs from the main branch, or there is none: these alone"
  files=("${few[@]}")
elif [ "${1:-}" != --all ]; then
  most=${RILL_LINT_MAX:-12}
  [ ${#files[@]} -le "$most" ] || echo "left out: $((${#files[@]} - most)) files with the fewest changed lines (tests/format/lint.sh --all has them)"
  files=("${files[@]:0:most}")
fi
printf '%s\n' "${files[@]}"

# The flags of any file; the presets' own compile commands name files that are put together (RILL_UNITY).
flags=(-std=c++20 -DVK_NO_PROTOTYPES -DRILL_SHADER_RELOAD -Iengine/include -Iengine -Iapps -Itests -Ishaders -isystem /usr/include/imgui -Wno-pragma-once-outside-header)
for name in RILL_SOURCE_DIR RILL_BINARY_DIR RILL_CXX RILL_LAYERS_FOLDER RILL_SOURCE_SCENES; do flags+=("-D$name=\"/lint\""); done

export tidy
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "${RILL_LINT_JOBS:-1}" bash -c '
  file=${!#}
  log=$("$tidy" --quiet "$file" -- "${@:1:$#-1}" 2>&1) || { printf "%s\n" "$log" | grep -v "warnings\? generated"; exit 1; }
' lint "${flags[@]}"
