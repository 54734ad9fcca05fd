"""make_package.py OUTDIR [PLATFORM=LIBRARY...]: the UPM package, with the C# classes and the shared libraries in it.

PLATFORM: linux-x64, linux-arm64 or windows-x64. Every file and folder gets its .meta file: Unity ignores what has none in
an installed package. Identifiers are hashes of the path, so that scenes keep their references when the package is updated.
"""

import hashlib
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
NAME = "org.hf.fields"
# what Unity calls a platform: the editor's system, the player, the processor
PLATFORMS = {
    "linux-x64": ("Linux", "Standalone: Linux64", "x86_64"),
    "windows-x64": ("Windows", "Standalone: Win64", "x86_64"),
    "linux-arm64": (None, "EmbeddedLinux: EmbeddedLinux", "ARM64"),
}


def plugin(platform):
    """The importer's settings of a native library: the editor of its system and its player."""
    editor, player, processor = PLATFORMS[platform]
    rows = [("Any: ", 0, [])]
    rows.append(("Editor: Editor", int(editor is not None), [f"CPU: {processor}", "DefaultValueInitialized: true",
                                                             f"OS: {editor or 'AnyOS'}"]))
    rows.append((player, 1, [f"CPU: {processor}"]))
    lines = ["PluginImporter:", "  externalObjects: {}", "  serializedVersion: 2", "  isPreloaded: 0", "  isOverridable: 0",
             "  isExplicitlyReferenced: 0", "  validateReferences: 1", "  platformData:"]
    for first, enabled, settings in rows:
        lines += ["  - first:", f"      {first}", "    second:", f"      enabled: {enabled}"]
        lines += ["      settings:"] + [f"        {line}" for line in settings] if settings else ["      settings: {}"]
    return lines


def importer(path, plugins):
    if path in plugins:
        return plugin(plugins[path])
    kind = {".cs": "MonoImporter", ".asmdef": "AssemblyDefinitionImporter", ".json": "TextScriptImporter",
            ".md": "TextScriptImporter", ".txt": "TextScriptImporter"}.get(path.suffix, "DefaultImporter")
    if path.name == "package.json":
        kind = "PackageManifestImporter"
    return (["folderAsset: yes"] if path.is_dir() else []) + [f"{kind}:", "  externalObjects: {}"]


def write_metas(folder, plugins):
    for path in sorted(folder.rglob("*")):
        if path.suffix != ".meta":
            guid = hashlib.md5(f"{NAME}/{path.relative_to(folder).as_posix()}".encode()).hexdigest()
            lines = ["fileFormatVersion: 2", f"guid: {guid}", *importer(path, plugins),
                     "  userData: ", "  assetBundleName: ", "  assetBundleVariant: ", ""]
            path.with_name(path.name + ".meta").write_text("\n".join(lines))


def main(outdir, libraries):
    out = pathlib.Path(outdir) / NAME
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    for name in ("package.json", "README.md"):
        shutil.copy(HERE / name, out)
    shutil.copy(HERE.parents[1] / "LICENSE", out / "LICENSE.md")
    for name in ("Runtime", "Editor"):
        shutil.copytree(HERE / name, out / name)
    shutil.copytree(HERE.parent / "csharp" / "Hf", out / "Runtime" / "Hf")
    plugins = {}
    for argument in libraries:
        platform, library = argument.split("=", 1)
        name = "hf.dll" if platform.startswith("windows") else "libhf.so"
        (out / "Plugins" / platform).mkdir(parents=True)
        plugins[pathlib.Path(shutil.copyfile(library, out / "Plugins" / platform / name))] = platform
    write_metas(out, plugins)


if __name__ == "__main__":
    if len(sys.argv) < 2 or any(argument.split("=")[0] not in PLATFORMS for argument in sys.argv[2:]):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
