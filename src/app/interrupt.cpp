#include "app/interrupt.h"

#include <csignal>

namespace lavalight {
namespace {

// A signal handler can reach nothing but a global: the one exception to "no globals".
volatile std::sig_atomic_t wasInterrupted = 0;

void remember(int signal) {
    wasInterrupted = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard() {
    wasInterrupted = 0;
    std::signal(SIGINT, remember);
    std::signal(SIGTERM, remember);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() const {
    return wasInterrupted != 0;
}

} // namespace lavalight
