// SPDX-License-Identifier: GPL-3.0-or-later
// The filter of thesis chapter 6: film and settings → picture. It never changes the film; the same input gives the same bits.
#pragma once

#include "film/film.h"
#include "filter/executor.h"
#include "filter/reject.h"
#include "scene/filter_settings.h"

#include <vector>

namespace cardioid::filter {

/// RGB of the film's region, bottom row first, exposure included.
struct Filtered {
    int width = 0, height = 0;
    std::vector<float> shown;  ///< all light: what is in no layer + the filtered layers
    std::vector<float>
        withheld;           ///< raw light of rejected clusters: raw = shown + withheld exactly with FilterMethod::none
    bool complete = false;  ///< false: stopped
    RejectionStats rejection;
};

/// Filters the layers that settings choose; settings have passed scene::validate. `lanes`: width of the kernels, 0: the best here.
Filtered run(const film::Film& film, const scene::FilterSettings& settings, const ForEach& for_each, int lanes = 0);

/// Puts the result into a frame that Film::resolve has filled: Filtered, Withheld and, when use_filter is on, Combined.
void write(const Filtered& result, const scene::FilterSettings& settings, film::Frame& frame);

}  // namespace cardioid::filter
