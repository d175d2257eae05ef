// A Vulkan layer that makes one call fail. A program has it where VK_INSTANCE_LAYERS names it; then
//   LAVALIGHT_FAULT="N RESULT"  the N-th of the calls below returns that VkResult instead of being made;
//   after
//                               VK_ERROR_DEVICE_LOST (-4) all later ones return it too, as of a real device
//   LAVALIGHT_FAULT="hidden"    no queue can present to a window
//   LAVALIGHT_FAULT_LOG=FILE    gets the names of the calls, one a line
// A program that loads this library itself may ask for faults while it runs: the functions at the end.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace {

struct Fault {
    std::atomic<long> call = 0; // 0: none
    std::atomic<VkResult> result = VK_SUCCESS;
    bool hidesWindows = false;
};

void readFault(Fault& fault) {
    const char* text = std::getenv("LAVALIGHT_FAULT");
    if (text == nullptr)
        return;
    long call = 0;
    int result = 0;
    if (std::sscanf(text, "%ld %d", &call, &result) == 2) {
        fault.call = call;
        fault.result = static_cast<VkResult>(result);
    }
    fault.hidesWindows = std::strcmp(text, "hidden") == 0;
}

std::FILE* openLog() {
    const char* file = std::getenv("LAVALIGHT_FAULT_LOG");
    return file == nullptr ? nullptr : std::fopen(file, "w");
}

Fault fault;
[[maybe_unused]] const bool isFaultRead = (readFault(fault), true);
std::FILE* const callLog = openLog();
std::atomic<long> calls = 0;
std::atomic<bool> deviceIsLost = false;
std::atomic<const char*> lastFailure = "";

// What a call returns instead of being made, or VK_SUCCESS.
VkResult failureOf(const char* name) {
    const long call = ++calls;
    if (callLog != nullptr) {
        std::fprintf(callLog, "%s\n", name);
        std::fflush(callLog);
    }
    if (deviceIsLost)
        return VK_ERROR_DEVICE_LOST;
    if (call != fault.call)
        return VK_SUCCESS;
    lastFailure = name;
    deviceIsLost = fault.result == VK_ERROR_DEVICE_LOST;
    return fault.result;
}

// The functions that follow in the chain. One for all instances and devices: they have the same driver.
PFN_vkGetInstanceProcAddr nextInstanceProcAddr = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProcAddr = nullptr;
VkInstance lastInstance = VK_NULL_HANDLE;

// A wrapper for every function whose pointer type returns a VkResult; Name tells functions of one type apart.
template <typename Name, typename Function>
struct Wrapper;
template <typename Name, typename... Arguments>
struct Wrapper<Name, VkResult(VKAPI_PTR*)(Arguments...)> {
    static inline VkResult(VKAPI_PTR* next)(Arguments...) = nullptr;

    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        const VkResult failure = failureOf(Name::text);
        if (failure == VK_ERROR_DEVICE_LOST && std::strstr(Name::text, "Wait") != nullptr)
            next(arguments...); // a lost device does no more work; this one is not really lost
        return failure == VK_SUCCESS ? next(arguments...) : failure;
    }
};

#define INSTANCE_CALLS(X)                                                                                    \
    X(EnumeratePhysicalDevices)                                                                              \
    X(GetPhysicalDeviceSurfaceCapabilitiesKHR)                                                               \
    X(GetPhysicalDeviceSurfaceFormatsKHR)                                                                    \
    X(GetPhysicalDeviceSurfacePresentModesKHR)
#define DEVICE_CALLS(X)                                                                                      \
    X(AllocateMemory)                                                                                        \
    X(MapMemory)                                                                                             \
    X(BindBufferMemory)                                                                                      \
    X(BindImageMemory)                                                                                       \
    X(CreateBuffer)                                                                                          \
    X(CreateBufferView)                                                                                      \
    X(CreateImage)                                                                                           \
    X(CreateImageView)                                                                                       \
    X(CreateSampler)                                                                                         \
    X(CreateRenderPass)                                                                                      \
    X(CreateFramebuffer)                                                                                     \
    X(CreateShaderModule)                                                                                    \
    X(CreatePipelineLayout)                                                                                  \
    X(CreateComputePipelines)                                                                                \
    X(CreateGraphicsPipelines)                                                                               \
    X(CreateDescriptorSetLayout)                                                                             \
    X(CreateDescriptorPool)                                                                                  \
    X(AllocateDescriptorSets)                                                                                \
    X(CreateCommandPool)                                                                                     \
    X(AllocateCommandBuffers)                                                                                \
    X(BeginCommandBuffer)                                                                                    \
    X(EndCommandBuffer)                                                                                      \
    X(CreateEvent)                                                                                           \
    X(ResetEvent)                                                                                            \
    X(CreateQueryPool)                                                                                       \
    X(GetQueryPoolResults)                                                                                   \
    X(CreateFence)                                                                                           \
    X(ResetFences)                                                                                           \
    X(WaitForFences)                                                                                         \
    X(CreateSemaphore)                                                                                       \
    X(QueueSubmit)                                                                                           \
    X(QueueWaitIdle)                                                                                         \
    X(DeviceWaitIdle)                                                                                        \
    X(CreateSwapchainKHR)                                                                                    \
    X(GetSwapchainImagesKHR)                                                                                 \
    X(AcquireNextImageKHR)                                                                                   \
    X(QueuePresentKHR)

#define DECLARE_NAME(function)                                                                               \
    struct Name##function {                                                                                  \
        static constexpr const char* text = #function;                                                       \
    };
INSTANCE_CALLS(DECLARE_NAME)
DEVICE_CALLS(DECLARE_NAME)

VKAPI_ATTR VkResult VKAPI_CALL noSurfaceSupport(VkPhysicalDevice, uint32_t, VkSurfaceKHR,
                                                VkBool32* supported) {
    *supported = VK_FALSE;
    return VK_SUCCESS;
}

// Goes one link down the chain that the loader hands to vkCreateInstance and vkCreateDevice.
template <typename Link, typename Info>
Link* nextLink(const Info* info, VkStructureType type) {
    auto* link = static_cast<Link*>(const_cast<void*>(info->pNext));
    while (link->sType != type || link->function != VK_LAYER_LINK_INFO)
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
    auto* link = nextLink<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    nextInstanceProcAddr = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    if (const VkResult failure = failureOf("CreateInstance"))
        return failure;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProcAddr(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    if (result == VK_SUCCESS)
        lastInstance = *instance;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physicalDevice, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link = nextLink<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    nextDeviceProcAddr = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    if (const VkResult failure = failureOf("CreateDevice"))
        return failure;
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(nextInstanceProcAddr(lastInstance, "vkCreateDevice"));
    return create(physicalDevice, info, allocator, device);
}

template <typename Wrapped>
PFN_vkVoidFunction wrap(PFN_vkVoidFunction next) {
    if (next == nullptr)
        return nullptr;
    Wrapped::next = reinterpret_cast<decltype(Wrapped::next)>(next);
    return reinterpret_cast<PFN_vkVoidFunction>(&Wrapped::call);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProcAddr(VkDevice device, const char* name) {
    const std::string wanted = name;
    if (wanted == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&deviceProcAddr);
    const PFN_vkVoidFunction next = nextDeviceProcAddr(device, name);
#define RETURN_WRAPPED(function)                                                                             \
    if (wanted == "vk" #function)                                                                            \
        return wrap<Wrapper<Name##function, PFN_vk##function>>(next);
    DEVICE_CALLS(RETURN_WRAPPED)
    return next;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProcAddr(VkInstance instance, const char* name) {
    const std::string wanted = name;
    if (wanted == "vkGetInstanceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&instanceProcAddr);
    if (wanted == "vkCreateInstance")
        return reinterpret_cast<PFN_vkVoidFunction>(&createInstance);
    if (wanted == "vkCreateDevice")
        return reinterpret_cast<PFN_vkVoidFunction>(&createDevice);
    if (wanted == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&deviceProcAddr);
    if (wanted == "vkGetPhysicalDeviceSurfaceSupportKHR" && fault.hidesWindows)
        return reinterpret_cast<PFN_vkVoidFunction>(&noSurfaceSupport);
    const PFN_vkVoidFunction next = nextInstanceProcAddr(instance, name);
    INSTANCE_CALLS(RETURN_WRAPPED) // calls of devices come through deviceProcAddr
    return next;
}

} // namespace

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
    negotiation->loaderLayerInterfaceVersion = 2;
    negotiation->pfnGetInstanceProcAddr = &instanceProcAddr;
    negotiation->pfnGetDeviceProcAddr = &deviceProcAddr;
    negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}

// From now on the `call`-th call returns `result`; 0: none does.
extern "C" void lavalightFaultSet(long call, int result) {
    calls = 0;
    deviceIsLost = false;
    lastFailure = "";
    fault.result = static_cast<VkResult>(result);
    fault.call = call;
}
// The name of the call that failed since then; empty: none did.
extern "C" const char* lavalightFaultMet() {
    return lastFailure;
}
