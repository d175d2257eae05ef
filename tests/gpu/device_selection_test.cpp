// Which device is taken, and why others are not: of machines that are not there.
#include "gpu/device_selection.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/error.h"
#include "kernels/kernel_source.h"
#include "kernels/shader_overlay.h"

namespace lavalight::gpu {
namespace {

DeviceDescription device(uint32_t index, const std::string& name, bool isCpu) {
    DeviceDescription description;
    description.index = index;
    description.name = name;
    description.isCpu = isCpu;
    return description;
}

// A machine with software, a graphics card, an older one that lacks something, and another card.
std::vector<DeviceDescription> machine() {
    std::vector<DeviceDescription> devices = {device(0, "llvmpipe", true), device(1, "Old Card", false),
                                              device(2, "Card", false), device(3, "Other Card", false)};
    devices[1].refusals = {"Vulkan 1.0, 1.2 needed"};
    return devices;
}

std::string errorOf(const std::vector<DeviceDescription>& devices, const DeviceConfig& config) {
    try {
        return "took " + std::to_string(chooseDevice(devices, config));
    } catch (const Error& error) {
        return error.what();
    }
}

DeviceConfig wanted(const std::string& words, RequiredDevice required = RequiredDevice::any) {
    DeviceConfig config;
    config.wanted = words;
    config.required = required;
    return config;
}

TEST(DeviceSelection, TakesTheFirstCardThatCanUnlessSoftwareIsAskedFor) {
    EXPECT_EQ(chooseDevice(machine(), wanted("")), 2u);
    EXPECT_EQ(chooseDevice(machine(), wanted("", RequiredDevice::gpu)), 2u);
    EXPECT_EQ(chooseDevice(machine(), wanted("", RequiredDevice::cpu)), 0u);
    EXPECT_EQ(chooseDevice({machine()[0], machine()[0]}, wanted("")), 0u);
}

TEST(DeviceSelection, TakesWhatIsNamedByIndexOrPartOfTheName) {
    EXPECT_EQ(chooseDevice(machine(), wanted("3")), 3u);
    EXPECT_EQ(chooseDevice(machine(), wanted("OTHER")), 3u);
    EXPECT_EQ(chooseDevice(machine(), wanted("pipe")), 0u);
}

TEST(DeviceSelection, SaysOfEachDeviceWhyItWasNotTaken) {
    EXPECT_EQ(errorOf({}, wanted("")),
              "no usable Vulkan device: none found; Debian's mesa-vulkan-drivers has one for CPUs");
    EXPECT_EQ(
        errorOf(machine(), wanted("old")),
        "no usable Vulkan device; 0 llvmpipe: its name does not contain \"old\"; 1 Old Card: Vulkan 1.0, "
        "1.2 needed; 2 Card: its name does not contain \"old\"; 3 Other Card: its name does not contain "
        "\"old\"");
    EXPECT_EQ(errorOf({machine()[0]}, wanted("7", RequiredDevice::gpu)),
              "no usable Vulkan device; 0 llvmpipe: --require-device gpu, its index is not 7");
    EXPECT_EQ(errorOf({machine()[2]}, wanted("", RequiredDevice::cpu)),
              "no usable Vulkan device; 2 Card: --require-device cpu");
}

// What Vulkan 1.2 lets a device be, at the least that serves.
vk::PhysicalDeviceLimits leastLimits() {
    vk::PhysicalDeviceLimits limits;
    limits.maxPerStageDescriptorStorageBuffers = 8;
    limits.maxPerStageDescriptorSampledImages = 16;
    limits.maxComputeWorkGroupInvocations = 64;
    limits.maxTexelBufferElements = 1u << 20;
    return limits;
}

vk::PhysicalDeviceSubgroupProperties leastSubgroup() {
    vk::PhysicalDeviceSubgroupProperties subgroup;
    subgroup.supportedStages = vk::ShaderStageFlagBits::eCompute;
    subgroup.supportedOperations = vk::SubgroupFeatureFlagBits::eBasic | vk::SubgroupFeatureFlagBits::eBallot;
    return subgroup;
}

TEST(DeviceSelection, EachThingThatIsMissingIsNamedWithWhatIsNeeded) {
    EXPECT_EQ(whatIsMissing(leastLimits(), leastSubgroup()), std::vector<std::string>());
    vk::PhysicalDeviceLimits limits = leastLimits();
    --limits.maxPerStageDescriptorStorageBuffers;
    --limits.maxComputeWorkGroupInvocations;
    EXPECT_EQ(whatIsMissing(limits, leastSubgroup()),
              (std::vector<std::string>{"7 storage buffers per stage, 8 needed",
                                        "workgroups of 63 invocations at most, 64 needed"}));
    vk::PhysicalDeviceSubgroupProperties subgroup = leastSubgroup();
    subgroup.supportedOperations = vk::SubgroupFeatureFlagBits::eBasic;
    EXPECT_EQ(whatIsMissing(leastLimits(), subgroup),
              std::vector<std::string>{"no subgroup ballot (needed to compact the queues)"});
    subgroup = leastSubgroup();
    subgroup.supportedStages = vk::ShaderStageFlagBits::eFragment;
    EXPECT_EQ(whatIsMissing(leastLimits(), subgroup),
              std::vector<std::string>{"no subgroup operations in compute shaders"});
}

// Storage buffers for texels and all else.
TEST(DeviceSelection, TexelBuffersThatAreTooSmallOrTooFewTakeStorageBuffersInstead) {
    for (const bool areSmall : {true, false}) {
        vk::PhysicalDeviceLimits limits = leastLimits();
        EXPECT_TRUE(hasTexelBuffers(limits));
        --(areSmall ? limits.maxTexelBufferElements : limits.maxPerStageDescriptorSampledImages);
        EXPECT_FALSE(hasTexelBuffers(limits));
        EXPECT_EQ(whatIsMissing(limits, leastSubgroup()),
                  std::vector<std::string>{"8 storage buffers per stage, 24 needed"});
        limits.maxPerStageDescriptorStorageBuffers = 24;
        EXPECT_EQ(whatIsMissing(limits, leastSubgroup()), std::vector<std::string>());
    }
}

TEST(DeviceSelection, NoKernelDeclaresMoreBuffersThanAreAskedFor) {
    size_t kernels = 0;
    uint32_t mostTexelBuffers = 0;
    for (const std::string& path : embeddedShaderPaths()) {
        if (!path.starts_with("kernels/") || !path.ends_with(".comp"))
            continue;
        const KernelCode code = embeddedKernel(path.substr(8, path.size() - 13));
        const auto count = [&](BindingKind kind) {
            return static_cast<uint32_t>(std::ranges::count(code.bindings, kind, &KernelBinding::kind));
        };
        EXPECT_LE(count(BindingKind::storageBuffer), kMostStorageBuffers) << path;
        EXPECT_LE(count(BindingKind::uniformTexelBuffer), kMostTexelBuffers) << path;
        mostTexelBuffers = std::max(mostTexelBuffers, count(BindingKind::uniformTexelBuffer));
        ++kernels;
    }
    EXPECT_GT(kernels, 10u);
    EXPECT_GE(mostTexelBuffers, 15u) << "the limit is a measured one";
}

} // namespace
} // namespace lavalight::gpu
