// A pool of worker threads that process fixed blocks.
#include "dsc/base/workers.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <dsc/base/signal_stack.hpp>
#include <dsc/base/spin.hpp>
#include <dsc/base/thread_mark.hpp>

namespace dsc {

struct Workers::Pool {
    using Body = std::function<void(std::size_t, std::size_t)>;

    // The blocks that a thread takes first. A loop gives each thread the same part of the list, so
    // that what it has read is still near its core in the next loop. Then it helps the others.
    struct alignas(64) Share {
        std::atomic<std::size_t> next{0};
        std::size_t end = 0;
    };

    std::mutex mutex;
    std::condition_variable work_ready;
    std::condition_variable work_done;
    const Body* body = nullptr;
    const void* mark = nullptr;  // of the thread that runs the loop, for the threads that help
    std::size_t count = 0;
    std::size_t block = 1;
    std::vector<Share> shares;            // the first one is that of the thread that runs the loop
    std::atomic<std::uint32_t> loops{0};  // begun so far; changes under the lock, like the next two
    std::atomic<std::size_t> helping{0};  // threads
    std::atomic<bool> stopping{false};
    std::size_t failed_block = 0;
    std::exception_ptr failure;
    std::vector<std::jthread> threads;

    explicit Pool(unsigned extra) : shares(extra + 1) {
        threads.reserve(extra);
        for (unsigned i = 1; i <= extra; ++i) threads.emplace_back([this, i] { serve(i); });
    }

    ~Pool() {
        {
            const std::lock_guard lock(mutex);
            stopping = true;
        }
        work_ready.notify_all();
    }

    void serve(std::size_t own) {
        const SignalStack stack;
        std::uint32_t seen = 0;
        const auto news = [this, &seen] { return stopping || loops != seen; };
        while (true) {
            spin_until(news);
            std::unique_lock lock(mutex);
            work_ready.wait(lock, news);
            if (stopping) return;
            seen = loops;
            if (body == nullptr) continue;  // The loop has ended without this thread.
            ++helping;
            lock.unlock();
            take_blocks(own);
            lock.lock();
            if (--helping == 0) work_done.notify_all();
        }
    }

    // Runs blocks until none is left.
    void take_blocks(std::size_t own) {
        const ThreadMark marked(mark);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            Share& share = shares[(own + i) % shares.size()];
            for (std::size_t at = share.next.fetch_add(1, std::memory_order_relaxed);
                 at < share.end; at = share.next.fetch_add(1, std::memory_order_relaxed))
                run_block(at * block);
        }
    }

    void run_block(std::size_t begin) {
        try {
            (*body)(begin, std::min(count, begin + block));
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (failure && begin > failed_block) return;
            failure = std::current_exception();
            failed_block = begin;
        }
    }

    void run(std::size_t total, std::size_t size, const Body& loop) {
        {
            const std::lock_guard lock(mutex);
            body = &loop;
            mark = thread_mark();
            count = total;
            block = size;
            failure = nullptr;
            const std::size_t blocks = (total + size - 1) / size;
            for (std::size_t i = 0; i < shares.size(); ++i) {
                shares[i].next.store(blocks * i / shares.size(), std::memory_order_relaxed);
                shares[i].end = blocks * (i + 1) / shares.size();
            }
            ++loops;
        }
        work_ready.notify_all();
        take_blocks(0);
        const auto done = [this] { return helping == 0; };
        spin_until(done);
        std::unique_lock lock(mutex);
        work_done.wait(lock, done);
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
