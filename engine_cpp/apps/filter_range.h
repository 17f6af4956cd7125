// SPDX-License-Identifier: GPL-3.0-or-later
// Filter settings from outside: a scene's are repaired with a warning, but here somebody is there to be told.
#pragma once

#include "scene/validate.h"

#include <string>
#include <vector>

namespace cardioid {

/// A sentence for each value out of range, which is repaired all the same; empty when all is well.
inline std::vector<std::string> range_errors(scene::FilterSettings& settings) {
    std::vector<std::string> errors;
    // The second half of a warning says what is used instead.
    for (const std::string& m : scene::messages(scene::validate(settings)))
        errors.push_back(m.substr(0, m.find(';')) + ", which is out of range");
    return errors;
}

}  // namespace cardioid
