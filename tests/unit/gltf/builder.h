// Builds small glTF files in memory for the tests of the import.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "gltf/import.h"

namespace lavalight::test {

using Json = nlohmann::json;

constexpr int kByte = 5120;
constexpr int kUnsignedByte = 5121;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

// Little-endian bytes of a .glb field.
inline std::string fourBytes(size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>((value >> shift) & 0xFF);
    return bytes;
}

// A .glb under construction: `json` may be edited freely, `bytes` becomes its BIN chunk.
struct GltfBuilder {
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    // Appends a buffer view with the bytes of `values`.
    template <class T>
    int addView(const std::vector<T>& values) {
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        const size_t size = values.size() * sizeof(T);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        bytes.append(reinterpret_cast<const char*>(values.data()), size);
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    int addAccessor(Json accessor) {
        json["accessors"].push_back(std::move(accessor));
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    int addVec3(const std::vector<glm::vec3>& values) {
        return addAccessor({{"bufferView", addView(values)},
                            {"componentType", kFloat},
                            {"count", values.size()},
                            {"type", "VEC3"}});
    }

    template <class T>
    int addIndices(const std::vector<T>& values, int componentType) {
        return addAccessor({{"bufferView", addView(values)},
                            {"componentType", componentType},
                            {"count", values.size()},
                            {"type", "SCALAR"}});
    }

    // A mesh of one primitive; returns its number.
    int addMesh(Json primitive) {
        json["meshes"].push_back({{"name", "part"}, {"primitives", Json::array({std::move(primitive)})}});
        return static_cast<int>(json["meshes"].size()) - 1;
    }

    int addNode(Json node) {
        json["nodes"].push_back(std::move(node));
        return static_cast<int>(json["nodes"].size()) - 1;
    }

    // The triangle (0,0,0), (1,0,0), (0,1,0), whose front faces +z; returns its mesh.
    int addTriangle() {
        return addMesh({{"attributes", {{"POSITION", addVec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}}});
    }

    [[nodiscard]] std::string glb() const {
        Json whole = json;
        if (!bytes.empty() && !whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string binary = bytes;
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        std::string chunks = fourBytes(text.size()) + "JSON" + text;
        if (!binary.empty())
            chunks += fourBytes(binary.size()) + std::string("BIN\0", 4) + binary;
        return "glTF" + fourBytes(2) + fourBytes(12 + chunks.size()) + chunks;
    }

    [[nodiscard]] Scene import() const { return importGltf("test.glb", glb()); }
};

// What importing says when it fails; empty if it succeeds.
inline std::string importError(const std::string& bytes) {
    try {
        static_cast<void>(importGltf("test.glb", bytes));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

inline std::string importError(const GltfBuilder& builder) {
    return importError(builder.glb());
}

// Corner positions of all triangles of a mesh, in order.
inline std::vector<std::array<glm::vec3, 3>> cornersOf(const Mesh& mesh) {
    std::vector<std::array<glm::vec3, 3>> corners;
    for (const glm::uvec3& t : mesh.triangles)
        corners.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
    return corners;
}

// The unit normal of the front of triangle `i`.
inline glm::vec3 frontOf(const Mesh& mesh, size_t i) {
    const auto corners = cornersOf(mesh).at(i);
    return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

// How many warnings contain `text`.
inline long warningsWith(const Scene& scene, const std::string& text) {
    long count = 0;
    for (const std::string& warning : scene.warnings)
        count += warning.find(text) != std::string::npos ? 1 : 0;
    return count;
}

} // namespace lavalight::test
