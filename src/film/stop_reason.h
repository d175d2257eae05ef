// Why a render ended.
#pragma once

#include <string_view>

namespace lavalight {

enum class StopReason { samples, time, targetError, interrupted };

// The reason's word in reports: "samples", "time", "target-error" or "interrupted".
[[nodiscard]] std::string_view nameOf(StopReason reason);

} // namespace lavalight
