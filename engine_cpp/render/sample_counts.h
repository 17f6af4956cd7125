// SPDX-License-Identifier: GPL-3.0-or-later
// The pass "Debug Sample Count", as Cycles has it: how many samples adaptive sampling gave to each pixel.
#pragma once

#include "film/film.h"

namespace cardioid::render {

/// Adds the pass, which show_sample_counts() then fills.
void add_sample_counts(film::Frame& frame);
/// Inside `part` (frame coordinates); nothing where the frame has no such pass.
void show_sample_counts(const film::Film& film, const film::Region& part, film::Frame& frame);

}  // namespace cardioid::render
