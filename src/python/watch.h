// Ctrl-C, time and progress of work that runs without Python's lock.
#pragma once

#include <chrono>
#include <optional>

#include <nanobind/nanobind.h>

namespace lavalight::python {

class Watch {
  public:
    // Work of at most so many seconds, or of any time where `seconds` is 0. `progress`: called with the
    // fraction done, or none; the caller keeps it.
    Watch(double seconds, nanobind::handle progress) : seconds_(seconds), progress_(progress) {}

    // Whether to go on. To be asked often, without Python's lock; Python itself is asked every 50 ms.
    [[nodiscard]] bool goesOn(double fraction);
    // Whether Python's signal handlers or `progress` raised something: then the work has no result.
    [[nodiscard]] bool hasRaised() const { return raised_.has_value(); }
    // Throws what Python raised, if it did. To be called with Python's lock.
    void rethrow();

  private:
    using Clock = std::chrono::steady_clock;

    bool ask(double fraction);

    double seconds_;
    nanobind::handle progress_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point asked_ = start_;
    std::optional<nanobind::python_error> raised_;
};

} // namespace lavalight::python
