// Whether this process may open devices: not where it was forked from one that had, since threads of drivers
// stay behind.
#pragma once

#include <string>

namespace lavalight::python {

// Before a device is opened or used. Throws Error where that is forbidden.
void beginDeviceUse();
// Makes every later use throw Error with that message, once a device has been used in this process.
void forbidDeviceUse(const std::string& reason);

} // namespace lavalight::python
