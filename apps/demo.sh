#!/usr/bin/env bash
# Builds Rill from a fresh clone and renders images of a dam break.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup.sh

usage() {
  cat <<'END'
Usage: ./apps/demo.sh [--no-install] [--help] [-- OPTION...]

Installs missing packages (Debian 12, Ubuntu 24.04 or newer; uses sudo if not root), builds Rill,
and renders the scene dam-break to ./out/dam-break. Does not require a GPU.

  --no-install   build and run without installing packages
  -- OPTION...   options for rill-capture

Examples:
  ./apps/demo.sh -- --frames 30 --size 640x360
  ./apps/demo.sh -- --video dam.mp4
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
images=yes
args=("$@")
for ((i = 0; i < $#; i++)); do
  case ${args[i]} in
    --out=*) out=${args[i]#--out=} ;;
    --out) out=${args[i + 1]:-$out} ;;
    --no-images) images=no ;;
  esac
done

look=(rill=0.2 look.sky=day look.stage=tank look.whitewater=true look.caustics=true)
phase "Simulating and rendering dam-break"
build/release/apps/capture/rill-capture dam-break --set "${look[@]}" "$@"
if [ $images = yes ]; then phase "Images are in $out"; else phase "Done"; fi
