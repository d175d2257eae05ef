#include "gpu/spirv_passes.h"

#include <string>
#include <unordered_map>

#include <fmt/format.h>
#include <spirv-tools/optimizer.hpp>

#include "base/error.h"

namespace lavalight::gpu {
namespace {

template <typename RegisterPasses>
std::vector<uint32_t> run(const std::vector<uint32_t>& spirv, const RegisterPasses& registerPasses) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    std::string messages;
    optimizer.SetMessageConsumer(
        [&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
            if (level <= SPV_MSG_ERROR) // higher levels warn, e.g. of functions that cannot be inlined
                messages += fmt::format("\n{}", message);
        });
    registerPasses(optimizer);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false); // the validation layer checks every module in the device tests
    std::vector<uint32_t> result;
    if (!optimizer.Run(spirv.data(), spirv.size(), &result, options))
        throw Error(fmt::format("SPIRV-Tools cannot change a kernel:{}", messages));
    return result;
}

} // namespace

std::vector<uint32_t> inlined(const std::vector<uint32_t>& spirv) {
    return run(spirv, [](spvtools::Optimizer& optimizer) {
        const auto registerMemoryPasses = [&] {
            optimizer.RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass());
            optimizer.RegisterPass(spvtools::CreateLocalSingleStoreElimPass());
            optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass());
        };
        optimizer.RegisterPass(spvtools::CreateInlineExhaustivePass());
        optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
        registerMemoryPasses();
        optimizer.RegisterPass(spvtools::CreateScalarReplacementPass());
        optimizer.RegisterPass(spvtools::CreateLocalAccessChainConvertPass());
        registerMemoryPasses();
        optimizer.RegisterPass(spvtools::CreateCCPPass()); // arguments that callers gave as constants
        optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
        optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass());
        optimizer.RegisterPass(spvtools::CreateBlockMergePass());
    });
}

std::vector<uint32_t> specialised(const std::vector<uint32_t>& spirv,
                                  std::span<const SpecialisationConstant> constants) {
    std::unordered_map<uint32_t, std::vector<uint32_t>> values;
    for (const SpecialisationConstant& constant : constants)
        values[constant.id] = {constant.value};
    return run(spirv, [&](spvtools::Optimizer& optimizer) {
        optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values));
        optimizer.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass());
        optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
        for (int round = 0; round < 2; ++round) { // the second finds what the first has laid bare
            optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
            optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
        }
    });
}

} // namespace lavalight::gpu
