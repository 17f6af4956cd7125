// SPDX-License-Identifier: GPL-3.0-or-later
// The path of an image may name a picture of a file that holds several: "film.mp4#frame=12", counted from 0.
#pragma once

#include <string>

namespace cardioid::scene {

struct ImagePath {
    std::string file;
    int frame = 0;
};

/// Splits it; a file that really has such a name is a file. Asks the file system only where the name ends so.
ImagePath image_path(const std::string& path);

}  // namespace cardioid::scene
