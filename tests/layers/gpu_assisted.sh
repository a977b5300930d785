#!/usr/bin/env bash
# gpu_assisted.sh RILL_CAPTURE LAYERS scene|view NAME: a frame of a scene without a picture, or of a view of box-and-sphere, draws no
# message of gpu-assisted validation. It instruments shaders to find accesses out of bounds; that it finds them here is tested in
# gpu_assisted_test.cpp.
set -euo pipefail
capture=$1 what=$3 name=$4
export VK_ADD_LAYER_PATH=$2 RILL_TEST_HOSTILE=gpu-assisted VK_INSTANCE_LAYERS=VK_LAYER_RILL_hostile:VK_LAYER_KHRONOS_validation
export VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
case $what in
  scene) set -- "$name" --no-images ;;
  view) set -- box-and-sphere --view "$name" --size 96x64 ;;
esac
# Without a fill a number of particles is refused.
! grep -q '"fill"' "$(dirname "$0")/../../assets/scenes/$1.json" || set -- "$@" --particles 1000
"$capture" "$@" --frames 2 --out "$folder" --quiet --no-pass-times >"$folder/messages" 2>&1 || {
  cat "$folder/messages" >&2
  exit 1
}
if [ -s "$folder/messages" ]; then  # --quiet: whatever is there comes from validation
  cat "$folder/messages" >&2
  exit 1
fi
