// Based on: Google's Draco 1.5, src/draco/compression/mesh/mesh_decoder.cc and its kin, for what is read
// when.
#include "gltf/decode/draco_stream.h"

#include <optional>
#include <string>

#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/os/memory.h"

namespace lavalight {
namespace {

// Draco allocates what the head of a stream states before it reads on. Real streams hold about a triangle a
// byte; a plane of millions may hold a few dozen.
constexpr uint64_t kMostTrianglesPerByte = 256;
// Bytes of attribute values: as many points, of 32 bytes each.
constexpr uint64_t kMostValuesPerByte = 32 * kMostTrianglesPerByte;
// Bytes of a triangle in the tables of neighbours that the decoder makes.
constexpr uint64_t kTableBytes = 128;

// The number of triangles that the head states; Draco reads the same bytes again.
std::optional<uint64_t> trianglesOfHead(std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
        header.encoder_type != draco::TRIANGULAR_MESH || header.version_major != 2 ||
        header.version_minor != 2)
        return std::nullopt;
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    if ((header.flags & METADATA_FLAG_MASK) != 0) {
        draco::GeometryMetadata metadata;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
            return std::nullopt;
    }
    uint32_t triangles = 0;
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
        uint8_t traversal = 0;
        uint32_t vertices = 0;
        if (!buffer.Decode(&traversal) || !draco::DecodeVarint(&vertices, &buffer))
            return std::nullopt;
    }
    if (!draco::DecodeVarint(&triangles, &buffer))
        return std::nullopt;
    return triangles;
}

// Draco's decoder, which stops before the values of attributes if they take too much: their number of
// components is the stream's to choose, whatever the accessors say.
template <class Decoder>
class CheckedDecoder : public Decoder {
  public:
    explicit CheckedDecoder(uint64_t mostBytes) : mostBytes_(mostBytes) {}

    [[nodiscard]] const std::string& problem() const { return problem_; }

  protected:
    bool DecodeAllAttributes() override {
        const draco::PointCloud& cloud = *this->point_cloud();
        uint64_t bytes = 0;
        for (int i = 0; i < cloud.num_attributes(); ++i)
            bytes += static_cast<uint64_t>(cloud.attribute(i)->byte_stride()) * cloud.num_points();
        if (bytes > mostBytes_)
            problem_ = fmt::format("is damaged: {} bytes of values cannot be in its stream", bytes);
        else if (const std::string shortage = memoryShortage(2 * bytes); !shortage.empty()) // and as integers
            problem_ = fmt::format("has values which {}", shortage);
        return problem_.empty() && Decoder::DecodeAllAttributes();
    }

  private:
    uint64_t mostBytes_;
    std::string problem_;
};

template <class Decoder>
std::unique_ptr<draco::Mesh> decodeWith(std::string_view stream) {
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    auto mesh = std::make_unique<draco::Mesh>();
    CheckedDecoder<Decoder> decoder(kMostValuesPerByte * stream.size());
    const draco::DecoderOptions options;
    const draco::Status status = decoder.Decode(options, &buffer, mesh.get());
    if (!decoder.problem().empty())
        throw Error(decoder.problem());
    if (!status.ok())
        throw Error(fmt::format("cannot be decoded: {}", status.error_msg_string()));
    return mesh;
}

} // namespace

uint64_t statedTriangles(std::string_view stream) {
    const std::optional<uint64_t> triangles = trianglesOfHead(stream);
    if (!triangles)
        throw Error("is damaged: its stream does not begin as a mesh of Draco's bitstream 2.2");
    if (*triangles > kMostTrianglesPerByte * stream.size())
        throw Error(
            fmt::format("is damaged: its stream states {} triangles in {} bytes", *triangles, stream.size()));
    return *triangles;
}

std::unique_ptr<draco::Mesh> decodeDracoStream(std::string_view stream) {
    const uint64_t triangles = statedTriangles(stream);
    if (const std::string shortage = memoryShortage(kTableBytes * triangles); !shortage.empty())
        throw Error(fmt::format("has {} triangles, which {}", triangles, shortage));
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
        throw Error("is damaged: its head cannot be read");
    return header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
               ? decodeWith<draco::MeshEdgebreakerDecoder>(stream)
               : decodeWith<draco::MeshSequentialDecoder>(stream);
}

} // namespace lavalight
