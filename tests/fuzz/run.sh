#!/usr/bin/env bash
# Fuzzes what reads files, each driver for a while, from seeds that it makes and small files of the real data.
# usage: bash tests/fuzz/run.sh [SECONDS] [DRIVER...]   SECONDS a driver: 600; DRIVER: dicom codec answer archive dimse image_file scene session
# What was found lies in build/fuzz/found; exit status 1 where there is something.
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
. "$top/app/setup.sh"
show_usage_if_asked "$0" "${1:-}"
seconds=${1:-600}
shift || true
drivers=("$@")
[ ${#drivers[@]} -gt 0 ] || drivers=(dicom codec answer archive dimse image_file scene session)

install_packages "${build_packages[@]}" "${run_packages[@]}" clang libclang-rt-14-dev
built=$top/build/fuzz
build fuzz make_seeds "${drivers[@]/#/fuzz_}"
seeds=$built/seeds
rm -rf "$seeds" && mkdir -p "$seeds" "$built/found"
QT_QPA_PLATFORM=offscreen "$built/tests/fuzz/make_seeds" "$seeds"
cp -r "$top/tests/fuzz/dimse" "$seeds/"
data=${VOLUMEN_DATA:-$top/../shared/data}
if [ -d "$data" ]; then
  find "$data" -type f -size -48k \( -name '*.dcm' -o -path '*dicom*' \) | sed -n 1,300p | while read -r file; do
    cp "$file" "$seeds/dicom/$(echo "$file" | md5sum | cut -c1-12)"
  done
fi
status=0
for driver in "${drivers[@]}"; do
  mkdir -p "$built/corpus/$driver"
  limits=allocator_may_return_null=1
  # Peers claim values of 4 GB, for which DCMTK asks the system, and can do without.
  [ "$driver" != dimse ] || limits+=:max_allocation_size_mb=512
  ASAN_OPTIONS=detect_leaks=0:$limits UBSAN_OPTIONS=print_stacktrace=1 \
    "$built/tests/fuzz/fuzz_$driver" -max_total_time="$seconds" -timeout=5 -rss_limit_mb=1024 -max_len=200000 \
    -print_final_stats=1 -artifact_prefix="$built/found/$driver-" "$built/corpus/$driver" "$seeds/$driver" \
    >"$built/$driver.log" 2>&1 || status=1
  say "fuzz_$driver: $(grep -E 'number_of_executed_units|SUMMARY' "$built/$driver.log" | tr '\n' ' ')"
done
exit $status
