// Writes a model or a mesh in another format, and lists in one line the contents that it kept and lost.
#include <cstdio>
#include <stdexcept>

#include "common/program.h"
#include "convert/contents.h"
#include "convert/obj_looks.h"
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
  at rest; .obj also texture coordinates, and materials and their images in files beside it. A .vrm can be written only from a .vrm, because it needs a humanoid map and a licence.
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

// A cloud of points stays one in .ply and .off; a file without vertices is damaged.
void refuse_empty(const SurfaceMesh& mesh, const Command& command, Format format) {
  const FileKind kind = kind_of_file(command.in);
  const bool holds_points = (kind == FileKind::ply || kind == FileKind::off) && (format == to_ply || format == to_off);
  const char* missing = mesh.positions.empty() ? "vertex" : mesh.face_count() == 0 && !holds_points ? "face" : nullptr;
  if (missing)
    throw std::runtime_error(command.in.string() + " has no " + missing + ", so there is no surface to write");
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
      SurfaceMesh mesh = format == to_obj ? to_obj_mesh(model, surface) : to_surface_mesh(surface);
      if (format == to_obj) write_obj_looks(plain_looks(model), command.out, mesh);
      write_mesh_file(mesh, command.out);
    }
    say(command.out, contents_of(model, format == to_gltf ? nullptr : &surface), format, model.warnings);
    return;
  }
  SurfaceMesh mesh = read_mesh_file(command.in, {}, true);
  refuse_empty(mesh, command, format);
  PlainLooks looks;
  if (format == to_gltf || format == to_obj) looks = read_obj_looks(command.in, mesh, format == to_gltf);
  if (format == to_gltf) {
    Model model = to_model(mesh, command.out.stem().string());
    if (!looks.materials.empty()) set_plain_looks(model, looks);
    write_gltf(model, command.out);
  } else {
    if (format == to_obj) write_obj_looks(looks, command.out, mesh);
    write_mesh_file(mesh, command.out);
  }
  Contents contents = contents_of(mesh);
  contents.push_back({looks.images.size(), "image", "images", to_gltf | to_obj});
  say(command.out, contents, format, mesh.warnings);
}

}  // namespace
}  // namespace samples

int main(int count, char** arguments) {
  return samples::run_program("hf_convert", samples::usage, count, arguments, samples::parse, samples::run);
}
