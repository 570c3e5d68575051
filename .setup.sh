# Functions of ./demo and ./check; to be sourced by bash. Expects $root, the project's folder.
# Requires only what every Debian has: coreutils, grep, dpkg, apt.

trap 'exit 130' INT TERM HUP

say() { printf '%s\n' "$*"; }
stop() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# run_logged LOG COMMAND...: output goes to LOG; if COMMAND fails, the end of LOG is printed.
run_logged() {
  local log=$1
  shift
  if ! "$@" >>"$log" 2>&1 </dev/null; then
    tail -n 40 "$log" >&2
    stop "command failed: $* (full log: $log)"
  fi
}

# Refuses what the viewer would refuse after the build: names of no file or built-in scene. A test
# compares the lists with the program's.
check_scene() {
  local built_in='sphere-flake cornell-box furnace boards rooms stars gallery flatland'
  local endings='obj gltf glb ply stl off rad vs3 vtp vtk'
  local name=${1%%:*} ending=${1##*.}
  case " $built_in " in
    *" $name "*) return ;;
  esac
  [ -f "$1" ] || stop "$1: no such file or built-in scene (built-in: $built_in)"
  case " $endings " in
    *" ${ending,,} "*) ;;
    *) stop "$1: not a scene file (endings: $endings)" ;;
  esac
}

# Refuses what ctest has no option for; it ignores such words. An option's value is no option.
check_ctest_options() {
  local line name takes_value='' word value_of=''
  local -A known=()
  # Lines such as "  -j <jobs>, --parallel <jobs> = Run …" and "  -V,--verbose = Enable …".
  while IFS= read -r line; do
    line=${line%% = *}
    takes_value=''
    case $line in *'<'* | *' ['*) takes_value=yes ;; esac
    for name in $(grep -oE '(^|[ ,])--?[A-Za-z][A-Za-z-]*' <<<"$line" | tr -d ' ,'); do
      known[$name]=$takes_value
    done
  done < <(ctest --help | grep -E '^  -')
  for word; do
    if [ -n "$value_of" ]; then
      value_of=''
      continue
    fi
    case $word in
      -j[0-9]*) continue ;;
      -*) name=${word%%=*} ;;
      *) stop "\"$word\" is no option of ctest (see ctest --help)" ;;
    esac
    [ -n "${known[$name]+set}" ] || stop "$word: ctest has no such option (see ctest --help)"
    [ "$name" != "$word" ] || [ -z "${known[$name]}" ] || value_of=$word
  done
  [ -z "$value_of" ] || stop "$value_of: the value is missing (see ctest --help)"
}

missing_packages() {
  local package
  grep -v '^ *\(#\|$\)' "$root/.packages" | while read -r package; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
      echo "$package"
  done
}

install_missing_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "Not a Debian system: assuming that the packages in .packages are installed."
    return
  fi
  local missing as_root=() log=$root/build/packages.log
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || stop "these packages are missing, and installing them requires root: ${missing[*]}"
    as_root=(sudo)
    sudo true || stop "these packages are missing: ${missing[*]}"
  fi
  mkdir -p "$root/build"
  : >"$log"
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  say "Installing ${#missing[@]} packages and their dependencies: ${missing[*]}"
  # Finishes an installation that was interrupted before.
  run_logged "$log" "${as_root[@]}" dpkg --configure -a
  run_logged "$log" "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update
  run_logged "$log" "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 install -y \
    --no-install-recommends "${missing[@]}"
}

# One job per core, and at most one per 2 GB of free memory.
job_count() {
  local cores memory=0
  cores=$(nproc)
  [ -r /proc/meminfo ] && memory=$(($(sed -n 's/^MemAvailable: *\([0-9]*\).*/\1/p' /proc/meminfo) / 2000000))
  if [ "$memory" -lt "$cores" ]; then cores=$memory; fi
  if [ "$cores" -lt 1 ]; then cores=1; fi
  echo "$cores"
}

# ccache, if installed, fails the build when it cannot write its files.
find_place_for_ccache() {
  [ -z "${CCACHE_DIR:-}" ] || return 0
  local cache=${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}
  if ! mkdir -p "$cache/ccache" 2>/dev/null || [ ! -w "$cache/ccache" ]; then
    export CCACHE_DIR=$root/build/ccache
  fi
}

# build PRESET TARGET...: configures and builds into build/PRESET; the log is build/PRESET/build.log.
build() {
  local preset=$1 line
  shift
  local folder=$root/build/$preset
  local log=$folder/build.log
  mkdir -p "$folder"
  find_place_for_ccache
  : >"$log"
  (cd "$root" && run_logged "$log" cmake --preset "$preset") || exit 1
  [ ! -t 1 ] && say "Building ($preset), log in build/$preset/build.log"
  set -o pipefail
  NINJA_STATUS='[%f/%t] ' nice cmake --build "$folder" -j "$(job_count)" --target "$@" 2>&1 </dev/null |
    tee -a "$log" | while IFS= read -r line; do
    case $line in
      '['*) [ ! -t 1 ] || printf '\rBuilding (%s) %s\033[K' "$preset" "${line%%]*}]" ;;
    esac
  done || {
    [ ! -t 1 ] || printf '\r\033[K'
    grep -A 20 'FAILED:\|[Ee]rror:\|CMake Error\|^ninja: ' "$log" | head -n 60 >&2
    stop "the build failed (full log: $log)"
  }
  [ ! -t 1 ] || printf '\r\033[K'
}

# built_programs PRESET SECONDS: what was built, and where it is.
built_programs() {
  local folder=build/$1/bin program
  say "Built in $(($2 / 60)) min $(($2 % 60)) s, in $root:"
  for program in transillum transillum-viewer transillum-mpi; do
    [ ! -x "$root/$folder/$program" ] || say "  $folder/$program"
  done
  say "  build/$1/lib/libtransillum.so"
}

# Starts a virtual display, which ends with this script. Without -noreset the server would restart,
# and refuse connections meanwhile, whenever its last client disconnects.
start_display() {
  local number
  exec 7< <(exec Xvfb -displayfd 1 -screen 0 1600x1000x24 +extension GLX -nolisten tcp -noreset 2>/dev/null)
  display_process=$!
  trap stop_display EXIT
  read -r -t 60 -u 7 number || stop "Xvfb did not start"
  export DISPLAY=:$number
  unset WAYLAND_DISPLAY
  # Without this folder Qt prints a warning.
  if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    export XDG_RUNTIME_DIR=$root/build/runtime
    mkdir -p "$XDG_RUNTIME_DIR"
    chmod 700 "$XDG_RUNTIME_DIR"
  fi
}

stop_display() {
  kill "$display_process" 2>/dev/null
  return 0
}
