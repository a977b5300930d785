#!/usr/bin/env bash
# check.sh accepts good documents and reports each kind of mistake.
#   check_test.sh COMPILER
set -euo pipefail
compiler=$1
check=$(dirname "$(realpath "$0")")/check.sh
project=$(mktemp -d)
trap 'rm -rf "$project"' EXIT
failures=0

# A project with one page, and programs that write down what they are called with.
reset() {
  rm -rf "${project:?}"/*
  mkdir -p "$project/docs" "$project/assets" "$project/apps" "$project/engine/include"
  touch "$project/apps/demo.sh"
  for program in capture bench view; do
    mkdir -p "$project/build/apps/$program"
    # shellcheck disable=SC2016
    printf '#!/bin/sh\necho rill-%s "$@" >>%s\n[ "$1" != bad ] && [ "$(cat "$1" 2>/dev/null)" != "{\\"rill\\": bad}" ]\n' $program "$project/calls" >"$project/build/apps/$program/rill-$program"
    chmod +x "$project/build/apps/$program/rill-$program"
  done
  printf '%s\n' '# Title' '[page](docs/page.md)' '```sh' 'rill-capture dam' '```' '```json' '{"rill": "0.1"}' '```' '<!-- test: compile -->' '```cpp' 'int main() {}' '```' >"$project/README.md"
  printf '%s\n' '# Page' '![picture](../assets)' >"$project/docs/page.md"
}

run() {
  case $1 in
    layout) "$check" layout "$project" ;;
    commands) "$check" commands "$project" "$project/build" ;;
    programs) "$check" programs "$project" "$compiler" ;;
  esac >"$project/output" 2>&1
}

# accepts CHECK, rejects CHECK MESSAGE: what check.sh says of the project as it is.
accepts() {
  if ! run "$1"; then
    cat "$project/output" >&2
    echo "$1: expected no failure" >&2
    failures=$((failures + 1))
  fi
}
rejects() {
  if run "$1" || ! grep -qF -- "$2" "$project/output"; then
    cat "$project/output" >&2
    echo "$1: expected a failure with: $2" >&2
    failures=$((failures + 1))
  fi
}
add() { printf '%s\n' "$@" >>"$project/docs/page.md"; }
called() {
  if ! grep -qxF -- "$1" "$project/calls"; then
    cat "$project/calls" >&2
    echo "expected a call of: $1" >&2
    failures=$((failures + 1))
  fi
}

reset
accepts layout
accepts programs
accepts commands
called 'rill-capture dam'
called 'rill-capture scene.json --frames 1 --particles 100 --no-images --quiet --out scene'

reset; add '[gone](gone.md)'; rejects layout 'docs/page.md:3: gone.md does not exist'
reset; add '![gone](../assets/gone.png)'; rejects layout '../assets/gone.png does not exist'
reset; add '[one](page.md) [two](other.md#part)'; rejects layout 'other.md#part does not exist'
reset; add "$(printf 'word %.0s' {1..25})"; rejects layout 'docs/page.md:3: 125 characters'
reset; add "| $(printf 'word %.0s' {1..25})|" '```' '[no link](in-code.md)' '```'; accepts layout
reset; printf '| %s |\n' "$(printf 'word %.0s' {1..25})" >>"$project/README.md"; rejects layout 'README.md:13: 129 characters'
reset; printf '%.0s\n' {1..150} >>"$project/README.md"; rejects layout 'README.md: 162 lines'

reset; add '```sh' 'rill-capture bad' '```'; rejects commands 'docs/page.md:3: the commands failed'
reset; add '```sh' 'rill-capture bad' 'rill-capture good' '```'; rejects commands 'docs/page.md:3: the commands failed'
reset; add '```sh' 'no-such-program' '```'; rejects commands 'docs/page.md:3: the commands failed'
reset; add '<!-- test: skip (needs a display) -->' '```sh' 'rill-view bad' '```'; accepts commands
reset; add '<!-- test: skip -->' '```sh' 'rill-view' '```'; rejects commands 'docs/page.md:4: unknown comment'
reset; add '<!-- test: skip () -->' '```sh' 'rill-view' '```'; rejects commands 'docs/page.md:4: unknown comment'
reset; add '<!-- test: skip (needs a display) -->' '' '```sh' 'rill-view bad' '```'; rejects commands 'docs/page.md:5: the commands failed'
reset; add '```sh' 'rill-view'; rejects commands 'docs/page.md: a fenced block does not end'
reset; add '```json' '{"rill": bad}' '```'; rejects commands 'docs/page.md:3: rill-capture does not accept the scene'
reset; add '```json' '{"other": bad}' '```'; accepts commands

reset
add '<!-- test: run with --frames 2 --quiet -->' '```sh' 'build/release/apps/capture/rill-capture dam --frames 900 --quiet --out x' 'rill-bench sort' '```'
accepts commands
called 'rill-capture dam --out x --frames 2 --quiet'
called 'rill-bench sort --frames 2 --quiet'
reset; add '<!-- test: file mine.json -->' '```json' '{"rill": "0.1"}' '```' '```sh' 'test -s mine.json' '```'; accepts commands

reset; add '<!-- test: compile -->' '```cpp' 'int main() { return none; }' '```'; rejects programs 'docs/page.md:4: the program does not compile'
reset; add '```cpp' 'fragment' '```'; accepts programs

exit $((failures > 0))
