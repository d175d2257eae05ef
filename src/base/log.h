// Messages for people: always on stderr, so that stdout carries results alone.
#pragma once

#include <spdlog/spdlog.h>

namespace lavalight {

enum class LogLevel { quiet, normal };

// Sends spdlog's messages to stderr as "lavalight: warning: text"; quiet keeps errors only. Call once, from
// main.
void configureLog(LogLevel level);

} // namespace lavalight
