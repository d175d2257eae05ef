// The table of schema_rules.h: all that Lavalight reads, and every reference between objects.
#include "gltf/check/schema_rules.h"

#include "gltf/check/material_rules.h"

namespace lavalight {
namespace {

void addFileRules(std::vector<ObjectRule>& rules) {
    rules.push_back({"",
                     {required("asset", Kind::object),
                      index("scene", "scenes"),
                      {"extensionsUsed", Kind::text, Need::optional, kAnyLength},
                      {"extensionsRequired", Kind::text, Need::optional, kAnyLength},
                      {"extensions", Kind::object}}});
    rules.push_back({"asset", {required("version", Kind::text), optional("minVersion", Kind::text)}});
    rules.push_back({"scenes[]", {indices("nodes", "nodes"), optional("name", Kind::text)}});
    rules.push_back({"nodes[]",
                     {optional("name", Kind::text), indices("children", "nodes"), index("mesh", "meshes"),
                      index("camera", "cameras"), index("skin", "skins"), numbers("matrix", 16),
                      numbers("translation", 3), numbers("rotation", 4), numbers("scale", 3),
                      numbers("weights", kAnyLength)}});
    rules.push_back({"cameras[]", {required("type", Kind::text), optional("name", Kind::text)}});
    rules.push_back({"cameras[].perspective",
                     {required("yfov", Kind::number), required("znear", Kind::number), number("zfar"),
                      number("aspectRatio")}});
    rules.push_back({"cameras[].orthographic",
                     {required("xmag", Kind::number), required("ymag", Kind::number),
                      required("zfar", Kind::number), required("znear", Kind::number)}});
}

// The lights themselves may be missing: some exporters declare the extension of every file.
void addLightRules(std::vector<ObjectRule>& rules) {
    rules.push_back(
        {"extensions.KHR_lights_punctual", {{"lights", Kind::object, Need::optional, kAnyLength}}});
    rules.push_back({"extensions.KHR_lights_punctual.lights[]",
                     {required("type", Kind::text), optional("name", Kind::text), number("intensity"),
                      number("range"), numbers("color", 3)}});
    rules.push_back({"extensions.KHR_lights_punctual.lights[].spot",
                     {number("innerConeAngle"), number("outerConeAngle")}});
    rules.push_back({"nodes[].extensions.KHR_lights_punctual",
                     {index("light", "extensions.KHR_lights_punctual.lights", Need::required)}});
}

// Faces and coefficients are lists of lists, which their reader checks.
void addImageLightRules(std::vector<ObjectRule>& rules) {
    const std::string extension = "extensions.EXT_lights_image_based";
    rules.push_back({extension, {{"lights", Kind::object, Need::optional, kAnyLength}}});
    rules.push_back({extension + ".lights[]",
                     {optional("name", Kind::text), number("intensity"), numbers("rotation", 4)}});
    rules.push_back({"scenes[].extensions.EXT_lights_image_based",
                     {index("light", "extensions.EXT_lights_image_based.lights", Need::required)}});
}

// Exporters write accessors and buffers of nothing, and meshes without primitives: empty_accessors.h
// says what becomes of them.
void addDataRules(std::vector<ObjectRule>& rules) {
    rules.push_back({"buffers[]", {required("byteLength", Kind::count), optional("uri", Kind::text)}});
    rules.push_back({"bufferViews[]",
                     {index("buffer", "buffers", Need::required), optional("byteOffset", Kind::count),
                      required("byteLength", Kind::count), optional("byteStride", Kind::stride)}});
    rules.push_back({"accessors[]",
                     {index("bufferView", "bufferViews"), optional("byteOffset", Kind::count),
                      required("componentType", Kind::componentType), required("count", Kind::count),
                      required("type", Kind::elementType), optional("normalized", Kind::flag),
                      optional("name", Kind::text)}});
    rules.push_back({"accessors[].sparse",
                     {required("count", Kind::small), required("indices", Kind::object),
                      required("values", Kind::object)}});
    rules.push_back({"accessors[].sparse.indices",
                     {index("bufferView", "bufferViews", Need::required), optional("byteOffset", Kind::small),
                      required("componentType", Kind::componentType)}});
    rules.push_back(
        {"accessors[].sparse.values",
         {index("bufferView", "bufferViews", Need::required), optional("byteOffset", Kind::small)}});
    rules.push_back({"meshes[]",
                     {{"primitives", Kind::object, Need::optional, kAnyLength},
                      optional("name", Kind::text),
                      numbers("weights", kAnyLength)}});
    rules.push_back({"meshes[].primitives[]",
                     {optional("attributes", Kind::object), index("indices", "accessors"),
                      index("material", "materials"), optional("mode", Kind::mode)}});
    rules.push_back({"meshes[].primitives[].attributes", {index("*", "accessors")}});
    rules.push_back({"meshes[].primitives[].targets[]", {index("*", "accessors")}});
}

// Compressed buffer views and primitives, instances, visibility.
void addGeometryExtensionRules(std::vector<ObjectRule>& rules) {
    for (const char* view : {"bufferViews[].extensions.EXT_meshopt_compression",
                             "bufferViews[].extensions.KHR_meshopt_compression"})
        rules.push_back(
            {view,
             {index("buffer", "buffers", Need::required), optional("byteOffset", Kind::count),
              required("byteLength", Kind::count), required("byteStride", Kind::count),
              required("count", Kind::count), required("mode", Kind::text), optional("filter", Kind::text)}});
    const char* draco = "meshes[].primitives[].extensions.KHR_draco_mesh_compression";
    rules.push_back(
        {draco, {index("bufferView", "bufferViews", Need::required), required("attributes", Kind::object)}});
    rules.push_back({"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes",
                     {optional("*", Kind::small)}});
    rules.push_back({"nodes[].extensions.EXT_mesh_gpu_instancing", {optional("attributes", Kind::object)}});
    rules.push_back({"nodes[].extensions.EXT_mesh_gpu_instancing.attributes", {index("*", "accessors")}});
    rules.push_back({"nodes[].extensions.KHR_node_visibility", {optional("visible", Kind::flag)}});
}

void addMotionRules(std::vector<ObjectRule>& rules) {
    rules.push_back({"skins[]",
                     {index("inverseBindMatrices", "accessors"),
                      index("skeleton", "nodes"),
                      {"joints", Kind::index, Need::required, kAnyLength, "nodes"},
                      optional("name", Kind::text)}});
    rules.push_back({"animations[]",
                     {{"channels", Kind::object, Need::optional, kAnyLength},
                      {"samplers", Kind::object, Need::optional, kAnyLength},
                      optional("name", Kind::text)}});
    rules.push_back(
        {"animations[].channels[]", {required("sampler", Kind::small), required("target", Kind::object)}});
    rules.push_back(
        {"animations[].channels[].target", {index("node", "nodes"), required("path", Kind::text)}});
    rules.push_back({"animations[].channels[].target.extensions.KHR_animation_pointer",
                     {required("pointer", Kind::text)}});
    rules.push_back({"animations[].samplers[]",
                     {index("input", "accessors", Need::required),
                      index("output", "accessors", Need::required), optional("interpolation", Kind::text)}});
}

} // namespace

std::vector<ObjectRule> gltfSchemaRules() {
    std::vector<ObjectRule> rules;
    addFileRules(rules);
    addLightRules(rules);
    addImageLightRules(rules);
    addDataRules(rules);
    addGeometryExtensionRules(rules);
    addMaterialRules(rules);
    addMotionRules(rules);
    return rules;
}

} // namespace lavalight
