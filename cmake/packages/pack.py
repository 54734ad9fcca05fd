"""Writes packages whose bytes depend on their content alone: sorted names, no owners, one date (SOURCE_DATE_EPOCH).

usage: pack.py tar OUT.tar.gz FOLDER [NAME]   NAME: the folder inside, the name of FOLDER when it is not given
       pack.py zip OUT.zip FOLDER [NAME]      NAME: the same; "." for none
       pack.py wheel OUTDIR FOLDER PYPROJECT README TAG   FOLDER: what is installed; prints the file's name
       pack.py assembly FILE.dll              takes the date and the random identifier out of a .NET assembly
       pack.py sums OUT FILE...               SHA-256 of the files, as sha256sum writes and checks them
"""

import base64
import gzip
import hashlib
import io
import os
import pathlib
import struct
import sys
import tarfile
import time
import zipfile

EPOCH = int(os.environ["SOURCE_DATE_EPOCH"])


def entries(folder):
    """(path, name inside) of all files and links below a folder, sorted by name."""
    folder = pathlib.Path(folder)
    paths = (path for path in folder.rglob("*") if path.is_symlink() or path.is_file())
    return sorted(((path, path.relative_to(folder).as_posix()) for path in paths), key=lambda entry: entry[1])


def mode_of(path):
    return 0o755 if path.stat().st_mode & 0o100 else 0o644


def tar(out, folder, name=None):
    name = name or pathlib.Path(folder).name
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for path, inside in entries(folder):
            info = tarfile.TarInfo(f"{name}/{inside}")
            info.mtime = EPOCH
            if path.is_symlink():
                info.type, info.linkname, info.mode = tarfile.SYMTYPE, os.readlink(path), 0o777
                archive.addfile(info)
                continue
            data = path.read_bytes()
            info.size, info.mode = len(data), mode_of(path)
            archive.addfile(info, io.BytesIO(data))
    with open(out, "wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=EPOCH) as packed:
        packed.write(buffer.getvalue())


def zipped(out, folder, name=None, order=None):
    """Links become files: a zip is unpacked where there are none."""
    name = pathlib.Path(folder).name if name is None else name
    date = time.gmtime(max(EPOCH, 315532800))[:6]  # a zip knows no date before 1980
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path, inside in sorted(entries(folder), key=order) if order else entries(folder):
            info = zipfile.ZipInfo(inside if name == "." else f"{name}/{inside}", date)
            info.compress_type, info.create_system = zipfile.ZIP_DEFLATED, 3
            info.external_attr = (0o100000 | mode_of(path)) << 16
            archive.writestr(info, path.read_bytes(), compresslevel=9)


def wheel(outdir, folder, pyproject, readme, tag):
    import tomllib
    project = tomllib.loads(pathlib.Path(pyproject).read_text())["project"]
    name, folder = project["name"].replace("-", "_"), pathlib.Path(folder)
    info = folder / f"{name}-{project['version']}.dist-info"
    info.mkdir(exist_ok=True)
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}", f"Keywords: {','.join(project['keywords'])}"]
    lines += [f"Project-URL: {kind}, {url}" for kind, url in project["urls"].items()]
    lines += [f"Requires-Dist: {need}" for need in project["dependencies"]]
    lines += ["Description-Content-Type: text/markdown", "", pathlib.Path(readme).read_text()]
    (info / "METADATA").write_text("\n".join(lines))
    tags = [f"Tag: py3-none-{system}" for system in tag.split(".")]
    (info / "WHEEL").write_text("\n".join(["Wheel-Version: 1.0", "Generator: hf", "Root-Is-Purelib: false", *tags, ""]))
    rows = []
    for path, inside in entries(folder):
        if inside != f"{info.name}/RECORD":
            data = path.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            rows.append(f"{inside},sha256={digest},{len(data)}")
    (info / "RECORD").write_text("\n".join([*rows, f"{info.name}/RECORD,,", ""]))
    out = pathlib.Path(outdir) / f"{name}-{project['version']}-py3-none-{tag}.whl"
    # the description stands at the end of the file, as the format asks for
    zipped(out, folder, ".", lambda entry: (entry[1].startswith(info.name), entry[1]))
    print(out.name)


def assembly(path):
    """The identifier becomes a hash of the rest, so that it still tells two builds apart."""
    data = bytearray(pathlib.Path(path).read_bytes())
    header = struct.unpack_from("<I", data, 0x3C)[0]
    assert data[header:header + 4] == b"PE\0\0", "no assembly"
    struct.pack_into("<I", data, header + 8, 0)  # TimeDateStamp
    root = data.index(b"BSJB")
    at = root + 16 + struct.unpack_from("<I", data, root + 12)[0]
    count = struct.unpack_from("<H", data, at + 2)[0]
    at += 4
    for _ in range(count):
        offset, size = struct.unpack_from("<II", data, at)
        end = data.index(b"\0", at + 8)
        name = bytes(data[at + 8:end])
        at += 8 + (len(name) + 4) // 4 * 4
        if name == b"#GUID":
            assert size == 16, "more than one identifier"
            data[root + offset:root + offset + 16] = bytes(16)
            data[root + offset:root + offset + 16] = hashlib.sha256(data).digest()[:16]
            pathlib.Path(path).write_bytes(data)
            return
    raise AssertionError("no identifiers")


def sums(out, *files):
    lines = [f"{hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()}  {os.path.relpath(file, pathlib.Path(out).parent)}\n"
             for file in sorted(files)]
    pathlib.Path(out).write_text("".join(lines))


if __name__ == "__main__":
    commands = {"tar": tar, "zip": zipped, "wheel": wheel, "assembly": assembly, "sums": sums}
    if len(sys.argv) < 3 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](*sys.argv[2:])
