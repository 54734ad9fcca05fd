"""Puts the shared library into the package: the file that HF_LIBRARY names, or the one in the folder hf. Without either the
install fails with a sentence, and not the first call."""

import os
import pathlib
import shutil

from setuptools import setup
from setuptools.command.build_py import build_py

NAMES = {".so": "libhf.so", ".dll": "hf.dll", ".dylib": "libhf.dylib"}


class WithLibrary(build_py):
    def run(self):
        for name in NAMES.values():  # of an install before this one
            pathlib.Path(self.build_lib, "hf", name).unlink(missing_ok=True)
        super().run()
        if getattr(self, "editable_mode", False):  # the sources are used where they are
            return
        folder, given = pathlib.Path(self.build_lib, "hf"), os.environ.get("HF_LIBRARY")
        if given:
            library = pathlib.Path(given).resolve()
            if not library.is_file():
                raise SystemExit(f"error: HF_LIBRARY names {given}, which is not there")
            name = next((n for suffix, n in NAMES.items() if suffix in library.suffixes), NAMES[".so"])
            shutil.copyfile(library, folder / name)
        if not any((folder / name).exists() for name in NAMES.values()):
            raise SystemExit("error: this package would have no hf library. Build it (cmake --preset library && cmake --build --preset library), "
                             "set HF_LIBRARY to the file (build/library/src/libhf.so), and install again")


setup(cmdclass={"build_py": WithLibrary})
