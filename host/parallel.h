// The host's threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace vndf {

inline unsigned thread_count() {
    return std::max(1u, std::thread::hardware_concurrency());
}

// Calls body(thread, begin, end) for pieces of [0, n) of at most `grain` on all threads (0 <= thread <
// thread_count()). Rethrows the first exception.
template <class Body>
void parallel_for(std::size_t n, std::size_t grain, Body body) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr failure;
    const auto work = [&](unsigned thread) {
        try {
            for (std::size_t begin; (begin = next.fetch_add(grain)) < n && !failed;)
                body(thread, begin, std::min(n, begin + grain));
        } catch (...) {
            if (!failed.exchange(true)) failure = std::current_exception();
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < thread_count(); ++i) threads.emplace_back(work, i);
    work(0);
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace vndf
