// SPDX-License-Identifier: GPL-3.0-or-later
// Every emitter of a scene: lamps, emissive triangles and the world, with a tree that chooses one by its estimated
// contribution at a point. Built once, then read-only. Kernels are in light/kernels.h.
#pragma once

#include "math/types.h"
#include "scene/scene_desc.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cardioid::light {

/// One triangle of an emissive mesh, in world space.
struct EmissiveTriangle {
    Float3 p0, p1, p2;
    Float3 radiance;        ///< estimate of the emitted radiance (program's emission_estimate)
    std::int32_t instance;  ///< trace/ instance index
    std::int32_t triangle;  ///< triangle within the mesh
    std::int32_t program;   ///< emission program, or -1 when `radiance` is exact and constant
    bool two_sided = true;
};

/// A lamp with its compiled emission program (or -1). Colour and strength of the graph multiply the lamp's own.
struct LampInput {
    scene::LightDesc desc;
    std::int32_t program = -1;
    Float3 program_estimate{1, 1, 1};
    bool soft_falloff = false;  ///< Blender 4.1's Soft Falloff: a point or spot lamp is a disk that faces the receiver
};

/// Radiance of the world toward the direction, for n ≤ 64 unit directions (world shader evaluated by the caller).
using EnvironmentEval = std::function<void(int n, const Float3* directions, Float3* radiance)>;

struct WorldInput {
    scene::WorldSampling sampling = scene::WorldSampling::automatic;
    int map_resolution = 1024;  ///< columns of the importance map; automatic: the width of the widest image, 0: 1024
    bool constant = true;       ///< no texture: one colour
    Float3 color{0, 0, 0};      ///< when constant
    EnvironmentEval eval;       ///< when not constant
    std::int32_t program = -1;  ///< emission program when not constant
    std::uint8_t visibility = scene::visible_all;
    int max_bounces = 1024;
    /// Samples leave what is evenly bright to rays that lobes send, which must then count with pdf_environment's MIS weight.
    bool compensate = true;
};

/// Asked while a table is built; throws to stop the building.
using Checkpoint = std::function<void()>;

/// Bounds that photons are aimed at; casters are instances whose materials may have specular lobes (spec 1).
struct PhotonTargets {
    bool any_casters = false;
    Float3 casters_min{0, 0, 0}, casters_max{0, 0, 0};
};

/// Plain arrays that the kernels read, see light/light_data.h.
struct LightData;

class LightTable {
public:
    LightTable(const std::vector<LampInput>& lamps, const std::vector<EmissiveTriangle>& triangles,
               const WorldInput* world, Float3 scene_min, Float3 scene_max, const Checkpoint& checkpoint = {},
               const PhotonTargets& targets = {});
    ~LightTable();
    LightTable(LightTable&&) noexcept;
    LightTable& operator=(LightTable&&) noexcept;
    const LightData& data() const;
    /// Nothing to sample: no lamp, triangle or world that gives light.
    bool empty() const;
    std::int64_t memory_bytes() const;

private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

}  // namespace cardioid::light
