#include "support/faults/faults.h"

#include <stdexcept>

#include <dlfcn.h>

namespace lavalight::test {

// The loader opens the layer by the same path, and so gets the same copy of it.
FaultyDevices::FaultyDevices() {
    void* layer = ::dlopen(LAVALIGHT_FAULTS "/libfault_layer.so", RTLD_NOW | RTLD_LOCAL);
    if (layer == nullptr)
        throw std::runtime_error(::dlerror());
    set_ = reinterpret_cast<void (*)(long, int)>(::dlsym(layer, "lavalightFaultSet"));
    met_ = reinterpret_cast<const char* (*)()>(::dlsym(layer, "lavalightFaultMet"));
}

} // namespace lavalight::test
