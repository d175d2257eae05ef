// Writes a scene as the program sees it into a .glb file, for other renderers to be measured on: baked to
// world space, with its first camera; a constant environment goes into the scene's extras. Usage:
// export_scene SCENE OUT.glb
#include <cstring>
#include <fstream>
#include <iostream>
#include <span>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "session/builtin.h"

namespace lavalight {
namespace {

using Json = nlohmann::json;

Json list(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Json materialJson(const Material& m) {
    const float strongest = std::max({m.emission.r, m.emission.g, m.emission.b, 1.0f});
    Json extensions{{"KHR_materials_ior", {{"ior", m.ior}}},
                    {"KHR_materials_specular",
                     {{"specularFactor", m.specular}, {"specularColorFactor", list(m.specularColor)}}},
                    {"KHR_materials_emissive_strength", {{"emissiveStrength", strongest}}}};
    if (m.transmission > 0.0f) {
        extensions.erase("KHR_materials_specular");
        extensions["KHR_materials_transmission"] = {{"transmissionFactor", m.transmission}};
        extensions["KHR_materials_volume"] = {{"thicknessFactor", m.isSolid ? 1.0f : 0.0f}};
    }
    return {{"name", m.name},
            {"doubleSided", m.doubleSided},
            {"emissiveFactor", list(m.emission / strongest)},
            {"extensions", extensions},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {m.baseColor.r, m.baseColor.g, m.baseColor.b, 1.0f}},
              {"metallicFactor", m.metallic},
              {"roughnessFactor", m.roughness}}}};
}

class Writer {
  public:
    explicit Writer(const Scene& scene) {
        for (const Material& material : scene.materials)
            json_["materials"].push_back(materialJson(material));
        for (const Mesh& mesh : scene.meshes)
            addMesh(mesh);
        addCamera(scene.cameras.front());
        json_["asset"] = {{"version", "2.0"}, {"generator", "lavalight export_scene"}};
        json_["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_specular",
                                   "KHR_materials_emissive_strength", "KHR_materials_transmission",
                                   "KHR_materials_volume"};
        Json nodes = Json::array();
        for (size_t i = 0; i < json_["nodes"].size(); ++i)
            nodes.push_back(i);
        json_["scenes"] = {{{"nodes", nodes}, {"extras", {{"environment", list(scene.environment)}}}}};
        json_["scene"] = 0;
    }

    void write(const std::string& path) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        json_["buffers"] = {{{"byteLength", binary_.size()}}};
        std::string text = json_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::ofstream file(path, std::ios::binary);
        writeWords(file, {0x46546c67u, 2u, static_cast<uint32_t>(28 + text.size() + binary_.size())});
        writeWords(file, {static_cast<uint32_t>(text.size()), 0x4e4f534au});
        file.write(text.data(), static_cast<std::streamsize>(text.size()));
        writeWords(file, {static_cast<uint32_t>(binary_.size()), 0x004e4942u});
        file.write(reinterpret_cast<const char*>(binary_.data()),
                   static_cast<std::streamsize>(binary_.size()));
        if (!file.flush())
            throw Error("cannot write " + path);
    }

  private:
    static void writeWords(std::ofstream& file, std::initializer_list<uint32_t> words) {
        for (const uint32_t word : words)
            file.write(reinterpret_cast<const char*>(&word), sizeof word);
    }

    // Adds an accessor and returns its number.
    template <typename T>
    size_t addAccessor(const std::vector<T>& data, int componentType, const char* type, size_t count) {
        const std::span<const std::byte> bytes = std::as_bytes(std::span(data));
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                      {"componentType", componentType},
                                      {"count", count},
                                      {"type", type}});
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return json_["accessors"].size() - 1;
    }

    void addMesh(const Mesh& mesh) {
        constexpr int kFloat = 5126;
        constexpr int kUnsignedInt = 5125;
        Json attributes;
        attributes["POSITION"] = addAccessor(mesh.positions, kFloat, "VEC3", mesh.positions.size());
        glm::vec3 lower = mesh.positions.front();
        glm::vec3 upper = lower;
        for (const glm::vec3& p : mesh.positions) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
        json_["accessors"].back()["min"] = list(lower);
        json_["accessors"].back()["max"] = list(upper);
        if (!mesh.normals.empty())
            attributes["NORMAL"] = addAccessor(mesh.normals, kFloat, "VEC3", mesh.normals.size());
        const size_t indices = addAccessor(mesh.triangles, kUnsignedInt, "SCALAR", 3 * mesh.triangles.size());
        json_["meshes"].push_back(
            {{"name", mesh.name},
             {"primitives",
              {{{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}}}}});
        json_["nodes"].push_back({{"mesh", json_["meshes"].size() - 1}});
    }

    void addCamera(const Camera& camera) {
        if (camera.projection != Projection::perspective)
            throw Error("the first camera is not a perspective one");
        json_["cameras"] = {
            {{"type", "perspective"}, {"perspective", {{"yfov", camera.verticalFov}, {"znear", 0.001f}}}}};
        const glm::vec3 back = -camera.forward;
        const glm::vec3& p = camera.position;
        json_["nodes"].push_back(
            {{"name", camera.name},
             {"camera", 0},
             {"matrix",
              {camera.right.x, camera.right.y, camera.right.z, 0.0f, camera.up.x, camera.up.y, camera.up.z,
               0.0f, back.x, back.y, back.z, 0.0f, p.x, p.y, p.z, 1.0f}}});
    }

    Json json_;
    std::vector<std::byte> binary_;
};

} // namespace
} // namespace lavalight

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: export_scene SCENE OUT.glb\n";
        return 2;
    }
    lavalight::Writer(lavalight::loadScene(argv[1])).write(argv[2]);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "export_scene: " << error.what() << '\n';
    return 1;
}
