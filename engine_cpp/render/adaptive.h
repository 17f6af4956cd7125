// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive sampling by Cycles' rules: after every 16th sample, pixels whose noise is below the threshold are left alone, unless
// a neighbour goes on. A range of samples (Settings::first_sample) decides by its own samples alone.
#pragma once

#include "film/film.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace cardioid::render {

/// Which half of the samples one belongs to. As Cycles' (Christensen et al. 2018, 10.2.1), but by eights: samples of a pass share
/// their photons, whose noise shows between passes alone.
constexpr bool in_second_half(std::uint32_t sample) { return (std::popcount(sample & 0xaaaaaaa8u) & 1) != 0; }

/// Of one pixel.
struct HalfSums {
    float all[3] = {}, half[3] = {};  ///< radiance of all samples, and of the second half of them
    std::uint32_t samples = 0, half_samples = 0;
    /// Cycles' error: difference of the halves relative to the root of the brightness, or to the brightness where that is over 1.
    /// Infinite as long as a half is empty.
    float error(float exposure) const;
};

class Adaptive {
public:
    static constexpr int k_step = 16;
    /// Cycles' factor between the setting and what the error is compared with.
    static constexpr float k_scale = 5;

    Adaptive(const scene::Settings& settings, const film::Region& region);

    bool on() const { return threshold_ > 0; }
    int min_samples() const { return min_samples_; }
    /// x, y in the whole frame; a pixel belongs to one task at a time. Only while it is on.
    void add(int x, int y, const film::Sample& sample, int number);
    /// Pixels are judged when all samples before number `end` have been added, `taken` of them by this render.
    bool due(int end, int taken) const { return on() && end % k_step == 0 && taken > min_samples_ + 1; }
    /// Judges all pixels, on the threads of the arena that it is called in.
    void update();
    /// Which pixels go on, by rows from the region's corner; empty: all.
    const std::vector<std::uint8_t>& active() const { return active_; }
    std::int64_t active_pixels() const { return count_; }
    bool finished() const { return count_ == 0; }
    double mean_samples() const;
    std::int64_t memory_bytes() const;

private:
    film::Region region_;
    float threshold_ = 0, exposure_ = 1;
    int min_samples_ = 0;
    std::vector<HalfSums> sums_;
    std::vector<std::uint8_t> active_;
    std::int64_t count_;
};

}  // namespace cardioid::render
