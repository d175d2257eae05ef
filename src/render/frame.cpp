#include "render/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/pixel_filter.h"
#include "scene/clipping.h"
#include "scene/starting_solids.h"
#include "scene/view_extent.h"
#include "shared/interior_list.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

static_assert(static_cast<uint32_t>(Projection::perspective) == kProjectionPerspective &&
              static_cast<uint32_t>(Projection::orthographic) == kProjectionOrthographic &&
              static_cast<uint32_t>(Projection::panorama) == kProjectionPanorama);

// In the layout of shaders/shared/interior_list.h. Of more solids than fit, the last have no room.
void setStart(const StartingSolids& starting, FrameParameters& frame) {
    std::array<uint32_t, kInteriorEntries> entries{};
    const size_t fitting = std::min(starting.around.size(), entries.size());
    for (size_t i = 0; i < fitting; ++i)
        entries[i] = std::min(starting.around[i], kLastSolid);
    const size_t without = std::min<size_t>(starting.around.size() - fitting, kInteriorOverflowMask);
    frame.startReference = starting.reference;
    frame.startOuter = entries[0] | entries[1] << 16u;
    frame.startInner = entries[2] | entries[3] << 16u;
    frame.startNotes = static_cast<uint32_t>(without) | (without > 0 ? kInteriorWasCrowded : 0u);
    frame.startsVary = starting.vary ? 1u : 0u;
}

// A direction of the environment map after the map has made so many turns.
glm::vec3 turned(const glm::vec3& direction, float turns) {
    const double angle = 2.0 * std::numbers::pi * turns;
    const glm::dvec3 d(direction);
    return {d.x * std::cos(angle) + d.z * std::sin(angle), d.y,
            d.z * std::cos(angle) - d.x * std::sin(angle)};
}

void setFilter(const FilterTable& table, FrameParameters& frame) {
    frame.hasFilter = 1;
    frame.filterPositive = table.positive;
    frame.filterScale = table.scale;
    for (size_t i = 0; i < table.nodes.size(); ++i)
        frame.filterNodes[i / 4][static_cast<glm::length_t>(i % 4)] = table.nodes[i];
}

// What camera rays see through all pixels: a filter lets those at the border reach beyond it.
ViewExtent seenExtent(const Camera& camera, const RenderSettings& settings) {
    const auto width = static_cast<float>(settings.image.width);
    const auto height = static_cast<float>(settings.image.height);
    const float beyond = std::max(0.0f, filterRadius(settings.estimator) - 0.5f);
    ViewExtent view = viewExtent(camera, width, height);
    view.halfWidth *= 1.0f + 2.0f * beyond / width;
    view.halfHeight *= 1.0f + 2.0f * beyond / height;
    return view;
}

} // namespace

FrameParameters makeFrame(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
    const ViewExtent view = viewExtent(camera, static_cast<float>(settings.image.width),
                                       static_cast<float>(settings.image.height));
    const ViewExtent seen = seenExtent(camera, settings);
    const ClipRange clip = neededClipping(scene, camera, seen);
    FrameParameters frame{};
    frame.cameraPosition = camera.position;
    frame.projection = static_cast<uint32_t>(camera.projection);
    frame.cameraRight = camera.right * view.halfWidth;
    frame.cameraUp = camera.up * view.halfHeight;
    frame.cameraForward = camera.forward;
    frame.axisX = 1.0f - view.middleRight / view.halfWidth;
    frame.axisY = 1.0f + view.middleUp / view.halfHeight;
    frame.clipNear = clip.nearest;
    frame.clipDepth = clip.depth;
    frame.lensRadius = camera.lensRadius;
    frame.focusDistance = camera.focusDistance;
    frame.imageWidth = settings.image.width;
    frame.imageHeight = settings.image.height;
    const PixelWindow window = windowOf(settings.image);
    frame.cropStart = window.y * settings.image.width + window.x;
    frame.cropWidth = window.width;
    if (!isUnitBox(settings.estimator))
        setFilter(filterTable(settings.estimator), frame);
    frame.seed = settings.estimator.seed;
    frame.environmentLight = kNoLight;
    frame.environmentRotation = settings.lighting.rotation / 360.0f;
    frame.sceneCenter = scene.bounds.center();
    frame.sceneRadius = std::max(scene.bounds.radius(), scene.reach);
    frame.maxBounces = settings.estimator.maxBounces;
    frame.rouletteStart = settings.estimator.rouletteStart;
    frame.rouletteProbability = settings.estimator.rouletteProbability;
    frame.clampIndirect = settings.estimator.clampIndirect;
    frame.waveSize = settings.work.waveSize;
    frame.hasBackground = settings.background.kind != Background::environment ? 1u : 0u;
    frame.hasLayers = settings.layers != 0 ? 1u : 0u;
    if (settings.background.kind == Background::constant)
        frame.background = settings.background.radiance;
    const Camera& next = scene.next ? scene.next->camera : camera;
    const ViewExtent nextView =
        viewExtent(next, static_cast<float>(settings.image.width), static_cast<float>(settings.image.height));
    frame.nextPosition = next.position;
    frame.nextRight = next.right * nextView.halfWidth;
    frame.nextUp = next.up * nextView.halfHeight;
    frame.nextForward = next.forward;
    frame.catchesShadows = settings.ground.kind == Ground::shadow ? 1u : 0u;
    if (frame.catchesShadows != 0)
        frame.groundHeight = scene.groundHeight;
    setStart(startingSolids(scene, camera, seen, clip.nearest), frame);
    return frame;
}

void setLights(FrameParameters& frame, const Lights& lights) {
    frame.environment = lights.environmentRadiance;
    frame.environmentLight = lights.environment.value_or(kNoLight);
    frame.environmentWidth = lights.environmentMap ? lights.environmentMap->width : 0;
    frame.environmentHeight = lights.environmentMap ? lights.environmentMap->height : 0;
    if (lights.sun) {
        frame.sunDirection = turned(lights.sun->direction, frame.environmentRotation);
        frame.sunRadiance = lights.sun->radiance;
        frame.sunSize = lights.sun->size;
        frame.sunShare = static_cast<float>(lights.sunShare);
    }
    frame.firstLightColumn = lights.firstColumn;
    frame.lightColumns = static_cast<uint32_t>(lights.table.size());
}

// The parameters that setLights() sets.
void copyLights(const FrameParameters& from, const Scene& scene, FrameParameters& to) {
    to.environment = from.environment;
    to.environmentLight = from.environmentLight;
    to.environmentWidth = from.environmentWidth;
    to.environmentHeight = from.environmentHeight;
    if (scene.environmentMap && scene.environmentMap->sun && from.sunSize > 0.0f)
        to.sunDirection = turned(scene.environmentMap->sun->direction, to.environmentRotation);
    to.sunRadiance = from.sunRadiance;
    to.sunSize = from.sunSize;
    to.sunShare = from.sunShare;
    to.firstLightColumn = from.firstLightColumn;
    to.lightColumns = from.lightColumns;
}

} // namespace lavalight
