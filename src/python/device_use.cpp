#include "python/device_use.h"

#include <atomic>

#include "base/error.h"

namespace lavalight::python {
namespace {

// Without locks, which another thread may hold while the process forks.
std::atomic<bool> hasBegun = false;
std::atomic<const std::string*> reasonAgainst = nullptr; // none: devices may be used

} // namespace

void beginDeviceUse() {
    if (const std::string* reason = reasonAgainst)
        throw Error(*reason);
    hasBegun = true;
}

void forbidDeviceUse(const std::string& reason) {
    if (hasBegun && reasonAgainst == nullptr)
        reasonAgainst = new std::string(reason); // for as long as the process lives
}

} // namespace lavalight::python
