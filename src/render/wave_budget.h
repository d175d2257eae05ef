// How many paths a wave may have, so that none keeps a device longer than its watchdog allows.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lavalight {

// Systems reset a GPU that works on one submission for too long: Windows after two seconds, Linux' amdgpu
// after ten. A CPU has no such watchdog, but Ctrl-C and --time wait for the end of a wave.
class WaveBudget {
  public:
    static constexpr double kLongest = 1.0; // seconds
    static constexpr uint32_t kFewest = 4096;
    static constexpr uint32_t kFirstOnCpu = 1u << 18;
    // Quick waves before a CPU gets larger ones. Each new page of memory costs a fault, which a short render
    // does not get back.
    static constexpr uint32_t kQuickOnCpu = 4;

    // Waves never have more than `most` slots, and the first ones fewer, until the device's speed is known:
    // much fewer on a GPU, whose watchdog may be near.
    WaveBudget(uint32_t most, bool isCpu)
        : most_(most), slots_(std::min(most, isCpu ? kFirstOnCpu : kFewest)),
          quickBeforeMore_(isCpu ? kQuickOnCpu : 1) {}

    [[nodiscard]] uint32_t slots() const { return slots_; }

    // Tells how long a wave of so many slots took. A wave of twice as many may take twice as long.
    void took(double seconds) {
        if (seconds > kLongest)
            slots_ = std::max(slots_ / 2, std::min(most_, kFewest));
        else if (seconds < kLongest / 4 && ++quick_ % quickBeforeMore_ == 0)
            slots_ = std::min(most_, slots_ > most_ / 2 ? most_ : 2 * slots_);
    }

  private:
    uint32_t most_;
    uint32_t slots_;
    uint32_t quickBeforeMore_;
    uint32_t quick_ = 0; // waves
};

} // namespace lavalight
