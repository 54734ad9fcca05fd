// decode_draco() of gltf_decompress.h, by Draco (Apache-2.0) where the build has it.
//
// The decoder allocates by counts in the stream, which the size of the stream does not bound. So the header is read
// here first and compared with the accessors. The sizes of the attributes are bounded between connectivity and values,
// in an overridden step of the decoder.
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "gltf/gltf_decompress.h"
#ifdef HF_GLTF_DRACO
#include <draco/compression/decode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/metadata/metadata_decoder.h>
#endif

namespace hf_gltf {

#ifdef HF_GLTF_DRACO
namespace {

// Bytes the decoder takes for a triangle: 63 with its output, measured on sheets of 0.5 and 2 million triangles, and a
// margin. Double would refuse sheets of a million triangles at the default limit.
constexpr uint64_t triangle_bytes = 100;
// Tables of one attribute with seams, for each triangle: three corners with a vertex each, and as much again.
constexpr uint64_t seam_bytes = 32;
// Copies of an attribute while it is decoded: portable values, corrections, result.
constexpr uint64_t attribute_copies = 3;

[[noreturn]] void damaged(const std::string& what) { throw std::runtime_error("holds a Draco stream that " + what); }

struct StreamHeader {
  bool edgebreaker = false;
  uint64_t triangles = 0, vertices = 0, seams = 0;
};

class HeaderReader {
 public:
  HeaderReader(const uint8_t* data, size_t size) { buffer_.Init(reinterpret_cast<const char*>(data), size); }

  StreamHeader run() {
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer_, &header).ok()) damaged("does not start as one");
    if (header.encoder_type != draco::TRIANGULAR_MESH) damaged("is not a triangle mesh");
    if (header.version_major != 2 || header.version_minor != 2) damaged("is not of version 2.2");
    if (header.encoder_method > draco::MESH_EDGEBREAKER_ENCODING) damaged("has an unknown method");
    buffer_.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    if ((header.flags & METADATA_FLAG_MASK) != 0) {
      draco::GeometryMetadata metadata;
      if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer_, &metadata)) damaged("has broken metadata");
    }
    StreamHeader out;
    out.edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    if (out.edgebreaker) {
      byte();  // how symbols are coded
      out.vertices = number();
      out.triangles = number();
      out.seams = byte();
    } else {
      out.triangles = number();
      out.vertices = number();
    }
    return out;
  }

 private:
  uint64_t byte() {
    uint8_t value = 0;
    if (!buffer_.Decode(&value)) damaged("is cut off in its header");
    return value;
  }
  // Seven bits a byte, the lowest first.
  uint64_t number() {
    uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const uint64_t next = byte();
      value |= (next & 127) << shift;
      if (next < 128) return value;
    }
    damaged("has a broken count");
  }

  draco::DecoderBuffer buffer_;
};

// Base is one of Draco's two mesh decoders.
template <class Base>
class BoundedDecoder final : public Base {
 public:
  BoundedDecoder(uint64_t rows, uint64_t bytes) : rows_(rows), bytes_(bytes) {}
  bool over_limit() const { return over_limit_; }

 protected:
  // All attributes have their types here, and none has values yet.
  bool DecodeAllAttributes() override {
    uint64_t bytes = 0;
    const draco::PointCloud& cloud = *this->point_cloud();
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      const auto row = static_cast<uint64_t>(std::max<int64_t>(attribute.byte_stride(), 1));
      bytes += attribute_copies * rows_ * std::max(row, 4 * static_cast<uint64_t>(attribute.num_components()));
    }
    over_limit_ = bytes > bytes_;
    return !over_limit_ && Base::DecodeAllAttributes();
  }

 private:
  const uint64_t rows_, bytes_;
  bool over_limit_ = false;
};

template <class Base>
void run_decoder(const uint8_t* data, size_t size, uint64_t rows, uint64_t bytes, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data), size);
  BoundedDecoder<Base> decoder(rows, bytes);
  const draco::DecoderOptions options;
  const draco::Status status = decoder.Decode(options, &buffer, &mesh);
  if (decoder.over_limit()) damaged("has attributes that take more memory than the limit");
  if (!status.ok()) damaged("is damaged");
}

template <typename T>
void convert(const draco::PointAttribute& from, uint32_t points, DracoAttribute& to) {
  T row[4] = {};
  for (uint32_t i = 0; i < points; ++i) {
    const draco::AttributeValueIndex value = from.mapped_index(draco::PointIndex(i));
    if (value.value() >= from.size() || !from.ConvertValue<T>(value, static_cast<int8_t>(to.components), row)) {
      damaged("has values its accessor cannot hold");
    }
    std::memcpy(to.data.data() + i * to.components * sizeof(T), row, to.components * sizeof(T));
  }
}

void copy_attribute(const draco::Mesh& mesh, DracoAttribute& to) {
  const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(to.id);
  if (!from) damaged("has no attribute " + std::to_string(to.id));
  if (from->num_components() != static_cast<int>(to.components)) {
    damaged("has " + std::to_string(from->num_components()) + " components in attribute " + std::to_string(to.id) +
            ", where its accessor has " + std::to_string(to.components));
  }
  const uint32_t points = mesh.num_points();
  to.data.resize(points * to.components * to.bytes);
  switch (to.component_type) {
    case 5120:
      return convert<int8_t>(*from, points, to);
    case 5121:
      return convert<uint8_t>(*from, points, to);
    case 5122:
      return convert<int16_t>(*from, points, to);
    case 5123:
      return convert<uint16_t>(*from, points, to);
    case 5125:
      return convert<uint32_t>(*from, points, to);
    default:
      return convert<float>(*from, points, to);
  }
}

void check_header(const StreamHeader& header, size_t point_count, size_t index_count, bool strip,
                  uint64_t memory_limit) {
  const uint64_t most = strip ? index_count : index_count / 3;
  if (header.triangles == 0 || header.triangles > most) {
    damaged("has " + std::to_string(header.triangles) + " triangles, where the accessor has " +
            std::to_string(index_count) + " indices");
  }
  if (header.vertices > point_count) {
    damaged("has " + std::to_string(header.vertices) + " vertices, where the accessors have " +
            std::to_string(point_count));
  }
  const uint64_t bytes = header.triangles * (triangle_bytes + seam_bytes * header.seams);
  if (bytes > memory_limit) {
    damaged("takes some " + std::to_string(bytes) + " bytes to decode, above the limit of " +
            std::to_string(memory_limit));
  }
}

}  // namespace

bool has_draco() { return true; }

void decode_draco(const uint8_t* data, size_t size, size_t point_count, size_t index_count, bool strip,
                  uint64_t memory_limit, std::vector<DracoAttribute>& attributes, std::vector<uint8_t>& indices) {
  const StreamHeader header = HeaderReader(data, size).run();
  check_header(header, point_count, index_count, strip, memory_limit);
  draco::Mesh mesh;
  if (header.edgebreaker) {
    // a corner can have a value of its own until seams are joined
    run_decoder<draco::MeshEdgebreakerDecoder>(data, size, 3 * header.triangles, memory_limit, mesh);
  } else {
    run_decoder<draco::MeshSequentialDecoder>(data, size, header.vertices, memory_limit, mesh);
  }
  if (mesh.num_points() != point_count) {
    damaged("has " + std::to_string(mesh.num_points()) + " vertices, where the accessors have " +
            std::to_string(point_count));
  }
  if (mesh.num_faces() > header.triangles) damaged("has more triangles than it says");
  for (DracoAttribute& attribute : attributes) copy_attribute(mesh, attribute);
  indices.resize(mesh.num_faces() * 3 * sizeof(uint32_t));
  for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
    for (size_t c = 0; c < 3; ++c) {
      const uint32_t v = face[c].value();
      if (v >= point_count) damaged("names vertex " + std::to_string(v) + " of " + std::to_string(point_count));
      std::memcpy(indices.data() + (3 * static_cast<size_t>(f) + c) * sizeof v, &v, sizeof v);
    }
  }
}
#else
bool has_draco() { return false; }

void decode_draco(const uint8_t*, size_t, size_t, size_t, bool, uint64_t, std::vector<DracoAttribute>&,
                  std::vector<uint8_t>&) {
  throw std::runtime_error("needs Draco");
}
#endif

}  // namespace hf_gltf
