// The options that choose a Vulkan device, shared by every command that uses one.
#pragma once

#include <CLI/CLI.hpp>

#include "gpu/device.h"

namespace lavalight {

// Lets lavapipe and loops on the host use so many threads. To be said before a device is opened.
void limitAllThreads(unsigned threads);

// Declares options on a parser. Must outlive the parsing; the parser points into it.
class DeviceOptions {
  public:
    explicit DeviceOptions(CLI::App& parser);
    DeviceOptions(const DeviceOptions&) = delete;
    DeviceOptions& operator=(const DeviceOptions&) = delete;

    // Throws UsageError for a time that is none.
    [[nodiscard]] gpu::DeviceConfig config() const;

  private:
    gpu::DeviceConfig config_;
};

} // namespace lavalight
