#include "cli/commands/trace_command.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "cli/options/option_values.h"
#include "inspect/path_inspector.h"
#include "inspect/traced_fate.h"
#include "scene/world_position.h"

namespace lavalight {
namespace {

using Json = nlohmann::ordered_json;

Json list(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json vertexJson(const TracedVertex& vertex, uint32_t number, const Scene& scene) {
    Json json;
    json["vertex"] = number;
    if (!std::isinf(vertex.t)) {
        json["position"] = list(toWorld(vertex.position, scene.origin));
        json["distance"] = vertex.t;
        json["triangle"] = vertex.surface.primitive;
        json["side"] = (vertex.flags & kTracedFront) != 0 ? "front" : "back";
        json["material"] = scene.materials[vertex.material].name;
    }
    json["throughput"] = list(vertex.throughput);
    json["emitted"] = list(vertex.emitted);
    if ((vertex.flags & kTracedShadowRay) != 0)
        json["light"] = {{"contribution", list(vertex.direct)},
                         {"arrives", (vertex.flags & kTracedOccluded) == 0}};
    if (vertex.direction != glm::vec3(0.0f))
        json["next"] = {{"direction", list(vertex.direction)}, {"pdf", vertex.pdf}};
    json["survival"] = vertex.survival;
    json["fate"] = fateOf(vertex);
    return json;
}

} // namespace

TraceCommand::TraceCommand(CLI::App& app)
    : Command(app, "trace", "Show one path of a render, vertex by vertex, as JSON"), options_(parser()),
      sceneOptions_(parser()), ground_(parser()), shaders_(parser()) {
    parser().add_option("input", scene_, "Built-in scene, or .gltf or .glb file")->type_name("SCENE");
    parser()
        .add_option("--pixel", pixel_, "Column and row of the image, from its top left")
        ->required()
        ->type_name("X,Y");
    parser().add_option("--sample", sample_, "Which of the pixel's samples, from 0")->type_name("N");
}

glm::uvec2 TraceCommand::pixelIn(const RenderSettings& settings) const {
    const std::vector<std::string_view> words = splitAt(pixel_, ',');
    const auto x = parseNumber<uint32_t>(words.front());
    const auto y = parseNumber<uint32_t>(words.back());
    if (words.size() != 2 || !x || !y || *x >= settings.image.width || *y >= settings.image.height)
        throw UsageError(fmt::format("--pixel: {} is not X,Y within the image's {} x {} pixels", pixel_,
                                     settings.image.width, settings.image.height));
    return {*x, *y};
}

int TraceCommand::run() {
    RenderPlan plan = options_.plan(scene_);
    plan.settings.ground = ground_.settings();
    const PreparedScene prepared = prepareScene(plan, sceneOptions_.importOptions());
    const glm::uvec2 pixel = pixelIn(prepared.settings);
    const KernelSource source = sourceOf(shaders_.overlay());
    gpu::Device device(plan.device);
    const Renderer renderer(device, prepared.scene, prepared.camera, prepared.settings, source);
    const TracedPath path = PathInspector(device, renderer, source).trace(renderer, pixel, sample_);
    device.requireNoValidationMessages();

    Json json;
    json["scene"] = prepared.scene.source;
    json["size"] = {prepared.settings.image.width, prepared.settings.image.height};
    json["pixel"] = {pixel.x, pixel.y};
    json["sample"] = sample_;
    json["radiance"] = list(path.radiance);
    for (size_t i = 0; i < path.vertices.size(); ++i)
        json["vertices"].push_back(
            vertexJson(path.vertices[i], static_cast<uint32_t>(i + 1), prepared.scene));
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
    return 0;
}

} // namespace lavalight
