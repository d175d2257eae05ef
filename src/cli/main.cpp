// The program `lavalight`.
#include "base/os/standard_streams.h"
#include "cli/run_command_line.h"

int main(int argc, char** argv) {
    lavalight::holdStandardStreams();
    return lavalight::runCommandLine(argc, argv);
}
