#include "base/os/shared_library.h"

#include <dlfcn.h>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {

// Libraries with threads of their own do not survive dlclose().
SharedLibrary::SharedLibrary(const std::filesystem::path& file)
    : handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
    if (handle_ == nullptr)
        throw Error(fmt::format("cannot load {}: {}", file.string(), dlerror()));
}

void* SharedLibrary::address(const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr)
        throw Error(fmt::format("cannot use a library: {}", dlerror()));
    return found;
}

} // namespace lavalight
