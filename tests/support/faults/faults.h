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
