// Primitives compressed by Draco: KHR_draco_mesh_compression.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/file/buffers.h"

namespace lavalight {

// Decodes every compressed primitive of `json`, which has passed the schema check, into a buffer of its own
// at the end of `buffers`, and makes the primitive an ordinary triangle list whose accessors view that
// buffer. Throws Error naming the mesh for a damaged stream and for one that lacks a promised attribute.
void decodeDraco(nlohmann::json& json, std::vector<GltfBuffer>& buffers, const std::string& source);

} // namespace lavalight
