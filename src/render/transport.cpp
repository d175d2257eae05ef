#include "render/transport.h"

#include <array>
#include <cassert>

#include "shared/wavefront.h"

namespace lavalight {
namespace {

constexpr std::array kPathStart{KernelStep{"generate", Over::slots}};
constexpr std::array kPathBounce{KernelStep{"extend", Over::rays}, KernelStep{"shade", Over::rays},
                                 KernelStep{"prepare", Over::once}, KernelStep{"connect", Over::shadowRays}};
constexpr std::array kPathWavefrontState{
    SlotBuffer{"Rays", "rays", sizeof(Ray)}, SlotBuffer{"Hits", "hits", sizeof(Hit)},
    SlotBuffer{"Paths", "paths", sizeof(Path)}, SlotBuffer{"ShadowRays", "shadow rays", sizeof(ShadowRay)}};
constexpr std::array kPathFusedState{
    SlotBuffer{"Paths", "paths", sizeof(Path)},
    SlotBuffer{"WaitingPaths", "waiting paths", sizeof(WaitingPath), kFeatureManyTriangles}};

} // namespace

constinit const Transport kPathTransport{.name = "path",
                                         .start = kPathStart,
                                         .bounce = kPathBounce,
                                         .wavefrontState = kPathWavefrontState,
                                         .fusedKernel = "path",
                                         .fusedState = kPathFusedState,
                                         .sink = {"accumulate", Over::pixels}};

std::span<const SlotBuffer> stateOf(const Transport& transport, Schedule schedule) {
    assert(schedule != Schedule::automatic);
    return schedule == Schedule::fused ? transport.fusedState : transport.wavefrontState;
}

} // namespace lavalight
