#!/usr/bin/env bash
# hf-VERSION-conan.tar.gz: the recipe for Conan 2. Tried: conan builds it, static and shared, from the source archive by a
# file URL, and runs a C program against it. Eigen's recipe there is a stand-in over the headers of this machine.
. "$(dirname "$0")/common.sh"

case "$1" in
  make)
    folder=$(mktemp -d) || exit 1
    cp -r "$hf_here/conan" "$folder/hf-conan"
    rm -rf "$folder/hf-conan/__pycache__" "$folder/hf-conan/test_package"/{build,__pycache__,CMakeUserPresets.json}
    cp "$hf_root/tests/consumer/use_hf.c" "$folder/hf-conan/test_package/"
    archive="$hf_work/first/source/hf-$hf_version-source.tar.gz"
    [ -e "$archive" ] || { mkdir -p "${archive%/*}"; "$hf_here/source.sh" make "${archive%/*}"; } || exit 1
    # who publishes the archive puts its address here; the hash stays
    printf 'sources:\n  "%s":\n    url: "%s"\n    sha256: "%s"\n' "$hf_version" "hf-$hf_version-source.tar.gz" "$(sha256sum "$archive" | cut -d' ' -f1)" >"$folder/hf-conan/conandata.yml"
    hf_pack tar "$2/hf-$hf_version-conan.tar.gz" "$folder/hf-conan"
    rm -rf "$folder"
    ;;
  try)
    scratch=$3
    tools=$(hf_python_tools) || exit $?
    tar xzf "$2/hf-$hf_version-conan.tar.gz" -C "$scratch"
    sed -i "s|url: \"|url: \"file://$hf_work/first/source/|" "$scratch/hf-conan/conandata.yml"
    export CONAN_HOME="$scratch/home"
    hf_quiet "$tools/bin/conan" profile detect
    mkdir "$scratch/eigen"
    cat >"$scratch/eigen/conanfile.py" <<'PY'
from conan import ConanFile
from conan.tools.files import copy
class Eigen(ConanFile):
    name, version, package_type = "eigen", "3.4.0", "header-library"
    def package(self): copy(self, "*", "/usr/include/eigen3", self.package_folder + "/include/eigen3")
    def package_info(self):
        self.cpp_info.includedirs = ["include/eigen3"]
        self.cpp_info.set_property("cmake_file_name", "Eigen3")
        self.cpp_info.set_property("cmake_target_name", "Eigen3::Eigen")
PY
    hf_quiet "$tools/bin/conan" create "$scratch/eigen" -nr
    for shared in False True; do
      hf_quiet "$tools/bin/conan" create "$scratch/hf-conan" --version "$hf_version" -nr -o "hf/*:shared=$shared" -s compiler.cppstd=17 \
        -c tools.build:jobs="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" -c tools.cmake.cmaketoolchain:generator=Ninja
    done
    hf_ran "conan $("$tools/bin/conan" --version | sed 's/.* //') create from a file URL, static and shared; its C program ran; Eigen's recipe a stand-in"
    ;;
esac
