#include "base/option_text.h"

#include "base/error.h"

namespace lavalight {

void requireRange(const char* option, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw UsageError(fmt::format("{}: {} is outside the range {} to {}", option, value, least, most));
}

} // namespace lavalight
