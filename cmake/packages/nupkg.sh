#!/usr/bin/env bash
# Hf.Fields.VERSION.nupkg: an assembly for .NET Framework and Mono, the sources for .NET 6 and later (this machine has no
# compiler for it), and the native library of each platform as runtimes/RID/native.
. "$(dirname "$0")/common.sh"

nupkg_make() {
  local out=$1 folder platform rid
  command -v mcs >/dev/null || hf_skip "no C# compiler here (Debian: mono-mcs)"
  folder=$(mktemp -d) || exit 1
  mkdir -p "$folder/lib/net45" "$folder/lib/net6.0" "$folder/contentFiles/cs/net6.0/Hf" "$folder/build/net45" "$folder/build/net6.0" \
    "$folder/_rels" "$folder/package/services/metadata/core-properties"
  hf_quiet mcs -langversion:latest -optimize -unsafe -target:library -out:"$folder/lib/net45/Hf.dll" "$hf_root"/bindings/csharp/Hf/*.cs
  hf_pack assembly "$folder/lib/net45/Hf.dll" || exit 1
  : >"$folder/lib/net6.0/_._"
  cp "$hf_root"/bindings/csharp/Hf/*.cs "$folder/contentFiles/cs/net6.0/Hf/"
  cp "$hf_root/bindings/csharp/README.md" "$folder/"
  for platform in $(hf_platforms); do
    rid=${platform/windows/win}
    mkdir -p "$folder/runtimes/$rid/native"
    cp "$(hf_library "$platform")" "$folder/runtimes/$rid/native/$(hf_library_name "$platform")"
    chmod 644 "$folder/runtimes/$rid/native"/*
  done
  # .NET takes runtimes/RID/native by itself; the Framework and Mono get the library beside the program
  cat >"$folder/build/net45/Hf.Fields.targets" <<'XML'
<Project xmlns="http://schemas.microsoft.com/developer/msbuild/2003">
  <ItemGroup>
    <None Condition="'$(OS)' == 'Windows_NT'" Include="$(MSBuildThisFileDirectory)..\..\runtimes\win-x64\native\hf.dll">
      <Link>hf.dll</Link><CopyToOutputDirectory>PreserveNewest</CopyToOutputDirectory>
    </None>
    <None Condition="'$(OS)' != 'Windows_NT'" Include="$(MSBuildThisFileDirectory)..\..\runtimes\linux-x64\native\libhf.so">
      <Link>libhf.so</Link><CopyToOutputDirectory>PreserveNewest</CopyToOutputDirectory>
    </None>
  </ItemGroup>
</Project>
XML
  printf '<Project>\n  <PropertyGroup>\n    <AllowUnsafeBlocks>true</AllowUnsafeBlocks>\n  </PropertyGroup>\n</Project>\n' >"$folder/build/net6.0/Hf.Fields.props"
  hf_licences "$folder/licences" "$(hf_platforms | paste -sd,)"
  hf_bom "$folder/bom.cdx.json" "$(hf_platforms | paste -sd,)" "$folder"
  cat >"$folder/Hf.Fields.nuspec" <<XML
<?xml version="1.0" encoding="utf-8"?>
<package xmlns="http://schemas.microsoft.com/packaging/2013/05/nuspec.xsd">
  <metadata minClientVersion="3.3">
    <id>Hf.Fields</id>
    <version>$hf_version</version>
    <authors>The hf authors</authors>
    <license type="expression">MIT</license>
    <projectUrl>https://hf.example.org</projectUrl>
    <repository type="git" url="https://hf.example.org/hf.git" />
    <readme>README.md</readme>
    <description>Dynamic harmonic fields: fields, posing and motion transfer on surfaces. Classes over the native library hf.</description>
    <tags>geometry mesh deformation harmonic animation</tags>
    <dependencies>
      <group targetFramework=".NETFramework4.5" />
      <group targetFramework="net6.0" />
    </dependencies>
    <contentFiles>
      <files include="cs/net6.0/Hf/*.cs" buildAction="Compile" copyToOutput="false" />
    </contentFiles>
  </metadata>
</package>
XML
  # the frame of the package format: what kinds of files there are, and which one describes the package
  python3 - "$folder" <<'PY'
import pathlib, sys
folder = pathlib.Path(sys.argv[1])
kinds = sorted({path.suffix[1:] for path in folder.rglob("*") if path.is_file() and path.suffix} | {"rels", "psmdcp"})
defaults = {"rels": "application/vnd.openxmlformats-package.relationships+xml", "psmdcp": "application/vnd.openxmlformats-package.core-properties+xml"}
lines = [f'  <Default Extension="{kind}" ContentType="{defaults.get(kind, "application/octet")}" />' for kind in kinds]
lines += [f'  <Override PartName="/{path.relative_to(folder).as_posix()}" ContentType="application/octet" />'
          for path in sorted(folder.rglob("*")) if path.is_file() and not path.suffix]
head = '<?xml version="1.0" encoding="utf-8"?>\n'
(folder / "[Content_Types].xml").write_text(head + '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">\n' + "\n".join(lines) + "\n</Types>\n")
(folder / "_rels/.rels").write_text(head + '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">\n'
  '  <Relationship Type="http://schemas.microsoft.com/packaging/2010/07/manifest" Target="/Hf.Fields.nuspec" Id="R1" />\n'
  '  <Relationship Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/core-properties" '
  'Target="/package/services/metadata/core-properties/hf.psmdcp" Id="R2" />\n</Relationships>\n')
(folder / "package/services/metadata/core-properties/hf.psmdcp").write_text(head +
  '<coreProperties xmlns:dc="http://purl.org/dc/elements/1.1/" xmlns="http://schemas.openxmlformats.org/package/2006/metadata/core-properties">\n'
  '  <dc:creator>The hf authors</dc:creator>\n  <dc:identifier>Hf.Fields</dc:identifier>\n</coreProperties>\n')
PY
  hf_pack zip "$out/Hf.Fields.$hf_version.nupkg" "$folder" .
  rm -rf "$folder"
}

nupkg_try() {
  local out=$1 scratch=$2 filled platform rid
  command -v mono >/dev/null || hf_skip "no Mono here (Debian: mono-runtime libmono-system-core4.0-cil)"
  filled=$(hf_filled) || exit 1
  (mkdir "$scratch/package" "$scratch/app" && cd "$scratch/package" && python3 -m zipfile -e "$out/Hf.Fields.$hf_version.nupkg" .) || exit 1
  python3 - "$scratch/package" <<'PY' || hf_fail "the package's own descriptions"
import pathlib, sys, xml.dom.minidom
folder = pathlib.Path(sys.argv[1])
for path in [*folder.rglob("*.nuspec"), *folder.rglob("*.xml"), *folder.rglob("*.rels"), *folder.rglob("*.targets"), *folder.rglob("*.props"), *folder.rglob("*.psmdcp")]:
    xml.dom.minidom.parse(str(path))
PY
  # as build/net45/Hf.Fields.targets lays them out
  cp "$scratch/package/lib/net45/Hf.dll" "$scratch/package/runtimes/linux-x64/native/libhf.so" "$scratch/app/"
  hf_quiet mcs -langversion:latest -unsafe -r:"$scratch/app/Hf.dll" -r:System.Core -out:"$scratch/app/golden.exe" "$hf_tests"/Golden*.cs "$hf_tests/Json.cs"
  (cd "$scratch" && "${hf_clean_env[@]}" mono "$scratch/app/golden.exe" "$hf_golden/meshes" "$filled" "$hf_golden/bad_input.json") >"$scratch/golden.log" 2>&1 || {
    tail -10 "$scratch/golden.log" >&2
    hf_fail "golden scenes of the assembly"
  }
  # the sources of the other frameworks compile by themselves
  hf_quiet mcs -langversion:latest -unsafe -target:library -out:"$scratch/sources.dll" "$scratch/package/contentFiles/cs/net6.0/Hf"/*.cs
  for platform in $(hf_platforms); do
    rid=${platform/windows/win}
    cmp -s "$(hf_library "$platform")" "$scratch/package/runtimes/$rid/native/$(hf_library_name "$platform")" || hf_fail "runtimes/$rid"
  done
  hf_ran "the assembly and libhf.so of the package under Mono: golden scenes, bad calls, lifetimes; the sources compile; no .NET here"
}

case "$1" in
  make) nupkg_make "$2" ;;
  try) nupkg_try "$2" "$3" ;;
esac
