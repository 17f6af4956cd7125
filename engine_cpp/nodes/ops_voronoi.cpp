// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi texture: octaves of cells, summed as Blender 4.0 and later do; without detail it is the texture of 3.4.
#include "nodes/kernel.h"
#include "nodes/kernel_cells.h"

namespace cardioid::CD_ISA_NS {

using nodes::CellFeature;
using nodes::Instruction;

namespace {

/// Octaves per lane.
struct Octaves {
    Float detail, roughness, lacunarity;
    Mask single;  ///< one octave, as it is
    Float rest;
    int last;  ///< the highest octave of any lane

    Octaves(Float d, Float r, Float l) : detail(d), roughness(r), lacunarity(l) {
        single = (d == Float(0.0f)) | (r == Float(0.0f));
        rest = d - floor(d);
        last = 0;
        for (int k = 0; k < W; ++k) {
            const int n = static_cast<int>(ceil(d)[k]);
            last = n > last ? n : last;
        }
        if (all(single)) last = 0;
    }
    Mask whole(int i) const { return Float(static_cast<float>(i)) <= detail; }
    Mask part(int i) const {
        return ~whole(i) & (Float(static_cast<float>(i)) < detail + 1.0f) & (rest != Float(0.0f));
    }
};

template <class T>
T lerp_all(T a, T b, Float t) {
    return a + (b - a) * t;
}

template <int D>
CellResult cell_octave(Vec4 p, const CellSettings& s, CellFeature feature) {
    if (feature != CellFeature::smooth_f1) return nearest_cell<D>(p, s, feature == CellFeature::f2);
    const Mask rough = s.smoothness == Float(0.0f);
    CellResult r = smooth_cell<D>(p, s);
    if (none(rough)) return r;
    const CellResult plain = nearest_cell<D>(p, s, false);
    r.distance = select(rough, plain.distance, r.distance);
    r.color = select(rough, plain.color, r.color);
    r.position = select(rough, plain.position, r.position);
    return r;
}

/// Distance, colour and position of the points.
template <int D>
CellResult cells(Vec4 p, const CellSettings& s, const Octaves& o, CellFeature feature, bool normalize) {
    CellResult sum;
    Float amplitude = 1.0f, total = 0.0f, scale = 1.0f;
    for (int i = 0; i <= o.last; ++i) {
        const CellResult c = cell_octave<D>(p * scale, s, feature);
        if (i == 0 && all(o.single)) {
            sum = c;
            total = 1.0f;
            break;
        }
        // A lane's weight of this octave: all, the fractional part, or none.
        const Mask first = mask_of(i == 0);
        const Float share = select(o.single, select(first, Float(1.0f), Float(0.0f)),
                                   select(o.whole(i), Float(1.0f), select(o.part(i), o.rest, Float(0.0f))));
        const Float weight = amplitude * share;
        sum.distance += c.distance * weight;
        sum.color = sum.color + c.color * weight;
        sum.position = lerp_all(sum.position, c.position * (1.0f / scale), weight);
        total += weight;
        scale *= o.lacunarity;
        amplitude *= select(o.single, Float(1.0f), o.roughness);
    }
    if (normalize) {
        const Float half = 0.5f + 0.5f * s.randomness, zero = 0.0f;
        const Vec4 corner = {half, D > 1 ? half : zero, D > 2 ? half : zero, D > 3 ? half : zero};
        const Float far =
            cell_distance<D>(corner, Vec4{zero, zero, zero, zero}, s) * (feature == CellFeature::f2 ? 2.0f : 1.0f);
        sum.distance = sum.distance / (total * far);
        sum.color = sum.color * (1.0f / total);
    }
    return sum;
}

template <int D>
Float edges(Vec4 p, const CellSettings& s, const Octaves& o, bool normalize) {
    const Float most = 0.5f + 0.5f * s.randomness;
    Float amplitude = 1.0f, total = most, scale = 1.0f, distance = 8.0f;
    for (int i = 0; i <= o.last; ++i) {
        const Float d = edge_distance<D>(p * scale, s);
        if (i == 0) {
            distance = select(o.single, d, mix(distance, min(distance, d), amplitude));
        } else {
            const Mask whole = o.whole(i) & ~o.single, part = o.part(i) & ~o.single;
            const Float nearer = mix(distance, min(distance, d / scale), amplitude);
            const Float wider = mix(total, most / scale, amplitude);
            distance = select(whole, nearer, select(part, mix(distance, min(distance, nearer), o.rest), distance));
            total = select(whole, wider, select(part, mix(total, wider, o.rest), total));
        }
        scale *= o.lacunarity;
        amplitude *= o.roughness;
    }
    return normalize ? distance / total : distance;
}

template <int D>
void voronoi(const Machine& m, const Instruction& in) {
    const auto feature = static_cast<CellFeature>(in.imm >> nodes::cell_feature_shift & 0xf);
    const bool normalize = in.imm & nodes::cell_normalize;
    Source a[11];
    for (int k = 0; k < 11; ++k) a[k] = m.arg(in, k);
    for (int i = 0; i < m.end; i += W) {
        const Vec4 p = {a[0].at(i), a[1].at(i), a[2].at(i), a[3].at(i)};
        const Octaves octaves(a[4].at(i), a[5].at(i), a[6].at(i));
        CellSettings s;
        s.metric = static_cast<nodes::CellMetric>(in.imm >> nodes::cell_metric_shift & 0xf);
        s.pcg = in.imm & nodes::cell_pcg;
        s.color = in.imm & nodes::cell_color;
        s.smoothness = a[7].at(i);
        s.exponent = a[8].at(i);
        s.randomness = a[9].at(i);
        CellResult r;
        if (feature == CellFeature::edge)
            r.distance = edges<D>(p, s, octaves, normalize);
        else if (feature == CellFeature::radius)
            r.distance = sphere_radius<D>(p, s);
        else
            r = cells<D>(p, s, octaves, feature, normalize);
        const Float scale = a[10].at(i);
        store(m.dst(in, 0) + i, r.distance);
        store_vec(m, in, 1, i, r.color);
        // Smooth blends shift the unused axes too.
        const auto axis = [&](Float v, int k) { return k < D ? safe_divide(v, scale) : Float(0.0f); };
        store_vec(m, in, 4, i, {axis(r.position.x, 0), axis(r.position.y, 1), axis(r.position.z, 2)});
        store(m.dst(in, 7) + i, axis(r.position.w, 3));
    }
}

}  // namespace

void op_voronoi(const Machine& m, const Instruction& in) {
    switch (in.imm & nodes::cell_dimension_mask) {
        case 1: voronoi<1>(m, in); break;
        case 2: voronoi<2>(m, in); break;
        case 3: voronoi<3>(m, in); break;
        default: voronoi<4>(m, in); break;
    }
}

}  // namespace cardioid::CD_ISA_NS
