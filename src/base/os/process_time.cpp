#include "base/os/process_time.h"

#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

namespace lavalight {

std::optional<double> secondsSinceProcessStart() {
    std::ifstream stat("/proc/self/stat");
    std::string line;
    std::getline(stat, line);
    const size_t afterName = line.rfind(')'); // the name may hold anything
    if (afterName == std::string::npos)
        return std::nullopt;
    std::istringstream fields(line.substr(afterName + 1));
    std::string skipped;
    for (int field = 3; field < 22; ++field) // proc(5): starttime is field 22, in clock ticks since boot
        fields >> skipped;
    double startTicks = 0.0;
    double uptime = 0.0;
    fields >> startTicks;
    std::ifstream("/proc/uptime") >> uptime;
    const double ticksPerSecond = static_cast<double>(sysconf(_SC_CLK_TCK));
    if (!fields || uptime <= 0.0 || ticksPerSecond <= 0.0)
        return std::nullopt;
    return uptime - startTicks / ticksPerSecond;
}

} // namespace lavalight
