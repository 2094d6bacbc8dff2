#!/usr/bin/env bash
# Installs what volumen needs, builds it and opens its sample study; without a display it draws a picture of it instead.
# usage: bash app/run.sh [PATH]   PATH: a file or folder to open instead of the sample study
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
. "$top/app/setup.sh"
show_usage_if_asked "$0" "${1:-}"

install_packages "${build_packages[@]}" "${run_packages[@]}"
build release volumen
volumen=$top/build/release/app/volumen

sample=$top/build/sample-head-ct
if [ $# -gt 0 ]; then
  study=$1
else
  study=$sample
  if [ ! -d "$sample" ]; then
    say "making the sample study, a synthetic head CT, in $sample"
    "$volumen" convert phantom:ct-head -o "$sample/" >/dev/null
  fi
fi

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  say "opening $study"
  exec "$volumen" open "$study"
fi
picture=$top/build/sample.png
say "no display here: drawing a picture of $study"
"$volumen" render "$study" -o "$picture"
say "the picture is $picture"
