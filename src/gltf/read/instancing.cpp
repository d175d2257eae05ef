#include "gltf/read/instancing.h"

#include <fmt/format.h>

#include "gltf/read/transform.h"

namespace lavalight {
namespace {

// The accessor of one of the extension's attributes; the schema check has seen to the index.
std::optional<size_t> accessorOf(JsonView node, const char* attribute) {
    return node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].index(attribute);
}

void readAttribute(const GltfDocument& document, JsonView node, const char* attribute,
                   std::optional<AccessorView>& view) {
    const std::optional<size_t> accessor = accessorOf(node, attribute);
    if (!accessor)
        return;
    view.emplace(document, *accessor);
    const bool isRotation = std::string_view(attribute) == "ROTATION";
    if (isRotation ? !view->isVec4() : !view->isVec3())
        throw document.error(fmt::format("{} is used as {} of instances and must be a {}", view->name(),
                                         attribute, isRotation ? "VEC4" : "VEC3"));
    if (view->count() != instanceCount(document, node))
        throw document.error(fmt::format("{} is used as {} of instances and has {} elements instead of {}",
                                         view->name(), attribute, view->count(),
                                         instanceCount(document, node)));
}

} // namespace

size_t instanceCount(const GltfDocument& document, JsonView node) {
    std::optional<size_t> count;
    for (const char* attribute : {"TRANSLATION", "ROTATION", "SCALE"}) {
        const std::optional<size_t> accessor = accessorOf(node, attribute);
        if (!accessor)
            continue;
        const size_t elements = document.list("accessors")[*accessor].count("count", 0);
        count = elements == 0 ? 0 : count.value_or(elements);
    }
    return count.value_or(1);
}

InstanceReader::InstanceReader(const GltfDocument& document, JsonView node)
    : count_(instanceCount(document, node)) {
    if (count_ == 0)
        return;
    readAttribute(document, node, "TRANSLATION", translations_);
    readAttribute(document, node, "ROTATION", rotations_);
    readAttribute(document, node, "SCALE", scales_);
}

glm::dmat4 InstanceReader::transform(size_t i) const {
    Transform transform;
    if (translations_)
        transform.translation = translations_->vec3At(i);
    if (rotations_)
        transform.rotation = rotations_->vec4At(i);
    if (scales_)
        transform.scale = scales_->vec3At(i);
    return transform.matrix();
}

} // namespace lavalight
