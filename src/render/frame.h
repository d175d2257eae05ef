// What kernels are told of a render: camera, image, lights, settings.
#pragma once

#include "light/lights.h"
#include "render/settings.h"
#include "scene/scene.h"
#include "shared/frame.h"

namespace lavalight {

// Parameters for the kernels, but for lights.
[[nodiscard]] FrameParameters makeFrame(const Scene& scene, const Camera& camera,
                                        const RenderSettings& settings);
void setLights(FrameParameters& frame, const Lights& lights);
// Takes what setLights() set of that scene. The map may be turned otherwise.
void copyLights(const FrameParameters& from, const Scene& scene, FrameParameters& to);

} // namespace lavalight
