// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a description on entry, names everything that is wrong with the object's name, and leaves it so that the rest
// of the engine needs no checks of its own: indices in range, sizes right, everything finite.
#pragma once

#include "scene/scene_desc.h"

#include <string>
#include <vector>

namespace cardioid::scene {

enum class Severity : std::uint8_t {
    warning,  ///< repaired, or dropped from the scene; the rest renders
    error,    ///< cannot be rendered
};

struct Problem {
    Severity severity = Severity::warning;
    std::string message;
};

/// Finds and repairs. Mesh, material, image and group indices keep their meaning; instances and lamps may be removed.
/// Idempotent for what was repaired: a second call reports only what still stands.
/// After a call without errors:
///  - instances place an existing mesh with at least one triangle, or a group; transforms are finite and invertible
///  - triangles index existing vertices, positions are finite, attributes have 1…4 channels and the right size
///  - graph links point to existing nodes and make no loops; image params are -1 or an index of an image
///  - numbers in lamps, world, camera and settings are finite and in their documented range
std::vector<Problem> validate(SceneDesc& scene);

/// The same for what may change after a render: numbers are finite and in range, the size is odd. Warnings alone.
std::vector<Problem> validate(FilterSettings& settings);

bool has_errors(const std::vector<Problem>& problems);
/// Errors first.
std::vector<std::string> messages(const std::vector<Problem>& problems);

}  // namespace cardioid::scene
