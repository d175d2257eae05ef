#include "base/version.h"

#include <fmt/format.h>

namespace lavalight {

std::string versionText() {
    return kCommit.empty() ? std::string(kVersion) : fmt::format("{} ({})", kVersion, kCommit);
}

} // namespace lavalight
