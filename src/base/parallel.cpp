#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace lavalight {
namespace {

std::atomic<unsigned> limit = 0; // limitThreads()

// Threads that wait for loops. To start a thread for each loop instead takes some 50 us, as long as a loop of
// a few hundred rays.
class LoopThreads {
  public:
    LoopThreads() {
        const unsigned processors = std::max(1u, std::thread::hardware_concurrency());
        const unsigned wanted = limit > 0 ? limit.load() : processors;
        try {
            for (unsigned i = 1; i < wanted; ++i) // whoever calls works too
                threads_.emplace_back([this] { serve(); });
        } catch (const std::system_error&) { // the system grants no more: those that there are have to do
        }
    }
    ~LoopThreads() {
        {
            const std::lock_guard lock(mutex_);
            isEnding_ = true;
        }
        started_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }
    LoopThreads(const LoopThreads&) = delete;
    LoopThreads& operator=(const LoopThreads&) = delete;

    // Takes the threads for a loop; false: another one has them.
    [[nodiscard]] bool run(std::size_t count, const std::function<void(std::size_t)>& work) {
        if (isTaken_.exchange(true))
            return false;
        {
            const std::lock_guard lock(mutex_);
            work_ = &work;
            count_ = count;
            next_ = 0;
            busy_ = threads_.size();
            ++loop_;
        }
        started_.notify_all();
        takePart(work, count);
        std::unique_lock lock(mutex_);
        done_.wait(lock, [&] { return busy_ == 0; });
        const std::exception_ptr failure = std::exchange(failure_, nullptr);
        isTaken_ = false;
        if (failure)
            std::rethrow_exception(failure);
        return true;
    }

  private:
    void takePart(const std::function<void(std::size_t)>& work, std::size_t count) {
        try {
            for (std::size_t i = next_++; i < count; i = next_++)
                work(i);
        } catch (...) {
            next_ = count; // no more for anyone
            const std::lock_guard lock(mutex_);
            failure_ = std::current_exception();
        }
    }

    void serve() {
        std::size_t seen = 0;
        for (;;) {
            std::unique_lock lock(mutex_);
            started_.wait(lock, [&] { return isEnding_ || loop_ != seen; });
            if (isEnding_)
                return;
            seen = loop_;
            const std::function<void(std::size_t)>& work = *work_;
            const std::size_t count = count_;
            lock.unlock();
            takePart(work, count);
            lock.lock();
            if (--busy_ == 0)
                done_.notify_one();
        }
    }

    std::atomic<bool> isTaken_ = false; // a loop has the threads
    std::mutex mutex_;                  // guards what follows
    std::condition_variable started_;
    std::condition_variable done_;
    const std::function<void(std::size_t)>* work_ = nullptr;
    std::size_t count_ = 0;
    std::size_t loop_ = 0; // number of loops so far
    std::size_t busy_ = 0; // threads that are not done with this one
    std::exception_ptr failure_;
    bool isEnding_ = false;
    std::atomic<std::size_t> next_ = 0; // not guarded, like the threads
    std::vector<std::thread> threads_;
};

} // namespace

void limitThreads(unsigned threads) {
    limit = threads;
}

unsigned threadLimit() {
    return limit;
}

void forEachInParallel(std::size_t count, const std::function<void(std::size_t)>& work) {
    if (count > 1 && limit != 1) {
        // Never destroyed: at the end of a process that embeds this, other threads may still be in a loop.
        static auto* threads = new LoopThreads;
        if (threads->run(count, work))
            return;
    }
    for (std::size_t i = 0; i < count; ++i)
        work(i);
}

} // namespace lavalight
