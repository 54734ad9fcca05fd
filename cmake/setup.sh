# Sourced by samples/run and tests/run: installs what is missing on a Debian machine, configures and builds.
# Every step that fails ends the script with a plain sentence.

hf_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

hf_say() { printf '== %s\n' "$*"; }
hf_fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

hf_yes=0  # 1: packages are installed without asking

# Asks a yes-or-no question on the terminal; no terminal is no.
hf_ask() {
  local answer=
  { [ -t 0 ] || [ -t 1 ]; } && [ -r /dev/tty ] || return 1
  printf '%s [y/N] ' "$1" >/dev/tty
  read -r answer </dev/tty || return 1
  case "$answer" in y | Y | yes | Yes) return 0 ;; *) return 1 ;; esac
}

# Installs the packages of a list whose command or file is not there. Asks first, unless it runs as root or hf_yes is 1.
hf_install_packages() {
  local list=$1 missing=() name probe
  while read -r name probe; do
    case "$name" in '' | '#'*) continue ;; esac
    case "$probe" in
      command:*) command -v "${probe#command:}" >/dev/null 2>&1 || missing+=("$name") ;;
      file:*) [ -e "${probe#file:}" ] || missing+=("$name") ;;
    esac
  done <"$list"
  [ ${#missing[@]} -eq 0 ] && return 0
  command -v apt-get >/dev/null 2>&1 || hf_fail "these packages are missing and there is no apt-get to install them: ${missing[*]}"
  local sudo=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 || hf_fail "these packages are missing; install them as root: ${missing[*]}"
    sudo=sudo
    if [ "$hf_yes" -ne 1 ] && ! hf_ask "These Debian packages are missing: ${missing[*]}. Install them with sudo apt-get?"; then
      hf_fail "nothing was installed. Run again with --yes, or do: sudo apt-get install ${missing[*]}"
    fi
  fi
  hf_say "installing ${missing[*]}"
  $sudo apt-get update -qq || hf_fail "apt-get update failed; is the machine connected to a Debian mirror?"
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
    hf_fail "apt-get could not install: ${missing[*]}"
}

# Reads what ninja prints, keeps it in LOG and shows how far it is: a bar that moves on a terminal, else a line a tenth.
hf_progress() {
  local log=$1 line done total tenth=0 begin=$SECONDS left bar width=30
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$log"
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    done=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
    left=
    [ "$done" -ge 5 ] && left=", about $(((SECONDS - begin) * (total - done) / done)) s left"
    if [ -t 1 ]; then
      printf -v bar '%*s' $((width * done / total)) ''
      printf '\r   [%-*s] %d of %d%s \033[K' "$width" "${bar// /#}" "$done" "$total" "$left"
    elif [ $((10 * done / total)) -gt "$tenth" ]; then
      tenth=$((10 * done / total))
      printf '   %d of %d%s\n' "$done" "$total" "$left"
    fi
  done
  [ -t 1 ] && [ -n "${total:-}" ] && printf '\n'
  return 0
}

# Configures and builds a preset (release, dev, ...), targets optional.
hf_build() {
  local preset=$1 log="$hf_root/build/$1.log" targets=() begin=$SECONDS
  shift
  mkdir -p "$hf_root/build"
  hf_say "building (preset $preset)"
  (cd "$hf_root" && cmake --preset "$preset" >"$log" 2>&1) || {
    tail -30 "$log" >&2
    hf_fail "cmake could not configure preset $preset; the log is build/$preset.log"
  }
  [ $# -gt 0 ] && targets=(--target "$@")
  (cd "$hf_root" && set -o pipefail &&
    NINJA_STATUS='[%f/%t] ' cmake --build --preset "$preset" -j "$(nproc)" "${targets[@]}" 2>&1 | hf_progress "$log") || {
    grep -E 'error|FAILED' "$log" | head -30 >&2
    hf_fail "the build of preset $preset failed; the log is build/$preset.log"
  }
  hf_say "built in $((SECONDS - begin)) s"
}

# The npm packages of a folder with a lock file (FROM), installed into another (TO): the versions and hashes of the lock
# file, and no install script runs. Returns 1 when there is no npm, or nothing to install from.
hf_install_locked() {
  local from=$1 folder=$2
  command -v npm >/dev/null 2>&1 || return 1
  [ -d "$folder/node_modules" ] && cmp -s "$from/package-lock.json" "$folder/installed.json" && return 0
  mkdir -p "$folder"
  hf_say "installing the npm packages of ${from#"$hf_root"/}"
  rm -f "$folder/installed.json"
  cp "$from/package.json" "$from/package-lock.json" "$folder/" || return 1
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1) || {
    hf_say "npm could not install them; the log is $folder/npm.log"
    return 1
  }
  cp "$from/package-lock.json" "$folder/installed.json"
}

# The npm packages of the tests: koffi, three.js, playwright-core, axe-core and the Khronos glTF validator.
hf_install_node_modules() { hf_install_locked "$hf_root/tests/npm" "$hf_root/build/npm"; }
