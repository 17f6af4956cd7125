// SPDX-License-Identifier: GPL-3.0-or-later
// Traces one sample of one pixel again, alone, and tells its vertices: samples depend on nothing but
// (seed, pixel, sample), so the path is the one of the render.
#pragma once

#include "scene/scene_desc.h"

#include <string>

namespace cardioid::render {

/// x, y from the bottom left of the whole frame. Text, a line for each vertex and one for the result by class.
/// Throws std::out_of_range when the pixel is outside the frame.
std::string replay_sample(const scene::SceneDesc& desc, int x, int y, int sample);

}  // namespace cardioid::render
