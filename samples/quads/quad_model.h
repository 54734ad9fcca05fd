// Quads in the place of a model's surface, with all that its vertices carry: texture coordinates with their seams,
// colours, joints and weights, morph targets. Nodes, skins, clips and looks stay, so that a character still moves.
//
// A part of the surface where texture coordinates and colours are continuous is a chart. A face takes what it carries
// from one chart, that of its middle. At a seam a corner has a copy for each chart; where it lies beyond its chart, the
// nearest point of the chart gives its texture coordinates and colours. All copies move alike, so no seam opens.
// Numbers are interpolated in the triangle of the surface where the corner lies. Normals are those of the quads, smooth
// over all of them.
//
// glTF has triangles only. Each face becomes a fan, and FB_ngon_encoding says so: triangles one after the other with
// the same first corner are one face. Cost: O(n log n).
#ifndef HF_SAMPLES_QUADS_QUAD_MODEL_H
#define HF_SAMPLES_QUADS_QUAD_MODEL_H

#include <cstdint>
#include <vector>

#include "common/mesh_file.h"
#include "gltf/flat_mesh.h"
#include "gltf/model.h"

namespace samples {

using namespace hf_gltf;

// Where the vertices of a quad mesh lie on the flat mesh that it was made of.
struct QuadPlaces {
  std::vector<uint32_t> triangles;   // by vertex
  std::vector<double> barycentrics;  // three by vertex, of the triangle's corners in their order
};

// flat: of the whole model. quads: with faces. Throws std::runtime_error if they do not fit.
Model quad_model(const Model& model, const FlatMesh& flat, const SurfaceMesh& quads, const QuadPlaces& places);

}  // namespace samples

#endif
