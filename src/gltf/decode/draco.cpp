// KHR_draco_mesh_compression by way of Draco's decoder. A view is decoded once for each primitive
// that names it: files where several do are rare.
#include "gltf/decode/draco.h"

#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gltf/decode/draco_stream.h"
#include "gltf/read/notes.h"
#include "scene/scene.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The values of all points, converted to T.
template <class T>
bool appendValues(const draco::PointAttribute& attribute, uint32_t points, std::string& bytes) {
    const size_t components = attribute.num_components();
    std::array<T, 4> value{}; // no more than a VEC4's: componentsOf
    for (draco::PointIndex point(0); point < points; ++point) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(point), static_cast<int8_t>(components),
                                       value.data()))
            return false;
        for (size_t i = 0; i < components; ++i)
            append(bytes, value[i]);
    }
    return true;
}

bool appendAttribute(const draco::PointAttribute& attribute, uint32_t points, const Json& accessor,
                     std::string& bytes) {
    switch (accessor.at("componentType").get<int>()) {
    case 5120:
        return appendValues<int8_t>(attribute, points, bytes);
    case 5121:
        return appendValues<uint8_t>(attribute, points, bytes);
    case 5122:
        return appendValues<int16_t>(attribute, points, bytes);
    case 5123:
        return appendValues<uint16_t>(attribute, points, bytes);
    case 5125:
        return appendValues<uint32_t>(attribute, points, bytes);
    default:
        return appendValues<float>(attribute, points, bytes);
    }
}

// Components of an element; 0 for matrices, which no attribute is.
int componentsOf(const Json& accessor) {
    const auto type = accessor.at("type").get<std::string>();
    return type == "SCALAR" ? 1 : type.starts_with("VEC") ? type.back() - '0' : 0;
}

// Decodes one primitive; the JSON and the buffers outlive it.
class PrimitiveDecoder {
    [[noreturn]] void fail(const std::string& text) const {
        throw gltfError(source_, fmt::format("{} (KHR_draco_mesh_compression) {}", name_, text));
    }

    template <class Act>
    auto naming(const Act& act) const {
        try {
            return act();
        } catch (const Error& error) {
            fail(error.what());
        }
    }

  public:
    PrimitiveDecoder(Json& json, std::vector<GltfBuffer>& buffers, std::string name,
                     const std::string& source)
        : json_(json), buffers_(buffers), name_(std::move(name)), source_(source) {}

    // Number of triangles that the stream states, before any is decoded.
    [[nodiscard]] uint64_t triangles(const Json& primitive) const {
        return naming([&] { return statedTriangles(streamOf(primitive)); });
    }

    void run(Json& primitive) {
        const Json extension = extensionOf(primitive);
        const auto mesh = naming([&] { return decodeDracoStream(streamOf(primitive)); });
        view_ = json_["bufferViews"].size();
        for (const auto& [attribute, id] : extension.at("attributes").items()) {
            if (primitive["attributes"].contains(attribute))
                takeAttribute(*mesh, id.get<uint32_t>(), primitive["attributes"][attribute], attribute);
        }
        takeTriangles(*mesh, primitive);
        json_["bufferViews"].push_back(
            {{"buffer", buffers_.size()}, {"byteOffset", 0}, {"byteLength", bytes_.size()}});
        buffers_.push_back({bytes_.size(), std::move(bytes_)});
    }

  private:
    [[nodiscard]] static const Json& extensionOf(const Json& primitive) {
        return primitive.at("extensions").at("KHR_draco_mesh_compression");
    }

    [[nodiscard]] std::string_view streamOf(const Json& primitive) const {
        const auto index = extensionOf(primitive).at("bufferView").get<size_t>();
        const Json& view = json_["bufferViews"][index];
        const BufferRange range{view.at("buffer").get<size_t>(), view.value("byteOffset", size_t{0}),
                                view.at("byteLength").get<size_t>()};
        return bytesOf(buffers_, range, describe("buffer view", index, ""), source_);
    }

    // Replaces the accessor's number by that of a new one with the decoded values: others may use the old
    // one.
    void takeAttribute(const draco::Mesh& mesh, uint32_t id, Json& index, const std::string& attribute) {
        const draco::PointAttribute* values = mesh.GetAttributeByUniqueId(id);
        Json accessor = json_["accessors"][index.get<size_t>()];
        if (values == nullptr || values->num_components() != componentsOf(accessor))
            fail(fmt::format("is damaged: its stream has no attribute {} of the type of {}", id, attribute));
        accessor["byteOffset"] = bytes_.size();
        if (!appendAttribute(*values, mesh.num_points(), accessor, bytes_))
            fail(fmt::format("is damaged: {} cannot be read from its stream", attribute));
        index = addAccessor(std::move(accessor), mesh.num_points());
    }

    void takeTriangles(const draco::Mesh& mesh, Json& primitive) {
        Json accessor = {{"componentType", 5125}, {"type", "SCALAR"}, {"byteOffset", bytes_.size()}};
        for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
            for (const draco::PointIndex& point : mesh.face(face))
                append(bytes_, point.value());
        }
        primitive["indices"] = addAccessor(std::move(accessor), size_t{3} * mesh.num_faces());
        primitive["mode"] = 4;
    }

    size_t addAccessor(Json accessor, size_t count) {
        accessor["bufferView"] = view_;
        accessor["count"] = count;
        accessor.erase("sparse");
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    Json& json_;
    std::vector<GltfBuffer>& buffers_;
    std::string name_;
    const std::string& source_;
    size_t view_ = 0;   // number of the view of the decoded bytes
    std::string bytes_; // values of all attributes, and the indices
};

} // namespace

void decodeDraco(Json& json, std::vector<GltfBuffer>& buffers, const std::string& source) {
    if (!json.contains("meshes") || !json.contains("bufferViews") || !json.contains("accessors"))
        return;
    std::vector<std::pair<PrimitiveDecoder, Json*>> compressed;
    uint64_t triangles = 0; // several primitives may name one stream
    Json& meshes = json["meshes"];
    for (size_t i = 0; i < meshes.size(); ++i) {
        if (!meshes[i].contains("primitives"))
            continue;
        for (Json& primitive : meshes[i]["primitives"]) {
            if (!primitive.contains("extensions") ||
                !primitive["extensions"].contains("KHR_draco_mesh_compression"))
                continue;
            const std::string name = describe("mesh", i, meshes[i].value("name", ""));
            compressed.emplace_back(PrimitiveDecoder(json, buffers, name, source), &primitive);
            triangles += compressed.back().first.triangles(primitive);
        }
    }
    if (triangles > kMostTriangles)
        throw gltfError(source,
                        fmt::format("its streams of KHR_draco_mesh_compression state {} triangles, at "
                                    "most {} are supported",
                                    triangles, kMostTriangles));
    for (auto& [decoder, primitive] : compressed)
        decoder.run(*primitive);
}

} // namespace lavalight
