// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/spread.h"

#include "filter/tile.h"

#include <algorithm>
#include <cmath>

namespace cardioid::filter {

namespace {

/// Sums over 2 · half + 1 neighbours of a line of n values, `step` floats apart; zero outside.
void box(float* line, int n, int step, int half, std::vector<double>& sums) {
    sums.assign(static_cast<std::size_t>(n) + 1, 0.0);
    for (int i = 0; i < n; ++i)
        sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + static_cast<double>(line[i * step]);
    for (int i = 0; i < n; ++i) {
        const auto first = static_cast<std::size_t>(std::max(0, i - half)),
                   last = static_cast<std::size_t>(std::min(n, i + half + 1));
        // Sums of nothing are nothing, whatever was rounded before them.
        line[i * step] = static_cast<float>(std::max(0.0, sums[last] - sums[first]));
    }
}

/// Three boxes of this half width have about the variance of the Gaussian.
int half_width(float deviation) {
    return std::max(
        1,
        static_cast<int>(std::lround(0.5 * (std::sqrt(4.0 * static_cast<double>(deviation * deviation) + 1.0) - 1.0))));
}

bool blur(std::vector<float>& plane, int width, int height, int half, const ForEach& for_each) {
    constexpr int k_lines = 32;
    const auto lines = [&](int count, const std::function<void(int)>& body) {
        return for_each((count + k_lines - 1) / k_lines, [&](int group) {
            for (int i = group * k_lines; i < std::min(count, (group + 1) * k_lines); ++i) body(i);
        });
    };
    const auto rows = [&](int y) {
        std::vector<double> sums;
        for (int i = 0; i < 3; ++i) box(plane.data() + static_cast<std::ptrdiff_t>(y) * width, width, 1, half, sums);
    };
    const auto columns = [&](int x) {
        std::vector<double> sums;
        for (int i = 0; i < 3; ++i) box(plane.data() + x, height, width, half, sums);
    };
    return lines(height, rows) && lines(width, columns);
}

}  // namespace

void withheld_light(const film::Film& film, const Rejection& rejection, int x, int y, float (&rgb)[3]) {
    std::fill_n(rgb, 3, 0.0f);
    for (int l = 0; l < film::k_layers; ++l) {
        const unsigned bits = rejection.withheld(x, y, l);
        if (bits == 0) continue;
        const auto clusters = film.clusters().view(x, y, l);
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            for (int k = 0; k < 3 && (bits >> i & 1) != 0; ++k) rgb[k] += clusters[i].radiance[k];
        }
    }
    const auto taken = static_cast<float>(film.samples(x, y));
    for (float& c : rgb) c = taken > 0 ? c / taken : 0;
}

namespace {

/// The most by which one pixel's withheld light may brighten its surroundings, of their own light; what is above is left out.
constexpr float k_largest_share = 0.25f;

/// What of a pixel's withheld light is spread. A value that would outshine its surroundings even then is no estimate of them.
void light_to_spread(const film::Film& film, const Rejection& rejection, const Picture& picture, int x, int y,
                     float area, float (&rgb)[3]) {
    withheld_light(film, rejection, x, y, rgb);
    const float withheld = film::luminance(rgb);
    if (withheld <= 0) return;
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
    float around[3] = {};
    for (const auto& layer : picture.layer) {
        for (std::size_t k = 0; k < 3; ++k) around[k] += layer[k][i];
    }
    const float most = k_largest_share * area * std::max(film::luminance(around), 0.0f);
    for (float& c : rgb) c *= std::min(1.0f, most / withheld);
}

}  // namespace

bool spread_withheld(const film::Film& film, const Rejection& rejection, const Picture& picture, float width,
                     const ForEach& for_each, std::vector<float> (&rgb)[3]) {
    const int w = picture.width, h = picture.height, half = half_width(width);
    const auto size = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
    for (auto& plane : rgb) plane.assign(size, 0.0f);
    if (std::all_of(rejection.bits.begin(), rejection.bits.end(), [](std::uint8_t b) { return b == 0; })) return true;
    const float area = 6.2831853f * width * width;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
            float light[3];
            light_to_spread(film, rejection, picture, x, y, area, light);
            for (std::size_t k = 0; k < 3; ++k) {
                if (picture.detail[k][i] > k_darkest_detail) rgb[k][i] = light[k];
            }
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<float>& detail = picture.detail[k];
        std::vector<float> around(size);
        for (std::size_t i = 0; i < size; ++i) around[i] = detail[i] > k_darkest_detail ? detail[i] : 0.0f;
        if (!blur(around, w, h, half, for_each)) return false;
        // Divided by the detail around where the light comes from: what a pixel loses its surroundings gain, at borders too.
        for (std::size_t i = 0; i < size; ++i) rgb[k][i] = around[i] > 0 ? rgb[k][i] / around[i] : 0.0f;
        if (!blur(rgb[k], w, h, half, for_each)) return false;
        for (std::size_t i = 0; i < size; ++i) rgb[k][i] *= detail[i] > k_darkest_detail ? detail[i] : 0.0f;
    }
    return true;
}

}  // namespace cardioid::filter
