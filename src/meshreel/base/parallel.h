/// parallel_for: the library's only threads, alive only while a call lasts.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#ifndef MESHREEL_DECODER_ALONE
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace meshreel {

/// How many threads a call may use. 0: as many as the machine has cores.
struct Threads {
    unsigned count = 0;

#ifdef MESHREEL_DECODER_ALONE
    unsigned used() const
    {
        return 1;
    }
#else
    unsigned used() const
    {
        return count != 0 ? count : std::max(1u, std::thread::hardware_concurrency());
    }
#endif
};

#ifdef MESHREEL_DECODER_ALONE
/// The decoder in a browser: one thread, no exceptions.
template <class Body>
void parallel_for(std::size_t count, Threads /*threads*/, const Body& body)
{
    for (std::size_t i = 0; i < count; ++i) body(i);
}
#else
/// Runs body(i) for i = 0 .. count-1, in any order. Results must not depend on the order: each i writes its own place.
/// An exception of the body is rethrown here once all threads have stopped.
template <class Body>
void parallel_for(std::size_t count, Threads threads, const Body& body)
{
    const std::size_t workers = std::min<std::size_t>(threads.used(), count);
    if (workers <= 1) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failure_lock;
    auto work = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) body(i);
        } catch (...) {
            const std::lock_guard guard(failure_lock);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    std::vector<std::thread> pool;
    try {
        pool.reserve(workers - 1);
        while (pool.size() + 1 < workers) pool.emplace_back(work);
    } catch (const std::exception&) { // no room or right for another thread: those that run do it all
    }
    work();
    for (std::thread& thread : pool) thread.join();
    if (failure) std::rethrow_exception(failure);
}
#endif

} // namespace meshreel
