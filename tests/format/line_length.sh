#!/usr/bin/env bash
# Lines of shaders have at most 140 columns, lines of prose in .md files at most 120.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/format/tools.sh
export LC_ALL=C.UTF-8  # columns are characters, not bytes

failed=0
# check LIMIT FILE: reads the lines to check from stdin.
check() {
  local long
  long=$(grep -nE "^.{$(($1 + 1)),}$" | cut -c1-100) || return 0
  sed "s#^#$2:#; s#\$#...#" <<<"$long"
  failed=1
}

mapfile -t shaders < <(tracked '*.comp' '*.vert' '*.frag' '*.glsl' '*.h')
[ ${#shaders[@]} -gt 50 ] || { echo "found only ${#shaders[@]} shaders"; exit 1; }
for file in "${shaders[@]}"; do check 140 "$file" <"$file"; done

# Not prose: code blocks, tables, and lines of one link or picture, which nothing can break.
mapfile -t texts < <(tracked '*.md')
[ ${#texts[@]} -gt 3 ] || { echo "found only ${#texts[@]} .md files"; exit 1; }
for file in "${texts[@]}"; do
  check 120 "$file" < <(awk '
    /^ *(```|~~~)/ { fence = !fence; print ""; next }
    fence || /^ *\|/ || /^ *([*-] )?!?\[[^]]*\](\([^)]*\)|:.*)[.,;]?$/ { print ""; next }
    { print }' "$file")
done

[ $failed = 0 ] || echo "The lines above are longer than 140 columns (shaders) or 120 (prose)."
exit $failed
