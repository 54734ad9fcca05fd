"""hf for Conan 2: builds the library of the source archive that conandata.yml names."""

import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get, rmdir


class HfRecipe(ConanFile):
    name = "hf"
    license = "MIT"
    homepage = "https://hf.example.org"
    url = "https://hf.example.org/hf.git"
    description = "Dynamic harmonic fields: fields, posing and motion transfer on surfaces"
    topics = ("geometry", "mesh", "deformation", "harmonic", "animation")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def validate(self):
        check_min_cppstd(self, 17)

    def layout(self):
        cmake_layout(self, src_folder="src")

    def requirements(self):
        self.requires("eigen/[>=3.4.0 <4]", visible=False)  # headers, compiled in

    def source(self):
        get(self, **self.conan_data["sources"][self.version], strip_root=True)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["CMAKE_UNITY_BUILD"] = True
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "hf")
        self.cpp_info.set_property("cmake_target_name", "hf::hf")
        self.cpp_info.set_property("pkg_config_name", "hf")
        self.cpp_info.libs = ["hf"]
        if not self.options.shared:
            self.cpp_info.defines = ["HF_STATIC"]
            if self.settings.os in ("Linux", "FreeBSD"):
                self.cpp_info.system_libs = ["m", "pthread", "stdc++"]
