// SPDX-License-Identifier: GPL-3.0-or-later
// A lock that is nearly free to hold for reading (one uncontended counter each thread) and slow to take for writing:
// tiles are read in every lookup and thrown away hardly ever.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace cardioid::image {

class ReaderLock {
public:
    class Reading {
    public:
        explicit Reading(ReaderLock& lock) : lock_(lock), stripe_(own_stripe()) { enter(); }
        ~Reading() {
            if (inside_) leave();
        }
        Reading(const Reading&) = delete;
        Reading& operator=(const Reading&) = delete;
        /// Between leave() and enter() a writer may run: what was read before is void.
        void leave() {
            inside_ = false;
            lock_.readers_[stripe_].count.fetch_sub(1, std::memory_order_release);
        }
        void enter() {
            std::atomic<int>& count = lock_.readers_[stripe_].count;
            // Sequentially consistent on both sides: either the writer sees this reader, or this reader sees the
            // writer.
            for (;;) {
                count.fetch_add(1);
                inside_ = !lock_.writing_.load();
                if (inside_) return;
                count.fetch_sub(1);
                lock_.writing_.wait(true);
            }
        }

    private:
        static std::size_t own_stripe() { return std::hash<std::thread::id>()(std::this_thread::get_id()) % k_stripes; }
        ReaderLock& lock_;
        std::size_t stripe_;
        bool inside_ = false;
    };

    /// Runs `change` while nobody reads. The caller must not be reading.
    template <class Change>
    void write(Change change) {
        const std::lock_guard only(mutex_);
        writing_.store(true);
        for (const Stripe& stripe : readers_)
            while (stripe.count.load() != 0) std::this_thread::yield();
        change();
        writing_.store(false);
        writing_.notify_all();
    }

private:
    static constexpr std::size_t k_stripes = 64;
    struct alignas(64) Stripe {
        std::atomic<int> count{0};
    };
    std::array<Stripe, k_stripes> readers_;
    std::atomic<bool> writing_{false};
    std::mutex mutex_;
};

}  // namespace cardioid::image
