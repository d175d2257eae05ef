// EXT_lights_image_based: the environment that a scene brings as a cube map.
#pragma once

#include <optional>
#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/notes.h"
#include "scene/scene.h"

namespace lavalight {

// The light of the document's chosen scene, unrolled, turned and scaled; none where it has none. Faces that
// cannot be read are noted, and the light is then what the irradiance coefficients say of it.
[[nodiscard]] std::optional<EnvironmentMap> readImageLight(const GltfDocument& document, GltfNotes& notes);

// The images of a file that are faces of lights, by number; ones that it does not have among them.
[[nodiscard]] std::vector<size_t> facesOfLights(JsonView json);

} // namespace lavalight
