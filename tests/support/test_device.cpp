#include "support/test_device.h"

#include <cstdlib>

namespace lavalight::test {

gpu::DeviceConfig testDeviceConfig() {
    gpu::DeviceConfig config;
    const char* wanted = std::getenv("LAVALIGHT_TEST_DEVICE");
    config.wanted = wanted != nullptr ? wanted : "";
    config.validate = true;
    return config;
}

gpu::Device& testDevice() {
    // The device is never destroyed: at exit the validation layer may be unloaded before it.
    static auto* const device = new gpu::Device(testDeviceConfig());
    return *device;
}

void DeviceTest::SetUp() {
    messagesBefore_ = device().validationMessages().size();
}

void DeviceTest::TearDown() {
    const auto messages = device().validationMessages();
    if (messages.size() > messagesBefore_)
        ADD_FAILURE() << "the validation layer says: " << messages[messagesBefore_];
}

} // namespace lavalight::test
