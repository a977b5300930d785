#!/usr/bin/env bash
# Tests README.md and the pages under docs/ against the project.
#   check.sh layout SOURCE                links and images exist; lines fit; README is short
#   check.sh commands SOURCE BUILD        ```sh blocks run, ```json scenes are accepted
#   check.sh programs SOURCE COMPILER     marked ```cpp blocks compile
# A comment on the line before a block says what to do with it:
#   <!-- test: run with --frames 2 -->    add these options to every rill- program, in place of the block's own
#   <!-- test: skip (reason) -->          do not run it
#   <!-- test: file NAME -->              save the block, for the commands after it
#   <!-- test: compile -->                a whole program
# Commands without a comment run as they stand; a block of json is a scene where it has the key "rill".
set -euo pipefail

check=$1
source=$(realpath "$2")
failures=0
checked=0

fail() {
  printf '%s\n' "$*" >&2
  failures=$((failures + 1))
}

pages() {
  cd "$source"
  printf '%s\n' README.md
  if [ -d docs ]; then find docs -name '*.md' | LC_ALL=C sort; fi
}

# blocks PAGE FOLDER: each fenced block as FOLDER/N.body, with FOLDER/N.head: its language, its line and the comment before it.
blocks() {
  awk -v folder="$2" '
    !inside && /^```/ {
      inside = 1; ++count; body = sprintf("%s/%03d.body", folder, count); head = sprintf("%s/%03d.head", folder, count)
      printf "%s\n%d\n%s\n", substr($0, 4), FNR, comment >head; close(head); printf "" >body; next
    }
    inside && /^```/ { inside = 0; comment = ""; close(body); next }
    inside { print >body; next }
    /^<!-- test: .* -->$/ { comment = substr($0, 12, length($0) - 15); next }
    { comment = "" }
    END { if (inside) { print "block without an end" >"/dev/stderr"; exit 1 } }' "$source/$1" || fail "$1: a fenced block does not end"
}

# prose PAGE: its lines with numbers, without fenced blocks.
prose() { awk '/^```/ { inside = !inside; next } !inside { print FNR ":" $0 }' "$source/$1"; }

layout() {
  local page line number target path length lines
  lines=$(wc -l <"$source/README.md")
  [ "$lines" -le 150 ] || fail "README.md: $lines lines, expected at most 150"
  while read -r page; do
    # Tables and images may be wider, but not in README.
    while IFS= read -r line; do
      number=${line%%:*} line=${line#*:}
      [[ $page != README.md && $line =~ ^(\||!\[) ]] && continue
      length=$(printf %s "$line" | wc -m)
      [ "$length" -le 120 ] || fail "$page:$number: $length characters, expected at most 120"
    done < <(if [ "$page" = README.md ]; then awk 'length > 100 { print FNR ":" $0 }' "$source/$page"; else prose "$page" | awk 'length > 100'; fi)
    while IFS= read -r line; do
      number=${line%%:*} target=${line#*](}
      target=${target%)}
      checked=$((checked + 1))
      case $target in
        http://* | https://* | mailto:* | \#*) continue ;;
      esac
      path=$(dirname "$page")/${target%%#*}
      [ -e "$source/$path" ] || fail "$page:$number: $target does not exist"
    done < <(prose "$page" | grep -oE '^[0-9]+:|\]\([^) ]*\)' | awk '/^[0-9]+:$/ { number = $0; next } { print number $0 }')
  done < <(pages)
  [ $checked -gt 0 ] || fail "no link was found"
}

# shims BUILD FOLDER: programs of the same names that change options before they start the real ones.
shims() {
  local program
  for program in capture bench view; do
    mkdir -p "$2/build/release/apps/$program"
    sed "s#@PROGRAM@#$1/apps/$program/rill-$program#" >"$2/build/release/apps/$program/rill-$program" <<'END'
#!/usr/bin/env bash
# The options in RILL_DOCS_WITH take the place of those given.
read -ra with <<<"${RILL_DOCS_WITH:-}"
given=()
while [ $# -gt 0 ]; do
  replaced=no
  for ((i = 0; i < ${#with[@]}; i++)); do
    if [ "$1" = "${with[i]}" ] && [[ $1 == --* ]]; then
      replaced=yes
      if [ $((i + 1)) -lt ${#with[@]} ] && [[ ${with[i + 1]} != --* ]]; then shift; fi
      break
    fi
  done
  [ $replaced = yes ] || given+=("$1")
  shift
done
exec @PROGRAM@ "${given[@]}" "${with[@]}"
END
    chmod +x "$2/build/release/apps/$program/rill-$program"
  done
}

commands() {
  local build page body comment language line with name count begin
  build=$(realpath "$1")
  while read -r page; do
    rm -rf "$scratch/blocks" "$scratch/run"
    mkdir -p "$scratch/blocks" "$scratch/run"
    shims "$build" "$scratch/run"
    ln -s "$source/assets" "$source/apps/demo.sh" "$scratch/run"
    blocks "$page" "$scratch/blocks"
    count=0
    for body in "$scratch/blocks"/*.body; do
      [ -e "$body" ] || break
      { read -r language && read -r line && read -r comment; } <"${body%.body}.head" || true
      with="" name=""
      case $comment in
        "" | compile) ;;
        "run with "*) with=${comment#run with } ;;
        "file "*) name=${comment#file } ;;
        "skip ("?*")") continue ;;
        *) fail "$page:$line: unknown comment \"test: $comment\", expected run with, skip (reason), file or compile"; continue ;;
      esac
      case $language in
        sh)
          count=$((count + 1)) begin=$SECONDS
          if ! (cd "$scratch/run" && export RILL_DOCS_WITH=$with PATH=$scratch/run/build/release/apps/capture:$scratch/run/build/release/apps/bench:$scratch/run/build/release/apps/view:$PATH &&
            timeout 300 bash -euo pipefail "$body") >"$scratch/output" 2>&1 </dev/null; then
            tail -n 20 "$scratch/output" >&2
            fail "$page:$line: the commands failed; a comment before the block can change or skip them, see tests/docs/check.sh"
          fi
          printf '%s:%s: ran, %d s\n' "$page" "$line" $((SECONDS - begin))
          ;;
        json | jsonc)
          [ -n "$name" ] && cp "$body" "$scratch/run/$name"
          grep -q '"rill"' "$body" || continue
          count=$((count + 1))
          cp "$body" "$scratch/run/scene.json"
          if ! (cd "$scratch/run" && "$build/apps/capture/rill-capture" scene.json --frames 1 --particles 100 --no-images --quiet --out scene) >"$scratch/output" 2>&1 </dev/null; then
            cat "$scratch/output" >&2
            fail "$page:$line: rill-capture does not accept the scene"
          fi
          ;;
      esac
    done
    checked=$((checked + count))
  done < <(pages)
  [ $checked -gt 0 ] || fail "no command was found"
}

programs() {
  local page body comment language line
  while read -r page; do
    rm -rf "$scratch/blocks"
    mkdir -p "$scratch/blocks"
    blocks "$page" "$scratch/blocks"
    for body in "$scratch/blocks"/*.body; do
      [ -e "$body" ] || break
      { read -r language && read -r line && read -r comment; } <"${body%.body}.head" || true
      [ "$language $comment" = "cpp compile" ] || continue
      checked=$((checked + 1))
      "$1" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I "$source/engine/include" -x c++ "$body" || fail "$page:$line: the program does not compile"
    done
  done < <(pages)
  [ $checked -gt 0 ] || fail "no program was found"
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
case $check in
  layout) layout ;;
  commands) commands "$3" ;;
  programs) programs "$3" ;;
  *) fail "unknown check $check, expected layout, commands or programs" ;;
esac
printf '%s: %d checked, %d failed\n' "$check" "$checked" $failures
[ $failures -eq 0 ]
