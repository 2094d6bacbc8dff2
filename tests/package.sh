#!/usr/bin/env bash
# Packs volumen as it was built, and installs, uses and removes the package as a user would.
# usage: bash tests/package.sh BUILD_FOLDER | PACKAGE.deb   PACKAGE.deb: only installs, uses and removes it
# To install it takes root on Debian 12, xvfb, xdg-utils, desktop-file-utils, shared-mime-info and libglib2.0-bin.
set -euo pipefail
folder=$(mktemp -d)
installed=
trap '[ -z "$installed" ] || dpkg -P volumen >/dev/null 2>&1 || true; rm -rf "$folder"' EXIT
# What the user has set is not asked, and stays as it is.
export HOME=$folder/home XDG_CONFIG_HOME=$folder/home/config XDG_DATA_HOME=$folder/home/data XDG_CACHE_HOME=$folder/home/cache
unset DISPLAY WAYLAND_DISPLAY XDG_DATA_DIRS XDG_CONFIG_DIRS XDG_CURRENT_DESKTOP DESKTOP_SESSION QT_QPA_PLATFORM
mkdir -p "$HOME"

# As Qt Test says it, for tests/run.sh.
pass() { echo "PASS   : package::$1()"; }
skip() { echo "SKIP   : package::$1() $2"; }
fail() { echo "FAIL!  : package::$1() $2"; exit 1; }
# same TEST WHAT EXPECTED IS
same() { [ "$3" = "$4" ] || fail "$1" "$2: \"$4\" instead of \"$3\""; }
installed_files() { find /usr /etc /var/lib -xdev -iname '*volumen*' 2>/dev/null | sort; }

pack() {
  (cd "$1" && cpack --config CPackConfig.cmake -B "$folder/packages") >"$folder/cpack.log" 2>&1 || {
    cat "$folder/cpack.log"
    fail packs "cpack failed"
  }
  package=$(echo "$folder"/packages/volumen_*.deb)
  local symbols=$folder/symbols built
  same packs "version in resources/package/changelog" "volumen ($(dpkg-deb -f "$package" Version))" \
    "$(dpkg-deb --fsys-tarfile "$package" | tar -xO ./usr/share/doc/volumen/changelog.gz | zcat | sed -n '1s/).*/)/p')"
  dpkg-deb -x "$(echo "$folder"/packages/volumen-dbgsym_*.ddeb)" "$symbols"
  built=$(readelf -n "$1/app/volumen" | sed -n 's/.*Build ID: //p')
  [ -s "$symbols/usr/lib/debug/.build-id/${built:0:2}/${built:2}.debug" ] || fail packs "there are no symbols of $built"
  pass packs
}

check_with_lintian() {
  command -v lintian >/dev/null || { skip lintianFindsNoErrors "lintian is not installed"; return; }
  lintian --allow-root --fail-on error "$package" "$folder"/packages/volumen-dbgsym_*.ddeb || fail lintianFindsNoErrors "see above"
  pass lintianFindsNoErrors
}

# Unpacked by somebody without root, into a folder of any name.
try_tar() {
  mkdir "$folder/any name"
  tar -xzf "$folder"/packages/volumen-*.tar.gz -C "$folder/any name" --strip-components=1
  use tarRunsAnywhere "$folder/any name/bin/volumen" "$1/app/volumen"
  [ -s "$folder/any name/share/doc/volumen/LICENSE" ] || fail tarRunsAnywhere "the licence is missing"
  pass tarRunsAnywhere
}

# use TEST PROGRAM [BUILT]: it says its version and renders a sample, both as the program that was built does.
use() {
  local test=$1 program=$2 built=${3:-}
  "$program" --version >"$folder/version" || fail "$test" "--version ended with status $?"
  "$program" render phantom:ct-head:64 --size 96x96 -o "$folder/sample.png" >/dev/null || fail "$test" "render ended with status $?"
  same "$test" "the picture begins with" PNG "$(head -c 4 "$folder/sample.png" | tail -c 3)"
  [ -n "$built" ] || return 0
  same "$test" "--version" "$("$built" --version)" "$(cat "$folder/version")"
  "$built" render phantom:ct-head:64 --size 96x96 -o "$folder/expected.png" >/dev/null
  cmp "$folder/sample.png" "$folder/expected.png" || fail "$test" "it renders another picture"
}

# Why the package cannot be installed here; nothing if it can.
hindrance() {
  [ "$(id -u)" -eq 0 ] || { echo "only root can install a package"; return; }
  grep -qs '^VERSION_ID="12"' /etc/os-release && grep -q '^ID=debian' /etc/os-release || { echo "this is no Debian 12"; return; }
  ! dpkg-query -W volumen >/dev/null 2>&1 || { echo "volumen is installed here, and stays"; return; }
  local program
  for program in xvfb-run xdg-mime gio update-desktop-database update-mime-database; do
    command -v "$program" >/dev/null || { echo "$program is not installed"; return; }
  done
}

# open_by_desktop FILE: as a double click in the file manager does: by its type the desktop file, whose Exec line is run.
open_by_desktop() {
  xvfb-run -a timeout 90 bash -c 'gio open "$1"
    until grep -rqsF "${1##*/}" "$XDG_CONFIG_HOME/volumen"; do sleep 0.2; done' open "$1" >"$folder/open.log" 2>&1 || {
    cat "$folder/open.log"
    fail opensFromTheFileManager "${1##*/} is not among the files opened"
  }
}

install_and_remove() {
  local reason type before
  reason=$(hindrance)
  [ -z "$reason" ] || { skip installs "$reason"; return; }
  before=$(installed_files)
  installed=1
  dpkg -i "$package" >"$folder/dpkg.log" 2>&1 ||
    DEBIAN_FRONTEND=noninteractive apt-get install -f -y --no-install-recommends >>"$folder/dpkg.log" 2>&1 || {
    cat "$folder/dpkg.log"
    fail installs "neither dpkg -i nor apt-get install -f installed it"
  }
  use installs volumen "$@"
  pass installs

  for type in application/dicom application/x-nrrd application/x-volumen-session x-scheme-handler/volumen; do
    same isAssociated "what opens $type" volumen.desktop "$(xdg-mime query default "$type")"
  done
  volumen convert phantom:ct-head:24 -o "$folder/scans/" >/dev/null
  cp "$(find "$folder/scans" -type f | head -1)" "$folder/scan without ending"
  volumen convert phantom:ct-head:24 -o "$folder/a volume.nrrd" >/dev/null
  echo '{"volumenSession": 1}' >"$folder/left.volumen"
  same isAssociated "the type of a session" application/x-volumen-session \
    "$(gio info -a standard::content-type "$folder/left.volumen" | sed -n 's/.*content-type: //p')"
  pass isAssociated

  open_by_desktop "$folder/scan without ending"
  open_by_desktop "$folder/a volume.nrrd"
  pass opensFromTheFileManager

  dpkg -P volumen >/dev/null || fail leavesNothing "dpkg -P ended with status $?"
  installed=
  same leavesNothing "files of the package" "$before" "$(installed_files)"
  same leavesNothing "what opens application/x-nrrd" "" "$(xdg-mime query default application/x-nrrd)"
  pass leavesNothing
}

for program in dpkg-deb dpkg-shlibdeps file readelf; do
  [[ $1 == *.deb ]] || command -v "$program" >/dev/null || { skip packs "$program is not installed"; exit 0; }
done
case $1 in
  *.deb) package=$1; install_and_remove ;;
  *) pack "$1"; check_with_lintian; try_tar "$1"; install_and_remove "$1/app/volumen" ;;
esac
