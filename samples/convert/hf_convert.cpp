// Writes a model or a mesh in another format, and lists in one line the contents that it kept and lost.
#include <cstdio>
#include <stdexcept>

#include "common/program.h"
#include "convert/contents.h"
#include "gltf/file_kind.h"
#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"

namespace samples {
namespace {

const char usage[] =
    R"(usage: hf_convert IN OUT
  Writes the model or mesh of IN in the format of OUT, and lists in one line the contents that it kept and lost.
  IN    .gltf .glb .vrm .obj .off .ply .stl; where the build has assimp also .fbx .dae .bvh
  OUT   .gltf .glb .vrm .obj .off .ply .stl, chosen by the ending
  A model keeps its nodes, skins, clips, morph targets and materials in .gltf and .glb. The other formats get its surface
  at rest. A .vrm can be written only from a .vrm, because it needs a humanoid map and a licence.
  --help
)";

struct Command {
  bool help = false;
  std::filesystem::path in, out;
};

Command parse(Words words) {
  Command command;
  while (words.next()) {
    if (words.is("--help", "-h")) {
      command.help = true;
      return command;
    }
    words.take_mesh(command.in.empty() ? command.in : command.out);
  }
  if (command.in.empty()) throw std::runtime_error("name a file to read; --help lists the formats");
  if (command.out.empty()) throw std::runtime_error("name a file to write; --help lists the formats");
  return command;
}

Format format_of(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".gltf" || ending == ".glb" || ending == ".vrm") return to_gltf;
  if (ending == ".obj") return to_obj;
  if (ending == ".off") return to_off;
  if (ending == ".ply") return to_ply;
  if (ending == ".stl") return to_stl;
  throw std::runtime_error(file.string() + ": the format is not written; .gltf, .glb, .vrm, .obj, .off, .ply and " +
                           ".stl are");
}

void say(const std::filesystem::path& file, const Contents& contents, Format format,
         const std::vector<std::string>& warnings) {
  const std::string kept = list_of(contents, format, true);
  std::string lost = list_of(contents, format, false);
  if (lost.empty()) lost = "nothing";
  for (const std::string& warning : warnings) lost += "; warning: " + warning;
  std::printf("%s: kept %s; lost %s\n", file.string().c_str(), kept.c_str(), lost.c_str());
}

void run(const Command& command) {
  const Format format = format_of(command.out);
  if (is_model(kind_of_file(command.in))) {
    const Model model = read_gltf(command.in);
    FlatMesh surface;
    if (format == to_gltf) {
      write_gltf(model, command.out);
    } else {
      surface = flatten(model);
      if (surface.triangles.empty())
        throw std::runtime_error(command.in.string() + " has no triangles; write its nodes and clips as .glb");
      write_mesh_file(to_surface_mesh(surface), command.out);
    }
    say(command.out, contents_of(model, format == to_gltf ? nullptr : &surface), format, model.warnings);
    return;
  }
  const SurfaceMesh mesh = read_mesh_file(command.in);
  write_mesh_file(mesh, command.out);
  say(command.out, contents_of(mesh), format, mesh.warnings);
}

}  // namespace
}  // namespace samples

int main(int count, char** arguments) {
  return samples::run_program("hf_convert", samples::usage, count, arguments, samples::parse, samples::run);
}
