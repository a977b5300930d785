#!/usr/bin/env bash
# From a clone to pictures of a dam break.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup.sh

usage() {
  cat <<'END'
Usage: ./apps/demo.sh [--no-install] [--help] [-- OPTION...]

Installs what is missing (Debian 12 or Ubuntu 24.04 and newer; with sudo where not root), builds Rill,
and captures the scene dam-break into ./out/dam-break. Needs no GPU.

  --no-install   install nothing, only build and run
  -- OPTION...   options for rill-capture, for example: -- --frames 30 --size 640x360, or -- --video dam.mp4
END
}

install=yes
while [ $# -gt 0 ]; do
  case $1 in
    --no-install) install=no ;;
    -h | --help) usage; exit ;;
    --) shift; break ;;
    *) printf 'demo.sh: unknown option %s\n\n' "$1" >&2; usage >&2; exit 2 ;;
  esac
  shift
done

[ $install = no ] || install_packages build run
build_release OFF rill-capture

out=out/dam-break
pictures=yes
args=("$@")
for ((i = 0; i < $#; i++)); do
  case ${args[i]} in
    --out=*) out=${args[i]#--out=} ;;
    --out) out=${args[i + 1]:-$out} ;;
    --no-images) pictures=no ;;
  esac
done

phase "Simulating and drawing dam-break"
build/release/apps/capture/rill-capture dam-break "$@"
if [ $pictures = yes ]; then phase "The pictures are in $out"; else phase "Done"; fi
