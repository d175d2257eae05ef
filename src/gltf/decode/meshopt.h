// Buffer views compressed by meshoptimizer's codecs: EXT_meshopt_compression, KHR_meshopt_compression.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/file/buffers.h"

namespace lavalight {

// Decodes every compressed view of `json`, which has passed the schema check, into a buffer of its own at the
// end of `buffers`, and makes the view an ordinary one of that buffer. Streams of codecs that the library
// does not know leave their view as it is where the file brings the data uncompressed too. Throws Error
// naming the view for others, and for damaged streams.
void decodeMeshopt(nlohmann::json& json, std::vector<GltfBuffer>& buffers, const std::string& source);

} // namespace lavalight
