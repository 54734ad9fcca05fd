// The colours of textures at vertices.
#include "transfer/texture_colors.h"

#include <gtest/gtest.h>

#include "gltf/flat_mesh.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

// Two pixels: red, green.
constexpr const char* two_pixels =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP4z8DA8J8BAAf/"
    "Af+4BDXgAAAAAElFTkSuQm"
    "CC";

// The colours of a triangle whose corners are at these places of the texture.
std::vector<glm::vec3> colors(const std::vector<glm::vec2>& places, const json& texture,
                              const char* image = two_pixels) {
  hf_gltf::Model model = hf_gltf::make_model("triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
  model.meshes[0].primitives[0].texcoords = {places};
  model.meshes[0].primitives[0].material = 0;
  model.materials.resize(1);
  const fs::path file = folder() / "textured.gltf";
  hf_gltf::write_gltf(model, file);
  json document = read_json(file);
  document["images"] = {{{"uri", image}}};
  document["textures"] = {{{"source", 0}}};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = texture;
  std::ofstream(file) << document.dump();
  const hf_gltf::Model read = hf_gltf::read_gltf(file);
  return samples::TextureColors(read).of(read.meshes[0].primitives[0]);
}

const glm::vec3 red(1, 0, 0), green(0, 1, 0), white(1);

TEST(TextureColors, AreThoseOfTheNearestPixelAndRepeat) {
  const std::vector<glm::vec2> places = {{0.25f, 0.5f}, {0.75f, 3.5f}, {-0.75f, 0.5f}};
  EXPECT_EQ(colors(places, {{"index", 0}}), (std::vector<glm::vec3>{red, green, red}));
  const json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
  EXPECT_EQ(colors(places, moved), (std::vector<glm::vec3>{green, red, green}));
  const json turned = {{"index", 0},
                       {"extensions", {{"KHR_texture_transform", {{"rotation", 1.5707963}, {"scale", {1, 2}}}}}}};
  EXPECT_EQ(colors({{0.5f, 0.125f}, {0.5f, 0.375f}, {0.0f, 0.125f}}, turned),
            (std::vector<glm::vec3>{red, green, red}));
}

TEST(TextureColors, AreWhiteWithoutATextureThatCanBeRead) {
  const std::vector<glm::vec2> places = {{0.25f, 0.5f}, {0.75f, 0.5f}, {0.1f, 0.5f}};
  const std::vector<glm::vec3> none(3, white);
  EXPECT_EQ(colors(places, {{"index", 0}, {"texCoord", 1}}), none);
  EXPECT_EQ(colors(places, {{"index", 0}}, "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAA"), none);
  EXPECT_EQ(colors(places, {{"index", 0}}, "elsewhere.png"), none);
}

}  // namespace
