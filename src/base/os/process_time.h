// How long this process has been running.
#pragma once

#include <optional>

namespace lavalight {

// Seconds since the process was started, loading of its libraries included, in steps of the kernel's clock
// (10 ms on Linux). Nothing where /proc does not tell.
[[nodiscard]] std::optional<double> secondsSinceProcessStart();

} // namespace lavalight
