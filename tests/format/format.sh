#!/usr/bin/env bash
# C++ files look as clang-format writes them. Needs clang-format 14; ends with 77 where there is none.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/format/tools.sh

format=$(clang_tool clang-format)
[ -n "$format" ] || skip "clang-format $clang_version is not installed (Debian, Ubuntu: clang-format-$clang_version)"
mapfile -t files < <(tracked '*.cpp' '*.hpp')
[ ${#files[@]} -gt 100 ] || { echo "found only ${#files[@]} C++ files"; exit 1; }
"$format" --dry-run -Werror "${files[@]}" || { echo "Run: $format -i FILE..."; exit 1; }
echo "${#files[@]} files"
