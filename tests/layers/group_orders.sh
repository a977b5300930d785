#!/usr/bin/env bash
# group_orders.sh RILL_CAPTURE LAYERS: the state hash of a dam break is the same in 8 orders of the workgroups, and with twice
# as many threads as cores.
set -euo pipefail
capture=$1
export VK_ADD_LAYER_PATH=$2
hash_of() {  # NAME=VALUE...: with these in the environment
  env "$@" "$capture" dam-break --particles 2000 --frames 1 --no-images --quiet \
    --no-pass-times --stats - | grep -o '"state_hash": *"[0-9a-f]*"' | tail -n 1
}
expected=$(hash_of LP_NUM_THREADS=0)
[ -n "$expected" ] || { echo "rill-capture printed no state hash" >&2; exit 1; }
if hash_of VK_INSTANCE_LAYERS=VK_LAYER_RILL_hostile RILL_TEST_HOSTILE=unknown 2>/dev/null; then
  echo "the layer VK_LAYER_RILL_hostile is not loaded from $VK_ADD_LAYER_PATH" >&2
  exit 1
fi
failed=0
check() {
  local found
  found=$(hash_of "$@") || found="an error"
  [ "$found" = "$expected" ] || { echo "$*: found $found, expected $expected" >&2; failed=1; }
}
for seed in $(seq 8); do check LP_NUM_THREADS=0 VK_INSTANCE_LAYERS=VK_LAYER_RILL_hostile RILL_TEST_HOSTILE=groups="$seed"; done
check LP_NUM_THREADS=$((2 * $(nproc)))
check LP_NUM_THREADS=$((2 * $(nproc))) VK_INSTANCE_LAYERS=VK_LAYER_RILL_hostile RILL_TEST_HOSTILE=groups=9
exit $failed
