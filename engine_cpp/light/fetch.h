// SPDX-License-Identifier: GPL-3.0-or-later
// Reads of one record per lane. Lanes often want the same record (one lamp, the top of a tree): then it is a broadcast.
#pragma once

#include "light/light_data.h"
#include "simd/vec.h"

namespace cardioid::CD_ISA_NS {

/// Which record each lane wants, as an offset into an array with `stride` numbers a record.
struct RecordIndex {
    Int offset;
    int uniform;  ///< offset of all lanes, or -1 where they differ
};

/// Inactive lanes read the record of some active lane, so every offset exists.
inline RecordIndex record_index(Int id, int stride, Mask active) {
    const std::uint32_t lanes = bits(active);
    if (lanes == 0) return {Int(0), 0};
    const int first = id[std::countr_zero(lanes)];
    if (all((id == Int(first)) | ~active)) return {Int(0), first * stride};
    return {select(active, id, Int(first)) * Int(stride), -1};
}

inline Float fetch(const float* p, RecordIndex at, int field) {
    return at.uniform >= 0 ? Float(p[at.uniform + field]) : gather(p + field, at.offset);
}
inline Int fetch(const std::int32_t* p, RecordIndex at, int field) {
    return at.uniform >= 0 ? Int(p[at.uniform + field]) : gather(p + field, at.offset);
}
inline Vec3 fetch3(const float* p, RecordIndex at, int field) {
    return {fetch(p, at, field), fetch(p, at, field + 1), fetch(p, at, field + 2)};
}
inline Spectrum fetch_rgb(const float* p, RecordIndex at, int field) {
    return {fetch(p, at, field), fetch(p, at, field + 1), fetch(p, at, field + 2)};
}

/// Emitter id of a triangle of the scene, -1 where it is not in the table.
inline Int triangle_emitter(const light::LightData& lights, Int instance, Int triangle, Mask active) {
    active &= (instance >= Int(0)) & (instance < Int(lights.instance_count)) & (triangle >= Int(0));
    if (none(active)) return Int(-1);
    const RecordIndex place = record_index(instance, 1, active);
    active &= triangle < fetch(lights.triangle_span, place, 0);
    if (none(active)) return Int(-1);
    const Int entry = fetch(lights.triangle_base, place, 0) + triangle;
    return select(active, fetch(lights.triangle_emitter, record_index(entry, 1, active), 0), Int(-1));
}

}  // namespace cardioid::CD_ISA_NS
