#include "cli/options/device_options.h"

#include <cstdlib>
#include <map>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "cli/options/named_option.h"

namespace lavalight {

namespace {

// Destructors would wait for the device, and so for ever.
[[noreturn]] void endProcess(const std::string& message) {
    spdlog::error("{}", message);
    spdlog::default_logger()->flush();
    std::_Exit(1);
}

} // namespace

DeviceOptions::DeviceOptions(CLI::App& parser) {
    parser.add_option("--device", config_.wanted, "Vulkan device by name or index (see lavalight devices)")
        ->type_name("NAME|INDEX");
    const std::map<std::string, gpu::RequiredDevice> kinds{{"any", gpu::RequiredDevice::any},
                                                           {"cpu", gpu::RequiredDevice::cpu},
                                                           {"gpu", gpu::RequiredDevice::gpu}};
    parser.add_option("--require-device", config_.required, "Refuse to run on another kind of device")
        ->type_name("any|cpu|gpu")
        ->transform(oneOf(kinds))
        ->default_str("any");
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
