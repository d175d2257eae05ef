// Sessions that wait for the next render, with their devices and kernels.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "session/render_session.h"

namespace lavalight::python {

// Renders in several threads have a session each; one after another they share one.
class SessionPool {
  public:
    // A session of that plan: one that is idle and has the plan's device, else a new one.
    [[nodiscard]] std::unique_ptr<RenderSession> take(RenderPlan plan);
    void giveBack(std::unique_ptr<RenderSession> session, const gpu::DeviceConfig& device);
    // Ends idle sessions: before the process does, since drivers end with it.
    void clear();

    [[nodiscard]] static SessionPool& ofProcess();

  private:
    struct Idle {
        gpu::DeviceConfig device;
        std::unique_ptr<RenderSession> session;
    };
    std::mutex mutex_;
    std::vector<Idle> idle_;
};

} // namespace lavalight::python
