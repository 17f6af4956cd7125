// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/version.h"

#include <OpenColorIO/OpenColorIO.h>
#include <OpenImageIO/imageio.h>

namespace cardioid::image {

std::string openimageio_version() {
    const int version = OIIO::openimageio_version();
    return std::to_string(version / 10000) + '.' + std::to_string(version / 100 % 100) + '.' +
           std::to_string(version % 100);
}

std::string opencolorio_version() { return OCIO_NAMESPACE::GetVersion(); }

}  // namespace cardioid::image
