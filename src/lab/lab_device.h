// The device that an experiment runs on, and the caller's word between its passes.
#pragma once

#include <functional>

#include "gpu/device.h"

namespace lavalight {

struct LabDevice {
    gpu::Device& device;
    // Called before each run of a kernel and between the waves of a render, from the experiment's thread.
    // What it throws ends the experiment.
    std::function<void()> betweenPasses{};

    void look() const {
        if (betweenPasses)
            betweenPasses();
    }
};

} // namespace lavalight
