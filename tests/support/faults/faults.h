// Failures that programs started by a test meet while one of these lives.
#pragma once

#include <string>

#include "support/environment_variable.h"

namespace lavalight::test {

// The layer of fault_layer.cpp; validation layers are not found beside it.
class VulkanFault {
  public:
    // `fault` as LAVALIGHT_FAULT has it; the names of the calls go to `log`.
    explicit VulkanFault(const std::string& fault, const std::string& log = "/dev/null")
        : fault_("LAVALIGHT_FAULT", fault), log_("LAVALIGHT_FAULT_LOG", log) {}

  private:
    EnvironmentVariable path_{"VK_LAYER_PATH", LAVALIGHT_FAULTS};
    EnvironmentVariable layer_{"VK_INSTANCE_LAYERS", "VK_LAYER_LAVALIGHT_fault"};
    EnvironmentVariable fault_;
    EnvironmentVariable log_;
};

// Faults within the test's own process: devices opened while one lives have the layer.
class FaultyDevices {
  public:
    FaultyDevices();
    // The `call`-th call from now on returns `result`.
    void failAt(long call, int result) const { set_(call, result); }
    void failNone() const { set_(0, 0); }
    // The name of the call that has failed since then; empty: none has.
    [[nodiscard]] std::string failure() const { return met_(); }

  private:
    VulkanFault layer_{""};
    void (*set_)(long, int) = nullptr;
    const char* (*met_)() = nullptr;
};

// The library of failing_new.cpp: the `call`-th allocation fails, none for 0. Their number goes to `log`.
class FailingNew {
  public:
    explicit FailingNew(long call, const std::string& log = "/dev/null")
        : call_("LAVALIGHT_FAILING_NEW", std::to_string(call)), log_("LAVALIGHT_NEW_LOG", log) {}

  private:
    EnvironmentVariable library_{"LD_PRELOAD", LAVALIGHT_FAULTS "/libfailing_new.so"};
    EnvironmentVariable call_;
    EnvironmentVariable log_;
};

} // namespace lavalight::test
