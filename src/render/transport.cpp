#include "render/transport.h"

#include <array>
#include <cassert>

#include "shared/path_layers.h"
#include "shared/wavefront.h"

namespace lavalight {
namespace {

constexpr std::array kPathStart{KernelStep{"generate", Over::slots}};
constexpr std::array kPathBounce{KernelStep{"extend", Over::rays}, KernelStep{"shade", Over::rays},
                                 KernelStep{"prepare", Over::once}, KernelStep{"connect", Over::shadowRays}};
constexpr SlotBuffer kLayers{"Layers", "path layers", sizeof(PathLayers), kFeatureLayers};
constexpr SlotBuffer kSurfaces{"Surfaces", "surfaces of samples", sizeof(uint32_t), kFeatureLayers};
constexpr std::array kPathWavefrontState{SlotBuffer{"Rays", "rays", sizeof(Ray)},
                                         SlotBuffer{"Hits", "hits", sizeof(Hit)},
                                         SlotBuffer{"Paths", "paths", sizeof(Path)},
                                         SlotBuffer{"ShadowRays", "shadow rays", sizeof(ShadowRay)},
                                         kLayers,
                                         kSurfaces};
constexpr std::array kPathFusedState{
    SlotBuffer{"Paths", "paths", sizeof(Path)},
    SlotBuffer{"WaitingPaths", "waiting paths", sizeof(WaitingPath), kFeatureManyTriangles}, kLayers,
    kSurfaces};
constexpr std::array kPathHostedState{SlotBuffer{"Paths", "paths", sizeof(Path)}, kLayers, kSurfaces};

} // namespace

constinit const Transport kPathTransport{
    .name = "path",
    .start = kPathStart,
    .bounce = kPathBounce,
    .wavefrontState = kPathWavefrontState,
    .fusedKernel = "path",
    .fusedState = kPathFusedState,
    .hosted = {.camera = "hosted/camera", .scatter = "hosted/scatter", .escape = "hosted/escape"},
    .hostedState = kPathHostedState,
    .sink = {"accumulate", Over::pixels},
    .sinkOfLayers = "accumulate_layers"};

std::span<const SlotBuffer> stateOf(const Transport& transport, Schedule schedule) {
    assert(schedule != Schedule::automatic);
    return schedule == Schedule::fused    ? transport.fusedState
           : schedule == Schedule::hosted ? transport.hostedState
                                          : transport.wavefrontState;
}

} // namespace lavalight
