#include "parallel/parallel_rows.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace luciole {
namespace {

/// The rows that are left, handed out one at a time.
class Queue {
public:
    explicit Queue(uint32_t rows) : rows_(rows) {}

    void workThrough(const std::function<void(uint32_t)>& work) {
        std::unique_lock lock(mutex_);
        while (next_ < rows_) {
            const uint32_t row = next_++;
            lock.unlock();
            std::exception_ptr failure;
            try {
                work(row);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            ++done_;
            if (failure) {
                failure_ = failure;
                rows_ = next_;
            }
            changed_.notify_one();
        }
    }

    /// Waits until all is done or a tenth of a second has passed. Returns the share done.
    double wait() {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::milliseconds(100), [&] { return done_ == rows_; });
        return rows_ == 0 ? 1 : double(done_) / rows_;
    }

    void stop() {
        const std::lock_guard lock(mutex_);
        rows_ = next_;
    }

    void rethrowFailure() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    uint32_t rows_, next_ = 0, done_ = 0;
    std::exception_ptr failure_;
};

}  // namespace

bool forEachRow(uint32_t rows, const std::function<void(uint32_t)>& work, const std::function<bool(double)>& progress) {
    Queue queue(rows);
    std::vector<std::jthread> threads;
    for (uint32_t i = 0; i < std::clamp(std::thread::hardware_concurrency(), 1u, std::max(rows, 1u)); ++i)
        threads.emplace_back([&] { queue.workThrough(work); });
    bool stopped = false;
    for (double done = 0; done < 1 && !stopped;) {
        done = queue.wait();
        stopped = progress && !progress(done);
    }
    if (stopped) queue.stop();
    threads.clear();
    queue.rethrowFailure();
    return !stopped;
}

}  // namespace luciole
