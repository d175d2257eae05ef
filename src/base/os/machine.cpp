#include "base/os/machine.h"

#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <sys/utsname.h>

namespace lavalight {
namespace {

// "key : value" of the first processor.
std::map<std::string, std::string> firstProcessorIn(const std::string& cpuinfo) {
    std::map<std::string, std::string> values;
    std::istringstream lines(cpuinfo);
    for (std::string line; std::getline(lines, line) && !line.empty();) {
        const size_t colon = line.find(':');
        if (colon == std::string::npos)
            continue;
        const std::string key = line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1);
        const size_t value = line.find_first_not_of(' ', colon + 1);
        values[key] = value == std::string::npos ? std::string() : line.substr(value);
    }
    return values;
}

} // namespace

std::string processorKindIn(const std::string& cpuinfo) {
    std::map<std::string, std::string> values = firstProcessorIn(cpuinfo);
    if (values["vendor_id"].empty() || values["cpu family"].empty() || values["model"].empty())
        return {};
    std::string kind =
        fmt::format("{} family {} model {},", values["vendor_id"], values["cpu family"], values["model"]);
    std::istringstream words(values["flags"]);
    const std::set<std::string> flags{std::istream_iterator<std::string>(words), {}};
    for (const char* flag : {"sse4_1", "avx", "avx2", "fma", "avx512f"})
        if (flags.contains(flag))
            kind += fmt::format(" {}", flag);
    if (kind.ends_with(','))
        kind.pop_back();
    return kind;
}

std::string processorKind() {
    std::ifstream file("/proc/cpuinfo");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::string kind = processorKindIn(text);
    utsname name{};
    if (kind.empty() && uname(&name) == 0)
        kind = name.machine;
    return kind;
}

std::string hostName() {
    utsname name{};
    std::string text = uname(&name) == 0 ? name.nodename : "";
    std::erase_if(text, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; });
    return text.empty() ? "host" : text;
}

} // namespace lavalight
