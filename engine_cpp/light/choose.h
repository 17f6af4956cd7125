// SPDX-License-Identifier: GPL-3.0-or-later
// Choosing an emitter by its estimated contribution (Conty Estevez & Kulla 2018): a few entries (lamps, suns, the world,
// parts of a tree) are weighed side by side, then the tree is descended, lane by lane, with the same random number.
#pragma once

#include "light/kernels.h"

namespace cardioid::CD_ISA_NS {

struct EmitterPick {
    Int emitter;
    Float pmf;
    Float u;     ///< what the choice left of the random number: uniform in [0,1) again
    Mask valid;  ///< false: no emitter can light the receiver
};

/// u in [0,1).
EmitterPick pick_emitter(const light::LightData& lights, LightReceiver at, Float u, Mask active);

/// Probability with which pick_emitter at the same receiver gives `emitter`; 0 for -1 and for emitters that are never chosen.
Float pick_probability(const light::LightData& lights, LightReceiver at, Int emitter, Mask active);

}  // namespace cardioid::CD_ISA_NS
