# Shared by the scripts beside it; sourced, not run.
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
scripts="$root/scripts"
build="$root/build"

say() { printf '== %s\n' "$*" >&2; }
die() { printf 'error: %s\n' "$*" >&2; exit 1; }

# help_if_asked ARGS…: prints the comment block at the top of the calling script when --help or -h comes first.
help_if_asked() {
  case "${1:-}" in
    -h | --help)
      sed -n '2,/^[^#]/{/^#/s/^# \{0,1\}//p}' "$0"
      exit 0
      ;;
  esac
}

# timed NAME COMMAND…: runs the command and says how long it took.
timed() {
  local name="$1" start="$SECONDS"
  shift
  "$@"
  say "$name: $((SECONDS - start)) s"
}

# compiler_jobs: compilers to run at once, one a core and one per 2 GB of free memory (a deal.II file takes about that much).
compiler_jobs() {
  local cores memory
  cores="$(nproc)"
  memory="$(awk '/^MemAvailable/ { print int($2 / 2000000) }' /proc/meminfo)"
  ((memory < 1)) && memory=1
  echo "${SNUG_JOBS:-$((cores < memory ? cores : memory))}"
}

# source_state: commit of the source, for reports.
source_state() {
  printf 'commit %s' "$(git -C "$root" log -1 --format='%h')"
  git -C "$root" diff --quiet HEAD || printf ' with changes not committed'
}

# machine_state: processor, cores and load, for reports.
machine_state() {
  printf '%s, %s cores, load average %s at the end' \
    "$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)" "$(nproc)" "$(cut -d' ' -f1 /proc/loadavg)"
}
