// SPDX-License-Identifier: GPL-3.0-or-later
// Colour models, blend modes that are more than arithmetic, tables, and black bodies.
#include "nodes/kernel.h"
#include "nodes/kernel_math.h"

namespace cardioid::CD_ISA_NS {

using nodes::Instruction;

namespace {

template <class F>
void map_color(const Machine& m, const Instruction& in, F f) {
    const Source3 a = m.arg3(in, 0);
    for (int i = 0; i < m.end; i += W) store_vec(m, in, 0, i, f(a.at(i)));
}

Vec3 rgb_to_hsv(Vec3 c) {
    const Float high = max(c.x, max(c.y, c.z)), low = min(c.x, min(c.y, c.z)), delta = high - low;
    const Float s = safe_divide(delta, high);
    const Float inv = select(delta != Float(0.0f), 1.0f / delta, Float(0.0f));
    const Vec3 d = {(high - c.x) * inv, (high - c.y) * inv, (high - c.z) * inv};
    Float h = select(c.x == high, d.z - d.y, select(c.y == high, 2.0f + d.x - d.z, 4.0f + d.y - d.x)) * (1.0f / 6.0f);
    h = select(h < Float(0.0f), h + 1.0f, h);
    return {select(s != Float(0.0f), h, Float(0.0f)), s, high};
}

Vec3 hsv_to_rgb(Vec3 c) {
    const Float s = c.y, v = c.z;
    const Float h = select(c.x == Float(1.0f), Float(0.0f), c.x) * 6.0f;
    const Float i = floor(h), f = h - i;
    const Float p = v * (1.0f - s), q = v * (1.0f - s * f), t = v * (1.0f - s * (1.0f - f));
    Vec3 r = {v, p, q};
    r = select(i == Float(4.0f), Vec3{t, p, v}, r);
    r = select(i == Float(3.0f), Vec3{p, q, v}, r);
    r = select(i == Float(2.0f), Vec3{p, v, t}, r);
    r = select(i == Float(1.0f), Vec3{q, v, p}, r);
    r = select(i == Float(0.0f), Vec3{v, t, p}, r);
    return select(s != Float(0.0f), r, Vec3{v, v, v});
}

Vec3 rgb_to_hsl(Vec3 c) {
    const Float high = max(c.x, max(c.y, c.z)), low = min(c.x, min(c.y, c.z)), delta = high - low, sum = high + low;
    const Float l = min(sum * 0.5f, 1.0f);
    const Mask grey = high == low;
    const Float s = delta / select(grey, Float(1.0f), select(l > Float(0.5f), 2.0f - high - low, sum));
    const Float d = select(grey, Float(1.0f), delta);
    const Float red = (c.y - c.z) / d + select(c.y < c.z, Float(6.0f), Float(0.0f));
    const Float h =
        select(high == c.x, red, select(high == c.y, (c.z - c.x) / d + 2.0f, (c.x - c.y) / d + 4.0f)) * (1.0f / 6.0f);
    return {select(grey, Float(0.0f), h), select(grey, Float(0.0f), s), l};
}

Vec3 hsl_to_rgb(Vec3 c) {
    const Float h = c.x * 6.0f, l = c.z;
    const Float r = saturate(abs(h - 3.0f) - 1.0f), g = saturate(2.0f - abs(h - 2.0f)),
                b = saturate(2.0f - abs(h - 4.0f));
    const Float chroma = (1.0f - abs(2.0f * l - 1.0f)) * c.y;
    return {(r - 0.5f) * chroma + l, (g - 0.5f) * chroma + l, (b - 0.5f) * chroma + l};
}

/// Position in a table of n entries: the entry and the way to the next.
struct TablePlace {
    Int entry;
    Float t;
    TablePlace(Float x, int n) {
        const Float f = saturate(x) * static_cast<float>(n - 1);
        entry = min(to_int(f), Int(n - 2));
        t = f - to_float(entry);
    }
};

}  // namespace

void op_rgb_to_hsv(const Machine& m, const Instruction& in) { map_color(m, in, rgb_to_hsv); }
void op_hsv_to_rgb(const Machine& m, const Instruction& in) { map_color(m, in, hsv_to_rgb); }
void op_rgb_to_hsl(const Machine& m, const Instruction& in) { map_color(m, in, rgb_to_hsl); }
void op_hsl_to_rgb(const Machine& m, const Instruction& in) { map_color(m, in, hsl_to_rgb); }

void op_mix_overlay(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float t) {
        const Float rest = 1.0f - t;
        return select(a < Float(0.5f), a * (rest + 2.0f * t * b), 1.0f - (rest + 2.0f * t * (1.0f - b)) * (1.0f - a));
    });
}
void op_mix_divide(const Machine& m, const Instruction& in) {
    map3(m, in,
         [](Float a, Float b, Float t) { return select(b != Float(0.0f), (1.0f - t) * a + t * safe_divide(a, b), a); });
}
void op_mix_dodge(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float t) {
        const Float rest = 1.0f - t * b;
        const Float r = select(rest <= Float(0.0f), Float(1.0f), min(safe_divide(a, rest), 1.0f));
        return select(a != Float(0.0f), r, a);
    });
}
void op_mix_burn(const Machine& m, const Instruction& in) {
    map3(m, in, [](Float a, Float b, Float t) {
        const Float rest = 1.0f - t + t * b;
        return select(rest <= Float(0.0f), Float(0.0f), saturate(1.0f - safe_divide(1.0f - a, rest)));
    });
}

/// A table of colours with alpha, `table_entries(imm)` of them; bit 0 of imm: interpolate between entries.
void op_ramp(const Machine& m, const Instruction& in) {
    const Source x = m.arg(in, 0);
    const float* table = m.view.data + in.data;
    const int n = nodes::table_entries(in.imm);
    for (int i = 0; i < m.end; i += W) {
        TablePlace at(x.at(i), n);
        if ((in.imm & 1) == 0) {
            at.entry = select(at.t >= Float(1.0f), at.entry + Int(1), at.entry);
            at.t = 0.0f;
        }
        const Int a = at.entry * Int(4), b = min(at.entry + Int(1), Int(n - 1)) * Int(4);
        for (int k = 0; k < 4; ++k) {
            const Float low = gather(table + k, a), high = gather(table + k, b);
            store(m.dst(in, k) + i, (1.0f - at.t) * low + at.t * high);
        }
    }
}

/// A table of numbers over [0, 1], `table_entries(imm)` of them; bit 0 of imm: goes on in a straight line outside.
void op_curve(const Machine& m, const Instruction& in) {
    const Source source = m.arg(in, 0);
    const float* table = m.view.data + in.data;
    const int n = nodes::table_entries(in.imm);
    for (int i = 0; i < m.end; i += W) {
        const Float x = source.at(i);
        const TablePlace at(x, n);
        Float y = (1.0f - at.t) * gather(table, at.entry) + at.t * gather(table, at.entry + Int(1));
        if ((in.imm & 1) != 0) {
            const float steps = static_cast<float>(n - 1);
            y = select(x < Float(0.0f), Float(table[0]) + Float(table[1] - table[0]) * x * steps, y);
            y = select(x > Float(1.0f), Float(table[n - 1]) + Float(table[n - 1] - table[n - 2]) * (x - 1.0f) * steps,
                       y);
        }
        store(m.dst(in) + i, y);
    }
}

/// Rec.709 colour of a black body at a temperature in kelvin: rational fits over seven ranges (data of nodes_color.cpp).
void op_blackbody(const Machine& m, const Instruction& in) {
    const float* data = m.view.data + in.data;
    map_color(m, in, [&](Vec3 v) {
        const Float t = clamp(v.x, 1.0f, 12000.0f), inv = 1.0f / t;
        Int range(0);
        constexpr float k_limits[] = {965.0f, 1167.0f, 1449.0f, 1902.0f, 3315.0f, 6365.0f};
        for (const float limit : k_limits) range = select(t >= Float(limit), range + Int(1), range);
        const Int at = range * Int(10);
        const auto c = [&](int k) { return gather(data + k, at); };
        Vec3 rgb = {c(0) * inv + c(1) * t + c(2), c(3) * inv + c(4) * t + c(5),
                    ((c(6) * t + c(7)) * t + c(8)) * t + c(9)};
        rgb = select(t >= Float(12000.0f), Vec3{0.8262954810464208f, 0.9945080501520986f, 1.566307710274283f}, rgb);
        rgb = select(t < Float(800.0f), Vec3{5.413294490189271f, -0.20319390035873933f, -0.0822535242887164f}, rgb);
        return Vec3{max(rgb.x, 0.0f), max(rgb.y, 0.0f), max(rgb.z, 0.0f)};
    });
}

/// XYZ of a spectral line as linear Rec.709 without negative channels, scaled so that none is above 1.
void op_wavelength(const Machine& m, const Instruction& in) {
    constexpr int k_last = 80;
    const float* data = m.view.data + in.data;
    const Source nm = m.arg(in, 0);
    for (int i = 0; i < m.end; i += W) {
        const Float place = (nm.at(i) - 380.0f) * 0.2f;
        const Mask inside = (place > Float(-1.0f)) & (place < Float(float(k_last)));
        const Int cell = to_int(select(inside, truncate(place), Float(0.0f)));
        const Float t = place - to_float(cell);
        const auto c = [&](int k) {
            return mix(gather(data + k, cell * Int(3)), gather(data + k + 3, cell * Int(3)), t);
        };
        const Float x = c(0), y = c(1), z = c(2), zero(0.0f);
        const auto channel = [&](float a, float b, float d) {
            return select(inside, max((a * x + b * y + d * z) * (1.0f / 2.52f), zero), zero);
        };
        store_vec(m, in, 0, i,
                  {channel(3.2404542f, -1.5371385f, -0.4985314f), channel(-0.9692660f, 1.8760108f, 0.0415560f),
                   channel(0.0556434f, -0.2040259f, 1.0572252f)});
    }
}

}  // namespace cardioid::CD_ISA_NS
