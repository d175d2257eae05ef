// `lavalight bench rays`: how fast rays are traced, beside Embree on the same rays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/command.h"
#include "cli/options/device_options.h"
#include "gltf/import_options.h"
#include "render/settings.h"

namespace lavalight {

class BenchCommand : public Command {
  public:
    explicit BenchCommand(CLI::App& app);
    // Prints Mrays/s of camera, bounce and shadow rays, ours and Embree's, one thread each.
    [[nodiscard]] int run() override;

  private:
    std::string scene_;
    ImportOptions import_;
    std::optional<DeviceOptions> deviceOptions_; // always there
    RayAccelerator accelerator_ = RayAccelerator::bvh8;
    uint32_t rays_ = 1000000; // number of camera rays; the others start where these hit
    uint32_t repeats_ = 5;
    bool json_ = false;
};

} // namespace lavalight
