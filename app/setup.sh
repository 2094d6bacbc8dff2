# Sourced by app/run.sh and tests/run.sh: installs what they need on Debian 12 and builds. Says what it does; quick when done before.

say() { printf '== %s\n' "$*" >&2; }

# show_usage_if_asked SCRIPT WORD [OPTION]: on -h and --help the comment at the script's head; its usage on options other than OPTION.
show_usage_if_asked() {
  case $2 in
    "${3:-}") ;;
    -h | --help) sed -n '2,/^[^#]/s/^# //p' "$1"; exit 0 ;;
    -*) say "unknown option $2"; sed -n 's/^# usage: /usage: /p' "$1" >&2; exit 2 ;;
  esac
}

# install_packages NAME...: installs those that are missing; as root, or through sudo, else names them and stops.
install_packages() {
  local missing=() p
  for p in "$@"; do
    dpkg-query -W -f='${Status}' "$p" 2>/dev/null | grep -q '^install ok installed' || missing+=("$p")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local run=()
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      run=(sudo)
    else
      say "these packages are missing; install them and start again: apt-get install ${missing[*]}"
      exit 1
    fi
  fi
  say "installing ${#missing[@]} packages: ${missing[*]}"
  "${run[@]}" apt-get update -qq >&2
  "${run[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

build_packages=(g++ cmake ninja-build pkg-config qt6-base-dev libqt6opengl6-dev qt6-svg-dev libglm-dev libtbb-dev
  libhwy-dev libdcmtk-dev libopenjp2-7-dev zlib1g-dev libbz2-dev libarchive-dev libepoxy-dev libegl-dev libgl-dev
  libcli11-dev nlohmann-json3-dev libinsighttoolkit5-dev fonts-dejavu-core)
run_packages=(qt6-qpa-plugins libqt6sql6-sqlite libqt6svg6 libgl1-mesa-dri libegl-mesa0 libegl1 libgl1)

# build PRESET [TARGET...]: configures where that was not done and builds.
build() {
  local preset=$1
  shift
  say "building (preset $preset) in $top/build/$preset"
  cmake -S "$top" --preset "$preset" >"$top/build-$preset.log" 2>&1 || { cat "$top/build-$preset.log" >&2; exit 1; }
  rm -f "$top/build-$preset.log"
  cmake --build "$top/build/$preset" ${1:+--target "$@"} >&2
}
