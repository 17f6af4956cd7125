// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a scene will fit in memory, judged before anything is built.
#pragma once

#include "scene/scene_desc.h"

#include <cstdint>
#include <string>

namespace cardioid::scene {

/// Bytes, estimated: what the built scene and the film will take while rendering. Saturates instead of overflowing.
struct MemoryEstimate {
    std::int64_t geometry = 0;  ///< the description's arrays, the engine's tables and Embree's trees
    std::int64_t film = 0;      ///< pixel buffers and one published picture
    std::int64_t photons = 0;   ///< of one pass; 0 where Settings::photons leaves the number to the engine
    std::int64_t textures = 0;  ///< the bound of the tile cache (files), and pixels held in memory
    std::int64_t total() const;
};
MemoryEstimate memory_estimate(const SceneDesc& scene);

/// Memory that this process may use: the machine's, or its control group's where that is less.
std::int64_t machine_memory();

/// Empty when it fits; otherwise a message with both numbers. The bound is Settings::memory_limit, or machine_memory().
std::string memory_problem(const SceneDesc& scene);

}  // namespace cardioid::scene
