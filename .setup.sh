# Shared by ./demo and ./check; to be sourced by bash. Expects $root, the project's folder.
# What it needs itself is part of every Debian: coreutils, grep, dpkg, apt.

trap 'exit 130' INT TERM HUP

say() { printf '%s\n' "$*"; }
stop() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# run_logged LOG COMMAND...: quiet, but the end of the log is shown where it fails.
run_logged() {
  local log=$1
  shift
  if ! "$@" >>"$log" 2>&1 </dev/null; then
    tail -n 40 "$log" >&2
    stop "this failed: $* (all of it: $log)"
  fi
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
    say "This is no Debian: taking for granted what .packages lists."
    return
  fi
  local missing as_root=() log=$root/build/packages.log
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || stop "these packages are missing, and installing them takes root: ${missing[*]}"
    as_root=(sudo)
    sudo true || stop "these packages are missing: ${missing[*]}"
  fi
  mkdir -p "$root/build"
  : >"$log"
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  say "Installing ${#missing[@]} packages and what they need: ${missing[*]}"
  # An installation that was interrupted before has to be finished first.
  run_logged "$log" "${as_root[@]}" dpkg --configure -a
  run_logged "$log" "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update
  run_logged "$log" "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 install -y \
    --no-install-recommends "${missing[@]}"
}

# A compiler may take 2 GB.
job_count() {
  local cores memory=0
  cores=$(nproc)
  [ -r /proc/meminfo ] && memory=$(($(sed -n 's/^MemAvailable: *\([0-9]*\).*/\1/p' /proc/meminfo) / 2000000))
  if [ "$memory" -lt "$cores" ]; then cores=$memory; fi
  if [ "$cores" -lt 1 ]; then cores=1; fi
  echo "$cores"
}

# ccache, where it is installed, stops a build when it cannot keep its files.
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
    grep -A 20 'FAILED\|rror' "$log" | head -n 60 >&2
    stop "the build failed (all of it: $log)"
  }
  [ ! -t 1 ] || printf '\r\033[K'
}

# A screen of its own, for programs that need one; gone when this script ends. Without -noreset it
# would start anew, and refuse programs meanwhile, whenever the last one leaves.
start_display() {
  local number
  exec 7< <(exec Xvfb -displayfd 1 -screen 0 1600x1000x24 +extension GLX -nolisten tcp -noreset 2>/dev/null)
  display_process=$!
  trap stop_display EXIT
  read -r -t 60 -u 7 number || stop "Xvfb did not start"
  export DISPLAY=:$number
  unset WAYLAND_DISPLAY
  # Qt talks about it where there is none.
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
