#include "cli/interrupt.h"

#include <csignal>

namespace lavalight {
namespace {

// A signal handler can reach nothing but a global: the one exception to "no globals".
volatile std::sig_atomic_t received = 0; // 0: none

void remember(int signal) {
    received = signal;
    std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard() {
    received = 0;
    std::signal(SIGINT, remember);
    std::signal(SIGTERM, remember);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() const {
    return received != 0;
}

int InterruptGuard::exitCode() const {
    return 128 + received;
}

} // namespace lavalight
