#!/usr/bin/env bash
# Installs what is needed, builds everything with warnings as errors and runs all tests.
# usage: bash tests/run.sh [--thorough] [PRESET]   PRESET: release (default), asan, tsan, dev
# --thorough: three times as many cases by chance or more, the same again from another seed, and all of the window under
# an X server, too
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
. "$top/app/setup.sh"
show_usage_if_asked "$0" "${1:-}" --thorough
thorough=
[ "${1:-}" != --thorough ] || { thorough=1; shift; }
preset=${1:-release}

install_packages "${build_packages[@]}" "${run_packages[@]}" xvfb xauth libxtst6 dcmtk orthanc orthanc-dicomweb openssl dicom3tools poppler-utils python3-pydicom python3-numpy fonts-noto-core fonts-cantarell \
  dpkg-dev file lintian xdg-utils desktop-file-utils shared-mime-info libglib2.0-bin munge slurmctld slurmd slurm-client parallel
build "$preset"

[ -e "${VOLUMEN_DATA:-$top/../shared/data}/MANIFEST.tsv" ] ||
  say "the real test data (../shared/data or \$VOLUMEN_DATA) are not here: tests that need them are skipped"
folder=$top/build/$preset
status=0
# Qt's stack dump on a crash waits for a debugger; a crash should just fail.
export QTEST_DISABLE_STACK_DUMP=1
[ -z "$thorough" ] || export VOLUMEN_THOROUGH=1

# run_tests NAME [ctest's options]: what fails of the tests, and which of them took longest; everything is in NAME.log.
run_tests() {
  local name=$1 out=$folder/$1.out log=$folder/$1.log
  shift
  # One more than there are cores: many tests wait for a window.
  ctest --test-dir "$folder" --no-tests=error -j "$(($(nproc) + 1))" --output-log "$log" -V "$@" >"$out" 2>&1 || status=$?
  grep -E '% tests passed|The following tests FAILED|^[[:space:]]+[0-9]+ - |Total Test time' "$out" >&2 || true
  grep -E -A4 'FAIL!|QFATAL|ERROR: AddressSanitizer|runtime error|no test class' "$out" | sed -n 1,200p >&2 || true
  say "the slowest, in seconds:"
  sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* ([0-9.]+) sec.*/\2 \1/p' "$out" | sort -rn | sed -n 1,12p >&2
  say "$(grep -cE '^[0-9]+: PASS' "$log") test rows passed, $(grep -cE '^[0-9]+: SKIP' "$log") skipped; everything is in $log"
  grep -E '^[0-9]+: SKIP' "$log" | sed 's/^[0-9]*: //' | sort | uniq -c | sort -rn | sed -n 1,20p >&2 || true
}

say "running the tests"
run_tests tests
if [ -n "$thorough" ]; then
  export VOLUMEN_RANDOM_SEED=$((RANDOM * 1000 + 10000))
  say "cases by chance once more, from seed $VOLUMEN_RANDOM_SEED on"
  by_chance=$(grep -rl 'seedsOf(' "$top/tests" --include=*.cpp | xargs sed -nE 's/^VOLUMEN_TEST\((.*)\);/\1/p' | paste -sd '|')
  run_tests by_chance -R "\\.($by_chance)\$"
  unset VOLUMEN_RANDOM_SEED
  say "the window under an X server"
  QT_QPA_PLATFORM=xcb LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1600x1000x24" "$folder/tests/ui/tst_ui" \
    >"$folder/window.out" 2>&1 || status=$?
  grep -E -A4 'FAIL!|QFATAL' "$folder/window.out" >&2 || true
fi
sed -n 's|.*longestFilesAndFunctions() ||p' "$folder/tests.out" >&2 || true
exit $status
