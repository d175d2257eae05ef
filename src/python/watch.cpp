#include "python/watch.h"

#include <utility>

namespace lavalight::python {

namespace nb = nanobind;

namespace {

constexpr std::chrono::milliseconds kAskEvery{50};

} // namespace

bool Watch::goesOn(double fraction) {
    const auto now = Clock::now();
    if (now - asked_ >= kAskEvery) {
        asked_ = now;
        if (!ask(fraction))
            return false;
    }
    return seconds_ <= 0.0 || std::chrono::duration<double>(now - start_).count() < seconds_;
}

void Watch::rethrow() {
    if (raised_)
        throw std::move(*raised_);
}

bool Watch::ask(double fraction) {
    const nb::gil_scoped_acquire lock;
    try {
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        if (!progress_.is_none())
            progress_(fraction);
    } catch (nb::python_error& error) {
        raised_.emplace(std::move(error));
        return false;
    }
    return true;
}

} // namespace lavalight::python
