// SPDX-License-Identifier: GPL-3.0-or-later
// Albedo of the kinds of broad.cpp (weight not included).
#pragma once

#include "bsdf/families.h"

namespace cardioid::CD_ISA_NS {

Float broad_albedo(const bsdf::Lobe& lobe, int i, Vec3 wo);

}  // namespace cardioid::CD_ISA_NS
