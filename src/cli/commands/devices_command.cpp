#include "cli/commands/devices_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "gpu/device.h"

namespace lavalight {
namespace {

void printText(const std::vector<gpu::DeviceDescription>& devices) {
    for (const gpu::DeviceDescription& device : devices)
        fmt::print("{}  {} ({}, Vulkan {}, {}): {}\n", device.index, device.name, device.type,
                   device.apiVersion, device.driver,
                   device.refusals.empty() ? device.tracesRays ? "can render, traces rays" : "can render"
                                           : fmt::format("refused: {}", fmt::join(device.refusals, "; ")));
}

void printJson(const std::vector<gpu::DeviceDescription>& devices) {
    auto json = nlohmann::ordered_json::array();
    for (const gpu::DeviceDescription& device : devices)
        json.push_back({{"index", device.index},
                        {"name", device.name},
                        {"driver", device.driver},
                        {"type", device.type},
                        {"api", device.apiVersion},
                        {"tracesRays", device.tracesRays},
                        {"refusals", device.refusals}});
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace

DevicesCommand::DevicesCommand(CLI::App& app)
    : Command(app, "devices", "List the Vulkan devices with the reasons why one would be refused") {
    parser().add_flag("--json", json_, "Print JSON");
}

int DevicesCommand::run() {
    const std::vector<gpu::DeviceDescription> devices = gpu::listDevices();
    json_ ? printJson(devices) : printText(devices);
    return std::any_of(devices.begin(), devices.end(), [](const auto& d) { return d.refusals.empty(); }) ? 0
                                                                                                         : 1;
}

} // namespace lavalight
