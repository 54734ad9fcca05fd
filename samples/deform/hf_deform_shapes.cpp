// hf_deform_shapes OUTDIR: the classic shapes the scripts of this sample pose, as .ply files.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "assets/shapes.h"
#include "common/mesh_file.h"
#include "gltf/file_name.h"

namespace {

using namespace samples;
using namespace hf_gltf;

void write(const std::filesystem::path& folder, const char* name, ShapeMesh shape, double stretch = 1) {
  SurfaceMesh mesh;
  for (size_t i = 0; i < shape.positions.size(); i += 3)
    mesh.positions.emplace_back(shape.positions[i], stretch * shape.positions[i + 1], shape.positions[i + 2]);
  mesh.triangles = shape.triangles;
  const std::filesystem::path file = folder / (std::string(name) + ".ply");
  write_mesh_file(mesh, file);
  std::printf("%s: %zu vertices\n", file.string().c_str(), mesh.positions.size());
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 || arguments[1][0] == '-') {
    std::fputs("usage: hf_deform_shapes OUTDIR\nWrites bar.ply, cylinder.ply, cactus.ply and bumpy_plane.ply.\n",
               count == 2 ? stdout : stderr);
    return count == 2 ? 0 : 1;
  }
  try {
    const std::filesystem::path folder = file_named(arguments[1]);
    std::filesystem::create_directories(folder);
    write(folder, "bar", box(1, 6, 1, 16, 96, 16));
    write(folder, "cylinder", cylinder(11, 118), 1.5);
    write(folder, "cactus", cactus(7400));
    write(folder, "bumpy_plane", bumpy_plane(101, 101));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hf_deform_shapes: %s\n", error.what());
    return 1;
  }
  return 0;
}
