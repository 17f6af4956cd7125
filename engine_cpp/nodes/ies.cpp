// SPDX-License-Identifier: GPL-3.0-or-later
// As forgiving as Cycles: whatever ranges of angles a file has are mirrored and shifted to type C.
#include "nodes/ies.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cardioid::nodes {

namespace {

using Table = std::vector<std::vector<float>>;  ///< by horizontal angle

constexpr long k_most_angles = 100000;
/// Candela to watts of a lamp: 4π over the luminous efficacy of D65, 177.83 lm/W.
constexpr double k_watts = 0.0706650768394;

class Numbers {
public:
    explicit Numbers(const char* at) : at_(at) {}
    double next() {
        char* end = nullptr;
        const double v = std::strtod(at_, &end);
        ok_ = ok_ && end != at_;
        at_ = end;
        return ok_ ? v : 0;
    }
    long whole() { return static_cast<long>(std::clamp(next(), -1e6, 1e6)); }
    bool ok() const { return ok_; }

private:
    const char* at_;
    bool ok_ = true;
};

struct Photometry {
    std::vector<float> h, v;
    Table value;
};

bool close(float a, float b) { return std::abs(a - b) < 1e-4f; }

/// Angles from 0 are mirrored about it; then -90…90 becomes 0…180.
template <class Mirror>
void shift_right_angle(std::vector<float>& angles, Mirror mirror_values) {
    const bool half = close(angles[0], 0);
    const std::vector<float> old = angles;
    angles.clear();
    if (half) {
        for (std::size_t i = old.size(); i-- > 1;) angles.push_back(90 - old[i]);
        mirror_values();
    }
    for (const float a : old) angles.push_back(90 + a);
}

void mirror(std::vector<float>& row) {
    std::vector<float> whole(row.rbegin(), row.rend() - 1);
    whole.insert(whole.end(), row.begin(), row.end());
    row.swap(whole);
}

/// Type B has a horizontal polar axis: the angles change places.
void from_type_b(Photometry& p) {
    Table turned(p.v.size());
    for (std::size_t i = 0; i < p.v.size(); ++i)
        for (std::size_t j = 0; j < p.h.size(); ++j) turned[i].push_back(p.value[j][i]);
    p.value.swap(turned);
    p.h.swap(p.v);
    shift_right_angle(p.h, [&] {
        Table whole(p.value.rbegin(), p.value.rend() - 1);
        whole.insert(whole.end(), p.value.begin(), p.value.end());
        p.value.swap(whole);
    });
    shift_right_angle(p.v, [&] {
        for (auto& row : p.value) mirror(row);
    });
}

void from_type_a(Photometry& p) {
    for (float& v : p.v) v += 90;
    Photometry turned;
    for (std::size_t i = p.h.size(); i-- > 0;) {
        turned.h.push_back(180 - p.h[i]);
        turned.value.push_back(p.value[i]);
    }
    if (close(p.h[0], 0)) {
        for (std::size_t i = 1; i < p.h.size(); ++i) {
            turned.h.push_back(180 + p.h[i]);
            turned.value.push_back(p.value[i]);
        }
    }
    p.h.swap(turned.h);
    p.value.swap(turned.value);
}

/// Appends the angles mirrored at the last one.
void mirror_at_end(Photometry& p, float sum) {
    for (std::size_t i = p.h.size() - 1; i-- > 0;) {
        p.h.push_back(sum - p.h[i]);
        p.value.push_back(p.value[i]);
    }
}

void from_type_c(Photometry& p) {
    if (close(p.h[0], 90))
        for (float& h : p.h) h -= 90;
    if (p.h.size() == 1) {
        p.h = {0, 360};
        p.value.push_back(p.value[0]);
    }
    if (close(p.h.back(), 90)) mirror_at_end(p, 180);
    if (close(p.h.back(), 180)) mirror_at_end(p, 360);
    // Some files leave out 360°, which is 0° again.
    if (!close(p.h[0], 0) || close(p.h.back(), 360)) return;
    const float gap = 360 - p.h.back();
    if (close(p.h.back() - p.h[p.h.size() - 2], gap) || close(p.h[1] - p.h[0], gap)) {
        p.h.push_back(360);
        p.value.push_back(p.value[0]);
    }
}

/// Where the numbers begin: behind the TILT line and its table.
const char* after_tilt(const std::string& text) {
    const std::size_t tilt = text.find("\nTILT=");
    if (tilt == std::string::npos) return nullptr;
    const std::size_t line = text.find('\n', tilt + 1);
    if (line == std::string::npos) return nullptr;
    return text.c_str() + line + 1;
}

bool read(Numbers& in, bool tilt_table, Photometry& p, long& type) {
    if (tilt_table) {
        in.next();
        for (long n = 2 * std::clamp(in.whole(), 0l, k_most_angles); n > 0; --n) in.next();
    }
    in.next();  // lamps
    in.next();  // lumens of each
    double factor = in.next();
    const long v = in.whole(), h = in.whole();
    type = in.whole();
    for (int k = 0; k < 4; ++k) in.next();  // unit and size
    factor *= in.next();
    factor *= in.next() * k_watts;
    in.next();  // watts
    if (!in.ok() || v < 1 || h < 1 || v > k_most_angles || h > k_most_angles / v * 10) return false;
    for (long k = 0; k < v; ++k) p.v.push_back(static_cast<float>(in.next()));
    for (long k = 0; k < h; ++k) p.h.push_back(static_cast<float>(in.next()));
    for (long i = 0; i < h && in.ok(); ++i) {
        p.value.emplace_back();
        for (long j = 0; j < v; ++j) p.value.back().push_back(static_cast<float>(factor * in.next()));
    }
    return in.ok();
}

}  // namespace

std::vector<float> parse_ies(const std::string& file) {
    std::string text = file;
    std::replace(text.begin(), text.end(), ',', ' ');
    const char* start = after_tilt(text);
    if (start == nullptr) return {};
    const std::size_t tilt = text.find("\nTILT=");
    Numbers in(start);
    Photometry p;
    long type = 0;
    if (!read(in, text.compare(tilt, 13, "\nTILT=INCLUDE") == 0, p, type)) return {};
    if (type == 1)
        from_type_c(p);
    else if (type == 2)
        from_type_b(p);
    else if (type == 3)
        from_type_a(p);
    else
        return {};
    if (p.h.size() < 2 || p.v.size() < 2) return {};
    std::vector<float> data = {static_cast<float>(p.h.size()), static_cast<float>(p.v.size())};
    for (const auto* angles : {&p.h, &p.v})
        for (const float a : *angles) data.push_back(a * 3.14159265358979f / 180);
    for (const auto& row : p.value) data.insert(data.end(), row.begin(), row.end());
    return data;
}

}  // namespace cardioid::nodes
