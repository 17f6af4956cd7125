// SPDX-License-Identifier: GPL-3.0-or-later
// Streaming 64-bit checksum of the scene file: finds damage, not tampering. The result does not depend on how the bytes
// are cut into calls.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace cardioid::scene {

class Checksum {
public:
    void add(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            if (held_ == 0 && bytes.size() >= 8) {
                const std::size_t words = bytes.size() / 8;
                for (std::size_t i = 0; i < words; ++i) mix(bytes.data() + 8 * i);
                bytes = bytes.subspan(8 * words);
            } else {
                partial_[held_++] = bytes.front();
                bytes = bytes.subspan(1);
                if (held_ == 8) {
                    mix(partial_);
                    held_ = 0;
                }
            }
        }
    }
    std::uint64_t value() const {
        Checksum last = *this;
        const std::uint64_t held = held_;
        std::memset(last.partial_ + held_, 0, 8 - held_);
        last.mix(last.partial_);
        return last.state_ ^ held;
    }

private:
    void mix(const std::byte* word) {
        std::uint64_t bits;
        std::memcpy(&bits, word, 8);
        state_ = (std::rotl(state_, 23) ^ bits) * 0x9e3779b97f4a7c15ull;
        state_ ^= state_ >> 32;
    }

    std::uint64_t state_ = 0x243f6a8885a308d3ull;
    std::byte partial_[8] = {};
    std::size_t held_ = 0;
};

}  // namespace cardioid::scene
