#include "support/draco_encode.h"

#include <draco/compression/encode.h>

namespace samples_test {

DracoStream encode_draco(const Sheet& sheet, bool edgebreaker) {
  const auto n = static_cast<uint32_t>(sheet.vertex_count());
  draco::Mesh mesh;
  mesh.set_num_points(n);
  mesh.SetNumFaces(sheet.indices.size() / 3);
  const auto add = [&](draco::GeometryAttribute::Type type, int8_t components, draco::DataType data, int64_t stride) {
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<uint8_t>(components), data, false, stride, 0);
    return mesh.AddAttribute(attribute, true, n);
  };
  DracoStream out;
  const int p = add(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32, 12);
  const int j = add(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8, 4);
  const int w = add(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32, 16);
  for (uint32_t v = 0; v < n; ++v) {
    const uint8_t joints[4] = {0, 1, 0, 0};
    const float share = sheet.positions[3 * v] / 8, weights[4] = {1 - share, share, 0, 0};
    const draco::AttributeValueIndex value(v);
    mesh.attribute(p)->SetAttributeValue(value, &sheet.positions[3 * v]);
    mesh.attribute(j)->SetAttributeValue(value, joints);
    mesh.attribute(w)->SetAttributeValue(value, weights);
  }
  for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
    draco::Mesh::Face face;
    for (size_t c = 0; c < 3; ++c) face[c] = draco::PointIndex(sheet.indices[3 * f + c]);
    mesh.SetFace(draco::FaceIndex(f), face);
  }
  out.position = static_cast<int>(mesh.attribute(p)->unique_id());
  out.joints = static_cast<int>(mesh.attribute(j)->unique_id());
  out.weights = static_cast<int>(mesh.attribute(w)->unique_id());
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok()) return out;
  out.bytes.assign(buffer.data(), buffer.data() + buffer.size());
  return out;
}

}  // namespace samples_test
