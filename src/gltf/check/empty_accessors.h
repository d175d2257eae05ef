// Accessors without elements: no glTF (specification, section 5.1.3), but exporters write them.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lavalight {

// Takes references to accessors of no elements off a checked document: attributes and morph targets, the
// inverse bind matrices of skins, channels of animations. The rest of the scene is then as if they had never
// been asked for. Indices and instances stay, since none of them means that nothing is shown.
void dropEmptyAccessors(nlohmann::json& json);

} // namespace lavalight
