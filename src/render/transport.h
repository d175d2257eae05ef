// Transports: methods by which a render finds light. A transport is a table of its kernels, of the state that
// they keep for each path, and of the sink that takes its results; the schedules run whatever such table they
// are given.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "render/settings.h"
#include "shared/features.h"

namespace lavalight {

// What a kernel has an invocation for.
enum class Over {
    slots,      // each path slot of the wave
    rays,       // each ray of the bounce
    shadowRays, // each shadow ray of the bounce
    pixels,     // each pixel of the wave
    once        // nothing in particular: one invocation
};

struct KernelStep {
    std::string_view kernel; // its file in shaders/kernels, without .comp
    Over over;
};

// A buffer with a record for each path slot. Transports of one render share buffers of the same block.
struct SlotBuffer {
    std::string_view block;     // name by which kernels declare the buffer
    std::string_view label;     // name in messages
    uint32_t bytes;             // size of a slot's record
    SceneFeatures onlyWith = 0; // features without which no kernel uses the buffer; 0: kernels always do
};

// Kernels of Schedule::hosted.
struct HostedKernels {
    std::string_view camera;  // starts paths
    std::string_view scatter; // takes the vertices of a class of materials
    std::string_view escape;  // ends the paths whose rays met nothing
};

struct Transport {
    std::string_view name; // in reports
    // Schedule::wavefront: kernels at the start of a wave, then those of each bounce.
    std::span<const KernelStep> start;
    std::span<const KernelStep> bounce;
    std::span<const SlotBuffer> wavefrontState;
    // Schedule::fused: one kernel takes whole paths; each invocation is a lane with several slots.
    std::string_view fusedKernel;
    std::span<const SlotBuffer> fusedState;
    // Schedule::hosted.
    HostedKernels hosted;
    std::span<const SlotBuffer> hostedState;
    // The sink adds the results of a finished wave to the film. Where films have layers, another kernel takes
    // its place, which is much to compile.
    KernelStep sink;
    std::string_view sinkOfLayers;
};

// The schedule must not be automatic.
[[nodiscard]] std::span<const SlotBuffer> stateOf(const Transport& transport, Schedule schedule);

// Paths from the camera, with next-event estimation at their vertices: shaders/scene/scatter.glsl.
extern const Transport kPathTransport;

} // namespace lavalight
