#include "gpu/spirv_passes.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spirv-tools/libspirv.h>
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

void registerSpecialising(spvtools::Optimizer& optimizer, std::span<const SpecialisationConstant> constants) {
    std::unordered_map<uint32_t, std::vector<uint32_t>> values;
    for (const SpecialisationConstant& constant : constants)
        values[constant.id] = {constant.value};
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values));
    optimizer.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass());
    optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    for (int round = 0; round < 2; ++round) { // the second finds what the first has laid bare
        optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
        optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    }
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
    return run(spirv, [&](spvtools::Optimizer& optimizer) { registerSpecialising(optimizer, constants); });
}

// Goes over the instructions, whose first word has their length in its upper half (SPIR-V 1.5, 2.3), for
// OpDecorate of an id, SpecId, and the number of the constant.
std::vector<SpecialisationConstant> declaredIn(std::span<const uint32_t> spirv,
                                               std::span<const SpecialisationConstant> constants) {
    constexpr size_t kHeaderWords = 5;
    constexpr uint32_t kOpDecorate = 71;
    constexpr uint32_t kSpecId = 1;
    std::unordered_set<uint32_t> declared;
    for (size_t i = kHeaderWords; i < spirv.size(); i += std::max(spirv[i] >> 16, 1u))
        if ((spirv[i] & 0xffffu) == kOpDecorate && i + 3 < spirv.size() && spirv[i + 2] == kSpecId)
            declared.insert(spirv[i + 3]);
    std::vector<SpecialisationConstant> result;
    for (const SpecialisationConstant& constant : constants)
        if (declared.contains(constant.id))
            result.push_back(constant);
    return result;
}

std::string specialisingPasses() {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    registerSpecialising(optimizer, {});
    return fmt::format("{} {}", spvSoftwareVersionString(), fmt::join(optimizer.GetPassNames(), " "));
}

} // namespace lavalight::gpu
