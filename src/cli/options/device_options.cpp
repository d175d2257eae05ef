#include "cli/options/device_options.h"

#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/parse.h"
#include "cli/options/named_option.h"

namespace lavalight {

namespace {

constexpr unsigned kMostThreads = 1024;

// Destructors would wait for the device, and so for ever.
[[noreturn]] void endProcess(const std::string& message) {
    spdlog::error("{}", message);
    spdlog::default_logger()->flush();
    std::_Exit(1);
}

} // namespace

void limitAllThreads(unsigned threads) {
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1); // lavapipe's
    limitThreads(threads);
}

DeviceOptions::DeviceOptions(CLI::App& parser) {
    parser.add_option("--device", config_.wanted, "Vulkan device by name or index (see lavalight devices)")
        ->type_name("NAME|INDEX");
    const std::map<std::string, gpu::RequiredDevice> kinds{{"any", gpu::RequiredDevice::any},
                                                           {"cpu", gpu::RequiredDevice::cpu},
                                                           {"gpu", gpu::RequiredDevice::gpu}};
    addOneOf(parser, "--require-device", config_.required, kinds, "Refuse to run on another kind of device")
        ->type_name("any|cpu|gpu")
        ->default_str("any");
    parser
        .add_option_function<unsigned>(
            "--threads", limitAllThreads,
            "Threads of lavapipe, of rays on the host, of loading and of denoising; default: the processors")
        ->type_name("N")
        ->check(CLI::Validator(
            [](std::string& text) {
                const std::optional<unsigned> threads = parseNumber<unsigned>(text);
                return threads && *threads >= 1 && *threads <= kMostThreads
                           ? std::string()
                           : fmt::format("{} is not a number from 1 to {}", text, kMostThreads);
            },
            ""));
    parser.add_flag("--validate", config_.validate,
                    "Run the Vulkan validation layer; any message fails the run");
    parser
        .add_option("--kernel-timeout", config_.kernelTimeout,
                    "Give up where a kernel has not come back after so many seconds; 0: wait for ever")
        ->type_name("SECONDS");
}

gpu::DeviceConfig DeviceOptions::config() const {
    if (!(config_.kernelTimeout >= 0.0)) // NaN is not
        throw UsageError("--kernel-timeout: not a number of seconds; give 0 or more");
    gpu::DeviceConfig config = config_;
    config.onKernelTimeout = endProcess;
    return config;
}

} // namespace lavalight
