// SPDX-License-Identifier: GPL-3.0-or-later
// Guided emission: which emitters, points and directions lead to photons that some pixel gathers (spec 2). Emission is a map
// from the unit cube (light/emit.h), so the guide is a density on emitters × [0,1)⁴: probabilities of emitters, and for each a
// binary tree of boxes with a constant density in each leaf. A fixed share stays as at the start, so no light is ever lost.
#pragma once

#include "photon/emission.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cardioid::photon {

class PhotonGuide {
public:
    /// `power`: probability of each emitter at the start, up to a factor; 0 is never chosen. All 0: nothing can be emitted.
    explicit PhotonGuide(std::vector<float> power);
    ~PhotonGuide();
    PhotonGuide(PhotonGuide&&) noexcept;
    PhotonGuide& operator=(PhotonGuide&&) noexcept;

    bool empty() const;
    /// `choice` in [0,1) picks what to follow and the emitter; `u` the place in the cube. The map keeps neighbours together, so
    /// stratified numbers stay stratified within cells.
    Emission draw(float choice, const float (&u)[k_cube]) const;
    /// Density that draw() has at (emitter, u).
    float density(std::int32_t emitter, const float (&u)[k_cube]) const;
    /// Learns from the lessons of all training passes so far and replaces what was learned before. Lessons come in the same order
    /// for any number of threads; so does the result.
    void learn(const std::vector<Lesson>& lessons);
    /// Mean of density over the gathered lessons of the emitter, relative to the start: how much denser photons are than at the
    /// start where it counts. 1 before learn(). For MIS against camera paths.
    float gain(std::int32_t emitter) const;
    std::int64_t memory_bytes() const;

private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

}  // namespace cardioid::photon
