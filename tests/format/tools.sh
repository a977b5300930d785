# shellcheck shell=bash
# What the checks of this folder share. Sourced, from the project's root.

# Later versions break lines elsewhere and have further checks, so that one tree could not satisfy two of them.
clang_version=14

# clang_tool NAME: the program of clang_version, as NAME-14 or NAME; nothing where there is none.
clang_tool() {
  local program
  for program in "$1-$clang_version" "$1"; do
    if "$program" --version 2>/dev/null | grep -qE "version $clang_version\."; then
      printf '%s\n' "$program"
      return
    fi
  done
}

# skip TEXT...: ends the test as skipped (SKIP_RETURN_CODE of ctest).
skip() {
  printf 'skipped: %s\n' "$*"
  exit 77
}

# tracked PATTERN...: the files that git tracks; of a tree without git, all outside of build folders.
tracked() {
  if git rev-parse --git-dir >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard --deduplicate -- "$@" | while IFS= read -r file; do
      [ ! -f "$file" ] || printf '%s\n' "$file"
    done
  else
    local names=() pattern
    for pattern in "$@"; do names+=(-o -name "$pattern"); done
    find . \( -path './build*' -o -path ./out -o -path './.*' \) -prune -o -type f \( "${names[@]:1}" \) -print | sed 's:^\./::' | sort
  fi
}
