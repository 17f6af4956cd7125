// SPDX-License-Identifier: GPL-3.0-or-later
// What to do with the texels of a named colour space. Hides OpenColorIO.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace cardioid::image {

enum class Transfer : std::uint8_t {
    none,     ///< scene-linear already
    data,     ///< not a colour: alpha is left alone, too
    srgb,     ///< the sRGB curve, same primaries
    convert,  ///< something else: ColorSpace::to_linear
};

struct ColorSpace {
    Transfer transfer = Transfer::none;
    bool known = true;  ///< false: the name means nothing here and a guess is used
    /// Converts `count` pixels of four floats (alpha is left alone) to scene-linear.
    std::shared_ptr<const class ColorProcessor> processor;
    void to_linear(float* rgba, std::size_t count) const;
};

class ColorSpaces {
public:
    /// The file is read when the first name needs it. Empty: standard spaces only.
    explicit ColorSpaces(const std::string& config_path);
    ~ColorSpaces();
    /// `is_float` decides the guess for an unknown name: linear, otherwise sRGB. Not thread-safe.
    ColorSpace find(const std::string& name, bool is_float);
    /// Why the configuration cannot be used; empty if it can, or was not needed.
    const std::string& config_problem() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cardioid::image
