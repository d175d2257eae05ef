// The device that device tests share: opened once per process, with the validation layer and its
// synchronisation checks.
#pragma once

#include <gtest/gtest.h>

#include "gpu/device.h"

namespace lavalight::test {

// LAVALIGHT_TEST_DEVICE (an index or a part of a name) picks another device than the first.
[[nodiscard]] gpu::DeviceConfig testDeviceConfig();
[[nodiscard]] gpu::Device& testDevice();

// Base of every test that touches the device: the first message of the validation layer fails the test.
class DeviceTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;
    [[nodiscard]] gpu::Device& device() { return testDevice(); }

  private:
    size_t messagesBefore_ = 0;
};

} // namespace lavalight::test
