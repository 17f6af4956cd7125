// SPDX-License-Identifier: GPL-3.0-or-later
// Colour spaces that are a curve and a matrix, under the names that they have in Blender 3.4 to 5.2: known without a
// configuration.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace cardioid::image {

class ColorProcessor {
public:
    virtual ~ColorProcessor() = default;
    /// Converts `count` pixels of four floats; the fourth is left alone.
    virtual void apply(float* rgba, std::size_t count) const = 0;
};

/// To linear Rec.709; null where the name is none of these spaces. Spaces that need tables (Filmic, AgX, logarithmic ones) are
/// not among them.
std::shared_ptr<const ColorProcessor> standard_space(const std::string& name);

}  // namespace cardioid::image
