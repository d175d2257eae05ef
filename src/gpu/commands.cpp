#include "gpu/commands.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

namespace lavalight::gpu {
namespace {

// Timestamps of one submission; what goes beyond is run but not timed.
constexpr uint32_t kMaxStamps = 4096;

// The command buffer calls the device's own functions: those of vk::CommandBuffer would link the build's
// loader.
const vk::raii::CommandBuffer& recorded(const std::vector<vk::raii::CommandBuffer>& buffers) {
    return buffers.front();
}

} // namespace

Commands::Commands(Device& device) : device_(&device) {
    checked("create", "a command buffer", [&] {
        pool_ = vk::raii::CommandPool(
            device.handle(), vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                       device.queueFamily()));
        const vk::CommandBufferAllocateInfo info(*pool_, vk::CommandBufferLevel::ePrimary, 1);
        for (auto& buffer : vk::raii::CommandBuffers(device.handle(), info))
            buffers_.push_back(std::move(buffer));
        fence_ = vk::raii::Fence(device.handle(), vk::FenceCreateInfo());
        if (device.limits().timestampNanoseconds > 0.0)
            queries_ = vk::raii::QueryPool(
                device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, kMaxStamps));
    });
}

Commands::~Commands() {
    if (isRunning_ && *pool_)
        waitUntilIdle();
}

Commands& Commands::operator=(Commands&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(buffers_, other.buffers_);
    std::swap(fence_, other.fence_);
    std::swap(marks_, other.marks_);
    std::swap(marked_, other.marked_);
    std::swap(isRunning_, other.isRunning_);
    std::swap(queries_, other.queries_);
    std::swap(timing_, other.timing_);
    std::swap(stamps_, other.stamps_);
    std::swap(submitted_, other.submitted_);
    std::swap(times_, other.times_);
    return *this;
}

void Commands::begin(Timing timing) {
    wait();
    timing_ = timing;
    checked("begin", "a command buffer", [&] {
        for (size_t i = 0; i < marked_.size(); ++i)
            marks_[i].reset();
        device_->handle().resetFences(*fence_);
        buffers_.front().reset(); // a failure may have left it half recorded
        buffers_.front().begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    });
    stamps_.clear();
    marked_.clear();
    if (*queries_ && timing_ == Timing::eachKernel)
        recorded(buffers_).resetQueryPool(*queries_, 0, kMaxStamps);
    stamp("");
}

void Commands::stamp(std::string_view name, uint32_t groups) {
    if (stamps_.size() == kMaxStamps)
        return;
    if (timing_ == Timing::eachKernel) {
        if (!*queries_)
            return;
        recorded(buffers_).writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *queries_,
                                          static_cast<uint32_t>(stamps_.size()));
    }
    stamps_.push_back({std::string(name), groups});
}

// Timestamps would say it too, but lavapipe waits for the submission where it is asked for one.
void Commands::mark(const std::string& kernel) {
    if (marks_.size() == marked_.size())
        checked("create", "an event", [&] { marks_.emplace_back(device_->handle(), vk::EventCreateInfo()); });
    marked_.push_back(kernel);
    recorded(buffers_).setEvent(*marks_[marked_.size() - 1], vk::PipelineStageFlagBits::eComputeShader);
}

void Commands::prepareDispatch(const BoundKernel& kernel, std::span<const std::byte> pushConstants) {
    assert(pushConstants.size() == kernel.kernel().code().pushConstantBytes);
    const vk::raii::CommandBuffer& commands = recorded(buffers_);
    const vk::PipelineLayout layout = kernel.kernel().layout();
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, kernel.kernel().pipeline());
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, layout, 0, kernel.set(), {});
    if (!pushConstants.empty())
        commands.pushConstants<std::byte>(
            layout, vk::ShaderStageFlagBits::eCompute, 0,
            {static_cast<uint32_t>(pushConstants.size()), pushConstants.data()});
}

void Commands::finishCommand() {
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    const vk::PipelineStageFlags work = Stage::eComputeShader | Stage::eTransfer;
    const vk::MemoryBarrier barrier(Access::eShaderWrite | Access::eTransferWrite,
                                    Access::eShaderRead | Access::eShaderWrite |
                                        Access::eIndirectCommandRead | Access::eTransferRead |
                                        Access::eTransferWrite | Access::eHostRead);
    recorded(buffers_).pipelineBarrier(work, work | Stage::eDrawIndirect | Stage::eHost, {}, barrier, {}, {});
}

void Commands::dispatch(const BoundKernel& kernel, uint32_t groups,
                        std::span<const std::byte> pushConstants) {
    assert(groups <= device_->limits().maxGroups);
    prepareDispatch(kernel, pushConstants);
    recorded(buffers_).dispatch(groups, 1, 1);
    finishCommand();
    mark(kernel.kernel().name());
    stamp(kernel.kernel().name(), groups);
}

void Commands::dispatchIndirect(const BoundKernel& kernel, const Buffer& sizes, uint64_t offset,
                                std::span<const std::byte> pushConstants) {
    prepareDispatch(kernel, pushConstants);
    recorded(buffers_).dispatchIndirect(sizes.handle(), offset);
    finishCommand();
    mark(kernel.kernel().name());
    stamp(kernel.kernel().name(), 1);
}

void Commands::build(const vk::AccelerationStructureBuildGeometryInfoKHR& geometry, uint32_t primitives) {
    using Access = vk::AccessFlagBits;
    using Stage = vk::PipelineStageFlagBits;
    const vk::AccelerationStructureBuildRangeInfoKHR range(primitives, 0, 0, 0);
    const vk::raii::CommandBuffer& commands = recorded(buffers_);
    const vk::MemoryBarrier copied(Access::eTransferWrite, Access::eShaderRead);
    commands.pipelineBarrier(Stage::eTransfer, Stage::eAccelerationStructureBuildKHR, {}, copied, {}, {});
    commands.buildAccelerationStructuresKHR(geometry, &range);
    const vk::MemoryBarrier barrier(Access::eAccelerationStructureWriteKHR,
                                    Access::eAccelerationStructureReadKHR |
                                        Access::eAccelerationStructureWriteKHR);
    commands.pipelineBarrier(Stage::eAccelerationStructureBuildKHR,
                             Stage::eAccelerationStructureBuildKHR | Stage::eComputeShader, {}, barrier, {},
                             {});
}

void Commands::fill(const Buffer& buffer, uint32_t value) {
    recorded(buffers_).fillBuffer(buffer.handle(), 0, VK_WHOLE_SIZE, value);
    finishCommand();
    stamp("");
}

void Commands::copy(const Buffer& from, const Buffer& to, uint64_t bytes) {
    recorded(buffers_).copyBuffer(from.handle(), to.handle(), vk::BufferCopy(0, 0, bytes));
    finishCommand();
    stamp("");
}

void Commands::submit() {
    checked("run", "a submission", [&] {
        buffers_.front().end();
        const vk::CommandBuffer commands = *recorded(buffers_);
        submitted_ = std::chrono::steady_clock::now();
        device_->queue().submit(vk::SubmitInfo({}, {}, commands), *fence_);
    });
    isRunning_ = true;
}

void Commands::wait() {
    if (!isRunning_)
        return;
    isRunning_ = false; // a failure leaves the queue idle, too
    checked("run", "a submission", [&] {
        while (!waitForFence())
            reportTimeout();
    });
    timing_ == Timing::eachKernel ? collectTimes() : shareOutTime();
}

void Commands::waitUntilIdle() const {
    try {
        device_->queue().waitIdle();
    } catch (const vk::SystemError&) { // a lost device is idle enough
    }
}

// False: not in time.
bool Commands::waitForFence() const {
    constexpr double kNever = 1e9; // seconds, which as nanoseconds fit in 64 bits
    const double seconds =
        device_->kernelTimeout() > 0.0 ? std::min(device_->kernelTimeout(), kNever) : kNever;
    const auto nanoseconds = static_cast<uint64_t>(seconds * 1e9);
    try {
        return device_->handle().waitForFences(*fence_, VK_TRUE, nanoseconds) == vk::Result::eSuccess;
    } catch (const vk::SystemError&) {
        waitUntilIdle(); // buffers die while this unwinds
        throw;
    }
}

void Commands::reportTimeout() const {
    device_->reportKernelTimeout(fmt::format("kernel {} has not come back within {} s (--kernel-timeout)",
                                             unfinishedKernel(), device_->kernelTimeout()));
}

std::string Commands::unfinishedKernel() const {
    for (size_t i = 0; i < marked_.size(); ++i)
        if (marks_[i].getStatus() != vk::Result::eEventSet)
            return marked_[i];
    return "of a submission";
}

void Commands::collectTimes() {
    if (stamps_.size() < 2)
        return;
    const auto [result, ticks] = checked("read", "the kernels' times", [&] {
        return queries_.getResults<uint64_t>(0, static_cast<uint32_t>(stamps_.size()),
                                             stamps_.size() * sizeof(uint64_t), sizeof(uint64_t),
                                             vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    });
    if (result != vk::Result::eSuccess)
        return;
    for (size_t i = 1; i < stamps_.size(); ++i) {
        if (stamps_[i].name.empty())
            continue;
        KernelTime& time = times_[stamps_[i].name];
        time.seconds +=
            static_cast<double>(ticks[i] - ticks[i - 1]) * device_->limits().timestampNanoseconds * 1e-9;
        ++time.dispatches;
    }
}

void Commands::shareOutTime() {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - submitted_).count();
    uint64_t allGroups = 0;
    for (const Stamp& stamp : stamps_)
        allGroups += stamp.groups;
    for (const Stamp& stamp : stamps_) {
        if (stamp.groups == 0)
            continue;
        KernelTime& time = times_[stamp.name];
        time.seconds += seconds * stamp.groups / static_cast<double>(allGroups);
        ++time.dispatches;
    }
}

void copyAndWait(Device& device, const Buffer& from, const Buffer& to, uint64_t bytes) {
    Commands commands(device);
    commands.begin();
    commands.copy(from, to, bytes);
    commands.submitAndWait();
}

} // namespace lavalight::gpu
