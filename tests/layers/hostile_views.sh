#!/usr/bin/env bash
# hostile_views.sh RILL_CAPTURE LAYERS VIEW: a small picture of the view is bitwise the same on drivers that use their freedom without
# rounding otherwise.
set -euo pipefail
capture=$1 view=$3
export VK_ADD_LAYER_PATH=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
draw() {  # FOLDER NAME=VALUE...: with these in the environment
  env "${@:2}" "$capture" box-and-sphere --view "$view" --particles 1000 --frames 1 --size 96x64 --out "$folder/$1" --quiet --no-pass-times
}
draw expected LP_NUM_THREADS=0
drivers=(assume-finite groups=3)
[ "$view" != final ] || drivers+=(poison-shuffles)  # shuffles are in the fluid's shaders alone, which are the same in each view
for driver in "${drivers[@]}"; do
  draw found VK_INSTANCE_LAYERS=VK_LAYER_RILL_hostile RILL_TEST_HOSTILE=$driver
  cmp "$folder/expected/frame_00000.png" "$folder/found/frame_00000.png" || { echo "$driver: the view $view differs" >&2; exit 1; }
done
