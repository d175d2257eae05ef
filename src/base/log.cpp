#include "base/log.h"

#include <memory>

#include <spdlog/sinks/stdout_color_sinks.h>

namespace lavalight {

void configureLog(LogLevel level) {
    auto logger = std::make_shared<spdlog::logger>("lavalight",
                                                   std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    logger->set_pattern("lavalight: %^%l%$: %v");
    logger->set_level(level == LogLevel::quiet ? spdlog::level::err : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace lavalight
