#!/usr/bin/env bash
# Installs what is needed, builds everything with warnings as errors and runs all tests.
# usage: bash tests/run.sh [PRESET]   PRESET: ci (default), asan, tsan, dev
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
. "$top/app/setup.sh"
preset=${1:-ci}

install_packages "${build_packages[@]}" "${run_packages[@]}" xvfb xauth libxtst6
build "$preset"

[ -e "${VOLUMEN_DATA:-$top/../shared/data}/MANIFEST.tsv" ] ||
  say "the real test data (../shared/data or \$VOLUMEN_DATA) are not here: tests that need them are skipped"
log=$top/build/$preset/tests.log
say "running the tests"
status=0
# Qt's stack dump on a crash waits for a debugger; a crash should just fail.
QTEST_DISABLE_STACK_DUMP=1 ctest --test-dir "$top/build/$preset" --output-on-failure --no-tests=error -j 2 \
  --output-log "$log" -V >"$top/build/$preset/tests.out" 2>&1 || status=$?
grep -E 'Test +#|% tests passed|FAIL!|The following tests FAILED|^[[:space:]]+[0-9]+ - ' "$top/build/$preset/tests.out" | sed 's/^[0-9]*: //' >&2 || true
if [ $status -ne 0 ]; then
  grep -E -A4 'FAIL!|QFATAL|ERROR: AddressSanitizer|runtime error' "$top/build/$preset/tests.out" >&2 | sed -n 1,200p || true
fi
passed=$(grep -cE '^[0-9]+: PASS' "$log" || true)
skipped=$(grep -cE '^[0-9]+: SKIP' "$log" || true)
sed -n 's|.*longestFilesAndFunctions() ||p' "$top/build/$preset/tests.out" >&2 || true
say "$passed test rows passed, $skipped skipped; everything is in $log"
[ "$skipped" -eq 0 ] || grep -E '^[0-9]+: SKIP' "$log" | sed 's/^[0-9]*: //' | sort | uniq -c | sort -rn | sed -n 1,20p >&2
exit $status
