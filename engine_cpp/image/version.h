// SPDX-License-Identifier: GPL-3.0-or-later
// Versions of the image libraries that are in use, as they report themselves.
#pragma once

#include <string>

namespace cardioid::image {

std::string openimageio_version();
std::string opencolorio_version();

}  // namespace cardioid::image
