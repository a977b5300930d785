#!/usr/bin/env bash
# Doxygen reads the public headers and the guide without a warning, and every type and function of a namespace is documented. Members
# of a type may go without a comment where their name says it all.
#   doxygen.sh SCRATCH_FOLDER
set -euo pipefail
scratch=$1
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
rm -rf "$scratch"
mkdir -p "$scratch"

{ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = \"$scratch\""; } | doxygen - || { echo "Doxygen warned, see above"; exit 1; }
for page in index classrill_1_1Fluid namespacerill; do
  [ -f "$scratch/html/$page.html" ] || { echo "no $page.html in $scratch/html"; exit 1; }
done

{
  cat docs/Doxyfile
  printf '%s\n' "OUTPUT_DIRECTORY = \"$scratch\"" 'WARN_IF_UNDOCUMENTED = YES' 'WARN_AS_ERROR = NO' "WARN_LOGFILE = \"$scratch/undocumented\""
} | doxygen - >/dev/null
if grep -E 'is not documented' "$scratch/undocumented" | grep -vE 'Member .* of (struct|class|union) '; then
  echo "Without a comment, see above"
  exit 1
fi
