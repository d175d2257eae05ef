// Phases of a render, which follow one another.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "render/settings.h"
#include "render/transport.h"

namespace lavalight {

// Samples of every pixel that one transport takes, [firstSample, firstSample + samples).
struct Phase {
    const Transport* transport; // one that lasts as long as the program
    uint32_t firstSample;
    uint32_t samples;
};

// The phases of a render. Their samples are StopRule::samples together; a stop rule may end the render
// before.
[[nodiscard]] std::vector<Phase> phasesOf(const RenderSettings& settings);

// Names of the kernels that the phases run by a schedule, each once. The schedule must not be automatic.
// Schedule::hosted may run several variants of one: kernelVariants() in render/estimator_kernels.h.
[[nodiscard]] std::vector<std::string_view> kernelNames(std::span<const Phase> phases, Schedule schedule);
[[nodiscard]] std::vector<std::string_view> kernelNames(const RenderSettings& settings);

} // namespace lavalight
