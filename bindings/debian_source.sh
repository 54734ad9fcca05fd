# Sourced by the build scripts: part of the source archive of a Debian package that this machine is set up with.

# hf_debian_source PACKAGE FOLDER PREFIX PATTERN...: unpacks what matches the patterns below FOLDER and prints the path of
# FOLDER/PREFIX-*; done once. Returns 77 with a sentence when the archive is not to be had.
hf_debian_source() {
  local package=$1 folder=$2 prefix=$3 found mirror apt
  shift 3
  found=$(find "$folder" -maxdepth 1 -name "$prefix-*" 2>/dev/null | head -1)
  if [ -z "$found" ]; then
    mkdir -p "$folder/lists/partial"
    . /etc/os-release
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 2>/dev/null |
      awk -v r="${VERSION_CODENAME:-}" '$2 == r && $3 == "main" { print $1; exit }')
    echo "deb-src ${mirror:-none:} ${VERSION_CODENAME:-stable} main" >"$folder/source.list"
    apt="apt-get -qq -o Dir::Etc::sourcelist=$folder/source.list -o Dir::Etc::sourceparts=- -o Dir::State::lists=$folder/lists"
    apt="$apt -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache="
    (cd "$folder" && $apt update && $apt source --download-only "$package") >"$folder/apt.log" 2>&1 || {
      echo "skipped: the source of $package is not to be had here (see $folder/apt.log)" >&2
      return 77
    }
    (cd "$folder" && tar xf "${package}"_*.orig.tar.* --wildcards "$@") >&2 || return 1
    found=$(find "$folder" -maxdepth 1 -name "$prefix-*" | head -1)
  fi
  echo "$found"
}
