#include "python/session_pool.h"

#include <algorithm>
#include <utility>

namespace lavalight::python {
namespace {

constexpr size_t kMostIdle = 2;

bool isSameDevice(const gpu::DeviceConfig& a, const gpu::DeviceConfig& b) {
    return a.wanted == b.wanted && a.required == b.required && a.validate == b.validate;
}

} // namespace

std::unique_ptr<RenderSession> SessionPool::take(RenderPlan plan) {
    std::unique_ptr<RenderSession> session;
    {
        const std::lock_guard lock(mutex_);
        const auto found = std::find_if(idle_.begin(), idle_.end(), [&](const Idle& idle) {
            return isSameDevice(idle.device, plan.device);
        });
        if (found != idle_.end()) {
            session = std::move(found->session);
            idle_.erase(found);
        }
    }
    if (!session)
        return std::make_unique<RenderSession>(std::move(plan));
    session->use(std::move(plan));
    return session;
}

void SessionPool::giveBack(std::unique_ptr<RenderSession> session, const gpu::DeviceConfig& device) {
    const std::lock_guard lock(mutex_);
    if (idle_.size() < kMostIdle)
        idle_.push_back({device, std::move(session)});
}

void SessionPool::clear() {
    std::vector<Idle> ended;
    const std::lock_guard lock(mutex_);
    ended.swap(idle_);
}

SessionPool& SessionPool::ofProcess() {
    static SessionPool* pool = new SessionPool; // never destroyed: clear() ends what is in it
    return *pool;
}

} // namespace lavalight::python
