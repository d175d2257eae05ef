#include "film/stop_reason.h"

namespace lavalight {

std::string_view nameOf(StopReason reason) {
    switch (reason) {
    case StopReason::samples:
        return "samples";
    case StopReason::time:
        return "time";
    case StopReason::targetError:
        return "target-error";
    case StopReason::interrupted:
        return "interrupted";
    }
    return "";
}

} // namespace lavalight
