#include "cli/run_command_line.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/log.h"
#include "cli/command_line.h"

namespace lavalight {
namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

// File names and library messages may hold line breaks; a message is one line.
void reportError(std::string message) {
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    spdlog::error("{}", message);
}

// Runs the command line. `failureCode` becomes that of the command before the command runs.
int parseAndRun(int argc, char** argv, int& failureCode) {
    CommandLine commandLine;
    const std::optional<int> exitCode = commandLine.parse(argc, argv, std::cout);
    if (exitCode)
        return *exitCode;
    failureCode = commandLine.failureCode();
    return commandLine.run();
}

// Flushes the results, which may end on a full disk.
void requireResultsWritten() {
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw Error("cannot write the results to stdout");
}

} // namespace

int runCommandLine(int argc, char** argv) {
    int failureCode = kFailed;
    try {
        configureLog(LogLevel::normal);
        const int exitCode = parseAndRun(argc, argv, failureCode);
        requireResultsWritten();
        return exitCode;
    } catch (const UsageError& error) {
        reportError(error.what());
        return kWrongUsage;
    } catch (const Error& error) {
        reportError(error.what());
    } catch (const std::bad_alloc&) {
        reportError("out of memory");
    } catch (const std::exception& error) {
        reportError(fmt::format("unexpected failure: {}", error.what()));
    }
    return failureCode;
}

} // namespace lavalight
