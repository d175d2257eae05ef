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

// One loop: what is to be done, and how far it is.
struct Loop {
    const std::function<void(std::size_t)>& work;
    const std::size_t count;
    std::atomic<std::size_t> next = 0;
    // Guarded by the mutex of the threads.
    std::size_t helpers = 0; // threads that take part beside the caller
    std::exception_ptr failure = nullptr;
};

// Threads that help loops. To start a thread for each loop instead takes some 50 us, as long as a loop of a
// few hundred rays.
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
        begun_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }
    LoopThreads(const LoopThreads&) = delete;
    LoopThreads& operator=(const LoopThreads&) = delete;

    void run(std::size_t count, const std::function<void(std::size_t)>& work) {
        Loop loop{work, count};
        {
            const std::lock_guard lock(mutex_);
            loops_.push_back(&loop);
        }
        begun_.notify_all();
        takePart(loop);
        std::unique_lock lock(mutex_);
        std::erase(loops_, &loop);
        left_.wait(lock, [&] { return loop.helpers == 0; });
        if (loop.failure)
            std::rethrow_exception(loop.failure);
    }

  private:
    void takePart(Loop& loop) {
        try {
            for (std::size_t i = loop.next++; i < loop.count; i = loop.next++)
                loop.work(i);
        } catch (...) {
            loop.next = loop.count; // no more for anyone
            const std::lock_guard lock(mutex_);
            loop.failure = std::current_exception();
        }
    }

    // The oldest loop with work that nobody has taken; null: none.
    [[nodiscard]] Loop* openLoop() const {
        const auto found =
            std::ranges::find_if(loops_, [](const Loop* loop) { return loop->next < loop->count; });
        return found == loops_.end() ? nullptr : *found;
    }

    void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            Loop* loop = nullptr;
            begun_.wait(lock, [&] { return isEnding_ || (loop = openLoop()) != nullptr; });
            if (isEnding_)
                return;
            ++loop->helpers;
            lock.unlock();
            takePart(*loop);
            lock.lock();
            if (--loop->helpers == 0)
                left_.notify_all(); // several callers may wait, each for its own loop
        }
    }

    std::mutex mutex_; // guards what follows
    std::condition_variable begun_;
    std::condition_variable left_;
    std::vector<Loop*> loops_; // of callers that are at work, the oldest first
    bool isEnding_ = false;
    std::vector<std::thread> threads_; // not guarded
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
        threads->run(count, work);
        return;
    }
    for (std::size_t i = 0; i < count; ++i)
        work(i);
}

} // namespace lavalight
