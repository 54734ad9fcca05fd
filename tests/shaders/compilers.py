"""The compilers of the shading languages, where they are: each function returns None without its compiler."""

import ctypes
import importlib.util
import shutil
import subprocess
import tempfile
from array import array
from pathlib import Path

DXIL, SPIRV = 0, 1  # what compushady calls the two kinds of code


def naga(path):
    """Returns what naga says about a file in WGSL."""
    if not shutil.which("naga"):
        return None
    return subprocess.run(["naga", path], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True).stdout


def glslang(source, stage, *options):
    """Returns SPIR-V, or b"" of a stage of OpenGL (options without -V)."""
    program = shutil.which("glslangValidator")
    if not program:
        return None
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "made.spv"
        command = [program, "--stdin", "-S", stage, *options] + (["-o", made] if "-V" in options else [])
        done = subprocess.run(command, input=source, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert done.returncode == 0, done.stdout
        return made.read_bytes() if made.exists() else b""


def low_bindings(spirv):
    """Returns SPIR-V whose bindings are the numbers of registers: compushady has DXC add 1024 or 2048."""
    words = array("I", spirv)
    at = 5
    while at < len(words):
        if words[at] & 0xFFFF == 71 and words[at + 2] == 33:  # OpDecorate Binding
            words[at + 3] %= 1024
        at += words[at] >> 16
    return words.tobytes()


def dxc(source, profile="cs_6_0", entry="hf_main", code=SPIRV):
    """Returns SPIR-V or DXIL made by DXC, which the Python package compushady has."""
    found = importlib.util.find_spec("compushady")
    if not found:
        return None
    for library in Path(found.origin).parent.glob("backends/libdxcompiler*"):
        ctypes.CDLL(str(library), ctypes.RTLD_GLOBAL)  # compushady looks for it among what is loaded
    from compushady.backends import dxc as compiler
    made = bytes(compiler.compile(source, entry, code, profile))
    return low_bindings(made) if code == SPIRV else made
