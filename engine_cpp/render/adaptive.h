// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive sampling by Cycles' rules: after every 16th sample, pixels whose noise is below the threshold are left alone, unless
// a neighbour goes on. A range of samples (Settings::first_sample) decides by its own samples alone.
#pragma once

#include "film/film.h"

#include <cstdint>
#include <vector>

namespace cardioid::render {

class Adaptive {
public:
    static constexpr int k_step = 16;
    /// Cycles' factor between the setting and what the noise is compared with.
    static constexpr float k_scale = 5;

    Adaptive(const scene::Settings& settings, const film::Region& region);

    bool on() const { return threshold_ > 0; }
    int min_samples() const { return min_samples_; }
    /// Pixels are judged when all samples before number `end` are in the film, `taken` of them from this render.
    bool due(int end, int taken) const { return on() && end % k_step == 0 && taken > min_samples_ + 1; }
    /// Judges all pixels, on the threads of the arena that it is called in.
    void update(const film::Film& film);
    /// Which pixels go on, by rows from the region's corner; empty: all.
    const std::vector<std::uint8_t>& active() const { return active_; }
    std::int64_t active_pixels() const { return count_; }
    bool finished() const { return count_ == 0; }

private:
    film::Region region_;
    float threshold_ = 0;
    int min_samples_ = 0;
    std::vector<std::uint8_t> active_;
    std::int64_t count_;
};

}  // namespace cardioid::render
