// SPDX-License-Identifier: GPL-3.0-or-later
// Where the light of withheld clusters goes in the default method: it is spread so widely that no firefly is seen, and its energy
// stays in the picture until enough samples support it in its place.
#pragma once

#include "filter/executor.h"
#include "filter/picture.h"
#include "filter/reject.h"

namespace cardioid::filter {

/// Mean withheld radiance of a pixel, without exposure.
void withheld_light(const film::Film& film, const Rejection& rejection, int x, int y, float (&rgb)[3]);

/// Planes of the film's size to be added to the picture: withheld light over detail, averaged by a Gaussian of standard deviation
/// `width` pixels (three boxes), times detail. Of light that would brighten the `picture` there by more than a quarter, the rest is
/// left out. False: stopped.
bool spread_withheld(const film::Film& film, const Rejection& rejection, const Picture& picture, float width,
                     const ForEach& for_each, std::vector<float> (&rgb)[3]);

}  // namespace cardioid::filter
