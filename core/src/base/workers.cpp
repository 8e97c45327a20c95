// A pool of worker threads that process fixed blocks.
#include "dsc/base/workers.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <dsc/base/signal_stack.hpp>
#include <dsc/base/thread_mark.hpp>

namespace dsc {

struct Workers::Pool {
    using Body = std::function<void(std::size_t, std::size_t)>;

    std::mutex mutex;
    std::condition_variable work_ready;
    std::condition_variable work_done;
    const Body* body = nullptr;
    const void* mark = nullptr;  // of the thread that runs the loop, for the threads that help
    std::size_t count = 0;
    std::size_t block = 1;
    std::size_t next = 0;
    std::size_t running = 0;
    std::size_t failed_block = 0;
    std::exception_ptr failure;
    bool stopping = false;
    std::vector<std::jthread> threads;

    explicit Pool(unsigned extra) {
        threads.reserve(extra);
        for (unsigned i = 0; i < extra; ++i) threads.emplace_back([this] { serve(); });
    }

    ~Pool() {
        {
            const std::lock_guard lock(mutex);
            stopping = true;
        }
        work_ready.notify_all();
    }

    void serve() {
        const SignalStack stack;
        std::unique_lock lock(mutex);
        while (true) {
            work_ready.wait(lock, [this] { return stopping || (body != nullptr && next < count); });
            if (stopping) return;
            take_blocks(lock);
        }
    }

    // Runs blocks until none is left; the caller holds the lock at the beginning and at the end.
    void take_blocks(std::unique_lock<std::mutex>& lock) {
        while (next < count) {
            const std::size_t begin = next;
            next = std::min(count, begin + block);
            const std::size_t end = next;
            ++running;
            lock.unlock();
            std::exception_ptr error;
            try {
                const ThreadMark marked(mark);
                (*body)(begin, end);
            } catch (...) {
                error = std::current_exception();
            }
            lock.lock();
            --running;
            if (error && (!failure || begin < failed_block)) {
                failure = error;
                failed_block = begin;
            }
        }
        if (running == 0) work_done.notify_all();
    }

    void run(std::size_t total, std::size_t size, const Body& loop) {
        std::unique_lock lock(mutex);
        body = &loop;
        mark = thread_mark();
        count = total;
        block = size;
        next = 0;
        failure = nullptr;
        work_ready.notify_all();
        take_blocks(lock);
        work_done.wait(lock, [this] { return running == 0; });
        body = nullptr;
        if (failure) std::rethrow_exception(failure);
    }
};

Workers::Workers(unsigned threads) {
    if (threads > 1) pool_ = std::make_unique<Pool>(threads - 1);
}
Workers::~Workers() = default;

unsigned Workers::threads() const noexcept {
    return pool_ ? static_cast<unsigned>(pool_->threads.size()) + 1 : 1;
}

void Workers::for_blocks(std::size_t count, std::size_t block,
                         const std::function<void(std::size_t, std::size_t)>& body) {
    block = std::max<std::size_t>(block, 1);
    if (pool_) {
        pool_->run(count, block, body);
        return;
    }
    for (std::size_t begin = 0; begin < count; begin += block)
        body(begin, std::min(count, begin + block));
}

}  // namespace dsc
