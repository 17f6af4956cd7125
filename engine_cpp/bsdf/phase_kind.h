// SPDX-License-Identifier: GPL-3.0-or-later
// Phase functions of a medium, by Blender's Volume Scatter node.
#pragma once

#include <cstdint>

namespace cardioid::bsdf {

/// Parameters, in this order. henyey_greenstein: g; draine: g, alpha; fournier_forand: backscatter fraction, index of
/// refraction; mie: droplet diameter in µm; rayleigh: none.
enum class PhaseKind : std::uint8_t { henyey_greenstein, rayleigh, fournier_forand, draine, mie };

}  // namespace cardioid::bsdf
