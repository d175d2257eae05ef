// The program `lavalight`.
#include "base/os/standard_streams.h"
#include "cli/run_command_line.h"
#include "gpu/wide_vectors.h"

int main(int argc, char** argv) {
    lavalight::holdStandardStreams();
    lavalight::gpu::allowWideVectors();
    return lavalight::runCommandLine(argc, argv);
}
